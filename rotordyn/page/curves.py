"""Charts of headline curves: variants over one another, known values as open marks."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any

import numpy as np

from rotordyn.machine.reference import QUANTITIES, Reference
from rotordyn.page.blocks import Chart
from rotordyn.page.looks import (
    FAINT,
    FEW_POINTS,
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
from rotordyn.results.headline import Curve, belongs

Curves = Callable[[Any, Any], Iterable[Curve]]
Panel = tuple[str, str, str, str]
MOST_CHARTS = 24  # of one analysis
OPEN = {"measured": "circle-open", "published": "diamond-open"}


def curve_charts(curves: Curves, spec: Any, variants: Sequence[Shown]) -> Iterator[Chart]:
    """A chart for every panel; a line for each curve of each variant."""
    panels: dict[Panel, dict[tuple[int, str, str], Curve]] = {}
    for place, variant in enumerate(variants):
        for curve in curves(spec, variant):
            if curve.backdrop and place:
                continue
            held = panels.setdefault((curve.panel, curve.label, curve.title, curve.along), {})
            held.setdefault((place, curve.series, curve.key), curve)  # once, of several figures
    for held in list(panels.values())[:MOST_CHARTS]:
        yield _chart([(place, curve) for (place, _, _), curve in held.items()], variants)


def _chart(held: Sequence[tuple[int, Curve]], variants: Sequence[Shown]) -> Chart:
    first = next((curve for _, curve in held if not curve.backdrop), held[0][1])
    names = [curve.series or curve.key for _, curve in held if not curve.backdrop]
    series = list(dict.fromkeys(names))
    traces = [
        _trace(place, curve, series, [variant.title for variant in variants])
        for place, curve in held
    ]
    traces = once_named(traces) + once_named(known_marks(held, variants))
    down, up = first.limits
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
    return Chart(title, traces, layout)


def once_named(traces: list[Any]) -> list[Any]:
    """Traces of which each name stands in the legend once, and hides all that bear it."""
    seen: set[str] = set()
    names = [trace["name"] for trace in traces]
    for trace in traces:
        trace["showlegend"] = trace.get("showlegend", True) and trace["name"] not in seen
        seen.add(trace["name"])
        if names.count(trace["name"]) > 1:
            trace.setdefault("legendgroup", trace["name"])
    return traces


def _trace(place: int, curve: Curve, series: Sequence[str], titles: Sequence[str]) -> Any:
    x, y = curve.drawn
    name = curve.series or curve.key
    if curve.backdrop:
        looks = {"color": FAINT, "width": 1.0, "dash": "dot"}
        return {"x": x, "y": y, "mode": "lines", "line": looks, "name": name, "hoverinfo": "name"}
    which = series.index(name)
    own = which if len(titles) == 1 else place
    trace: dict[str, Any] = {"x": x, "y": y, "name": name or curve.label}
    if len(titles) > 1:
        trace["name"] = f"{titles[place]}, {name}" if name else titles[place]
        trace["legendgroup"] = titles[place]
        trace["showlegend"] = len(titles) <= MANY
    if len(x) < FEW_POINTS:
        return trace | marks_only(own)
    dash = which if len(titles) == 1 or len(series) > 1 else place
    return trace | {
        "mode": "lines+markers" if len(titles) > 1 else "lines",
        "line": line(own, dash),
        "marker": {"symbol": mark(own), "size": 6, "maxdisplayed": 8},
    }


def known_marks(held: Sequence[tuple[int, Curve]], variants: Sequence[Shown]) -> list[Any]:
    """Published and measured values of what a chart shows, once each."""
    wanted = {curve.known for _, curve in held if curve.known is not None}
    found: dict[Reference, int] = {}
    for place, variant in enumerate(variants):
        for each in variant.known:
            if belongs(each, wanted):
                found.setdefault(each, place)
    shared = [r for r in found if all(r in variant.known for variant in variants)]
    traces = []
    for each, place in found.items():
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
    """Named places along the abscissa."""
    shapes = [
        dict(type="line", x0=x, x1=x, y0=0, y1=1, yref="paper", line=dict(color=FAINT, width=0.7))
        for x, _ in curve.places
    ]
    words = [
        dict(x=x, y=1.0, yref="paper", text=name, showarrow=False, textangle=-90, yanchor="bottom")
        for x, name in curve.places
    ]
    return shapes, words
