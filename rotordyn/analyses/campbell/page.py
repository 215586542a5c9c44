"""Page of the Campbell diagram: its critical speeds, modes, and animated shapes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from rotordyn.analyses.campbell.figures import headline_curves
from rotordyn.analyses.campbell.figures.diagram import (
    critical_hertz,
    highest,
    orders,
    shown_criticals,
)
from rotordyn.analyses.campbell.result import CampbellResult
from rotordyn.arrays import Array, Complex
from rotordyn.figures.mode_lines import KNOWN, LONE, jumps, look_of
from rotordyn.machine.spindle import Spindle
from rotordyn.page.blocks import Block, Chart, Control, Shapes, Table, Text
from rotordyn.page.curves import curve_charts, once_named
from rotordyn.page.looks import COLOURS, FAINT, FEW_POINTS, INK, axis
from rotordyn.results.described import Shown
from rotordyn.results.display import RPM, number
from rotordyn.results.frames import turning
from rotordyn.results.headline import broken
from rotordyn.results.text import from_to
from rotordyn.surface.body import together
from rotordyn.surface.motion import drawn_scale
from rotordyn.surface.several import holders, section_motions, surfaces

_LINES = {
    "forward": (COLOURS[0], "solid"),
    "backward": (COLOURS[1], "dash"),
    "planar": (INK, "dot"),
    "axial": (COLOURS[2], "dashdot"),
    "torsion": (COLOURS[3], "longdashdot"),
}
_MARKS = {"^": "triangle-up", "v": "triangle-down", "o": "circle", ">": "triangle-right"}
_MARKS |= {"D": "diamond", "s": "square"}
_WHIRL = {1: "forward whirl", -1: "backward whirl"}
AMPLITUDE = 0.08  # of a shape, over the length of the shaft
FACETS = 16


def page(spec: Any, variants: Sequence[Shown]) -> Iterator[Block]:
    """Yield the diagram of one machine, or of all overlaid; lists of every one."""
    if len(variants) == 1:
        yield _diagram(spec, variants[0])
    else:
        yield from curve_charts(headline_curves, spec, variants)
    for variant in variants:
        title = f"{variant.title}: " if len(variants) > 1 else ""
        if not title or len(variant.result.critical):
            yield from _criticals(variant.result, title)
        yield from _modes(variant.result, title, folded=len(variants) > 1)
    yield from _shapes(variants[0], variants[0].title if len(variants) > 1 else "")


def _diagram(spec: Any, variant: Shown) -> Chart:
    result: CampbellResult = variant.result
    rpm, top = result.speed * RPM.factor, getattr(spec, "max_frequency", 0.0) or highest([result])
    excited, last = orders(result, getattr(spec, "teeth", ())), np.array([0.0, rpm[-1]])
    traces = [
        {"x": last, "y": order * last / 60.0, "name": name, "mode": "lines", "showlegend": False}
        | {"line": {"color": FAINT, "width": 1.2, "dash": "dot"}}
        for order, name in excited.items()
    ]
    traces += [
        {"x": rpm, "y": hertz, "name": name, "mode": "lines", "visible": "legendonly"}
        | {"line": {"color": FAINT, "width": 1.0, "dash": "dash"}}
        for name, hertz in zip(result.passing, result.passing_frequency.T, strict=True)
        if not turning(result)
    ]
    traces += [_mode(result, k) for k in np.flatnonzero(~result.mostly_overdamped).tolist()]
    if result.unstable.any():
        traces.append(_unstable(result))
    traces += [*_critical_marks(result), *([] if turning(result) else once_named(_known(variant)))]
    layout: dict[str, Any] = {
        "xaxis": axis("speed", "rpm", range=[0.0, max(float(rpm[-1]), 1.0) * 1.01]),
        "yaxis": axis("damped frequency", "Hz", range=[0.0, top]),
        "annotations": [
            {"x": x, "y": y, "text": name, "showarrow": False, "xanchor": "right"}
            | {"yanchor": "bottom", "font": {"color": FAINT, "size": 12}}
            for x, y, name in _ends(excited, float(rpm[-1]), top)
        ],
    }
    note = "Solid: forward whirl, dashed: backward; move the pointer over a curve for its damping."
    return Chart("Campbell diagram", traces, layout, note=note, wide=True, tall=560)


def _ends(
    orders: Mapping[float, str], rpm: float, top: float
) -> Iterator[tuple[float, float, str]]:
    """Yield where a line of excitation leaves the diagram, and its name."""
    for order, name in orders.items():
        end = min(rpm, 60.0 * top / order) if order > 0.0 else rpm
        yield end, order * end / 60.0, name


def _mode(result: CampbellResult, k: int) -> dict[str, Any]:
    rpm, hertz = result.speed * RPM.factor, result.frequency[:, k]
    look = look_of(result.kind[k], result.whirl[-1, k])
    colour, dash = _LINES[look]
    breaks = jumps(result)[:, k]
    x, y = broken(rpm, hertz, breaks)
    hints = [
        f"{_WHIRL.get(_sign(w), result.kind[k])}, damping ratio {100.0 * ratio:.3g} %"
        for w, ratio in zip(result.whirl[:, k], result.damping_ratio[:, k], strict=True)
    ]
    at = np.flatnonzero(breaks) + 1
    texts = np.insert(np.array(hints, dtype=object), at, "") if at.size else hints
    trace = {"x": x, "y": y, "name": result.mode[k], "text": [str(text) for text in texts]}
    if len(rpm) < FEW_POINTS:
        return trace | {
            "mode": "markers",
            "marker": {"symbol": _MARKS[LONE[look]], "color": colour},
        }
    return trace | {"mode": "lines", "line": {"color": colour, "dash": dash, "width": 1.8}}


def _sign(whirl: float) -> int:
    return int(whirl) if np.isfinite(whirl) else 0


def _unstable(result: CampbellResult) -> dict[str, Any]:
    rpm = np.broadcast_to((result.speed * RPM.factor)[:, None], result.frequency.shape)
    marker = {"symbol": "x-thin-open", "size": 9, "color": COLOURS[1], "line": {"width": 2}}
    at = result.unstable
    return {"x": rpm[at], "y": result.frequency[at], "name": "unstable", "mode": "markers"} | {
        "marker": marker
    }


def _critical_marks(result: CampbellResult) -> list[dict[str, Any]]:
    shown = shown_criticals(result)
    if not shown:
        return []
    numbers = [str(number) for number in range(1, len(shown) + 1)]
    return [
        {
            "x": result.critical_speed[shown] * RPM.factor,
            "y": np.array([critical_hertz(result, k) for k in shown]) * (not turning(result)),
            "text": numbers,
            "hovertext": [result.critical[k] for k in shown],
            "mode": "markers+text",
            "textposition": "bottom right",
            "name": "critical speed, numbered",
            "marker": {"symbol": "circle-open", "size": 11, "color": INK, "line": {"width": 2}},
        }
    ]


def _known(variant: Shown) -> list[dict[str, Any]]:
    return [
        {
            "x": np.asarray(reference.speeds) * RPM.factor,
            "y": np.asarray(reference.values),
            "name": f"{reference.kind}{KNOWN[reference.quantity][1]}",
            "text": reference.source,
            "mode": "markers",
            "marker": {
                "symbol": f"{_MARKS[KNOWN[reference.quantity][0]]}-open",
                "size": 10,
                "color": INK,
                "line": {"width": 2},
            },
        }
        for reference in variant.known
        if reference.quantity in KNOWN
    ]


def _criticals(result: CampbellResult, title: str) -> Iterator[Block]:
    """Yield every critical speed, also beyond the top speed and without excitation."""
    if len(result.speed) < 2:
        return
    top, marked = float(result.speed[-1]), shown_criticals(result)
    rows = []
    for k in np.argsort(result.critical_speed, kind="stable").tolist():
        speed, rotor = float(result.critical_speed[k]), result.critical_rotor[k]
        by = f"{result.critical_order[k]:g}×" + (f" {rotor}" if len(result.rotor) > 1 else "")
        rows.append(
            [
                str(marked.index(k) + 1) if k in marked else "–",
                number(speed * RPM.factor, 0),
                number(critical_hertz(result, k)),
                result.critical[k],
                result.critical_whirl[k],
                by,
                f"{100.0 * result.critical_damping[k]:.3g}",
                f"{(speed / top - 1.0) * 100.0:+.0f}" if top > 0.0 else "",
                "yes" if result.critical_excited[k] else "no",
            ]
        )
    heads = ["no.", "speed [rpm]", "frequency [Hz]", "mode", "whirl", "order", "damping ratio [%]"]
    heads += ["margin to top speed [%]", "excited"]
    name = f"{title}critical speeds" if title else "Critical speeds"
    if rows:
        yield Table(name, heads, rows)
    else:
        yield Text(["None within the given speeds and frequencies."], title=name)


def _modes(result: CampbellResult, title: str, *, folded: bool) -> Iterator[Table]:
    rows = [
        [
            result.mode[k],
            result.character[k],
            from_to(result.frequency[:, k]),
            from_to(100.0 * result.damping_ratio[:, k], 2),
        ]
        for k in np.flatnonzero(~result.mostly_overdamped).tolist()
    ]
    ends = from_to(result.speed * RPM.factor, 0)
    heads = ["mode", "character", f"frequency [Hz] at {ends} rpm", "damping ratio [%]"]
    yield Table(f"{title}modes" if title else "Modes", heads, rows, folded=folded)


def _shapes(variant: Shown, title: str) -> Iterator[Shapes]:
    """Yield every mode at every speed of its shapes; only motions of cross-sections are stored."""
    result: CampbellResult = variant.result
    exists = np.asarray(np.isfinite(result.shape).all(axis=(2, 3)))
    if variant.spindle is None or not exists.any():
        return
    parts = surfaces(variant.spindle, FACETS)
    stations = {name: np.unique(part.station) for name, part in parts.items()}
    offsets = np.cumsum([0, *map(len, stations.values())])
    section = [
        first + np.searchsorted(stations[name], part.station)
        for first, (name, part) in zip(offsets, parts.items(), strict=False)
    ]
    fixed = holders(variant.spindle, FACETS)
    rows = np.flatnonzero(exists.any(axis=1)).tolist()
    columns = np.flatnonzero(exists.any(axis=0)).tolist()
    speeds = [f"{rpm:.0f} rpm" for rpm in result.shape_speed[rows] * RPM.factor]
    captions = [
        f"{result.mode[m]} at {speed}" if exists[s, m] else "There is no such mode at this speed."
        for m in columns
        for s, speed in zip(rows, speeds, strict=True)
    ]
    yield Shapes(
        f"Mode shapes, {title}" if title else "Mode shapes",
        [Control("mode", [result.mode[k] for k in columns]), Control("speed", speeds, slider=True)],
        points=together(list(parts.values())).points,
        triangles=together(list(parts.values())).triangles,
        place=np.concatenate(section),
        station=np.concatenate(list(stations.values())),
        motion=np.array(
            [[_motion(variant.spindle, stations, result, s, m) for s in rows] for m in columns]
        ),
        still_points=np.zeros((0, 3)) if fixed is None else fixed.points,
        still_triangles=np.zeros((0, 3), np.intp) if fixed is None else fixed.triangles,
        words=captions,
        note="Drag to turn. Displacements are exaggerated; a period takes two seconds.",
    )


def _motion(
    spindle: Spindle, stations: Mapping[str, Array], result: CampbellResult, speed: int, mode: int
) -> Complex:
    """Return displacements of the cross-sections as drawn, NaN where the mode does not exist."""
    shape = result.shape[speed, mode]
    motion = section_motions(spindle, stations, result.node, result.node_rotor, shape)
    if not np.isfinite(shape).all():
        return motion
    length = AMPLITUDE * (spindle.shaft.end - spindle.shaft.start)
    return motion * drawn_scale(motion[:, :3], shape, length)
