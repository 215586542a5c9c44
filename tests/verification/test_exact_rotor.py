"""The exact rotor against closed forms, against itself cut elsewhere, and its proven counts."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm

from rotordyn.errors import InvalidInput
from rotordyn.machine.shaft import Shaft
from rotordyn.machine.spindle import Spindle
from tests.oracles.exact_shaft.count import modes_below, whirl_frequencies
from tests.oracles.exact_shaft.poles import exact_mode
from tests.oracles.exact_shaft.rotor import exact_rotor
from tests.oracles.exact_shaft.segment import Segments, transfer
from tests.oracles.rotors import STEPPED, support, uniform
from tests.oracles.spinning_beam import PinnedBeam
from tests.oracles.stepped_rotors import stepped_rotor

NO_SEATS = np.zeros((0, 5, 5))
STIFF = 1e19  # N/m: as good as a pin


def pinned(length: float, diameter: float) -> Spindle:
    ends = [support("a", 0.0, (STIFF, STIFF)), support("b", length, (STIFF, STIFF))]
    return uniform(length, diameter, supports=ends)


@pytest.mark.parametrize("tension", [0.0, 2e7, -1e7])
@pytest.mark.parametrize("omega", [3000.0, -8000.0, 2000.0 + 300.0j, 0.0])
def test_transfer_is_the_matrix_exponential(omega: complex, tension: float) -> None:
    own = Segments(*(np.array([v]) for v in (0.1, 5e8, 1e6, 30.0, 0.01, tension)))
    spin, share, across = 1500.0, 5e8 / (5e8 + tension), 5e8 + tension
    mass, inertia = 30.0 * omega**2, 0.01 * (omega**2 - 2 * spin * omega) - share * tension
    a = np.array(
        [
            [0, share, 1 / across, 0],
            [0, 0, 0, 1e-6],
            [-mass, 0, 0, 0],
            [0, -inertia, -share, 0],
        ],
        complex,
    )
    unit = np.diag([1.0, 1.0, 1e-7, 1e-6])
    expected = expm(unit @ a @ np.linalg.inv(unit) * 0.1)
    found = unit @ transfer(own, np.array(omega), spin)[0] @ np.linalg.inv(unit)
    assert np.abs(found - expected).max() < 1e-14 * np.abs(expected).max()


@pytest.mark.few(4)
@pytest.mark.parametrize("direction", [-1, 1])
@pytest.mark.parametrize("spin", [0.0, 2000.0])
@pytest.mark.parametrize(("length", "diameter"), [(1.0, 0.05), (0.5, 0.1), (20.0, 0.02)])
def test_pinned_spinning_beam(length: float, diameter: float, spin: float, direction: int) -> None:
    beam = PinnedBeam(length, diameter)
    rotor = exact_rotor(pinned(length, diameter), spin, NO_SEATS)
    found = whirl_frequencies(rotor, 6, direction)
    side = 0 if direction < 0 else 1
    exact = [beam.bending_whirl(mode, spin)[side] for mode in range(1, 7)]
    assert found == pytest.approx(exact, rel=1e-9)


@pytest.mark.parametrize("spin", [0.0, 2500.0])
def test_cutting_a_section_changes_nothing(spin: float) -> None:
    sections = STEPPED.shaft.sections
    halves = tuple(replace(s, length=s.length * part) for s in sections for part in (0.3, 0.7))
    cut = replace(STEPPED, shaft=Shaft(STEPPED.shaft.start, halves))
    held = (support("a", 0.05, (2e8, 2e8)), support("b", 0.25, (1e8, 1e8)))
    found = [
        whirl_frequencies(exact_rotor(replace(s, supports=held), spin, NO_SEATS), 8)
        for s in (STEPPED, cut)
    ]
    assert found[0] == pytest.approx(found[1], rel=1e-11)


def test_reversing_the_spin_exchanges_the_whirls() -> None:
    held = replace(
        STEPPED, supports=(support("a", 0.05, (2e8, 2e8)), support("b", 0.25, (1e8, 1e8)))
    )
    forward = whirl_frequencies(exact_rotor(held, 3000.0, NO_SEATS), 6, +1)
    backward = whirl_frequencies(exact_rotor(held, -3000.0, NO_SEATS), 6, -1)
    assert forward == pytest.approx(backward, rel=1e-12)


@pytest.mark.few(4)
@pytest.mark.parametrize("seed", range(12))
def test_count_steps_by_one_at_every_mode(seed: int) -> None:
    """The n-th frequency has n modes below it and n − 1 just under it: none missed, none twice."""
    rng = np.random.default_rng(seed)
    spindle = stepped_rotor(rng)
    first = whirl_frequencies(exact_rotor(spindle, 0.0, NO_SEATS), 1)[0]
    rotor = exact_rotor(spindle, rng.uniform(0.0, 5.0) * first, NO_SEATS)
    for direction in (-1, 1):
        found = whirl_frequencies(rotor, 6, direction)
        assert (np.diff(found) > 0.0).all()
        for order, omega in enumerate(found):
            counts = [modes_below(rotor, direction * omega * (1 + s * 2e-7)) for s in (-1, 1)]
            assert counts == [order, order + 1]


def test_both_planes_together_give_the_isotropic_modes() -> None:
    """A difference of 1e-6 between the planes couples the whirls: the poles hardly move."""
    places = (("front", 0.05, 2e8), ("rear", 0.25, 1e8))
    alike = replace(STEPPED, supports=tuple(support(name, x, (k, k)) for name, x, k in places))
    almost = replace(
        STEPPED, supports=tuple(support(n, x, (k, k * (1 + 1e-6))) for n, x, k in places)
    )
    one, two = (exact_rotor(s, 2500.0, NO_SEATS) for s in (alike, almost))
    assert (one.planes, two.planes) == (1, 2)
    for omega in whirl_frequencies(one, 4):
        found = exact_mode(two.up_to(1.5 * omega), omega).omega
        assert found.real == pytest.approx(omega, rel=1e-6)
        assert abs(found.imag) < 1e-9 * omega


def test_what_cannot_be_counted_is_refused() -> None:
    damped = replace(STEPPED, supports=(support("a", 0.05, (2e8, 2e8), 500.0),))
    uneven = replace(STEPPED, supports=(support("a", 0.05, (2e8, 1e8)),))
    for spindle in (damped, uneven):
        with pytest.raises(InvalidInput, match="only without damping, on isotropic supports"):
            modes_below(exact_rotor(spindle, 0.0, NO_SEATS), 100.0)
    with pytest.raises(InvalidInput, match="no modes to damp one by one"):
        exact_rotor(replace(STEPPED, rotor_damping=(0.01,)), 0.0, NO_SEATS)
