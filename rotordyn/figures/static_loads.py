"""Static loads as arrows on the half-section [mm]: y upwards, z towards the viewer.

A moment about x or y is an arrow with two heads along its axis, one about z a turning arrow.
"""

from __future__ import annotations

import math

import numpy as np

from rotordyn.figures.sketch import Sketch
from rotordyn.figures.style import GREEN
from rotordyn.machine.spindle import Spindle
from rotordyn.scene.loads import PointLoad

FORCES, MOMENTS = ("Fx", "Fy", "Fz"), ("Mx", "My", "Mz")


def draw_load(sketch: Sketch, spindle: Spindle, load: PointLoad, long: float) -> tuple[float, str]:
    """Draw an arrow ``long`` for every force and moment of a load; return its station and label."""
    place = spindle.place(load.at)
    shaft = spindle.part(place.rotor).shaft
    x, radius = place.x * 1e3, shaft.diameters_at(place.x)[0] * 500.0
    short = 0.6 * long  # which fits at the end of a shaft
    side = -0.5 if abs(place.x - shaft.start) < abs(place.x - shaft.end) else 0.5
    if load.Fx:
        _arrow(sketch, (x + side * short, 0.0), math.copysign(1.0, load.Fx), short, along=True)
    if load.Fy:
        up = math.copysign(1.0, load.Fy)
        foot = -up * (radius + long / 2.0)
        _arrow(sketch, (x, foot), up, long, along=False)
    if load.Fz:
        _normal_force(sketch, x, radius + 0.35 * long, 0.2 * long, towards=load.Fz > 0.0)
    free = -1.0 if load.Fy < 0.0 else 1.0  # the side without the arrow of Fy
    if load.Mx:
        middle, sense = (x, free * (radius + 0.75 * long)), math.copysign(1.0, load.Mx)
        _arrow(sketch, middle, sense, 0.9 * long, along=True, heads=2)
    if load.My:  # beside Fz, on the side of the shaft
        middle = x - side * 0.9 * long, free * (radius + 0.5 * long)
        _arrow(sketch, middle, math.copysign(1.0, load.My), 0.8 * long, along=False, heads=2)
    if load.Mz:
        _turning_arrow(sketch, x, 0.4 * long, math.copysign(1.0, load.Mz))
    return x, "\n".join([load.name or "load", *_values(load)])


def height(spindle: Spindle, load: PointLoad, long: float) -> float:
    """Return the radius that the arrows of a load reach."""
    place = spindle.place(load.at)
    return spindle.part(place.rotor).shaft.diameters_at(place.x)[0] * 500.0 + long


def _values(load: PointLoad) -> list[str]:
    forces = [f"{key} {getattr(load, key):.5g} N" for key in FORCES if getattr(load, key)]
    return forces + [f"{key} {getattr(load, key):.5g} N·m" for key in MOMENTS if getattr(load, key)]


def _arrow(
    sketch: Sketch,
    middle: tuple[float, float],
    sense: float,
    length: float,
    *,
    along: bool,
    heads: int = 1,
) -> None:
    """Draw an arrow about ``middle`` along the axis or across it, its ``sense`` ±1."""
    (x, y), half, head = middle, 0.5 * length * sense, 0.32 * length

    def at(ahead: float, across: float) -> tuple[float, float]:
        return (x + ahead, y + across) if along else (x + across, y + ahead)

    sketch.line([at(-half, 0.0), at(half - head * sense, 0.0)], GREEN, 1.8, z=9)
    for k in range(heads):
        tip = half - 0.8 * k * head * sense
        neck = tip - head * sense
        shape = [at(tip, 0.0), at(neck, 0.4 * head), at(neck, -0.4 * head)]
        sketch.polygon(shape, GREEN, edge=GREEN, z=9)


def _turning_arrow(sketch: Sketch, x: float, radius: float, sense: float) -> None:
    """Draw three quarters of a circle about a point of the axis, anticlockwise for ``sense`` 1."""
    angle = np.linspace(-0.75 * np.pi, 0.75 * np.pi, 37) * sense
    arc = np.column_stack([x + radius * np.cos(angle), radius * np.sin(angle)])
    end, along = arc[-1], 0.6 * radius * sense * np.array([-np.sin(angle[-1]), np.cos(angle[-1])])
    across = 0.25 * radius * np.array([np.cos(angle[-1]), np.sin(angle[-1])])
    sketch.line(arc.tolist(), GREEN, 1.8, z=9)
    tip = [end + along, end + across, end - across]
    sketch.polygon([point.tolist() for point in tip], GREEN, edge=GREEN, z=9)


def _normal_force(sketch: Sketch, x: float, y: float, radius: float, *, towards: bool) -> None:
    """Draw a force normal to the drawing: the tip of its arrow (a dot) or its tail (a cross)."""
    sketch.circle(x, y, radius, "#FFFFFF", edge=GREEN, width=1.2, z=9)
    if towards:
        sketch.circle(x, y, 0.3 * radius, GREEN, edge=GREEN, z=10)
    else:
        half = radius / math.sqrt(2.0)
        sketch.cross(x - half, x + half, y - half, y + half, colour=GREEN, width=1.2, z=10)
