"""The degree follows the wave that an element must carry, and the tolerance."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rotordyn.equation.elements.rod import shapes
from rotordyn.equation.fineness import (
    HIGHEST,
    USUAL,
    Fineness,
    bending_wave,
    least_degree,
    parts_and_degree,
    resolved,
    rod_wave,
)
from tests.oracles.cylinder_elements import hierarchic_rod
from tests.oracles.spinning_beam import PinnedBeam
from tests.verification.test_rotor_hierarchic import at_rest

STRAIGHT = np.ones(1)  # ratio of diameters of cylinders


def expected_error(phase: np.ndarray, degree: np.ndarray) -> np.ndarray:
    """Relative error of a frequency by elements crossed with a ``phase`` k h (Ainsworth 2004)."""
    factor = [(math.factorial(n) / math.factorial(2 * n)) ** 2 / (2 * n + 1) for n in degree]
    return np.asarray(0.5 * np.array(factor) * phase ** (2.0 * degree))


@pytest.mark.parametrize("degree", [2, 3, 4, 5])
@pytest.mark.parametrize("slenderness", [5.0, 1000.0])
def test_expected_error_bounds_that_of_a_pinned_beam(degree: int, slenderness: float) -> None:
    """And is no more than three times as large, over all its energy in bending and shear."""
    beam = PinnedBeam(0.1 * slenderness, 0.1)
    exact = beam.bending_whirl(1, 0.0)[1]
    found = at_rest(beam, 3, degree, 1)[0] / exact - 1.0
    bound = float(expected_error(np.array([np.pi / 3.0]), np.array([degree]))[0])
    assert 0.3 * bound < found < 1.05 * bound


def test_rod_of_any_degree_errs_as_expected() -> None:
    """A free rod of unit speed of sound: mode n has k = n π / L."""
    for degree in (1, 2, 3, 4):
        both = hierarchic_rod(np.array([1.0]), np.array([1.0]), np.array([1.0]), degree=degree)
        count = 4
        size = count + 1 + count * (degree - 1)
        mass, stiffness = np.zeros((size, size)), np.zeros((size, size))
        for k in range(count):
            first = count + 1 + k * (degree - 1)
            rows = np.r_[k, k + 1, first : first + degree - 1]
            mass[np.ix_(rows, rows)] += both[0][0]
            stiffness[np.ix_(rows, rows)] += both[1][0]
        values = np.linalg.eigvals(np.linalg.solve(mass, stiffness)).real
        found = np.sqrt(np.sort(values)[1]) / (np.pi / count) - 1.0
        bound = float(expected_error(np.array([np.pi / count]), np.array([degree]))[0])
        assert found == pytest.approx(bound, rel=0.15)


def test_rod_shapes_meet_at_the_nodes() -> None:
    assert shapes(4, np.array([-1.0, 1.0])) == pytest.approx(np.eye(5)[:2], abs=1e-14)


def test_least_degree_is_the_least() -> None:
    phase = np.array([1e-4, 0.1, 0.5, 1.0, 2.0, 4.0])
    degree = least_degree(phase, 1e-5, STRAIGHT)
    assert (np.diff(degree) >= 0).all()
    assert (expected_error(phase, degree) <= 1e-5).all()
    above = degree > 1
    assert (expected_error(phase[above], degree[above] - 1) > 1e-5).all()
    assert least_degree(np.array([100.0]), 1e-8, STRAIGHT)[0] == 0


def test_a_degree_serves_up_to_the_phase_of_its_bound() -> None:
    """Where ½ (n!/(2n)!)² (k h)^(2n)/(2n + 1) is the tolerance, the next degree takes over."""
    n, tolerance = np.arange(1, HIGHEST + 1), 1e-4
    growth = np.array([math.factorial(2 * k) / math.factorial(k) for k in n])
    last = (growth * np.sqrt(2.0 * tolerance * (2 * n + 1))) ** (1.0 / n)
    assert least_degree(last * (1.0 - 1e-9), tolerance, STRAIGHT).tolist() == n.tolist()
    assert least_degree(last * (1.0 + 1e-9), tolerance, STRAIGHT).tolist() == [*n[1:], 0]


def test_long_waves_are_cut_into_parts() -> None:
    parts, degree = parts_and_degree(np.array([0.01, 3.0, 300.0]), 1e-6, STRAIGHT)
    assert list(parts[:2]) == [1, 1]
    assert parts[2] > 20
    assert degree.max() <= HIGHEST


def test_waves_are_those_of_the_exact_dispersion() -> None:
    beam = PinnedBeam(0.5, 0.1)
    for mode in (1, 3):
        for spin in (0.0, 2000.0):
            backward = beam.bending_whirl(mode, spin)[0]
            found = bending_wave(
                backward,
                spin,
                *(
                    np.array([v])
                    for v in (beam.shear, beam.bending, beam.line_mass, beam.line_inertia)
                ),
            )
            assert found[0] == pytest.approx(beam.wave_number(mode), rel=1e-9)
    assert rod_wave(10.0, np.array([4.0]), np.array([1.0]))[0] == 5.0


def test_resolved_frequency_is_where_the_error_meets_the_tolerance() -> None:
    assert resolved(lambda w: (w / 50.0) ** 4, 1e-4, 1.0) == pytest.approx(5.0, rel=1e-9)


def test_cut_offs_follow_the_powers_by_which_their_errors_fall() -> None:
    """The fourth of that of the modes kept, the second of that of a fictitious mass."""
    usual, hundredth = (Fineness(200.0, accuracy=each) for each in (USUAL, USUAL / 100.0))
    assert hundredth.cutoff**4 == pytest.approx(100.0 * usual.cutoff**4)
    assert hundredth.weightless**2 == pytest.approx(100.0 * usual.weightless**2)


def test_a_taper_adds_to_the_phase_of_a_linear_element() -> None:
    """k h + 4 τ with τ = 4 (√r − 1)/(√r + 1), of the error ½ (1/2)²/3 of its square."""
    tolerance = (0.5 + 4.0 * 4.0 * 0.1 / 2.1) ** 2 / 24.0
    for slack, degree in ((1e-9, 1), (-1e-9, 2)):
        found = least_degree(np.array([0.5]), tolerance * (1.0 + slack), np.array([1.21]))
        assert (found[0] == 1) == (degree == 1)


def test_free_modes_are_kept_as_far_as_accuracy_asks() -> None:
    """The truncation error falls with the fourth power; one step finer doubles the cutoff."""
    usual = Fineness(1000.0, accuracy=USUAL)
    assert Fineness(1000.0, accuracy=USUAL / 16.0).cutoff == pytest.approx(2.0 * usual.cutoff)
    for steps in (1, 2):
        finer = Fineness(1000.0, accuracy=USUAL, finer=steps)
        assert finer.cutoff == pytest.approx(2.0**steps * usual.cutoff)
        assert finer.slow == pytest.approx(2.0**steps * usual.slow)
