"""Half-section of the machine to scale."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from rotordyn.figures.labels import spread
from rotordyn.figures.sketch import Sketch
from rotordyn.figures.style import BLACK, BLUE, FONT_SIZE, RED, add_axes, new_figure, round_ticks
from rotordyn.figures.symbols import (
    SLEEVE,
    draw_bearing,
    draw_drawbar,
    draw_ground,
    draw_sleeve,
    spring,
)
from rotordyn.machine.housing import Housing
from rotordyn.machine.lumped import PointMass
from rotordyn.machine.shaft import Section
from rotordyn.machine.sleeve import Sleeve
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import GROUND, SPINDLE, LinearSupport
from rotordyn.surface.rotor import bearing_width

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SHADES = ("#B9C4CE", "#D8C3A5", "#B5CDB8", "#CBB9D1", "#E3D9A9", "#C7C7C7")
_WIDTH, _SIDE = 168.0, 4.0
OUTSIDE = 2  # zorder of what is seen from outside, thicker rotors in front


def machine_figure(spindle: Spindle) -> Figure:
    """All rotors cut above their axis, with all that they carry and all that holds them [mm]."""
    left, right = _extent(spindle)
    reach = _reach(spindle)
    scale = (_WIDTH - 2.0 * _SIDE) / (right - left)
    above, below = reach + 13.0 / scale, reach + 21.0 / scale
    height = (above + below) * scale
    figure = new_figure(_WIDTH, height + 15.0)
    axes = add_axes(figure, (_SIDE, 13.0, _WIDTH - 2.0 * _SIDE, height), "axial position x [mm]")
    axes.set(xlim=(left, right), ylim=(-below, above), aspect="equal")
    axes.set_xticks(round_ticks(left, right, 12))
    axes.set_yticks([])
    axes.grid(visible=False)
    for side in ("left", "right", "top"):
        axes.spines[side].set_visible(False)
    sketch = Sketch()
    thickest_last = sorted(spindle.parts.values(), key=lambda part: part.shaft.largest_diameter)
    for rank, part in enumerate(thickest_last):  # it covers the others
        _draw_shaft(sketch, part, _shades(spindle), rank)
        _draw_discs(sketch, part, _shades(spindle), rank)
    sketch.line([(left, 0.0), (right, 0.0)], BLACK, 0.5, "dashdot", z=6)
    if spindle.drawbar:
        draw_drawbar(sketch, spindle.drawbar, spindle.shaft)
    for seat in spindle.seats:
        radius = spindle.shaft.diameters_at(seat.x)[0] / 2.0
        draw_bearing(sketch, seat, bearing_width(seat, spindle.seats), radius)
    _hold(sketch, axes, spindle, reach + 3.0 / scale, (left, right), scale)
    _supports(sketch, spindle)
    _name_below(sketch, axes, spindle, reach, scale, (left, right))
    sketch.draw(axes)
    _legend(axes, spindle)
    return figure


def _extent(spindle: Spindle) -> tuple[float, float]:
    shafts = [part.shaft for part in spindle.parts.values()]
    start = min(shaft.start for shaft in shafts) * 1e3
    end = max(shaft.end for shaft in shafts) * 1e3
    room = 0.04 * (end - start)
    return start - room, end + room


def _reach(spindle: Spindle) -> float:
    """Largest radius of anything drawn [mm]."""
    parts = spindle.parts.values()
    radii = [part.shaft.largest_diameter / 2.0 for part in parts]
    radii += [d.outer_diameter / 2.0 for part in parts for d in part.discs]
    radii += [(s.bearing.pitch_diameter + 2.1 * s.bearing.ball_diameter) / 2 for s in spindle.seats]
    sleeves = 9.0 if spindle.sleeves else 0.0
    return max(radii) * 1e3 + max(sleeves, 1.2 * _foot(spindle) if spindle.supports else 2.0)


def _draw_shaft(sketch: Sketch, spindle: Spindle, shades: dict[str, str], rank: int) -> None:
    """One rotor; of ``rank`` 0 the thinnest, alone with what is within its bore."""
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
    """The wall cut above the axis with the bore open behind it; the outside below."""
    (front, rear), (bore, end) = (
        [d * 500.0 for d in each] for each in (section.outer, section.inner)
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


def _hold(
    sketch: Sketch,
    axes: Axes,
    spindle: Spindle,
    lane: float,
    limits: tuple[float, float],
    scale: float,
) -> None:
    """Housing or sleeve above every bearing, with the names over it."""
    for seat in spindle.seats:
        if spindle.sleeve_of(seat.name) is None:
            top = (seat.bearing.pitch_diameter / 2 + 1.05 * seat.bearing.ball_diameter) * 1e3
            half = bearing_width(seat, spindle.seats) * 500.0
            draw_ground(sketch, seat.x * 1e3, top, half, upright=False, side=1.0)
    named = [(seat.x * 1e3, seat.name) for seat in spindle.seats]
    _words_in_a_row(axes, named, lane, limits, scale, weight="bold")
    said = [(_hold_sleeve(sketch, spindle, s), _sleeve_words(s)) for s in spindle.sleeves]
    for r in spindle.rotors:
        middle = (r.shaft.start + r.shaft.end) * 500.0
        said.append((middle, f"{r.name}: {r.speed_ratio:g} × the speed"))
    _words_in_a_row(axes, said, lane + 5.5 / scale, limits, scale, color=BLUE)


def _words_in_a_row(
    axes: Axes,
    words: Sequence[tuple[float, str]],
    y: float,
    limits: tuple[float, float],
    scale: float,
    **look: Any,
) -> None:
    """Words, each over its place or beside it, above ``y``."""
    places = spread([x for x, _ in words], [_text(each, scale) for _, each in words], *limits)
    for x, (_, each) in zip(places, words, strict=True):
        axes.text(x, y, each, ha="center", va="bottom", fontsize=FONT_SIZE, **look)


def _hold_sleeve(sketch: Sketch, spindle: Spindle, sleeve: Sleeve) -> float:
    """The sleeve over its bearings; returns the middle of these [mm]."""
    seats = [s for s in spindle.seats if s.name in sleeve.bearings]
    widths = [bearing_width(s, spindle.seats) / 2 for s in seats]
    left = min(s.x - w for s, w in zip(seats, widths, strict=True)) * 1e3
    right = max(s.x + w for s, w in zip(seats, widths, strict=True)) * 1e3
    base = max(s.bearing.pitch_diameter / 2 + 1.05 * s.bearing.ball_diameter for s in seats) * 1e3
    draw_sleeve(sketch, left, right, base, seats[0].thrust, stop=math.isfinite(sleeve.stop_travel))
    return sum(s.x for s in seats) / len(seats) * 1e3


def _sleeve_words(sleeve: Sleeve) -> str:
    parts = [sleeve.spring.words]
    if math.isfinite(sleeve.spring.stiffness):
        parts.append(sleeve.spring.rate)
    if math.isfinite(sleeve.stop_travel):
        parts.append(f"stop after {sleeve.stop_travel * 1e6:g} µm")
    return f"{sleeve.name}: {', '.join(parts)}"


def _foot(spindle: Spindle) -> float:
    """How far the ground is below the shaft [mm]."""
    return 0.02 * (spindle.shaft.end - spindle.shaft.start) * 1e3


def _supports(sketch: Sketch, spindle: Spindle) -> None:
    """Linear supports as a spring from a rotor down to the ground, rigid ones as a wedge."""
    foot = _foot(spindle)
    for support in spindle.supports:
        x = support.x * 1e3
        if support.against != GROUND:
            _between(sketch, spindle, support)
            continue
        radius, ground = _outside(spindle, support), _ground(spindle, support)
        if support.rigid:
            left, right = (x - 0.4 * foot, ground), (x + 0.4 * foot, ground)
            sketch.polygon([(x, -radius), left, right], "#FFFFFF", edge=BLUE)
        else:
            sketch.line(spring((x, -radius), (x, ground), 0.2 * foot), BLUE, 1.0)
        if support.name not in {name for each in spindle.housings for name in each.carries}:
            unit = 0.1 * foot
            draw_ground(sketch, x, ground, 4.0 * unit, upright=False, side=-1.0, unit=unit)
    for housing in spindle.housings:
        _housing(sketch, spindle, housing)


def _outside(spindle: Spindle, support: LinearSupport) -> float:
    """Radius of what a support holds [mm]."""
    shaft = spindle.part(support.holds).shaft
    return shaft.diameters_at(support.x)[0] * 500.0


def _ground(spindle: Spindle, support: LinearSupport) -> float:
    """Where a support stands on ground [mm]: below every rotor there."""
    there = [
        part.shaft.diameters_at(support.x)[0] * 500.0
        for part in spindle.parts.values()
        if part.shaft.start <= support.x <= part.shaft.end
    ]
    return -max(_outside(spindle, support), *there, 0.0) - _foot(spindle)


def _between(sketch: Sketch, spindle: Spindle, support: LinearSupport) -> None:
    """A crossed box between two rotors, in the gap from the thinner to the wall of the thicker."""
    low, high = _gap(spindle, support)
    half, x = 0.5 * max(high - low, 5.0), support.x * 1e3
    sketch.box(x - half, x + half, low, high, "#FFFFFF", edge=BLUE, z=5)
    sketch.cross(x - half, x + half, low, high, colour=BLUE, width=0.7, z=6)


def _gap(spindle: Spindle, support: LinearSupport) -> tuple[float, float]:
    """Radii between which a support joins two rotors [mm]."""
    ends = [spindle.part(end).shaft.diameters_at(support.x) for end in support.ends]
    (thin, _), (_, bore) = sorted(ends)
    low, high = thin * 500.0, bore * 500.0
    if high > low:
        return low, high
    return low - 2.0, low + 2.0  # side by side, or one on the other


def _housing(sketch: Sketch, spindle: Spindle, housing: Housing) -> None:
    """A block under the supports that it carries."""
    foot = _foot(spindle)
    feet = [(s.x * 1e3, _ground(spindle, s)) for s in spindle.supports if s.name in housing.carries]
    if feet:
        left, right = min(x for x, _ in feet) - 0.4 * foot, max(x for x, _ in feet) + 0.4 * foot
        low = min(y for _, y in feet) - 0.3 * foot
        sketch.box(left, right, low, low + 0.3 * foot, SLEEVE, z=4)
        for x, y in feet:
            sketch.line([(x, y), (x, low + 0.3 * foot)], BLUE, 1.0)


def _name_below(
    sketch: Sketch,
    axes: Axes,
    spindle: Spindle,
    reach: float,
    scale: float,
    limits: tuple[float, float],
) -> None:
    """Masses, supports, points, discs and the drawbar under the shaft, joined by leaders."""
    marks = _marks(sketch, spindle, 1.6 / scale)
    sizes = [max(_text(line, scale) for line in text.split("\n")) for _, _, text in marks]
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
            fontsize=FONT_SIZE - 1.5,
            linespacing=1.05,
        )


def _marks(sketch: Sketch, spindle: Spindle, size: float) -> list[tuple[float, float, str]]:
    """What is to be named: place of the leader's start [mm] and the words."""
    marks = []
    for rotor, part in spindle.parts.items():
        for mass in part.masses:
            height = _height(part, mass.x, rotor)
            _mass_symbol(sketch, mass, height, size)
            words = f"{mass.name.replace('_', ' ')}\n{mass.mass:.3g} kg"
            marks.append((mass.x * 1e3, height, words))
        marks += [(joint.x * 1e3, 0.0, joint.name) for joint in part.joints]
    for name, (rotor, x) in spindle.places.items():
        height = _height(spindle.part(rotor), x, rotor)
        sketch.circle(x * 1e3, height, 0.55 * size, "#FFFFFF", edge=BLACK, z=8)
        marks.append((x * 1e3, height, f"{name}\n{x * 1e3:.1f}"))
    foot = -_reach(spindle)
    for support in spindle.supports:
        low = foot if support.against == GROUND else _gap(spindle, support)[0]
        marks.append((support.x * 1e3, low, support.name))
    for housing in spindle.housings:
        carried = [s.x * 1e3 for s in spindle.supports if s.name in housing.carries]
        if carried:
            marks.append(((min(carried) + max(carried)) / 2.0, foot - 3.0, housing.name))
    discs = [disc for part in spindle.parts.values() for disc in part.discs]
    marks += [(disc.x * 1e3, foot, disc.name) for disc in discs]
    if bar := spindle.drawbar:
        marks.append(((bar.start + bar.end) * 500.0, 0.0, f"drawbar\n{bar.force / 1e3:.3g} kN"))
    return marks


def _height(part: Spindle, x: float, rotor: str) -> float:
    """Where something on a rotor is marked [mm]: on the axis, of a further one in its wall."""
    wall = sum(part.shaft.diameters_at(x)) * 250.0
    return 0.0 if rotor == SPINDLE else wall


def _mass_symbol(sketch: Sketch, mass: PointMass, height: float, size: float) -> None:
    """The quartered circle of a centre of gravity."""
    x = mass.x * 1e3
    sketch.circle(x, height, size, "#FFFFFF", edge=BLACK, z=7)
    for start in (0.0, math.pi):
        turn = [start + k * math.pi / 16.0 for k in range(9)]
        arc = [(x + size * math.cos(t), height + size * math.sin(t)) for t in turn]
        sketch.polygon([(x, height), *arc], BLACK, edge=BLACK, width=0.3, z=7)


def _text(words: str, scale: float) -> float:
    """Width of a line of text in axis units [mm of machine], with room to its neighbour."""
    return (len(words) * 0.56 * (FONT_SIZE - 1.0) * 25.4 / 72.0 + 2.5) / scale


def _legend(axes: Axes, spindle: Spindle) -> None:
    """Materials where there are several, and the symbols that are drawn."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    shades = _shades(spindle)
    some = shades.items() if len(shades) > 1 else ()
    handles: list[Any] = [Patch(fc=c, ec="#333333", lw=0.5, label=n) for n, c in some]
    parts = spindle.parts.values()
    circle: dict[str, Any] = dict(ls="none", ms=4.5, mec=BLACK, mew=0.7, mfc="white")
    halves: dict[str, Any] = dict(fillstyle="left", mfc=BLACK, mfcalt="white")
    symbols: list[tuple[object, str, dict[str, Any]]] = [
        (spindle.seats, "contact line", dict(color=RED, lw=0.9, ls="dashdot")),
        (spindle.places, "point", dict(marker="o", **circle)),
        ([m for p in parts for m in p.masses], "mass", dict(marker="o", **{**circle, **halves})),
        ([j for p in parts for j in p.joints], "joint", dict(color=RED, lw=1.4)),
    ]
    handles += [Line2D([], [], label=name, **look) for there, name, look in symbols if there]
    if not handles:
        return
    axes.legend(
        handles=handles,
        loc="lower right",
        bbox_to_anchor=(1.0, 0.0),
        frameon=False,
        fontsize=FONT_SIZE - 1.0,
        ncols=len(handles),
        handlelength=1.6,
        columnspacing=1.2,
        borderaxespad=0.0,
    )
