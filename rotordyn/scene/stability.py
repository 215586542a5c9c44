"""Motions that grow by themselves, among all eigenvalues that were solved."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from rotordyn.arrays import Array, Complex
from rotordyn.equation.free_motion import FreeMotions
from rotordyn.results.display import RPM, number

STRAIGHT = 1e-2  # of the growth: a motion that turns less while it grows e-fold does not swing


def fastest_growth(systems: Iterable[FreeMotions], count: int) -> Complex:
    """The pole that grows fastest at every speed (``count``,) [rad/s], 0 where none does."""
    fastest = np.full(count, 0j)
    for modes in (one for one in systems if one.pole.size):
        pole = np.where(modes.growing, modes.pole, 0.0)
        first = np.take_along_axis(pole, pole.real.argmax(axis=-1)[..., None], axis=-1)[..., 0]
        fastest = np.where(first.real > fastest.real, first, fastest)
    return fastest


def instability(systems: Iterable[FreeMotions], speed: Array) -> list[str]:
    """One sentence where some motion grows at some of ``speed`` [rad/s], else none."""
    fastest = fastest_growth(systems, len(speed))
    at = np.flatnonzero(fastest.real > 0.0)
    if not at.size:
        return []
    return [
        f"unstable at {at.size} of {len(speed)} speeds, first at "
        f"{number(speed[at[0]] * RPM.factor, 0)} rpm: the machine "
        f"{how_it_grows(fastest[at[0]])}; steady responses there are solutions of "
        "the linear equations that the machine does not reach by itself"
    ]


def how_it_grows(pole: complex) -> str:
    """What the machine does in motion of such a ``pole`` [rad/s], which grows.

    >>> how_it_grows(50.0 + 200.0j * math.pi)
    'vibrates at 100 Hz, growing e-fold in 0.02 s'
    """
    how = f"vibrates at {abs(pole.imag) / (2.0 * math.pi):.4g} Hz"
    if abs(pole.imag) <= STRAIGHT * pole.real:
        how = "moves away without vibrating (divergence, a static instability like buckling)"
    return f"{how}, growing e-fold in {1.0 / pole.real:.3g} s"
