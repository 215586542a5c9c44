"""Figure of the half-section of the machine, to scale."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from rotordyn.figures.holders import (
    draw_holders,
    foot,
    gap,
    held_radius,
    housed,
    housings_above,
    lower_end,
)
from rotordyn.figures.labels import spread
from rotordyn.figures.legends import rows_of
from rotordyn.figures.sketch import Sketch
from rotordyn.figures.static_loads import draw_load, height
from rotordyn.figures.style import (
    BLACK,
    BLUE,
    FONT_SIZE,
    GREEN,
    RED,
    SKY,
    add_axes,
    new_figure,
    round_ticks,
    text_width,
)
from rotordyn.figures.symbols import (
    draw_bearing,
    draw_drawbar,
    draw_ground,
    draw_sleeve,
    outside_of,
)
from rotordyn.machine.housing import RigidHousing
from rotordyn.machine.lumped import PointMass
from rotordyn.machine.shaft import Section
from rotordyn.machine.sleeve import Sleeve
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import GROUND, SPINDLE
from rotordyn.scene.loads import PointLoad
from rotordyn.surface.rotor import bearing_width

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SHADES = ("#B9C4CE", "#D8C3A5", "#B5CDB8", "#CBB9D1", "#E3D9A9", "#C7C7C7")
_WIDTH, _SIDE = 168.0, 4.0
APART = 4.0  # [mm of paper] between labels in a row
_LINE, _LEGEND_LINE = 2.8, 4.2  # [mm of paper]: line height of labels below, and of the legend
Mark = tuple[float, float, str]  # start of a leader [mm], and its label
OUTSIDE = 2  # zorder of outer surfaces, thicker rotors in front


def machine_figure(spindle: Spindle, loads: Sequence[PointLoad] = ()) -> Figure:
    """Draw all rotors, cut above their axis, with the parts they carry, bearings, supports and
    housings [mm], and the static ``loads`` on them."""
    left, right = _extent(spindle)
    scale = (_WIDTH - 2.0 * _SIDE) / (right - left)
    reach = max(_reach(spindle), *(height(spindle, load, 9.0 / scale) for load in loads), 0.0)
    sketch = Sketch()
    marks = _marks(sketch, spindle, 1.6 / scale)
    marks += _load_marks(sketch, spindle, loads, 9.0 / scale)
    lines = max((text.count("\n") + 1 for _, _, text in marks), default=1)
    words = 11.8 + _LINE * max(lines, 2)  # from the reach to below the labels [mm of paper]
    rows = _legend_rows(spindle, loads)
    above = reach + 13.0 / scale
    below = reach + (words + _LEGEND_LINE * len(rows)) / scale
    tall = (above + below) * scale
    figure = new_figure(_WIDTH, tall + 15.0)
    axes = add_axes(figure, (_SIDE, 13.0, _WIDTH - 2.0 * _SIDE, tall), "axial position x [mm]")
    axes.set(xlim=(left, right), ylim=(-below, above), aspect="equal")
    axes.set_xticks(round_ticks(left, right, 12))
    axes.set_yticks([])
    axes.grid(visible=False)
    for side in ("left", "right", "top"):
        axes.spines[side].set_visible(False)
    thickest_last = sorted(spindle.parts.values(), key=lambda part: part.shaft.largest_diameter)
    for rank, part in enumerate(thickest_last):  # the thickest covers the others
        _draw_shaft(sketch, part, _shades(spindle), rank)
        _draw_discs(sketch, part, _shades(spindle), rank)
    sketch.line([(left, 0.0), (right, 0.0)], BLACK, 0.5, "dashdot", z=6)
    if spindle.drawbar:
        draw_drawbar(sketch, spindle.drawbar, spindle.shaft)
    for seat in spindle.seats:
        radius = spindle.shaft.diameters_at(seat.x)[0] / 2.0
        draw_bearing(sketch, seat, bearing_width(seat, spindle.seats), radius)
    _draw_above(sketch, axes, spindle, reach + 3.0 / scale, (left, right), scale)
    draw_holders(sketch, spindle)
    _draw_marks(sketch, axes, marks, reach, scale, (left, right))
    sketch.draw(axes)
    _legend(figure, axes, rows)
    return figure


def _extent(spindle: Spindle) -> tuple[float, float]:
    shafts = [part.shaft for part in spindle.parts.values()]
    start = min(shaft.start for shaft in shafts) * 1e3
    end = max(shaft.end for shaft in shafts) * 1e3
    room = 0.04 * (end - start)
    return start - room, end + room


def _reach(spindle: Spindle) -> float:
    """Return the largest radius of all parts drawn [mm]."""
    parts = spindle.parts.values()
    radii = [part.shaft.largest_diameter / 2.0 for part in parts]
    radii += [d.outer_diameter / 2.0 for part in parts for d in part.discs]
    radii += [outside_of(seat) / 1e3 for seat in spindle.seats]
    sleeves = 9.0 if spindle.sleeves else 0.0
    room = max(sleeves, 1.2 * foot(spindle) if spindle.supports else 2.0)
    return max(max(radii) * 1e3 + room, held_radius(spindle))


def _draw_shaft(sketch: Sketch, spindle: Spindle, shades: dict[str, str], rank: int) -> None:
    """Draw one rotor; the thinnest has ``rank`` 0 and alone shows its bore."""
    for section, ends in zip(
        spindle.shaft.sections, pairwise(spindle.shaft.boundaries), strict=True
    ):
        a, b = (x * 1e3 for x in ends)
        _draw_section(sketch, section, a, b, shades[section.material.name], rank)
    for joint in spindle.joints:
        x, radius = joint.x * 1e3, spindle.shaft.diameters_at(joint.x)[0] * 500.0
        sketch.line([(x, -radius), (x, radius)], RED, 1.4, z=7)


def _draw_section(
    sketch: Sketch, section: Section, a: float, b: float, shade: str, rank: int
) -> None:
    """Draw the cut wall above the axis with the bore behind it, and the outer surface below."""
    (front, rear), (bore, end) = (
        [d * 500.0 for d in diameters] for diameters in (section.outer, section.inner)
    )
    sketch.polygon([(a, bore), (b, end), (b, rear), (a, front)], shade)
    if max(bore, end) > 0.0 and not rank:
        hole = [(a, 0.0), (b, 0.0), (b, end), (a, bore)]
        sketch.polygon(hole, "#F7F7F7", width=0.35, edge="#999999")
    below = [(a, -front), (b, -rear), (b, 0.0), (a, 0.0)]
    sketch.polygon(below, "#ECEFF1", width=0.7, z=OUTSIDE + 2 * rank)


def _shades(spindle: Spindle) -> dict[str, str]:
    parts = spindle.parts.values()
    names = [s.material.name for part in parts for s in part.shaft.sections]
    names += [d.material.name for part in parts for d in part.discs]
    return {n: SHADES[k % len(SHADES)] for k, n in enumerate(dict.fromkeys(names))}


def _draw_discs(sketch: Sketch, spindle: Spindle, shades: dict[str, str], rank: int) -> None:
    for disc in spindle.discs:
        a, b = (disc.x - disc.width / 2) * 1e3, (disc.x + disc.width / 2) * 1e3
        inner, outer = disc.inner_diameter * 500.0, disc.outer_diameter * 500.0
        sketch.box(a, b, inner, outer, shades[disc.material.name], z=3)
        sketch.box(a, b, -outer, -inner, "#ECEFF1", z=OUTSIDE + 1 + 2 * rank)


def _draw_above(
    sketch: Sketch,
    axes: Axes,
    spindle: Spindle,
    lane: float,
    limits: tuple[float, float],
    scale: float,
) -> None:
    """Draw a ground or sleeve above every bearing, with names above it."""
    for seat in spindle.seats:
        if spindle.sleeve_of(seat.name) is None and not housed(spindle, seat.name):
            half = bearing_width(seat, spindle.seats) * 500.0
            draw_ground(sketch, seat.x * 1e3, outside_of(seat), half, upright=False, side=1.0)
    named = [(seat.x * 1e3, seat.name) for seat in spindle.seats]
    _labels_in_a_row(axes, named, lane, limits, scale, weight="bold")
    texts = [(_sleeve_over(sketch, spindle, s), _sleeve_words(s)) for s in spindle.sleeves]
    for name, (a, b, _) in housings_above(spindle).items():
        texts.append(((a + b) / 2.0, _housing_words(spindle, name)))
    for r in spindle.rotors:
        middle = (r.shaft.start + r.shaft.end) * 500.0
        texts.append((middle, f"{r.name}: {r.speed_ratio:g} × the speed"))
    _labels_in_a_row(axes, texts, lane + 5.5 / scale, limits, scale, color=BLUE)


def _labels_in_a_row(
    axes: Axes,
    labels: Sequence[tuple[float, str]],
    y: float,
    limits: tuple[float, float],
    scale: float,
    **look: Any,
) -> None:
    """Draw labels above ``y``, each at its position or next to it."""
    sizes = [_width(text, FONT_SIZE, scale, APART) for _, text in labels]
    places = spread([x for x, _ in labels], sizes, *limits)
    for x, (_, text) in zip(places, labels, strict=True):
        axes.text(x, y, text, ha="center", va="bottom", fontsize=FONT_SIZE, **look)


def _sleeve_over(sketch: Sketch, spindle: Spindle, sleeve: Sleeve) -> float:
    """Draw the sleeve over its bearings; return the middle of these [mm]."""
    seats = [s for s in spindle.seats if s.name in sleeve.bearings]
    widths = [bearing_width(s, spindle.seats) / 2 for s in seats]
    left = min(s.x - w for s, w in zip(seats, widths, strict=True)) * 1e3
    right = max(s.x + w for s, w in zip(seats, widths, strict=True)) * 1e3
    draw_sleeve(
        sketch,
        left,
        right,
        max(outside_of(s) for s in seats),
        seats[0].thrust,
        stop=math.isfinite(sleeve.stop_travel),
        rigid=math.isinf(sleeve.spring.stiffness),
        grounded=not any(housed(spindle, s.name) for s in seats),
    )
    return sum(s.x for s in seats) / len(seats) * 1e3


def _sleeve_words(sleeve: Sleeve) -> str:
    parts = [sleeve.spring.words, sleeve.spring.rate]
    if math.isfinite(sleeve.stop_travel):
        parts.append(f"stop after {sleeve.stop_travel * 1e6:g} µm")
    return f"{sleeve.name}: {', '.join(parts)}"


def _housing_words(spindle: Spindle, name: str) -> str:
    housing = next(housing for housing in spindle.housings if housing.name == name)
    weight = f"{housing.mass:.4g} kg" if isinstance(housing, RigidHousing) else "reduced model"
    return f"{name}: housing, {weight}"


def _draw_marks(
    sketch: Sketch,
    axes: Axes,
    marks: Sequence[Mark],
    reach: float,
    scale: float,
    limits: tuple[float, float],
) -> None:
    """Draw labels of masses, supports, points and others under the shaft, joined by leaders."""
    size = FONT_SIZE - 1.5
    sizes = [max(_width(line, size, scale) for line in text.split("\n")) for _, _, text in marks]
    places = spread([x for x, _, _ in marks], sizes, *limits)
    upper, lower = -reach - 2.0 / scale, -reach - 8.5 / scale
    for at, (x, y, text) in zip(places, marks, strict=True):
        sketch.line([(x, y), (x, upper), (at, lower)], "#777777", 0.4, z=7)
        axes.text(
            at,
            lower - 0.8 / scale,
            text,
            ha="center",
            va="top",
            fontsize=size,
            linespacing=1.05,
        )


def _marks(sketch: Sketch, spindle: Spindle, size: float) -> list[Mark]:
    """Draw symbols of masses and points; return the start of each leader [mm] and its label."""
    marks: list[Mark] = []
    for rotor, part in spindle.parts.items():
        for mass in part.masses:
            height = _height(part, mass.x, rotor)
            _mass_symbol(sketch, mass, height, size)
            label = f"{mass.name.replace('_', ' ')}\n{mass.mass:.3g} kg"
            marks.append((mass.x * 1e3, height, label))
        marks += [(joint.x * 1e3, 0.0, joint.name) for joint in part.joints]
    for name, (rotor, x) in spindle.places.items():
        height = _height(spindle.part(rotor), x, rotor)
        sketch.circle(x * 1e3, height, 0.55 * size, "#FFFFFF", edge=BLACK, z=8)
        marks.append((x * 1e3, height, f"{name}\n{x * 1e3:.1f}"))
    for support in spindle.supports:
        grounded = support.against == GROUND
        low = lower_end(spindle, support) if grounded else gap(spindle, support)[0]
        marks.append((support.x * 1e3, low, support.name))
    for housing in spindle.housings:
        carried = [s for s in spindle.supports if s.name in housing.carries]
        if carried:  # leader from its centre of gravity, within its block
            ends = min(s.x for s in carried) * 1e3, max(s.x for s in carried) * 1e3
            at = housing.x * 1e3 if isinstance(housing, RigidHousing) else sum(ends) / 2.0
            low = lower_end(spindle, carried[0])
            marks.append((min(max(at, ends[0]), ends[1]), low, housing.name))
    discs = [disc for part in spindle.parts.values() for disc in part.discs]
    marks += [(disc.x * 1e3, -disc.outer_diameter * 500.0, disc.name) for disc in discs]
    marks += [(film.x * 1e3, -film.radius * 1e3, film.name) for film in spindle.dampers]
    if bar := spindle.drawbar:
        marks.append(((bar.start + bar.end) * 500.0, 0.0, f"drawbar\n{bar.force / 1e3:.3g} kN"))
    return marks


def _load_marks(
    sketch: Sketch, spindle: Spindle, loads: Sequence[PointLoad], length: float
) -> list[Mark]:
    """Draw the loads; return marks, with the labels of loads at one station together."""
    labels: dict[float, list[str]] = {}
    for load in loads:
        x, label = draw_load(sketch, spindle, load, length)
        labels.setdefault(x, []).append(label)
    return [(x, 0.0, "\n".join(label)) for x, label in labels.items()]


def _height(part: Spindle, x: float, rotor: str) -> float:
    """Return the height of marks on a rotor [mm]: 0 on the spindle, in the wall of others."""
    wall = sum(part.shaft.diameters_at(x)) * 250.0
    return 0.0 if rotor == SPINDLE else wall


def _mass_symbol(sketch: Sketch, mass: PointMass, height: float, size: float) -> None:
    """Draw the quartered circle of a centre of gravity."""
    x = mass.x * 1e3
    sketch.circle(x, height, size, "#FFFFFF", edge=BLACK, z=7)
    for start in (0.0, math.pi):
        angles = [start + k * math.pi / 16.0 for k in range(9)]
        arc = [(x + size * math.cos(angle), height + size * math.sin(angle)) for angle in angles]
        sketch.polygon([(x, height), *arc], BLACK, edge=BLACK, width=0.3, z=7)


def _width(words: str, size: float, scale: float, apart: float = 2.5) -> float:
    """Return the width of a line of text in axis units [mm of machine], with the distance
    ``apart`` from the next [mm of paper]."""
    return (text_width(words, size) + apart) / scale


def _legend_rows(spindle: Spindle, loads: Sequence[PointLoad]) -> list[list[Any]]:
    """Return legend entries of materials, if several, and of symbols drawn, in rows that fit."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    shades = _shades(spindle)
    materials = shades.items() if len(shades) > 1 else ()
    handles: list[Any] = [Patch(fc=c, ec="#333333", lw=0.5, label=n) for n, c in materials]
    parts = spindle.parts.values()
    circle: dict[str, Any] = dict(ls="none", ms=4.5, mec=BLACK, mew=0.7, mfc="white")
    halves: dict[str, Any] = dict(fillstyle="left", mfc=BLACK, mfcalt="white")
    symbols: list[tuple[object, str, dict[str, Any]]] = [
        (spindle.seats, "contact line", dict(color=RED, lw=0.9, ls="dashdot")),
        (spindle.places, "point", dict(marker="o", **circle)),
        ([m for p in parts for m in p.masses], "mass", dict(marker="o", **{**circle, **halves})),
        ([j for p in parts for j in p.joints], "joint", dict(color=RED, lw=1.4)),
        (spindle.dampers, "squeeze film", dict(color=SKY, lw=3.0)),
        (loads, "static load", dict(color=GREEN, lw=1.8, marker=">", ms=4.0)),
    ]
    handles += [Line2D([], [], label=name, **look) for items, name, look in symbols if items]
    return rows_of(handles, _WIDTH - 2.0 * _SIDE)


def _legend(figure: Figure, axes: Axes, rows: Sequence[Sequence[Any]]) -> None:
    """Draw the legend rows above the axis of positions, aligned at the right."""
    tall = axes.get_position().height * figure.get_size_inches()[1] * 25.4
    for place, row in enumerate(reversed(rows)):
        legend = axes.legend(
            handles=list(row),
            loc="lower right",
            bbox_to_anchor=(1.0, (0.8 + place * _LEGEND_LINE) / tall),
            frameon=False,
            fontsize=FONT_SIZE - 1.0,
            ncols=len(row),
            handlelength=1.6,
            columnspacing=1.2,
            borderaxespad=0.0,
            borderpad=0.2,
        )
        if place < len(rows) - 1:
            axes.add_artist(legend)
