"""Charts of measured curves, the identified machine, and the residuals."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from rotordyn.arrays import Array
from rotordyn.page.blocks import Block, Chart, Control, Table
from rotordyn.page.looks import COLOURS, FAINT, axis, colour, line, logarithmic, mark
from rotordyn.study.columns import Column
from rotordyn.study.identification.measurement import FEW
from rotordyn.study.identification.responses import PARTS

WITHIN = 2.0  # standard deviations of the noise in the shaded band
GREY = "rgba(138, 138, 138, 0.3)"


class Curves(NamedTuple):
    """Points of all measurements: names of measurement and curve (``series``), label and value of
    the abscissa (``along``, ``at``); ``machine``, ``residual`` and ``noise`` (points,) in
    ``unit``."""

    measurement: Sequence[str]
    series: Sequence[str]
    along: Sequence[str]
    unit: Sequence[str]
    at: Array
    machine: Array
    residual: Array
    noise: Array

    @classmethod
    def of(cls, table: Mapping[str, Column]) -> Curves:
        """Make the points from the columns of ``differences.csv``."""
        along, unit = table["along"].words, table["unit"].words
        series = table["measurement"].words, table["curve"].words
        values = (table[head].values for head in ("at", "machine", "residual", "noise"))
        return cls(*series, along, unit, *values)

    def rows(self, chosen: Sequence[int]) -> Curves:
        """Select points by index."""
        places = list(chosen)

        def words(part: Sequence[str]) -> list[str]:
            return [part[k] for k in places]

        return Curves(
            words(self.measurement),
            words(self.series),
            words(self.along),
            words(self.unit),
            self.at[places],
            self.machine[places],
            self.residual[places],
            self.noise[places],
        )

    def split(self, keys: Sequence[str]) -> Iterator[tuple[str, Curves]]:
        """Yield each distinct key and its points."""
        for key in dict.fromkeys(keys):
            yield key, self.rows([k for k, word in enumerate(keys) if word == key])


def curve_blocks(every: Curves) -> Iterator[Block]:
    """Yield two charts of every curve, one of frequency responses, and a table of single points."""
    single: list[list[str]] = []
    for name, points in every.split(every.measurement):
        if points.series[0].endswith(f", {PARTS[0]}"):
            yield _responses(name, points)
        elif len(points.at) >= FEW:
            yield _measured(name, points)
            yield _left(name, points)
        else:
            single += _single(name, points)
    if single:
        head = ["", "unit", "measured", "computed", "difference", "noise", "difference / noise"]
        yield Table("Single values", head, single)


def _measured(name: str, points: Curves) -> Chart:
    """Chart of measured points without tare and drift, and of the machine as lines."""
    traces: list[dict[str, Any]] = []
    for place, (word, curve) in enumerate(points.split(points.series)):
        order = np.argsort(curve.at)
        x, model = curve.at[order], curve.machine[order]
        measured = model + curve.residual[order]
        marker = {"color": colour(place), "symbol": f"{mark(place)}-open", "size": 6}
        traces += [
            {"x": x, "y": model, "mode": "lines", "line": line(place), "name": word or "computed"},
            {"x": x, "y": measured, "mode": "markers", "marker": marker, "name": "measured"},
        ]
        traces[-1]["showlegend"] = not place
    note = "Marks: measured, tare and drift taken off; lines: the identified machine."
    return Chart(f"{name}: measured and computed", traces, _axes(points), note=note)


def _left(name: str, points: Curves) -> Chart:
    """Chart of the residuals with a band of the noise."""
    ends = np.array([points.at.min(), points.at.max()])
    half = WITHIN * float(points.noise.mean())
    traces: list[dict[str, Any]] = [
        {
            "x": np.concatenate([ends, ends[::-1]]),
            "y": np.array([-half, -half, half, half]),
            "mode": "lines",
            "line": {"width": 0, "color": FAINT},
            "fill": "toself",
            "fillcolor": GREY,
            "hoverinfo": "skip",
            "name": f"± {WITHIN:g} deviations of the noise",
        }
    ]
    for place, (word, curve) in enumerate(points.split(points.series)):
        order = np.argsort(curve.at)
        style = {"line": line(place, width=0.8), "marker": {"symbol": mark(place), "size": 5}}
        x, y = curve.at[order], curve.residual[order]
        traces.append({"x": x, "y": y, "mode": "lines+markers", "name": word or name, **style})
    return Chart(f"{name}: residuals", traces, _axes(points))


def _axes(points: Curves) -> dict[str, Any]:
    ordinate = {"text": f"[{points.unit[0]}]"} if points.unit[0] else {"text": ""}
    return {"xaxis": axis(points.along[0]), "yaxis": {"title": ordinate}}


def _responses(name: str, points: Curves) -> Chart:
    """Chart of amplitudes over frequency of a selected response, and of its residual."""
    pairs = [word.rpartition(", ")[0] for word in points.series]
    drawn = list(points.split(pairs))
    longest = max(len(curve.at) // 2 for _, curve in drawn)
    values = np.full((5, len(drawn), longest), np.nan)  # abscissa, then what is drawn
    for k, (_, curve) in enumerate(drawn):
        count = len(curve.at) // 2
        values[0, k, :count] = curve.at[:count]
        shown = (curve.machine + curve.residual, curve.machine, curve.residual, curve.noise)
        for place, part in enumerate(shown):
            values[1 + place, k, :count] = np.hypot(part[:count], part[count:])
    styles: tuple[dict[str, Any], ...] = (
        {"name": "measured", "mode": "markers", "marker": {"color": FAINT, "size": 4}},
        {"name": "computed", "mode": "lines", "line": line(0)},
        {"name": "difference", "mode": "lines", "line": line(1, width=0.9)},
        {"name": "noise", "mode": "lines", "line": {"color": COLOURS[1], "dash": "dash"}},
    )
    traces = [
        {**style, "moving": {"x": values[0], "y": values[1 + place]}}
        for place, style in enumerate(styles)
    ]
    layout = {"xaxis": axis(points.along[0]), "yaxis": logarithmic("amplitude", points.unit[0])}
    controls = [Control("response", [pair for pair, _ in drawn])]
    return Chart(f"{name}: measured and computed", traces, layout, controls, wide=True)


def _single(name: str, points: Curves) -> Iterator[list[str]]:
    for k in range(len(points.at)):
        which = points.series[k] or (f"{points.at[k]:g}" if len(points.at) > 1 else "")
        residual, noise, machine = points.residual[k], points.noise[k], points.machine[k]
        numbers = (machine + residual, machine, residual, noise, residual / noise)
        words = [f"{value:.4g}".replace("-", "−") for value in numbers]
        yield [f"{name} {which}".strip(), points.unit[k] or "–", *words]
