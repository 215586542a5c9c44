"""Intervals of a run: ranges of numbers, effects of single tolerances, bands of curves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from rotordyn.arrays import Array
from rotordyn.job.results import Part
from rotordyn.job.values import named_curves, shown_of
from rotordyn.page.blocks import Block, Chart, Control, Markup, Table, Text
from rotordyn.page.curves import MOST_CHARTS, edge_of, known_marks
from rotordyn.page.looks import COLOURS, FAINT, axis, colour, line, logarithmic, marks_only
from rotordyn.report.interval import interval_doubts, interval_over, interval_ranges
from rotordyn.results.headline import FAR, Curve
from rotordyn.results.interval import OVER_HYPOTHESES, OVER_TOLERANCES, Interval, short_path

MOST, BARS = 24, 10  # numbers to choose from, sources of each
FEW = 4  # curves of a small chart
SEEN = 3e-3  # of the largest change of a number: less is no bar
GREY, OPAQUE = "#8A8A8A", 0.35
BAR, ROOM = 26, 130  # px of a bar, and of what surrounds them
Lists = list[list[float]]


def interval_blocks(parts: Mapping[str, Part], held: Mapping[str, Interval]) -> Iterator[Block]:
    """Yield the blocks of every part with an interval."""
    for name, sure in held.items():
        part = parts[name]
        of = f"{part.case.title or name}: " if name else ""
        yield Text([f"{of}Over {interval_over(sure)}; {sure.runs} machines solved."])
        head, *rows = interval_ranges(sure)
        if rows:
            yield Table(f"{of}Ranges of the numbers that vary most", head, rows)
        if doubts := list(interval_doubts(sure)):
            yield Text(doubts, listed=True)
        if chosen := sure.apart(sure.varying())[:MOST]:
            yield _tornado(f"{of}Largest influences on a number", sure, chosen)
        yield from _bands(of, part, sure)


def _tornado(title: str, held: Interval, chosen: Sequence[int]) -> Chart:
    """Tornado chart of a selected number: change by source, the largest on top."""
    several = len(held.combination) > 1
    bars = [_bars(held, k, several=several) for k in chosen]
    kinds = [(f"at its {end} value", COLOURS[k]) for k, end in enumerate(held.end)]
    kinds += [(OVER_HYPOTHESES, GREY)] * several
    traces = [
        {
            "type": "bar",
            "orientation": "h",
            "name": name,
            "marker": {"color": shade},
            "hovertemplate": Markup("%{y}: %{x:.4g}<extra></extra>"),
            "moving": {
                "y": [names for names, _, _ in bars],
                "base": [bases[kind] for _, bases, _ in bars],
                "x": [lengths[kind] for _, _, lengths in bars],
            },
        }
        for kind, (name, shade) in enumerate(kinds)
    ]
    layout = {
        "barmode": "overlay",
        "xaxis": axis(""),
        "yaxis": {"autorange": "reversed"},
        "moving": {"xaxis.title.text": [f"change [{held.unit[k] or '–'}]" for k in chosen]},
    }
    most = max(len(names) for names, _, _ in bars)
    controls = [Control("number", [held.number[k] for k in chosen])]
    return Chart(title, traces, layout, controls, wide=True, tall=ROOM + BAR * most)


def _bars(held: Interval, k: int, *, several: bool) -> tuple[list[str], Lists, Lists]:
    """Names of the bars of a number, and for each kind their starts and lengths."""
    effects = np.nan_to_num(held.effect[k])
    size = np.abs(effects).max(axis=1, initial=0.0)
    order = [int(s) for s in np.argsort(-size, kind="stable")[:BARS]]
    sources = [s for s in order if size[s] > SEEN * size.max()]
    names = [short_path(held.source[s]) for s in sources]
    lengths, bases = [*effects[sources].T.tolist()], [[0.0] * len(sources) for _ in held.end]
    if several:
        low, high = (float(end) for end in held.hypotheses[k] - held.nominal[k])
        names = ["hypotheses", *names]
        none = [0.0] * len(sources)
        lengths = [*([0.0, *each] for each in lengths), [high - low, *none]]
        bases = [*([0.0, *each] for each in bases), [low, *none]]
    return names, bases, lengths


def _bands(of: str, part: Part, held: Interval) -> Iterator[Chart]:
    """Yield charts of headline curves with their bands."""
    panels: dict[tuple[str, ...], list[tuple[Curve, int]]] = {}
    for name, result in part.results.items():
        for key, curve in named_curves(part.case, name, result):
            if key in held.curve:
                panel = (curve.figure, curve.panel, curve.label, curve.title)
                panels.setdefault(panel, []).append((curve, held.curve.index(key)))
    for curves in list(panels.values())[:MOST_CHARTS]:
        yield _band_chart(of, part, held, curves)


def _band_chart(of: str, part: Part, held: Interval, curves: list[tuple[Curve, int]]) -> Chart:
    first = curves[0][0]
    traces: list[dict[str, Any]] = []
    names = [curve.series or curve.key or curve.label for curve, _ in curves]
    for name, (curve, which) in zip(names, curves, strict=True):
        place = list(dict.fromkeys(names)).index(name)
        rows = held.rows_of(which)
        x, y = held.x[rows], _drawable(held.curve_nominal[rows], curve)
        for ends, words, shade in (
            (held.curve_hypotheses[rows], OVER_HYPOTHESES, GREY),
            (held.curve_tolerances[rows], OVER_TOLERANCES, colour(place)),
        ):
            if (np.ptp(ends, axis=1) > 0.0).any():
                traces.append({**_band(x, _drawable(ends, curve), shade), "name": words})
        single = len(x) == 1 or curve.dotted
        drawn = marks_only(place) if single else {"mode": "lines", "line": line(place)}
        traces.append({"x": x, "y": y, "name": name, **drawn})
    for k, trace in enumerate(traces):
        trace["showlegend"] = trace["name"] not in [other["name"] for other in traces[:k]]
    traces += known_marks([(0, curve) for curve, _ in curves], [shown_of(part.case, None)])
    ordinate = logarithmic if first.log else axis
    layout = {"xaxis": axis(first.along), "yaxis": ordinate(first.label, first.unit)}
    if np.isfinite(first.ceiling):  # the axis does not grow for what lies beyond
        layout["yaxis"]["range"] = [0.0, edge_of([curve for curve, _ in curves])]
    title = first.title or (f"{first.panel}: {first.label}" if first.panel else first.label)
    return Chart(f"{of}{title}", traces, layout, wide=first.log or len(curves) > FEW)


def _drawable(values: Array, curve: Curve) -> Array:
    """Values to draw: positive on a logarithmic axis, and up to ``FAR`` times the ceiling."""
    values = np.minimum(values, FAR * curve.ceiling)
    return np.where(values > 0.0, values, np.nan) if curve.log else values


def _band(x: Array, ends: Array, shade: str) -> dict[str, Any]:
    """Trace of the area between two ends; a vertical line if there is one point only."""
    known = np.isfinite(ends).all(axis=1)
    there, back = x[known], ends[known]
    if len(there) == 1:
        return {"x": np.repeat(there, 2), "y": back[0], "mode": "lines", "line": {"color": shade}}
    red, green, blue = (int(shade[k : k + 2], 16) for k in (1, 3, 5))
    return {
        "x": np.concatenate([there, there[::-1]]),
        "y": np.concatenate([back[:, 0], back[::-1, 1]]),
        "mode": "lines",
        "line": {"width": 0, "color": FAINT},
        "fill": "toself",
        "fillcolor": f"rgba({red},{green},{blue},{OPAQUE})",
        "hoverinfo": "skip",
    }
