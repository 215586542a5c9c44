"""Limits of milling and shaping of published machines, converged in the time domain."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rotordyn.analyses.stability_lobes import limit_depth, turning_limit
from tests.oracles.milling_floquet import Machine, Milling

RPM = math.pi / 30.0
X, Y = (1.0, 0.0), (0.0, 1.0)
STIFF = 0.03993 * (2.0 * math.pi * 922.0) ** 2
ONE = Machine(((922.0, 0.011, STIFF, X),))
TWO = Machine(((922.0, 0.011, STIFF, X), (922.0, 0.011, STIFF, Y)))
WECK = Machine(((603.0, 0.039, 5.59e6, X), (666.0, 0.035, 5.715e6, Y)))
AL7075 = Machine(
    (
        (456.780, 0.111705, 7.93310e6, X),
        (1448.889, 0.0170370, 1.469178e7, X),
        (516.518, 0.0245796, 9.37461e6, Y),
        (1408.448, 0.0313576, 1.240639e7, Y),
    )
)
SLOT = (0.0, math.pi)
HALF_UP, HALF_DOWN = (0.0, math.pi / 2.0), (math.pi / 2.0, math.pi)
UP, DOWN = (0.0, math.acos(0.9)), (math.acos(-0.9), math.pi)
B = (2, 6e8, 2e8)
A, I = (3, 6e8, 0.07 * 6e8), (2, 1319.41e6, 788.83e6)  # noqa: E741
# Insperger and Stépán 2004 and Ding 2010 (machine), Altintas and Budak 1995 [M], Altintas 2012:
# speed [rpm], limit by collocation [mm], limit of zero order [mm], kind of loss
CASES = [
    *[
        (ONE, B, SLOT, *row, "hopf")
        for row in (
            (5000, 0.408628, 0.369919),
            (10000, 0.322379, 0.306858),
            (18000, 0.689539, 0.551384),
            (25000, 3.93993, 5.80426),
        )
    ],
    (ONE, B, HALF_UP, 6000, 0.227894, 0.223357, "hopf"),
    (ONE, B, HALF_UP, 11000, 0.368196, 0.354763, "hopf"),
    (ONE, B, HALF_UP, 17000, 0.251865, 0.244887, "hopf"),
    (ONE, B, DOWN, 10000, 4.09071, 8.43690, "flip"),
    (ONE, B, DOWN, 14000, 13.0003, 17.8491, "flip"),
    (ONE, B, DOWN, 19000, 3.84070, 3.10380, "hopf"),
    (TWO, B, UP, 10000, 1.48695, 1.35011, "hopf"),
    (TWO, B, UP, 14000, 8.45533, 9.12019, "hopf"),
    (TWO, B, UP, 19000, 1.18347, 4.20317, "flip"),
    (WECK, A, HALF_UP, 5000, 1.09739, 1.08702, "hopf"),
    (WECK, A, HALF_UP, 8000, 1.09823, 1.09536, "hopf"),
    (WECK, A, HALF_UP, 11000, 2.09864, 2.02415, "hopf"),
    (WECK, A, HALF_UP, 14000, 2.74264, 2.79153, "hopf"),
    (AL7075, I, HALF_DOWN, 4000, 0.94583, 1.08583, "hopf"),
    (AL7075, I, HALF_DOWN, 9500, 0.91306, 0.96442, "hopf"),
    (AL7075, I, HALF_DOWN, 14000, 4.9541, 4.6197, "hopf"),
]
SIX_DIGITS = 6e-6  # the limits of zero order are given to six digits, the last ones to five


@pytest.mark.parametrize(("machine", "cut", "ends", "rpm", "limit", "mean", "kind"), CASES)
def test_limits_of_published_machines(machine, cut, ends, rpm, limit, mean, kind):
    found = limit_depth(machine.receptance, *cut, *ends, speed=rpm * RPM)
    assert found.depth * 1e3 == pytest.approx(limit, rel=1e-4)
    assert found.kind == kind
    quick = limit_depth(machine.receptance, *cut, *ends, rpm * RPM, "zero-order")
    assert quick.depth * 1e3 == pytest.approx(mean, rel=SIX_DIGITS)


@pytest.mark.parametrize(("machine", "cut", "ends", "rpm", "limit", "mean", "kind"), CASES[::2])
def test_collocation_agrees(machine, cut, ends, rpm, limit, mean, kind):
    oracle = Milling(machine, *cut, *ends, rpm * RPM)
    found, how = oracle.limit(0.9e-3 * limit, 1.1e-3 * limit, 5)
    assert found * 1e3 == pytest.approx(limit, rel=1e-4)
    assert how == kind


def test_converged_multipliers():
    """Slot at 5000 rpm; what 200 steps of semi-discretisation give is 2e-3 off [M]."""
    oracle = Milling(ONE, *B, *SLOT, 5000 * RPM)
    radius = [oracle.radius(a * 1e-3) for a in (0.2, 0.5, 0.7, 1.0)]
    np.testing.assert_allclose(radius, [0.819743, 1.073976, 1.221556, 1.406474], rtol=1e-5)
    np.testing.assert_allclose(radius, [0.8192, 1.0726, 1.2197, 1.4040], rtol=2e-3)


SHAPING = ((250.0, 0.012, 2.26e8, 30.0), (150.0, 0.010, 2.13e8, -45.0))


@pytest.mark.parametrize(
    ("rpm", "modes", "limit"),
    [
        (4000, 1, 7.49219),
        (8000, 1, 10.8805),
        (4000, 2, 7.37549),
        (8000, 2, 10.7835),
        (12000, 2, 9.47624),
    ],
)
def test_shaping(rpm, modes, limit):
    def receptance(omega):
        total = np.zeros(len(omega), dtype=complex)
        for hertz, ratio, stiffness, degrees in SHAPING[:modes]:
            r = omega / (2.0 * math.pi * hertz)
            share = math.cos(math.radians(degrees)) ** 2
            total += share / (stiffness * (1.0 - r**2 + 2j * ratio * r))
        return total

    found = turning_limit(receptance, 1e9, rpm * RPM)
    assert found.depth * 1e3 == pytest.approx(limit, rel=5e-6)  # six digits are given


@pytest.mark.parametrize(
    ("ratio", "rpm", "limit", "mean"),
    [(1e-3, 9000, 2.7503, 2.00169), (1e-4, 9000, 2.7235, 1.99072), (1e-4, 25000, 3.7763, 5.61686)],
)
def test_lightly_damped_modes_limit_beside_their_peaks(ratio, rpm, limit, mean):
    """A slot far from the resonance, beside collocation; zero order tends to its closed form
    without damping, −1/(2 H Φ) where the tooth period holds (2k + 1)/2 waves."""
    machine = Machine(((922.0, ratio, STIFF, X),))
    oracle = Milling(machine, *B, *SLOT, rpm * RPM)
    known, how = oracle.limit(0.97e-3 * limit, 1.03e-3 * limit, 5)
    found = limit_depth(machine.receptance, *B, *SLOT, rpm * RPM)
    assert found.depth == pytest.approx(known, rel=1e-4)
    assert found.kind == how
    quick = limit_depth(machine.receptance, *B, *SLOT, rpm * RPM, "zero-order")
    omega = (2.0 * np.arange(20) + 1.0) * rpm * RPM
    stiffness = STIFF * ((omega / (2.0 * math.pi * 922.0)) ** 2 - 1.0)
    free = (stiffness[stiffness > 0.0] / (2.0 * 1e8)).min()
    assert quick.depth == pytest.approx(free, rel=10.0 * ratio)
    assert quick.depth * 1e3 == pytest.approx(mean, rel=SIX_DIGITS)
