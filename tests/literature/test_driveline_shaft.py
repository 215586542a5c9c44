"""The worm-driven intermediate shaft of an oral examination after SIB 2007.

Its section forces, as formulas of what acts (x from Q1, the part behind a section on the part in
front), with L1, L2, L3 the distances Q1 A, A Q2, Q2 B:

    Q2 B:  N 0,   Ty −R12,        Tz −T12,        Mt −d2/2 T12, My (L−x) T12, Mz −(L−x) R12
    A Q2:  N XQ2, Ty −R12 + YQ2, Tz −T12 + ZQ2, My − (L1+L2−x) ZQ2, Mz + (L1+L2−x) YQ2 besides
"""

from __future__ import annotations

import math

import numpy as np
import pytest

import rotordyn
from rotordyn.analyses.section_forces.result import SectionForcesResult
from rotordyn.job import solve
from tests.oracles.spindles import CASES

L1, L2, L3 = 0.080, 0.131, 0.108
L = L1 + L2 + L3
R12, T12, D2 = 655.0, 1800.0, 0.156
A32, R32, T32, DP = 9e3, 1900.0, 3900.0, 0.072


@pytest.fixture(scope="module")
def result() -> SectionForcesResult:
    found = solve(rotordyn.load(CASES / "driveline_shaft.yaml")).results["section_forces"]
    assert isinstance(found, SectionForcesResult)
    return found


def forces(result: SectionForcesResult, first: float, last: float) -> np.ndarray:
    inside = (result.cut > first + 1e-9) & (result.cut < last - 1e-9)
    names = ("normal_force", "shear_force_y", "shear_force_z", "torque")
    names += ("bending_moment_y", "bending_moment_z")
    return np.array([result.cut[inside], *(getattr(result, n)[0, inside] for n in names)])


def reactions_of_q2() -> tuple[float, float, float]:
    """By moments about Q1 of the plane figures."""
    thrust = A32 * DP / 2.0  # of the worm, about z at A
    y = (R32 * L1 + R12 * L + thrust) / (L1 + L2)
    z = (-T32 * L1 + T12 * L) / (L1 + L2)
    return -A32, y, z


def test_overhang_behind_q2(result: SectionForcesResult) -> None:
    x, *found = forces(result, L1 + L2, L)
    wanted = (0.0, -R12, -T12, -D2 / 2 * T12, (L - x) * T12, -(L - x) * R12)
    for own, value in zip(found, wanted, strict=True):
        np.testing.assert_allclose(own, value + 0 * x, rtol=1e-11, atol=1e-9)


def test_between_worm_and_q2(result: SectionForcesResult) -> None:
    px, py, pz = reactions_of_q2()
    assert result.reaction[0, 1, :3] == pytest.approx([px, py, pz], rel=1e-11)
    x, *found = forces(result, L1, L1 + L2)
    lever = L1 + L2 - x
    wanted = (
        px,
        -R12 + py,
        -T12 + pz,
        -D2 / 2 * T12,
        (L - x) * T12 - lever * pz,
        -(L - x) * R12 + lever * py,
    )
    for own, value in zip(found, wanted, strict=True):
        np.testing.assert_allclose(own, value + 0 * x, rtol=1e-11, atol=1e-9)


def test_diagrams_have_the_published_form(result: SectionForcesResult) -> None:
    """Mt constant and negative from A to B; My falls to the end, and is zero at Q1."""
    _, _, _, _, torque, my, _ = forces(result, L1, L)
    assert (torque < 0.0).all()
    assert np.ptp(torque) < 1e-9
    assert (np.diff(my) <= 1e-9).all()
    assert result.bending_moment_y[0, 0] == pytest.approx(0.0, abs=1e-9)
    assert result.torque[0, 0] == pytest.approx(0.0, abs=1e-9)


def test_diameter_for_the_limit_of_twist(result: SectionForcesResult) -> None:
    """Printed: 39.52 mm with 0.1° rounded to 1.75 mrad, 40 mm chosen; 39.55 mm with 0.1°."""
    (needed,) = result.required_diameter[0]
    limit = math.radians(0.1)
    known = (16 * D2 * T12 * (L2 + L3) / (80e9 * math.pi * limit)) ** 0.25
    assert needed == pytest.approx(known, rel=1e-9)
    rounded = needed * (limit / 1.75e-3) ** 0.25
    assert rounded == pytest.approx(39.52e-3, abs=0.01e-3)
    assert needed < 0.040
    assert result.outer_diameter.max() == pytest.approx(0.040)
    assert abs(result.twist_between[0, 0]) == pytest.approx(limit * (needed / 0.040) ** 4, rel=1e-9)
