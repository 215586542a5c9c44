"""Random stepped rotors on linear supports, stubby and slender sections side by side."""

from __future__ import annotations

import numpy as np

from bearings.materials import Material
from rotordyn.machine.lumped import Disc, PointMass
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
