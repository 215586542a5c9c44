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
    """The pole that grows fastest at every speed (``count``,) [rad/s], 0 where none does.

    It is one of the band that a model is made for; where none of these grows, the slowest beyond,
    which the model errs least in.
    """
    fastest, best = np.full(count, 0j), np.full(count, -np.inf)
    for modes in (one for one in systems if one.pole.size):
        ranks = np.where(modes.growing, rank(modes.pole, made_for(modes)), -np.inf)
        first = ranks.argmax(axis=-1)[..., None]
        pole, size = (
            np.take_along_axis(each, first, axis=-1)[..., 0] for each in (modes.pole, ranks)
        )
        fastest, best = np.where(size > best, pole, fastest), np.maximum(size, best)
    return fastest


def rank(pole: Complex, highest: float) -> Array:
    """Of growing poles [rad/s] the larger the sooner it is told of, by a model that is made for
    frequencies up to the ``highest`` [Hz]."""
    swing = np.abs(pole.imag)
    return np.where(swing <= 2.0 * math.pi * highest, pole.real, -swing)


def made_for(motions: FreeMotions) -> float:
    """The highest frequency [Hz] that a model is made for."""
    return motions.linear.structure.fine.frequency


def instability(systems: Iterable[FreeMotions], speed: Array) -> list[str]:
    """One sentence where some motion grows at some of ``speed`` [rad/s], else none."""
    systems = list(systems)
    fastest = fastest_growth(systems, len(speed))
    at = np.flatnonzero(fastest.real > 0.0)
    if not at.size:
        return []
    return [
        f"unstable at {at.size} of {len(speed)} speeds, first at "
        f"{number(speed[at[0]] * RPM.factor, 0)} rpm: the machine "
        f"{how_it_grows(fastest[at[0]], made_for(systems[0]))}; steady responses there are "
        "solutions of the linear equations that the machine does not reach by itself"
    ]


def how_it_grows(pole: complex, highest: float) -> str:
    """What the machine does in motion of such a ``pole`` [rad/s], which grows, of a model that is
    made for frequencies up to the ``highest`` [Hz].

    >>> how_it_grows(50.0 + 200.0j * math.pi, 400.0)
    'vibrates at 100 Hz, growing e-fold in 0.02 s'
    """
    hertz = abs(pole.imag) / (2.0 * math.pi)
    if hertz > highest:
        return (
            f"vibrates at about {float(f'{hertz:.2g}'):g} Hz, above the {highest:.4g} Hz that its "
            "model is made for (campbell with a higher max_frequency tells how it grows)"
        )
    how = f"vibrates at {hertz:.4g} Hz"
    if abs(pole.imag) <= STRAIGHT * pole.real:
        how = "moves away without vibrating (divergence, a static instability like buckling)"
    return f"{how}, growing e-fold in {1.0 / pole.real:.3g} s"
