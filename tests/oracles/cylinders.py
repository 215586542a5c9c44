"""Cones as ever more cylinders, and the frequencies they tend to.

A frequency of n cylinders a cone has an error in even powers of 1/n, as long as each is as heavy as
its part; of n, 2n, 4n and 8n cylinders three such powers are eliminated (Romberg).
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from rotordyn.errors import NoSolution
from rotordyn.machine.shaft import Section
from rotordyn.machine.spindle import Spindle
from tests.oracles.exact_shaft.count import modes_below, whirl_frequencies
from tests.oracles.exact_shaft.poles import exact_mode
from tests.oracles.exact_shaft.rotor import ExactRotor, exact_rotor

Array = NDArray[np.float64]
NO_SEATS = np.zeros((0, 5, 5))
APART = 1e-6  # of a section: stations nearer to its ends are there
ENCLOSED = 1e-6  # relative: modes nearer than that to one another are enclosed by bisection


def cylinders(section: Section, count: int) -> tuple[Section, ...]:
    """A cone as equally long cylinders, each as heavy as its part; a cylinder as it is."""
    if section.outer[0] == section.outer[1] and section.inner[0] == section.inner[1]:
        return (section,)
    edge = np.linspace(0.0, 1.0, count + 1)
    mean = []
    for a, b in (section.outer, section.inner):
        d = a + edge * (b - a)
        mean.append(np.sqrt((d[1:] ** 2 + d[1:] * d[:-1] + d[:-1] ** 2) / 3.0))
    return tuple(
        Section(section.length / count, float(do), float(di), section.material)
        for do, di in zip(*mean, strict=True)
    )


def of_cylinders(spindle: Spindle, count: int) -> Spindle:
    """Every part of a cone between two stations as ``count`` cylinders: a station in the middle of
    one would leave errors that are no even powers."""
    shaft, pieces = spindle.shaft, []
    stations = np.array([at.x for at in (*spindle.supports, *spindle.lumped, *spindle.joints)])
    for own, left in zip(shaft.sections, shaft.boundaries, strict=False):
        share = np.unique((stations - left) / own.length)
        cuts = [0.0, *share[(share > APART) & (share < 1.0 - APART)], 1.0]
        for begin, end in pairwise(cuts):
            (a, b), (c, d) = (
                (p + begin * (q - p), p + end * (q - p)) for p, q in (own.outer, own.inner)
            )
            part = Section((end - begin) * own.length, a, c, own.material, "", b, d)
            pieces += cylinders(part, count)
    return replace(spindle, shaft=replace(shaft, sections=tuple(pieces)))


def cone_frequencies(
    spindle: Spindle, spin: float, near: Array, direction: int, first: int = 8
) -> tuple[Array, Array]:
    """The lowest frequencies of whirl [rad/s] of a rotor with cones, and how well each is known
    (relative), by the last step of the extrapolation; each proven to be the n-th.

    ``near`` (n,): where they are looked for, ascending; it only saves time.
    """
    found: list[Array] = []
    for count in (first, 2 * first, 4 * first, 8 * first):
        rotor = exact_rotor(of_cylinders(spindle, count), spin, NO_SEATS)
        found.append(_followed(rotor, _starts(found) if found else near, direction))
    row, last = found, found[-1]
    for power in (4.0, 16.0, 64.0):
        row = [(power * b - a) / (power - 1.0) for a, b in pairwise(row)]
        before, last = last, row[-1]
    return last, np.abs(last / before - 1.0)


def _starts(found: list[Array]) -> Array:
    """Where twice as many cylinders have their frequencies."""
    return found[-1] if len(found) == 1 else found[-1] + (found[-1] - found[-2]) / 4.0


def _followed(rotor: ExactRotor, starts: Array, direction: int) -> Array:
    """The frequencies near ``starts``, ascending, if each is the n-th; else by bisection."""
    fine = rotor.up_to(1.1 * float(starts.max()))
    try:
        own = np.array([abs(exact_mode(fine, direction * s).omega.real) for s in starts])
    except NoSolution:
        return whirl_frequencies(rotor, len(starts), direction)
    for order, omega in enumerate(own):
        for side, below in ((-1.0, order), (1.0, order + 1)):
            if modes_below(fine, direction * omega * (1.0 + side * ENCLOSED)) != below:
                return whirl_frequencies(rotor, len(starts), direction)
    return own
