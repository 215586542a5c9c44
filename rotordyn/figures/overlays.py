"""Overlays of variants: the headline curves of an analysis, and their differences.

A few variants have a colour and marks each, and curves of one variant different dashes; the colour
of many variants is the value that was varied.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from rotordyn.figures import stations
from rotordyn.figures.curve_groups import BEYOND, Group, Layer, groups_of, limit_ordinate
from rotordyn.figures.curves import draw_references
from rotordyn.figures.end_names import NAMES, End, name_ends
from rotordyn.figures.legends import shortened, top_legend
from rotordyn.figures.panels import Box
from rotordyn.figures.style import (
    BLACK,
    CYCLE,
    DASHES,
    FONT_SIZE,
    GREY,
    add_axes,
    axis_start,
    colour_scale,
    marked,
    new_figure,
    round_ticks,
)
from rotordyn.results.described import Shown
from rotordyn.results.headline import Curve, belongs, under

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

MOST_NAMED = 14  # variants in a legend; with more, the colour is a value
COLOURS = (*CYCLE, "#882255", "#DDCC77", "#6699CC", "#999933", "#CC6677", "#117733", "#AA4499")
THICK, THIN = 2.4, 1.0  # line widths of the first variant, visible below the last, and of that
MAP, DARK = "viridis", "#444444"
LEFT, RIGHT, BELOW, GAP = 17.0, 6.0, 12.0, 5.0  # [mm]
STRIP, OVER_STRIP = 26.0, 5.0  # height of differences, gap above them [mm]
NAMED_STRIP = 48.0  # height of differences of curves with names at their ends [mm]
BAR = 16.0  # width of the space of a colour bar [mm]
MOST_STRIPS = 4

Curves = Callable[[Shown], Iterable[Curve]]


class Scale(NamedTuple):
    """Varied quantity with its unit (``label``), and its value in each variant."""

    label: str
    values: Sequence[float]


@dataclass(frozen=True, slots=True)
class Looks:
    """Line styles of variants: ``colours`` by variant, dashes by ``series``."""

    colours: Sequence[Any]
    series: Sequence[str]
    named: bool

    def of(self, place: int, series: str) -> dict[str, Any]:
        """Return the line style of a variant and series."""
        if not self.named:
            return {"color": self.colours[place], "ls": self.dash(series), "lw": 0.8}
        several, last = len(self.series) > 1, max(len(self.colours) - 1, 1)
        return {
            "color": self.colours[place],
            "ls": self.dash(series) if several else dash(place),
            "lw": THICK + (THIN - THICK) * place / last,
            **marked(place),
        }

    def dash(self, series: str) -> Any:
        """Return the dashes of a series; a curve without one has a solid line."""
        return DASHES[self.series.index(series) % len(DASHES)] if series else DASHES[0]


def colour(place: int) -> str:
    """Return the colour of the variant at an index."""
    return COLOURS[place % len(COLOURS)]


def dash(place: int) -> Any:
    """Return the dashes of the variant at an index, which identify it without colour."""
    return DASHES[(place + place // len(DASHES)) % len(DASHES)]


def overlay_figure(
    name: str, curves: Curves, variants: Sequence[Shown], scale: Scale | None = None
) -> Figure:
    """Draw the curves of the figure ``name`` of all variants, a panel for each of their groups.

    Linear panels have the difference from the first variant below. ``scale``: of many variants.
    """
    groups = groups_of([[c for c in curves(v) if c.figure == name] for v in variants])
    looks = _looks(groups, len(variants), scale)
    strips = len(groups) <= MOST_STRIPS
    names = looks.named and len(groups) == 1 and any(c.end for _, c in groups[0].layers)
    figure, boxes, columns = _layout(groups, strips=strips, bar=not looks.named, names=names)
    several = len({group.first.label for group in groups}) > 1 or groups[0].first.panel != ""
    for place, (group, (above, below)) in enumerate(zip(groups, boxes, strict=True)):
        curve, strip = group.first, strips and bool(group.changes)
        under = groups[place + columns :][:1]
        is_lowest = not under or under[0].first.along != curve.along
        label = curve.along if strip or is_lowest else ""
        axes = add_axes(figure, above, "" if strip else label, _ordinate(curve, several=several))
        if place == 0:
            _entries(axes, groups, variants, looks, numbers=names)
        lines = _draw(axes, group, looks)
        _draw_known(axes, group, variants, looks)
        _finish(axes, curve, above[2], labelled=bool(label) and not strip, top=place < columns)
        _beyond(axes, group.layers, looks, lines)
        if names:
            name_ends(axes, _ends(group.layers, looks), above[3])
        if strip:
            beneath = add_axes(figure, below, label, f"difference [{curve.unit}]")
            _draw_changes(beneath, group.changes, looks)
            _note(beneath, f"to {shortened(variants[0].title)}")
            beneath.set_xlim(axes.get_xlim())
            beneath.set_xticks(axes.get_xticks())
            beneath.set_xlim(axes.get_xlim())
            if names:
                name_ends(beneath, _ends(group.changes, looks), below[3])
    if not looks.named:
        order = Scale("variant, in the order of the case", range(1, len(variants) + 1))
        _colour_bar(figure, scale or order, boxes)
    top_legend(figure, *figure.axes, above=_names_height(groups[0].first, boxes[0][0][2]))
    return figure


def _ends(layers: Sequence[Layer], looks: Looks) -> list[End]:
    """Return the ends of the named curves that reach the right edge."""
    return [
        End(float(curve.y[-1]), _numbered(place, curve.end), looks.colours[place], place)
        for place, curve in layers
        if curve.end and np.isfinite(curve.y[-1])
    ]


def _numbered(place: int, name: str) -> str:
    """A name with the number of its variant, which tells it without colour."""
    return f"{place + 1}: {name}"


def _ordinate(curve: Curve, *, several: bool) -> str:
    label = f"{curve.label} [{curve.unit}]"
    return f"{curve.panel}: {label}" if several and curve.panel and not curve.title else label


def _looks(groups: Sequence[Group], count: int, scale: Scale | None) -> Looks:
    layers = sorted((layer for group in groups for layer in group.layers), key=lambda x: x.place)
    series = list(dict.fromkeys(layer.curve.series for layer in layers))
    if count <= MOST_NAMED:
        return Looks([colour(k) for k in range(count)], series, named=True)
    from matplotlib import colormaps

    values = np.asarray(scale.values if scale else range(count), float)
    share = (values - values.min()) / max(float(np.ptp(values)), 1e-300)
    return Looks(list(colormaps[MAP](share)), series, named=False)


def _layout(
    groups: Sequence[Group], *, strips: bool, bar: bool, names: bool
) -> tuple[Figure, list[tuple[Box, Box]], int]:
    """Return a figure, boxes of each panel and of its differences [mm], and the number of columns.

    Logarithmic panels, which show resonances, are as wide as the figure.
    """
    curve, count = groups[0].first, len(groups)
    resonances = all(group.first.log for group in groups)
    columns = 1 if resonances else 2 if count == 4 else min(count, 3)
    rows = [groups[k : k + columns] for k in range(0, count, columns)]
    right = RIGHT + (BAR if bar else 0.0) + (NAMES if names else 0.0)
    changes = NAMED_STRIP if names else STRIP
    gap = 17.0 if columns > 1 else 0.0
    wide = (168.0 - LEFT - right - gap * (columns - 1)) / columns
    tall = 50.0 if resonances else 84.0 if count == 1 else 62.0 if len(rows) == 1 else 39.0
    top = _names_height(curve, wide) + 6.0 if curve.places else 8.0
    mixed = len({group.first.along for group in groups}) > 1  # labelled between rows
    between = (9.0 if curve.title else GAP) + (6.0 if mixed else 0.0)
    between += 1.0 if curve.places else 0.0
    under = [
        changes + OVER_STRIP if strips and any(group.changes for group in row) else 0.0
        for row in rows
    ]
    height = sum(under) + len(rows) * tall + (len(rows) - 1) * between
    figure = new_figure(168.0, BELOW + height + top)
    boxes, foot = [], BELOW + height
    for row, space in zip(rows, under, strict=True):
        foot -= tall + space
        for column, group in enumerate(row):
            left, below = LEFT + column * (wide + gap), space if group.changes else 0.0
            panel = (left, foot + below, wide, tall + space - below)
            boxes.append((panel, (left, foot, wide, changes)))
        foot -= between
    return figure, boxes, columns


def _names_height(curve: Curve, wide: float) -> float:
    """Return the height of the names of places above a panel [mm]."""
    if not curve.places:
        return 0.0
    ends = float(curve.x[0]), float(curve.x[-1])
    return stations.room(curve.places, stations.upright(curve.places, wide, *ends))


def _draw(axes: Axes, group: Group, looks: Looks) -> list[Line2D]:
    for place, curve in enumerate(group.backdrop):
        look: dict[str, Any] = {"color": DARK, "lw": 0.8, "ls": DASHES[place % len(DASHES)]}
        axes.plot(curve.x, curve.y, zorder=1.5, scalex=False, scaley=curve.log, **look)
        axes.plot([], [], label=curve.series, **look)
    return _plot(axes, group.layers, looks, group.ceiling)


def _draw_changes(axes: Axes, changes: Sequence[Layer], looks: Looks) -> None:
    axes.axhline(0.0, color=BLACK, lw=0.7, zorder=1.4)
    ceiling = max(curve.ceiling for _, curve in changes)
    lines = _plot(axes, changes, looks, ceiling, lw=0.9)
    low, high = axes.get_ylim()
    axes.set_ylim(low - 0.06 * (high - low), high + 0.06 * (high - low))
    _beyond(axes, changes, looks, lines)


def _plot(
    axes: Axes, layers: Sequence[Layer], looks: Looks, ceiling: float, **style: Any
) -> list[Line2D]:
    """Draw a line for each curve up to the ceiling; only marks if it has too few points."""
    lines = []
    for place, curve in layers:
        (x, y), look = curve.drawn, looks.of(place, curve.series) | style
        look |= _dots(look) if curve.dotted else {}
        lines += axes.plot(x, under(y, ceiling), **look)
    return lines


def _beyond(axes: Axes, layers: Sequence[Layer], looks: Looks, lines: list[Line2D]) -> None:
    """Draw values beyond an axis with fixed limits: lines leave the frame, points of curves without
    a line are triangles at its edge."""
    low, high = axes.get_ylim()
    for (place, curve), line in zip(layers, lines, strict=True):
        (x, y), look = curve.drawn, looks.of(place, curve.series)
        if np.isinf(curve.ceiling):
            continue
        if not curve.dotted:
            line.set_ydata(np.clip(y, 2.0 * low - high, 2.0 * high - low))
            continue
        for outside, edge, sign in ((y > high, high, "^"), (y < low, low, "v")):
            if outside.any():
                marks = look | _dots({"marker": sign})
                axes.plot(x[outside], np.full(outside.sum(), edge), **marks)
                axes.plot([], [], label=BEYOND, **marks | {"color": GREY})


def _dots(look: dict[str, Any]) -> dict[str, Any]:
    marks = {"marker": look.get("marker", "o"), "markevery": None, "ms": 4.0, "ls": ""}
    return {"clip_on": False, **marks}


def _finish(axes: Axes, curve: Curve, wide: float, *, labelled: bool, top: bool) -> None:
    """Set limits, ticks, title and, at the ``top`` of the figure, names of places."""
    low, high = float(curve.x[0]), float(curve.x[-1])
    if curve.places:
        axes.set_xlim(low, high)
        stations.mark(axes, curve.places)
        if top:
            upright = stations.upright(curve.places, wide, low, high)
            stations.name(axes, curve.places, wide, upright)
        axes.axhline(0.0, color=BLACK, lw=0.7, zorder=1.4)
    else:
        start, high = axis_start(low, high), max(high, 1.0)
        left, right = axes.get_xlim()
        beyond = right > high * (1.0 + 1e-9)  # marks of references at the end
        axes.set_xlim(min(left, start) if beyond else start, right if beyond else high)
        axes.set_xticks(round_ticks(start, high, 8 if wide > 90.0 else 4))
    axes.tick_params(labelbottom=labelled)
    limit_ordinate(axes, curve)
    if curve.title:
        axes.set_title(curve.title, fontsize=FONT_SIZE, pad=4.0)


def _draw_known(axes: Axes, group: Group, variants: Sequence[Shown], looks: Looks) -> None:
    """Draw published and measured values: black if all variants share them, else in its colour."""
    if not group.known:
        return
    top, several = float(group.first.x[-1]), len({subject for _, subject in group.known}) > 1
    shared = [r for r in variants[0].known if all(r in v.known for v in variants)]
    for quantity in dict.fromkeys(quantity for quantity, _ in group.known):
        for place, variant in enumerate(variants):
            alone = [r for r in variant.known if r not in shared and belongs(r, group.known)]
            colours = dict.fromkeys((r.subject for r in alone), looks.colours[place])
            draw_references(axes, alone, quantity, top, subject=several, colours=colours)
        black = [r for r in shared if belongs(r, group.known)]
        draw_references(axes, black, quantity, top, subject=several)


def _note(axes: Axes, words: str) -> None:
    axes.annotate(
        words,
        (0.0, 1.0),
        (0.0, 2.0),
        "axes fraction",
        "offset points",
        ha="left",
        va="bottom",
        fontsize=FONT_SIZE - 1.5,
        color=GREY,
    )


def _entries(
    axes: Axes, groups: Sequence[Group], variants: Sequence[Shown], looks: Looks, *, numbers: bool
) -> None:
    """Add an entry of the legend for every variant, unless they are many, and every series;
    ``numbers``: of the variants before their titles."""
    layers = [layer for group in groups for layer in group.layers]
    solved = {k for k, c in layers if (np.isfinite(c.y) | (c.y > c.ceiling)).any()}
    dotted = all(curve.dotted for _, curve in layers)
    for place, variant in enumerate(variants if looks.named else ()):
        look = looks.of(place, looks.series[0]) | {"markevery": None}
        if len(looks.series) > 1:
            look["ls"] = "-"
        elif dotted:
            look |= _dots(look)
        title = _numbered(place, variant.title) if numbers else variant.title
        title += "" if place in solved else ": none"
        axes.plot([], [], label=title, **look)
    for series in looks.series if len(looks.series) > 1 else ():
        axes.plot([], [], color=BLACK, lw=1.2, ls=looks.dash(series), label=series)


def _colour_bar(figure: Figure, scale: Scale, boxes: Sequence[tuple[Box, Box]]) -> None:
    """Draw the colour bar of the values, at the right of all panels."""
    tops = [above[1] + above[3] for above, _ in boxes]
    box = (168.0 - BAR - 2.0, boxes[-1][0][1], 3.0, max(tops) - boxes[-1][0][1])
    low, high = float(min(scale.values)), float(max(scale.values))
    colour_scale(figure, box, low, high, scale.label, MAP)
