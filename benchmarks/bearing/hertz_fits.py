"""Exact elliptic integrals against the usual fits: k, and its effect on load and K.

Curvature radii Ry/Rx of the contact give the ellipticity κ and the integrals K, E by

- Brewe & Hamrock, J. Lubr. Technol. 99 (1977) 485: 1.0339 r^0.636, 1.5277 + 0.6023 ln r,
  1.0003 + 0.5968/r;
- Hamrock & Brewe, J. Lubr. Technol. 105 (1983) 171: r^(2/π), π/2 + q ln r, 1 + q/r, q = π/2 − 1.

The reference is that of mpmath with 30 digits.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import Any
from unittest import mock

import mpmath
import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk

from bearings import AngularContactBallBearing
from bearings.contact import hertz
from bearings.contact.hertz import HertzContact
from bearings.geometry import geometry
from benchmarks.bearing.reference import largest
from benchmarks.bearing.subject import LOAD, SPEED, VEX70, solver
from benchmarks.bearing.timing import fastest
from tests.oracles.known_bearings import HARRIS_218, RPM

Array = NDArray[np.float64]
Solve = Callable[[float, float, float], HertzContact]
Elliptic = tuple[float, float, float]  # κ and the integrals of first and second kind
COMPLIANCE = 1.0e-11
CONFORMITIES = (0.51, 0.52, 0.54, 0.56)
STEEPEST = 500.0  # κ


def measure_hertz(repeats: int = 7) -> list[dict[str, Any]]:
    """µs per contact, errors of k, of load at given displacement and of K at given load."""
    cases = [_contact(f, side) for f in CONFORMITIES for side in (1.0, -1.0)]
    truth = [_truth(*case) for case in cases]
    with solver(compiled=False):
        points = [_working_point(*point) for point in POINTS]
        return [_line(name, solve, cases, truth, points, repeats) for name, solve in WAYS.items()]


def brewe_hamrock(r: float) -> Elliptic:
    """The fit of 1977."""
    return 1.0339 * r**0.636, 1.5277 + 0.6023 * math.log(r), 1.0003 + 0.5968 / r


def hamrock_brewe(r: float) -> Elliptic:
    """The fit of 1983."""
    q = math.pi / 2.0 - 1.0
    return r ** (2.0 / math.pi), math.pi / 2.0 + q * math.log(r), 1.0 + q / r


def fitted(fit: Callable[[float], Elliptic], total: float, part: float, c: float) -> HertzContact:
    """A contact of curvature sum and difference, like ``bearings.hertz.contact``."""
    return _of_integrals(*fit((1.0 + part) / (1.0 - part)), total, c)


def by_scipy(tolerance: float, total: float, part: float, c: float) -> HertzContact:
    """The ellipticity by ``brentq``, the integrals by ``scipy.special``."""

    def fault(log: float) -> float:
        kappa = math.exp(log)
        first, second = ellipk(1.0 - kappa**-2), ellipe(1.0 - kappa**-2)
        return 1.0 - 2.0 * (first / second - 1.0) / (kappa**2 - 1.0) - part

    kappa = math.exp(brentq(fault, 1e-3, math.log(STEEPEST), xtol=tolerance, rtol=1e-14))
    m = 1.0 - kappa**-2
    return _of_integrals(kappa, float(ellipk(m)), float(ellipe(m)), total, c)


WAYS: dict[str, Solve] = {
    "exact, `bearings.contact.hertz`": hertz.contact,
    "Brewe and Hamrock 1977": partial(fitted, brewe_hamrock),
    "Hamrock and Brewe 1983": partial(fitted, hamrock_brewe),
    **{
        f"SciPy, `brentq` to {t:.0e}": partial(by_scipy, t)
        for t in (1e-1, 1e-2, 1e-3, 1e-5, 1e-8, 1e-12)
    },
}
POINTS = (
    (VEX70, LOAD, SPEED),
    (HARRIS_218, np.array([17800.0, 0.0, 0.0, 0.0, 0.0]), 10000.0 * RPM),
)


def _of_integrals(
    kappa: float, first: float, second: float, total: float, c: float
) -> HertzContact:
    major = (2.0 * kappa**2 * second / math.pi * 1.5 * c / total) ** (1.0 / 3.0)
    approach = 1.5 * c * first / (math.pi * major)
    return HertzContact(approach**-1.5, kappa, second, major, major / kappa)


def _contact(conformity: float, side: float) -> tuple[float, float, float]:
    """Curvature sum, difference and compliance of the proportions of VEX 70."""
    d, gamma = 9.525e-3, 0.096
    rolling, groove = side * 2.0 / d * gamma / (1.0 - side * gamma), -1.0 / (conformity * d)
    total = 4.0 / d + rolling + groove
    return total, (rolling - groove) / total, COMPLIANCE


def _truth(total: float, part: float, c: float) -> float:
    """k in 30 digits."""
    with mpmath.workdps(30):

        def fault(kappa: Any) -> Any:
            m = 1 - 1 / kappa**2
            return 1 - 2 * (mpmath.ellipk(m) / mpmath.ellipe(m) - 1) / (kappa**2 - 1) - part

        kappa = mpmath.findroot(fault, hertz.ellipticity(part))
        m = 1 - 1 / kappa**2
        major = mpmath.cbrt(2 * kappa**2 * mpmath.ellipe(m) / mpmath.pi * 3 * c / (2 * total))
        return float((3 * c * mpmath.ellipk(m) / (2 * mpmath.pi * major)) ** mpmath.mpf("-1.5"))


@contextmanager
def contacts(solve: Solve) -> Iterator[None]:
    """Bearings described within the context have contacts by ``solve``."""
    geometry.cache_clear()
    try:
        with mock.patch("bearings.geometry.contact", solve):
            yield
    finally:
        geometry.cache_clear()


Point = tuple[AngularContactBallBearing, Array, float, Array, Array, Array]


def _working_point(bearing: AngularContactBallBearing, load: Array, speed: float) -> Point:
    state = bearing.equilibrium(load=load, speed=speed)
    half = bearing.pitch_diameter / 2.0
    lever = np.array([1.0, 1.0, 1.0, 1.0 / half, 1.0 / half])
    return bearing, load, speed, state.displacement, state.stiffness(), lever


def _line(
    name: str,
    solve: Solve,
    cases: list[tuple[float, float, float]],
    truth: list[float],
    points: list[Point],
    repeats: int,
) -> dict[str, Any]:
    seconds = fastest(lambda: [solve(*case) for case in cases], repeats) / len(cases)
    wrong = [abs(solve(*case).stiffness / k - 1.0) for case, k in zip(cases, truth, strict=True)]
    pairs = np.array(wrong).reshape(-1, 2).max(axis=1)
    with contacts(solve):
        worked = [_worked(point) for point in points]
    return {
        "way": name,
        "contact": 1e6 * seconds,
        "k": dict(zip(map(str, CONFORMITIES), pairs.tolist(), strict=True)),
        "load": [load for load, _ in worked],
        "stiffness": [k for _, k in worked],
    }


def _worked(point: Point) -> tuple[float, float]:
    """Errors of load at the displacement and of K at the load of a working point."""
    bearing, load, speed, shift, k, lever = point
    carried = bearing.equilibrium(displacement=shift, speed=speed).load
    stiff = bearing.equilibrium(load=load, speed=speed).stiffness()
    return (
        largest(carried - load, load, lever),
        largest((stiff - k) * lever, k * lever, lever[:, None]),
    )
