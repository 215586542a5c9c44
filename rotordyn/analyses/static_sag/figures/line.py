"""The deflection line under weight, drawn on to the gauges in front of the nose."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from rotordyn.analyses.static_sag.result import StaticSagResult
from rotordyn.figures import stations
from rotordyn.figures.labels import spread
from rotordyn.figures.legends import top_legend
from rotordyn.figures.overlays import colour, dash
from rotordyn.figures.style import BLACK, FONT_SIZE, add_axes, new_figure
from rotordyn.machine.spindle import Spindle
from rotordyn.results.described import Shown
from rotordyn.results.display import MICROMETRE, MILLIMETRE, RPM

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SEEN = 1e-9  # of the largest deflection: less is no sag
WIDE = 145.0  # [mm] of a panel


def line_figure(variants: Sequence[Shown]) -> Figure:
    """Deflection over station, a panel for every direction that sags, a line per variant or, of
    one machine, at the slowest and the fastest speed; gauges with their readings."""
    names = _directions(variants)
    tall, gap = 62.0, 6.0
    figure = new_figure(168.0, 14.0 + (tall + gap) * len(names))
    for place, name in enumerate(names):
        last = place == len(names) - 1
        box = (17.0, 12.0 + (len(names) - 1 - place) * (tall + gap), WIDE, tall)
        label = "station x [mm]" if last else ""
        axes = add_axes(figure, box, label, f"deflection {name} [µm]")
        axes.tick_params(labelbottom=last)
        for k, (variant, row, title) in enumerate(_lines(variants)):
            _draw(axes, variant, row, name, k, title)
        axes.axhline(0.0, color=BLACK, lw=0.7, zorder=1)
        axes.margins(x=0.03, y=0.14)
        axes.autoscale_view()
        _mark(axes, variants[0].spindle)
        for variant, row, _ in _lines(variants)[:1]:
            _write(axes, variant, row, name)
    top_legend(figure, *figure.axes, above=4.0)
    return figure


def _directions(variants: Sequence[Shown]) -> list[str]:
    """Directions in which a variant sags; y where none does."""
    first: StaticSagResult = variants[0].result
    largest = np.array([np.nanmax(np.abs(v.result.deflection), axis=(0, 1)) for v in variants]).max(
        axis=0
    )
    drawn = [n for n, m in zip(first.direction, largest, strict=True) if m > SEEN * largest.max()]
    return drawn or [first.direction[0]]


def _lines(variants: Sequence[Shown]) -> list[tuple[Shown, int, str]]:
    """Lines to draw: variant, row of the speed, name in the legend."""
    lines = []
    for variant in variants:
        result: StaticSagResult = variant.result
        rows = np.flatnonzero(np.isfinite(result.slope).all(axis=1))
        for row in rows[:1] if len(variants) > 1 else dict.fromkeys(rows[[0, -1]].tolist()):
            speed = f"{result.speed[row] * RPM.factor:.0f} rpm"
            lines.append((variant, int(row), f"{variant.title}, {speed}".removeprefix(", ")))
    return lines


def _draw(axes: Axes, variant: Shown, row: int, name: str, place: int, title: str) -> None:
    result: StaticSagResult = variant.result
    k = result.direction.index(name)
    y = result.deflection[row, :, k] * MICROMETRE.factor
    look: dict[str, Any] = {"color": colour(place), "ls": dash(place)}
    axes.plot(result.station * MILLIMETRE.factor, y, label=f"shaft, {title}", **look)
    if variant.spindle is None:
        return
    start = variant.spindle.points[result.point]
    gauges = np.array([0.0, *np.sort(result.gauge)])
    sag = np.interp(start, result.station, result.deflection[row, :, k])
    bar = (sag - gauges * result.slope[row, k]) * MICROMETRE.factor
    if result.gauge.any():
        look = {"color": colour(place), "lw": 0.8, "ls": ":", "label": f"test bar, {title}"}
        axes.plot((start - gauges) * MILLIMETRE.factor, bar, **look)
    x = (start - result.gauge) * MILLIMETRE.factor
    sags = result.sag[row, :, k] * MICROMETRE.factor
    axes.plot(x, sags, ls="none", marker="v", ms=5.0, color=colour(place), label=f"gauge, {title}")


def _write(axes: Axes, variant: Shown, row: int, name: str) -> None:
    """Write the readings of the gauges above them, or below where the shaft lies above; texts are
    spread so that none overlap."""
    result: StaticSagResult = variant.result
    if variant.spindle is None:
        return
    k = result.direction.index(name)
    gauge_x = (variant.spindle.points[result.point] - result.gauge) * MILLIMETRE.factor
    values, runout = (field[row, :, k] * MICROMETRE.factor for field in (result.sag, result.runout))
    texts = [f"{value:.3g} µm".replace("-", "−") for value in values]
    if result.ring:
        texts = [f"{sag}\nrunout {r:.3g} µm" for sag, r in zip(texts, runout, strict=True)]
    left, right = axes.get_xlim()
    sizes = [max(map(len, text.split("\n"))) * stations.LETTER + 1.5 for text in texts]
    places = spread(gauge_x.tolist(), [size * (right - left) / WIDE for size in sizes], left, right)
    shaft = result.deflection[row, :, k] * MICROMETRE.factor
    for x, y, text, size in zip(places, values, texts, sizes, strict=True):
        distance = np.abs(result.station * MILLIMETRE.factor - x)
        covered = shaft[distance <= 0.5 * size * (right - left) / WIDE]
        below = covered.size > 0 and float(covered.mean()) > y
        axes.annotate(
            text,
            (float(x), y),
            (0.0, -6.0 if below else 6.0),
            textcoords="offset points",
            ha="center",
            va="top" if below else "baseline",
            fontsize=FONT_SIZE - 1.5,
            color=colour(0),
        )


def _mark(axes: Axes, spindle: Spindle | None) -> None:
    """Mark bearings and supports with a thin line and their names, which do not overlap."""
    supports = sorted(spindle.connections, key=lambda support: support.x) if spindle else []
    marks = [(support.x * MILLIMETRE.factor, support.name) for support in supports]
    stations.mark(axes, marks)
    stations.name(axes, marks, WIDE, upright=False, foot="baseline")
