"""Discs and masses on a shaft that are possible but rarely intended: a sentence each."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import combinations

from rotordyn.machine.lumped import Disc, PointMass
from rotordyn.machine.spindle import Spindle

UNLIKE = 1.25  # bore over the diameter below it; some models count inner rings as shaft
TWICE = 0.1  # of a disc's mass that another disc shares
BORED = 0.02  # of a disc's mass that the shaft shares, as where the bore is left at zero
DENSEST, TIGHT = 2e4, 0.1  # [kg/m³] of any metal; share of the inertia of a solid ball of it
HALF = 0.501  # of the width of a disc: one at the end of a shaft reaches half beyond it
FAR = 1.0  # [m] radius of gyration of a body, where it is longer than the shaft


def implausible_bodies(spindle: Spindle) -> Iterator[str]:
    """Yield sentences about the discs and masses of a spindle."""
    yield from _discs(spindle)
    for body in spindle.masses:
        yield from _inertia(body, spindle.shaft.end - spindle.shaft.start)


def _discs(spindle: Spindle) -> Iterator[str]:
    start, end = spindle.shaft.reach
    for disc in spindle.discs:
        half = 0.5 * disc.width
        beyond = max(start - disc.x + half, disc.x + half - end)
        if disc.width > end - start or beyond > HALF * disc.width:
            yield (
                f"disc {disc.name}, {disc.width * 1e3:.4g} mm wide at {disc.x * 1e3:.4g} mm, "
                f"reaches {beyond * 1e3:.4g} mm beyond an end of the shaft, which is "
                f"{(end - start) * 1e3:.4g} mm long: check the unit of its width, and its station"
            )
        under = spindle.shaft.diameters_at(disc.x)[0]
        if disc.inner_diameter > UNLIKE * (widest := _diameter_below(spindle, disc)):
            yield (
                f"disc {disc.name} does not touch the shaft: its bore is "
                f"{disc.inner_diameter * 1e3:.4g} mm, what is below it {widest * 1e3:.4g} mm"
            )
            continue
        shared = max(min(under, disc.outer_diameter) ** 2 - disc.inner_diameter**2, 0.0)
        if shared > BORED * _ring(disc):
            yield (
                f"disc {disc.name} and the shaft fill the same space: its bore is "
                f"{disc.inner_diameter * 1e3:.4g} mm, the shaft there {under * 1e3:.4g} mm, so "
                "that mass is counted twice; give it the shaft's diameter as bore"
            )
    for one, other in combinations(spindle.discs, 2):
        high = min(one.outer_diameter, other.outer_diameter)
        low = max(one.inner_diameter, other.inner_diameter)
        both = max(_shared_length(one, other), 0.0) * max(high**2 - low**2, 0.0)
        if both > TWICE * min(each.width * _ring(each) for each in (one, other)):
            yield (
                f"discs {one.name} and {other.name} fill the same space, so that mass is counted "
                "twice: check their stations, widths and diameters"
            )


def _ring(disc: Disc) -> float:
    return disc.outer_diameter**2 - disc.inner_diameter**2


def _shared_length(one: Disc, other: Disc) -> float:
    """Return the length along the axis that two discs share [m], negative where they are apart."""
    ends = [(disc.x - 0.5 * disc.width, disc.x + 0.5 * disc.width) for disc in (one, other)]
    return min(end for _, end in ends) - max(start for start, _ in ends)


def _diameter_below(spindle: Spindle, disc: Disc) -> float:
    """Return the largest diameter that a disc may sit on, of the shaft or another disc [m]."""
    start, end = disc.x - 0.5 * disc.width, disc.x + 0.5 * disc.width
    stations = [start, disc.x, end, *(x for x in spindle.shaft.boundaries if start < x < end)]
    diameters = [
        other.outer_diameter
        for other in spindle.discs
        if other is not disc
        and other.outer_diameter <= UNLIKE * disc.inner_diameter
        and _shared_length(disc, other) > 0.0
    ]
    return max(*(spindle.shaft.diameters_at(x)[0] for x in stations), *diameters)


def _inertia(body: PointMass, length: float) -> Iterator[str]:
    """Yield a sentence where an inertia is far below any body of that mass, or implies a body
    beyond the machine of that length [m], as in a wrong unit."""
    ball = 0.4 * body.mass * (0.75 * body.mass / (math.pi * DENSEST)) ** (2.0 / 3.0)
    for axis in ("polar", "diametral"):
        inertia = getattr(body, f"{axis}_inertia")
        if 0.0 < inertia < TIGHT * ball:
            yield (
                f"mass {body.name}: its {axis} inertia of {inertia:.3g} kg m^2 is far below "
                f"that of any body of {body.mass:.4g} kg (a ball of tungsten has {ball:.2g}): "
                "check its unit"
            )
        if inertia > body.mass * max(FAR, length) ** 2 > 0.0:  # 0 kg is meant as inertia alone
            yield (
                f"mass {body.name}: its {axis} inertia of {inertia:.3g} kg m^2 is that of "
                f"{body.mass:.4g} kg at {math.sqrt(inertia / body.mass):.3g} m from the axis, on "
                f"a shaft {length:.3g} m long: check its unit"
            )
