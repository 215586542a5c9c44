"""Symbols of bearings, sleeves, springs, ground and the drawbar on a half-section [mm]."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from rotordyn.figures.sketch import Sketch
from rotordyn.figures.style import BLUE, RED
from rotordyn.machine.drawbar import Drawbar
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.shaft import Shaft

RING, BALL, SLEEVE, GROUND, BAR = "#C9D3DC", "#FFFFFF", "#E9DFC7", "#555555", "#A8B0B8"
Line = list[tuple[float, float]]
FLATTEST = math.radians(60.0)  # contact lines of larger angles do not reach the axis
ON_AXIS = 1e-9  # m
MISFIT = 0.02  # of the shaft diameter: a bore that differs more does not fit
SLEEVE_WALL = 9.0
GROUND_DEPTH = 1.8  # units of its hatching


def contact_lines(seat: BearingSeat) -> list[Line]:
    """Return the contact lines of a ball, each from the axis through the ball centre [m].

    A push on the inner ring in the direction of ``thrust`` presses the ball against the outer race
    ahead of it: the line leans forward, and meets the axis ``thrust`` · r · tan α behind the
    bearing, the pressure centre. A line flatter than ``FLATTEST`` ends before the axis.
    """
    ball, beyond = seat.bearing.pitch_diameter / 2.0, 1.1 * seat.bearing.ball_diameter
    lines = []
    for angle in seat.bearing.contact_lines:
        upright = max(abs(math.cos(angle)), math.cos(FLATTEST))
        rise, lean = math.cos(angle) / upright, seat.thrust * math.sin(angle) / upright
        lines.append([(seat.x + lean * end, ball + rise * end) for end in (-ball, beyond)])
    return lines


def outside_of(seat: BearingSeat) -> float:
    """Return the radius of the outer ring as drawn [mm]."""
    return (seat.bearing.pitch_diameter / 2.0 + 1.05 * seat.bearing.ball_diameter) * 1e3


def bore_of(seat: BearingSeat, shaft_radius: float) -> float:
    """Return the radius of the bore of the inner ring as drawn [mm].

    It is ``shaft_radius`` [m], unless the model gives a bore that the shaft does not fit.
    """
    bore = seat.sizes.get("bore_diameter", 2.0 * shaft_radius) / 2.0
    if abs(bore - shaft_radius) > MISFIT * shaft_radius:
        return bore * 1e3
    largest = seat.bearing.pitch_diameter / 2.0 - 0.35 * seat.bearing.ball_diameter
    return min(shaft_radius, largest) * 1e3


def draw_bearing(sketch: Sketch, seat: BearingSeat, width: float, shaft_radius: float) -> None:
    """Draw a bearing, [m] in, [mm] out: upper half cut with ball and contact lines, lower half a
    crossed box."""
    ball, pitch = seat.bearing.ball_diameter * 1e3, seat.bearing.pitch_diameter * 500.0
    left, right, x = (seat.x - width / 2.0) * 1e3, (seat.x + width / 2.0) * 1e3, seat.x * 1e3
    bore, outside = bore_of(seat, shaft_radius), outside_of(seat)
    sketch.box(left, right, bore, pitch - 0.18 * ball, RING, z=4)
    sketch.box(left, right, pitch + 0.18 * ball, outside, RING, z=4)
    sketch.circle(x, pitch, ball / 2.0, BALL, z=5)
    sketch.box(left, right, -outside, -bore, RING, z=4)
    sketch.cross(left, right, -outside, -bore, width=0.4, z=5)
    for foot, tip in contact_lines(seat):
        line = [(a * 1e3, r * 1e3) for a, r in (foot, tip)]
        sketch.line(line, RED, 0.9, "dashdot", z=6)
        if foot[1] <= ON_AXIS:
            sketch.circle(*line[0], 0.9, RED, edge=RED, z=6)


def spring(start: tuple[float, float], end: tuple[float, float], half: float) -> Line:
    """Return a zigzag of half-height ``half`` between two points."""
    a, b = np.array(start), np.array(end)
    along, across = b - a, np.array([a[1] - b[1], b[0] - a[0]])
    across = across / np.hypot(*across) * half
    steps = [(0.0, 0.0), (0.12, 0.0)]
    steps += [(0.12 + 0.76 * (k + 0.5) / 6.0, (-1.0) ** k) for k in range(6)]
    steps += [(0.88, 0.0), (1.0, 0.0)]
    points = [a + along * s + across * t for s, t in steps]
    return [(float(p[0]), float(p[1])) for p in points]


def draw_ground(
    sketch: Sketch,
    x: float,
    y: float,
    half: float,
    *,
    upright: bool,
    side: float,
    unit: float = 1.0,
) -> None:
    """Draw a wall through (x, y), hatched in ``unit`` mm towards ``side`` (+1 or −1)."""
    count, depth, step = max(round(2.0 * half / (2.2 * unit)), 2), GROUND_DEPTH * unit, 1.2 * unit

    def at(along: float, into: float) -> tuple[float, float]:
        return (x + into, y + along) if upright else (x + along, y + into)

    sketch.line([at(-half, 0.0), at(half, 0.0)], GROUND, 1.0)
    for start in np.linspace(-half, half - step, count):
        sketch.line([at(start, 0.0), at(start + step, side * depth)], GROUND, 0.5)


def sleeve_top(carried: Iterable[BearingSeat]) -> float:
    """Return the outer radius of the sleeve over its bearings [mm]."""
    return max(outside_of(seat) for seat in carried) + SLEEVE_WALL


def draw_sleeve(
    sketch: Sketch,
    left: float,
    right: float,
    base: float,
    thrust: int,
    *,
    stop: bool,
    rigid: bool,
    grounded: bool,
) -> None:
    """Draw a sleeve over its bearings, its spring and its stop; of ``rigid`` preload it is fixed.

    The spring pushes against ``thrust``, so that it is on the ``thrust`` side, like the stop.
    """
    top = base + SLEEVE_WALL
    sketch.box(left, right, base, top, SLEEVE, z=4)
    if rigid:
        if grounded:
            half = (right - left) / 2.0
            draw_ground(sketch, left + half, top, half, upright=False, side=1.0)
        return
    face = right if thrust > 0 else left
    wall = face + thrust * 13.0
    sketch.line(spring((face, base + 2.8), (wall, base + 2.8), 1.7), BLUE, 1.0)
    draw_ground(sketch, wall, base + 2.8, 2.8, upright=True, side=float(thrust))
    if stop:
        near = face + thrust * 2.4
        sketch.line([(near, base + 7.3), (wall, base + 7.3)], GROUND, 1.0)
        sketch.line([(near, base + 5.9), (near, base + 8.7)], GROUND, 1.8)
        draw_ground(sketch, wall, base + 7.3, 1.7, upright=True, side=float(thrust))


def draw_drawbar(sketch: Sketch, bar: Drawbar, shaft: Shaft) -> None:
    """Draw the drawbar, [m] in, [mm] out, in the upper half of the bore, which it fills if guided
    everywhere.

    It has a plate at either end, where it pulls the shaft, and a ring at every guide.
    """
    bore = _narrowest(bar, shaft) * 500.0
    radius = 0.55 * bore if bar.contacts else bore
    start, end = bar.start * 1e3, bar.end * 1e3
    thick = min(0.012 * (shaft.end - shaft.start) * 1e3, 0.25 * (end - start))
    sketch.box(start, end, 0.0, radius, BAR, z=4)
    for left in (start, end - thick):
        sketch.box(left, left + thick, 0.0, bore, BAR, z=4)
    for x in bar.contacts[1:-1]:
        sketch.box(x * 1e3 - thick / 2.0, x * 1e3 + thick / 2.0, radius, bore, BAR, z=4)


def _narrowest(bar: Drawbar, shaft: Shaft) -> float:
    """Return the narrowest bore along the bar [m]; without a bore, a third of the shaft."""
    edges = shaft.boundaries
    along = [
        section
        for section, left, right in zip(shaft.sections, edges, edges[1:], strict=False)
        if left < bar.end and right > bar.start
    ]
    bores = [bore for section in along for bore in section.inner if bore > 0.0]
    return min(bores) if bores else min(min(section.outer) for section in along) / 3.0
