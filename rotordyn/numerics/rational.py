"""Poles of a rational function close to a response that is known as a function, without noise.

Source: Nakatsukasa, Sète and Trefethen (2018), the AAA algorithm, as SciPy has it.
"""

from __future__ import annotations

import warnings
from typing import NamedTuple

import numpy as np

from rotordyn.arrays import Array, Complex

MOST = 40  # interpolated samples: twice as many as pairs of poles, and one
SAMPLES = 1000  # of a response, uniform: more take time without gain
REAL = 1e-3  # of a pole: one with a smaller imaginary part is real
LEAST_DAMPING = 1e-6  # of |pole|: least distance of poles left of the axis


class RationalPoles(NamedTuple):
    """Poles ``pole`` (m,) of Im ≥ 0, left of the imaginary axis, and the distance ``near`` of the
    rational function from the response over its largest value."""

    pole: Complex
    near: float


def rational_poles(omega: Array, response: Complex, near: float) -> RationalPoles:
    """Return poles of a rational function within ``near``, a share of the largest value, of a
    ``response`` (f,) at ``omega`` (f,) > 0 [rad/s]; at least one, and those of the nearest function
    if none is as close."""
    from scipy.interpolate import AAA

    taken = slice(None, None, -(-len(omega) // SAMPLES))
    s, response = 1j * omega[taken], response[taken]
    with np.errstate(all="ignore"), warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # no function as close
        function = AAA(s, response, rtol=near, max_terms=MOST, clean_up=False)
        pole = function.poles()
    distance = float(function.errors[-1] / np.abs(response).max())
    size = np.abs(pole)
    pole = pole[np.isfinite(size) & (size > 0.0) & (pole.imag > -REAL * size)]
    if not len(pole):
        return RationalPoles(np.array([(-LEAST_DAMPING + 1j) * omega[-1]]), distance)
    size = np.abs(pole)
    frequency = np.where(pole.imag > REAL * size, pole.imag, 0.0)
    left = np.sort_complex(-np.maximum(np.abs(pole.real), LEAST_DAMPING * size) + 1j * frequency)
    return RationalPoles(left, distance)
