"""Charts of headline curves: variants in one chart, known values as open markers."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any

import numpy as np

from rotordyn.machine.reference import QUANTITIES, Reference
from rotordyn.page.blocks import Chart
from rotordyn.page.looks import (
    FAINT,
    INK,
    MANY,
    axis,
    colour,
    line,
    logarithmic,
    mark,
    marks_only,
)
from rotordyn.results.described import Shown
from rotordyn.results.display import RPM, shown
from rotordyn.results.headline import Curve, belongs, under

Curves = Callable[[Any, Any], Iterable[Curve]]
Panel = tuple[str, str, str, str]
MOST_CHARTS = 24  # charts of one analysis
ROOM = 1.05  # upper end of an axis over the largest value
ROUNDED = 1e-5  # margin of an axis over its end, so that a marker rounded up is still drawn
BEYOND = "Triangles at the upper edge lie beyond the axis: pointing at them gives their values."
OPEN = {"measured": "circle-open", "published": "diamond-open"}


def curve_charts(curves: Curves, spec: Any, variants: Sequence[Shown]) -> Iterator[Chart]:
    """Yield a chart for every panel, with a line for each curve of each variant."""
    panels: dict[Panel, dict[tuple[int, str, str], Curve]] = {}
    for place, variant in enumerate(variants):
        for curve in curves(spec, variant):
            if curve.backdrop and place:
                continue
            by_curve = panels.setdefault((curve.panel, curve.label, curve.title, curve.along), {})
            by_curve.setdefault((place, curve.series, curve.key), curve)  # once, of several figures
    for by_curve in list(panels.values())[:MOST_CHARTS]:
        yield _chart([(place, curve) for (place, _, _), curve in by_curve.items()], variants)


def _chart(curves: Sequence[tuple[int, Curve]], variants: Sequence[Shown]) -> Chart:
    first = next((curve for _, curve in curves if not curve.backdrop), curves[0][1])
    names = [curve.series or curve.key for _, curve in curves if not curve.backdrop]
    series = list(dict.fromkeys(names))
    edge = _edge([curve for _, curve in curves])
    traces = [
        _trace(place, curve, series, [variant.title for variant in variants], edge)
        for place, curve in curves
    ]
    off = [mark for pair in zip(curves, traces, strict=True) for mark in _beyond(*pair, edge)]
    traces = once_named(traces) + once_named(known_marks(curves, variants)) + off
    down, up = first.limits
    if np.isfinite(edge):
        up = edge * (1.0 + ROUNDED)
    ordinate = logarithmic if first.log else axis
    layout: dict[str, Any] = {
        "xaxis": axis(first.along),
        "yaxis": ordinate(first.label, first.unit),
    }
    if up is not None and not first.log:
        layout["yaxis"]["range"] = [down or 0.0, up]
    elif down is not None and not first.log:
        layout["yaxis"]["rangemode"] = "tozero"
    layout["shapes"], layout["annotations"] = _places(first)
    if sum(bool(each.get("showlegend", True)) for each in traces) < 2:
        layout["showlegend"] = False
    title = first.title or (f"{first.panel}: {first.label}" if first.panel else first.label)
    return Chart(title, traces, layout, note=BEYOND if off else "")


def _edge(curves: Sequence[Curve]) -> float:
    """Upper end of an axis that cuts some values off; infinite if it shows all."""
    ceiling = max(curve.ceiling for curve in curves)
    return edge_of(curves) if any((curve.y > ceiling).any() for curve in curves) else np.inf


def edge_of(curves: Sequence[Curve]) -> float:
    """Upper end of an axis that ignores values above the ceiling of its curves."""
    ceiling = max(curve.ceiling for curve in curves)
    values = np.concatenate([curve.y for curve in curves])
    return ROOM * float(np.max(values, where=values <= ceiling, initial=0.0)) or ceiling


def _beyond(held: tuple[int, Curve], trace: Any, edge: float) -> Iterator[Any]:
    """Yield triangles at the edge for points beyond it, if these are too few for a line."""
    place, curve = held
    off = curve.y > edge
    if curve.dotted and off.any():
        group = trace.setdefault("legendgroup", trace["name"])
        marks = {"symbol": "triangle-up", "color": colour(place), "size": 10}
        yield {
            "x": curve.x[off],
            "y": np.full(off.sum(), edge),
            "text": [f"{y:.4g}" if np.isfinite(y) else "unbounded" for y in curve.y[off]],
            "hovertemplate": f"%{{x}}, %{{text}} {curve.unit}",
            "name": trace["name"],
            "mode": "markers",
            "marker": marks,
            "cliponaxis": False,
            "legendgroup": group,
            "showlegend": False,
        }


def once_named(traces: list[Any]) -> list[Any]:
    """Show each name once in the legend, where it toggles all traces of that name."""
    seen: set[str] = set()
    names = [trace["name"] for trace in traces]
    for trace in traces:
        trace["showlegend"] = trace.get("showlegend", True) and trace["name"] not in seen
        seen.add(trace["name"])
        if names.count(trace["name"]) > 1:
            trace.setdefault("legendgroup", trace["name"])
    return traces


def _trace(
    place: int, curve: Curve, series: Sequence[str], titles: Sequence[str], edge: float
) -> Any:
    x, y = curve.drawn
    y = under(y, edge) if curve.dotted else np.minimum(y, 2.0 * edge)
    name = curve.series or curve.key
    if curve.backdrop:
        looks = {"color": FAINT, "width": 1.0, "dash": "dot"}
        return {"x": x, "y": y, "mode": "lines", "line": looks, "name": name, "hoverinfo": "name"}
    which = series.index(name)
    number = which if len(titles) == 1 else place
    trace: dict[str, Any] = {"x": x, "y": y, "name": name or curve.label}
    if len(titles) > 1:
        trace["name"] = f"{titles[place]}, {name}" if name else titles[place]
        trace["legendgroup"] = titles[place]
        trace["showlegend"] = len(titles) <= MANY
    if len(x) < curve.least:
        return trace | marks_only(number)
    dash = which if len(titles) == 1 or len(series) > 1 else place
    return trace | {
        "mode": "lines+markers" if len(titles) > 1 else "lines",
        "line": line(number, dash),
        "marker": {"symbol": mark(number), "size": 6, "maxdisplayed": 8},
    }


def known_marks(curves: Sequence[tuple[int, Curve]], variants: Sequence[Shown]) -> list[Any]:
    """Traces of published and measured values of the quantities of a chart, once each."""
    wanted = {curve.known for _, curve in curves if curve.known is not None}
    references: dict[Reference, int] = {}
    for place, variant in enumerate(variants):
        for each in variant.known:
            if belongs(each, wanted):
                references.setdefault(each, place)
    shared = [r for r in references if all(r in variant.known for variant in variants)]
    traces = []
    for each, place in references.items():
        whose = f" {each.subject}" if each.subject and len(wanted) > 1 else ""
        traces.append(
            {
                "x": np.asarray(each.speeds) * RPM.factor,
                "y": np.asarray(each.values) * shown(QUANTITIES[each.quantity]).factor,
                "name": f"{each.kind}{whose}",
                "text": each.source,
                "mode": "markers",
                "marker": {
                    "symbol": OPEN.get(each.kind, "square-open"),
                    "size": 11,
                    "line": {"width": 2},
                    "color": INK if each in shared else colour(place),
                },
            }
        )
    return traces


def _places(curve: Curve) -> tuple[list[Any], list[Any]]:
    """Shapes and labels of named positions along the abscissa."""
    shapes = [
        dict(type="line", x0=x, x1=x, y0=0, y1=1, yref="paper", line=dict(color=FAINT, width=0.7))
        for x, _ in curve.places
    ]
    words = [
        dict(x=x, y=1.0, yref="paper", text=name, showarrow=False, textangle=-90, yanchor="bottom")
        for x, name in curve.places
    ]
    return shapes, words
