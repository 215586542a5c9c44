"""Unstable motions among all eigenvalues that are solved."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from rotordyn.arrays import Array, Complex
from rotordyn.equation.free_motion import FreeMotions
from rotordyn.results.display import RPM, number
from rotordyn.results.severity import Severity, of_severity

STRAIGHT = 1e-2  # |Im λ| / Re λ of a growing motion below which it is a divergence


def fastest_growth(systems: Iterable[FreeMotions], count: int) -> Complex:
    """Return the fastest growing pole at every speed (``count``,) [rad/s], 0 where none grows.

    Poles in the frequency band of the model come first; where none of these grows, the one of
    lowest frequency beyond, which has the least error of the model.
    """
    fastest, best = np.full(count, 0j), np.full(count, -np.inf)
    for modes in (motions for motions in systems if motions.pole.size):
        ranks = np.where(modes.growing, rank(modes.pole, made_for(modes)), -np.inf)
        first = ranks.argmax(axis=-1)[..., None]
        pole, size = (
            np.take_along_axis(values, first, axis=-1)[..., 0] for values in (modes.pole, ranks)
        )
        fastest, best = np.where(size > best, pole, fastest), np.maximum(size, best)
    return fastest


def rank(pole: Complex, highest: float) -> Array:
    """Rank growing poles [rad/s]: by growth up to the ``highest`` frequency [Hz] that the model is
    made for, behind these by falling frequency. The largest is reported first."""
    frequency = np.abs(pole.imag)
    return np.where(frequency <= 2.0 * math.pi * highest, pole.real, -frequency)


def made_for(motions: FreeMotions) -> float:
    """Return the highest frequency [Hz] that a model is made for."""
    return motions.linear.structure.fine.frequency


@of_severity(Severity.NO_STATE)
def instability(systems: Iterable[FreeMotions], speed: Array) -> list[str]:
    """Return one sentence where a motion is unstable at some of ``speed`` [rad/s], else none."""
    systems = list(systems)
    fastest = fastest_growth(systems, len(speed))
    unstable = np.flatnonzero(fastest.real > 0.0)
    if not unstable.size:
        return []
    return [
        f"unstable at {unstable.size} of {len(speed)} speeds, first at "
        f"{number(speed[unstable[0]] * RPM.factor, 0)} rpm: the machine "
        f"{how_it_grows(fastest[unstable[0]], made_for(systems[0]))}; steady responses there are "
        "solutions of the linear equations that an unstable machine does not reach"
    ]


def how_it_grows(pole: complex, highest: float) -> str:
    """Describe the motion of a growing ``pole`` [rad/s], of a model that is made for frequencies
    up to the ``highest`` [Hz].

    >>> how_it_grows(50.0 + 200.0j * math.pi, 400.0)
    'vibrates at 100 Hz, its amplitude grows by a factor e in 0.02 s'
    """
    hertz = abs(pole.imag) / (2.0 * math.pi)
    if hertz > highest:
        return (
            f"vibrates at about {float(f'{hertz:.2g}'):g} Hz, above the {highest:.4g} Hz that its "
            "model is made for (campbell with a higher max_frequency gives its growth)"
        )
    motion = f"vibrates at {hertz:.4g} Hz"
    if abs(pole.imag) <= STRAIGHT * pole.real:
        motion = "moves away without vibrating (divergence, a static instability like buckling)"
    return f"{motion}, its amplitude grows by a factor e in {1.0 / pole.real:.3g} s"
