"""Random stepped rotors on linear supports, stubby and slender sections side by side; with cones,
joints, and a further rotor on the axis."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from bearings.materials import Material
from rotordyn.machine.joint import Joint
from rotordyn.machine.lumped import Disc, PointMass
from rotordyn.machine.rotor import Rotor
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport

STEEL = Material("steel", 2.1e11, 0.3, 7800.0)
LIGHT = Material("light", 7.1e10, 0.33, 2800.0)


def stepped_rotor(
    rng: np.random.Generator, *, isotropic: bool = True, damped: bool = False, sections: int = 8
) -> Spindle:
    """Up to ``sections`` with L/d from 0.2 to 500 (logarithmic), discs, masses, two to four
    supports."""
    diameter = 10.0 ** rng.uniform(-2.3, -1.0)
    pieces = []
    for _ in range(rng.integers(1, sections + 1)):
        own = diameter * 10.0 ** rng.uniform(-0.3, 0.3)
        slender = 10.0 ** rng.uniform(np.log10(0.2), np.log10(500.0 if rng.random() < 0.1 else 8.0))
        bore = own * float(rng.choice([0.0, rng.uniform(0.1, 0.8)]))
        material = STEEL if rng.random() < 0.8 else LIGHT
        pieces.append(Section(own * slender, own, bore, material))
    shaft = Shaft(0.0, tuple(pieces))
    span = shaft.end
    mass = sum(np.pi / 4 * (s.outer_diameter**2) * s.length * s.material.density for s in pieces)
    masses = [
        PointMass(
            f"m{k}",
            rng.uniform(0, span),
            0.3 * mass * rng.random(),
            *_inertias(rng, mass, diameter),
        )
        for k in range(rng.integers(0, 3))
    ]
    discs = [
        Disc(f"d{k}", rng.uniform(0, span), 4.0 * diameter, diameter, 0.5 * diameter, STEEL)
        for k in range(rng.integers(0, 3))
    ]
    thin = min(s.outer_diameter**4 - s.inner_diameter**4 for s in pieces)
    flexible = 48.0 * 2.1e11 * np.pi * thin / 64.0 / span**3
    places = sorted(rng.uniform(0, span, rng.integers(2, 5)))
    supports = [
        _support(f"s{k}", x, flexible, rng, isotropic, damped) for k, x in enumerate(places)
    ]
    return Spindle(
        "random", shaft, masses=tuple(masses), discs=tuple(discs), supports=tuple(supports)
    )


def conical(rng: np.random.Generator, spindle: Spindle) -> Spindle:
    """Most sections of its shaft as cones: outer diameters up to three times as large or as small
    at the rear, the bore with a taper of its own."""
    pieces = []
    for own in spindle.shaft.sections:
        steep, wall = rng.uniform(-1.0, 1.0, 2) * np.log(3.0)
        outer = own.outer_diameter * float(np.exp(steep * rng.random()))
        share = 1.0 - own.inner_diameter / own.outer_diameter
        inner = outer * (1.0 - min(share * float(np.exp(wall)), 0.95)) if share < 1.0 else 0.0
        taper = {"rear_outer_diameter": outer, "rear_inner_diameter": inner}
        pieces.append(replace(own, **taper) if rng.random() < 0.7 else own)
    return replace(spindle, shaft=replace(spindle.shaft, sections=tuple(pieces)))


def jointed(rng: np.random.Generator, spindle: Spindle) -> Spindle:
    """One to three joints that give way across the axis, from much softer to much stiffer than the
    shaft, some damped."""
    shaft = spindle.shaft
    thick = max(s.outer_diameter for s in shaft.sections)
    bending = 2.1e11 * np.pi * thick**4 / 64.0
    joints = []
    for k in range(rng.integers(1, 4)):
        radial, tilt = 10.0 ** rng.uniform(-3.0, 3.0, 2)
        radial, tilt = radial * bending / thick**3, tilt * bending / thick
        loss = 10.0 ** rng.uniform(-7.0, -5.0) if rng.random() < 0.5 else 0.0
        ways = [("radial", float(radial)), ("tilt", float(tilt))]
        chosen = [ways, ways[:1], ways[1:]][rng.integers(0, 3)]
        values = dict(chosen)
        values |= {f"{name}_damping": value * loss for name, value in chosen if loss}
        joints.append(Joint(f"j{k}", float(rng.uniform(0.05, 0.95) * shaft.end), **values))
    return replace(spindle, joints=tuple(joints))


def coaxial(rng: np.random.Generator, spindle: Spindle, *, damped: bool = False) -> Spindle:
    """With a further rotor on its axis, at −3 to 3 times its speed, on two or three supports to
    ground or to the spindle's shaft, some of them cones or with joints."""
    other = stepped_rotor(rng, isotropic=False, damped=damped, sections=4)
    if rng.random() < 0.3:
        other = conical(rng, other)
    if rng.random() < 0.3:
        other = jointed(rng, other)
    end = spindle.shaft.end
    ratio = float(rng.choice([0.0, 1.0, rng.uniform(-3.0, 3.0)], p=[0.1, 0.1, 0.8]))
    scale = 0.8 * end / other.shaft.end
    begin = float(rng.uniform(0.0, 0.2) * end)

    def moved(item: LinearSupport | PointMass | Disc | Joint) -> float:
        return begin + scale * item.x

    sections = tuple(replace(s, length=scale * s.length) for s in other.shaft.sections)
    rotor = Rotor(
        "other",
        ratio,
        Shaft(begin, sections),
        masses=tuple(replace(m, x=moved(m)) for m in other.masses),
        discs=tuple(replace(d, x=moved(d)) for d in other.discs),
        joints=tuple(replace(j, x=moved(j)) for j in other.joints),
    )
    supports = [
        replace(
            own,
            name=f"o{k}",
            x=moved(own),
            holds="other",
            against="spindle" if rng.random() < 0.5 else "ground",
        )
        for k, own in enumerate(other.supports)
    ]
    return replace(spindle, rotors=(rotor,), supports=(*spindle.supports, *supports))


def _inertias(rng: np.random.Generator, mass: float, diameter: float) -> tuple[float, float]:
    polar = 0.3 * mass * diameter**2 * rng.random()
    return polar, polar * rng.uniform(0.5, 3.0)


def _support(
    name: str, x: float, scale: float, rng: np.random.Generator, isotropic: bool, damped: bool
) -> LinearSupport:
    stiff = scale * 10.0 ** rng.uniform(-1.0, 3.0)
    other = stiff if isotropic else stiff * rng.uniform(0.3, 3.0)
    entries = {("y", "y"): stiff, ("z", "z"): other}
    damping = {}
    if damped:
        ratio = 10.0 ** rng.uniform(-6, -3.5)
        damping = {("y", "y"): stiff * ratio, ("z", "z"): other * ratio}
    return LinearSupport(name, float(x), entries, damping)
