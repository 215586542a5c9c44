"""Variants over one another: the headline curves of an analysis, and how they differ.

A few variants have a colour and marks each, curves of one variant dashes; of many the colour is the
value that was varied.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from rotordyn.figures import stations
from rotordyn.figures.amplitudes import log_axis
from rotordyn.figures.curves import draw_references
from rotordyn.figures.legends import shortened, top_legend
from rotordyn.figures.panels import Box, Shown
from rotordyn.figures.style import (
    BLACK,
    CYCLE,
    DASHES,
    FONT_SIZE,
    GREY,
    add_axes,
    marked,
    new_figure,
    round_ticks,
)
from rotordyn.results.headline import Curve, Known
from rotordyn.results.kinds import Array

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST_NAMED = 14  # variants in a legend; of more the colour is a value
COLOURS = (*CYCLE, "#882255", "#DDCC77", "#6699CC", "#999933", "#CC6677", "#117733", "#AA4499")
THICK, THIN = 2.4, 1.0  # the first variant, still seen below the last
LEAST_POINTS = 4  # for a line; fewer are marks
ALIKE = 1e-9  # of the largest value: no difference
MAP, DARK = "viridis", "#444444"
LEFT, RIGHT, BELOW, GAP = 17.0, 6.0, 12.0, 5.0  # [mm]
STRIP, OVER_STRIP = 26.0, 5.0  # height of differences, room above them [mm]
BAR = 16.0  # room of a bar of colours [mm]
MOST_STRIPS = 4

Curves = Callable[[Shown], Iterable[Curve]]
Group = tuple[str, str, str]  # panel, label, title


class Scale(NamedTuple):
    """What was varied, with its unit, and its value in each variant."""

    label: str
    values: Sequence[float]


@dataclass(frozen=True, slots=True)
class Looks:
    """How lines of variants look: ``colours`` by variant; ``series`` have dashes each."""

    colours: Sequence[Any]
    series: Sequence[str]
    named: bool

    def of(self, place: int, series: str) -> dict[str, Any]:
        """The line of a variant and series."""
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
        return DASHES[self.series.index(series) % len(DASHES)]


def colour(place: int) -> str:
    """Colour of the variant at a place."""
    return COLOURS[place % len(COLOURS)]


def dash(place: int) -> Any:
    """Dashes of the variant at a place: told apart without colour, too."""
    return DASHES[(place + place // len(DASHES)) % len(DASHES)]


def overlay_figure(
    name: str, curves: Curves, variants: Sequence[Shown], scale: Scale | None = None
) -> Figure:
    """The curves of the figure ``name`` of all variants, a panel for each of their groups.

    Below linear panels stands the difference to the first variant. ``scale``: of many variants.
    """
    sets = [[c for c in curves(v) if c.figure == name] for v in variants]
    groups = list(dict.fromkeys(map(_group, (c for own in sets for c in own))))
    looks = _looks(sets, scale)
    changed = {group: _differences(sets, group) for group in groups}
    strips = len(groups) <= MOST_STRIPS and any(changed.values())
    figure, boxes = _layout(_first(sets, groups[0]), len(groups), strips, bar=not looks.named)
    several = len({group[1] for group in groups}) > 1 or groups[0][0] != ""
    for place, (group, (above, below)) in enumerate(zip(groups, boxes, strict=True)):
        first = _first(sets, group)
        lowest = place + _columns(groups, first) >= len(groups)
        strip = strips and bool(changed[group])
        words = first.along if lowest or strips else ""
        axes = add_axes(figure, above, "" if strip else words, _ordinate(first, several=several))
        if place == 0:
            _name(axes, sets, variants, looks)
        _draw(axes, sets, group, looks)
        _known(axes, sets, group, variants, looks)
        _finish(axes, first, above[2], labelled=bool(words) and not strip)
        if strip:
            own = add_axes(figure, below, words, f"difference [{first.unit}]")
            _draw_differences(own, changed[group], looks)
            _say(own, f"to {shortened(variants[0].title)}")
            own.set_xlim(axes.get_xlim())
            own.set_xticks(axes.get_xticks())
            own.set_xlim(axes.get_xlim())
    if not looks.named:
        _bar(figure, scale or _order(variants), boxes)
    top_legend(figure, *figure.axes, above=_above(sets, boxes))
    return figure


def _group(curve: Curve) -> Group:
    return curve.panel, curve.label, curve.title


def _first(sets: Sequence[Sequence[Curve]], group: Group) -> Curve:
    return next(c for own in sets for c in own if _group(c) == group and not c.backdrop)


def _ordinate(curve: Curve, *, several: bool) -> str:
    label = f"{curve.label} [{curve.unit}]"
    return f"{curve.panel}: {label}" if several and curve.panel and not curve.title else label


def _looks(sets: Sequence[Sequence[Curve]], scale: Scale | None) -> Looks:
    series = list(dict.fromkeys(c.series for own in sets for c in own if not c.backdrop))
    if len(sets) <= MOST_NAMED:
        return Looks([colour(k) for k in range(len(sets))], series, named=True)
    from matplotlib import colormaps

    values = np.asarray(scale.values if scale else range(len(sets)), float)
    share = (values - values.min()) / max(float(np.ptp(values)), 1e-300)
    return Looks(list(colormaps[MAP](share)), series, named=False)


def _order(variants: Sequence[Shown]) -> Scale:
    return Scale("variant, in the order of the case", range(1, len(variants) + 1))


def _columns(groups: Sequence[Group], curve: Curve) -> int:
    """Panels beside each other: logarithmic ones, of resonances, are as wide as the figure."""
    return 1 if curve.log else min(len(groups), 3)


def _layout(
    curve: Curve, count: int, strips: bool, *, bar: bool
) -> tuple[Figure, list[tuple[Box, Box]]]:
    """A figure, and for each panel its box and that of its differences [mm]."""
    columns = 1 if curve.log else min(count, 3)
    rows = math.ceil(count / columns)
    names = [(x, name) for x, name in curve.places]
    right = RIGHT + (BAR if bar else 0.0)
    gap = 17.0 if columns > 1 else 0.0
    wide = (168.0 - LEFT - right - gap * (columns - 1)) / columns
    tall = 50.0 if curve.log else 84.0 if count == 1 else 62.0 if rows == 1 else 39.0
    between = 9.0 if curve.title else GAP
    if names:
        ends = float(curve.x[0]), float(curve.x[-1])
        between += 1.0
        top = stations.room(names, stations.upright(names, wide, *ends)) + 6.0
    else:
        top = 8.0
    cell = tall + (STRIP + OVER_STRIP if strips else 0.0)
    height = BELOW + rows * cell + (rows - 1) * between + top
    figure = new_figure(168.0, height)
    boxes = []
    for place in range(count):
        row, column = divmod(place, columns)
        left = LEFT + column * (wide + gap)
        foot = BELOW + (rows - 1 - row) * (cell + between)
        below = (left, foot, wide, STRIP)
        boxes.append(((left, foot + cell - tall, wide, tall), below))
    return figure, boxes


def _draw(axes: Axes, sets: Sequence[Sequence[Curve]], group: Group, looks: Looks) -> None:
    for place, curve in enumerate(c for c in sets[0] if c.backdrop and _group(c) == group):
        look: dict[str, Any] = {"color": DARK, "lw": 0.8, "ls": DASHES[place % len(DASHES)]}
        axes.plot(curve.x, curve.y, zorder=1.5, scalex=False, scaley=curve.log, **look)
        axes.plot([], [], label=curve.series, **look)
    for place, own in enumerate(sets):
        for curve in (c for c in own if _group(c) == group and not c.backdrop):
            y = np.where(curve.y > 0.0, curve.y, np.nan) if curve.log else curve.y
            look = looks.of(place, curve.series)
            if len(curve.x) < LEAST_POINTS and len(curve.x) > 1:
                look |= {"marker": look.get("marker", "o"), "markevery": None, "ms": 4.0, "ls": ""}
                axes.plot(curve.x, y, clip_on=False, **look)
                continue
            axes.plot(*_broken(curve.x, y, curve.breaks), **look)


def _broken(x: Array, y: Array, breaks: Any) -> tuple[Array, Array]:
    """The curve without a line over steps at which it jumps."""
    if breaks is None or not breaks.any():
        return x, y
    at = np.flatnonzero(breaks) + 1
    return np.insert(x, at, x[at]), np.insert(y, at, np.nan)


def _finish(axes: Axes, curve: Curve, wide: float, *, labelled: bool) -> None:
    """Limits, ticks, title and names of places."""
    low, high = float(curve.x[0]), float(curve.x[-1])
    if curve.places:
        axes.set_xlim(low, high)
        stations.mark(axes, curve.places)
        stations.name(axes, curve.places, wide, stations.upright(curve.places, wide, low, high))
        axes.axhline(0.0, color=BLACK, lw=0.7, zorder=1.4)
    else:
        start, high = min(low, 0.0), max(high, 1.0)
        left, right = axes.get_xlim()
        beyond = right > high * (1.0 + 1e-9)  # marks of references at the end
        axes.set_xlim(min(left, start) if beyond else start, right if beyond else high)
        axes.set_xticks(round_ticks(start, high, 8 if wide > 90.0 else 4))
    axes.tick_params(labelbottom=labelled)
    if curve.log:
        log_axis(axes)
    bottom, top = curve.limits
    if top is None and bottom is not None:
        top = axes.get_ylim()[1] * 1.05
    axes.set_ylim(bottom, top)
    if curve.title:
        axes.set_title(curve.title, fontsize=FONT_SIZE, pad=4.0)


def _known(
    axes: Axes,
    sets: Sequence[Sequence[Curve]],
    group: Group,
    variants: Sequence[Shown],
    looks: Looks,
) -> None:
    """Published and measured values: black where all variants share them, else of its colour."""
    wanted = {c.known for own in sets for c in own if _group(c) == group and c.known}
    if not wanted:
        return
    top = float(_first(sets, group).x[-1])
    told = len({subject for _, subject in wanted}) > 1
    shared = [r for r in variants[0].known if all(r in v.known for v in variants)]
    for quantity in dict.fromkeys(quantity for quantity, _ in wanted):
        for place, variant in enumerate(variants):
            own = [r for r in variant.known if r not in shared and _fits(r, wanted)]
            colours = dict.fromkeys((r.subject for r in own), looks.colours[place])
            draw_references(axes, own, quantity, top, subject=told, colours=colours)
        black = [r for r in shared if _fits(r, wanted)]
        draw_references(axes, black, quantity, top, subject=told)


def _fits(reference: Any, wanted: set[Known]) -> bool:
    """Whether it is about a curve, or about none of several in particular."""
    own = {subject for quantity, subject in wanted if quantity == reference.quantity}
    return bool(own) and (reference.subject in own or not reference.subject)


def _differences(sets: Sequence[Sequence[Curve]], group: Group) -> list[tuple[int, Curve]]:
    """By the place of a variant its curves less those of the first; none where all are alike."""
    base = {c.key or c.series: c for c in sets[0] if _group(c) == group and not c.backdrop}
    found = []
    for place, own in enumerate(sets):
        for curve in (c for c in own if _group(c) == group and not c.backdrop and not c.log):
            first = base.get(curve.key or curve.series)
            if first is not None and np.array_equal(first.x, curve.x) and len(curve.x) > 1:
                found.append((place, curve._replace(y=curve.y - first.y)))
    size = max((float(np.nanmax(np.abs(c.y), initial=0.0)) for c in base.values()), default=0.0)
    largest = max((float(np.nanmax(np.abs(c.y), initial=0.0)) for _, c in found), default=0.0)
    return found if largest > ALIKE * size else []


def _draw_differences(axes: Axes, found: Sequence[tuple[int, Curve]], looks: Looks) -> None:
    axes.axhline(0.0, color=BLACK, lw=0.7, zorder=1.4)
    for place, curve in found:
        if place == 0:
            continue
        look = looks.of(place, curve.series) | {"lw": 0.9}
        if len(curve.x) < LEAST_POINTS:
            look |= {"marker": look.get("marker", "o"), "markevery": None, "ms": 4.0, "ls": ""}
            axes.plot(curve.x, curve.y, clip_on=False, **look)
        else:
            axes.plot(*_broken(curve.x, curve.y, curve.breaks), **look)
    low, high = axes.get_ylim()
    axes.set_ylim(low - 0.06 * (high - low), high + 0.06 * (high - low))


def _say(axes: Axes, words: str) -> None:
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


def _name(
    axes: Axes, sets: Sequence[Sequence[Curve]], variants: Sequence[Shown], looks: Looks
) -> None:
    """An entry of the legend for every variant, unless they are many, and for every series."""
    for place, (variant, own) in enumerate(zip(variants, sets, strict=True) if looks.named else ()):
        look = looks.of(place, looks.series[0]) | {"markevery": None}
        if len(looks.series) > 1:
            look["ls"] = "-"
        some = any(np.isfinite(c.y).any() for c in own if not c.backdrop)
        axes.plot([], [], label=variant.title if some else f"{variant.title}: none", **look)
    for series in looks.series if len(looks.series) > 1 else ():
        axes.plot([], [], color=BLACK, lw=1.2, ls=looks.dash(series), label=series)


def _above(sets: Sequence[Sequence[Curve]], boxes: Sequence[tuple[Box, Box]]) -> float:
    """Height of names above the first panel [mm]."""
    curve = next(c for c in sets[0] if not c.backdrop)
    if not curve.places:
        return 0.0
    ends = float(curve.x[0]), float(curve.x[-1])
    upright = stations.upright(curve.places, boxes[0][0][2], *ends)
    return stations.room(curve.places, upright)


def _bar(figure: Figure, scale: Scale, boxes: Sequence[tuple[Box, Box]]) -> None:
    """The colours of the values, beside all panels."""
    tops = [above[1] + above[3] for above, _ in boxes]
    box = (168.0 - BAR - 2.0, boxes[-1][0][1], 3.0, max(tops) - boxes[-1][0][1])
    low, high = float(min(scale.values)), float(max(scale.values))
    axes = add_axes(figure, box)
    axes.imshow(
        np.linspace(0.0, 1.0, 128)[:, None],
        origin="lower",
        aspect="auto",
        cmap=MAP,
        rasterized=True,
        extent=(0.0, 1.0, low, high),
    )
    axes.set_xticks([])
    axes.yaxis.tick_right()
    axes.yaxis.set_label_position("right")
    axes.set_ylabel(scale.label, fontsize=FONT_SIZE)
    axes.grid(visible=False)
    axes.tick_params(labelsize=FONT_SIZE - 0.5)
