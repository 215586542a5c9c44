"""Modal damping lands on the flexible modes, in order, the last ratio repeated; on static answers
as on the modes of which they are made."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import eigh

from rotordyn.numerics.reduction import ritz_basis
from rotordyn.system.rotor_damping import damping_ratios, modal_rates, own_damping
from tests.oracles.rotors import uniform

VALUES = np.array([0.0, 0.0, 1.0, 4.0, 9.0])


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        ((), [0, 0, 0, 0, 0]),
        ((0.01,), [0, 0, 0.01, 0.01, 0.01]),
        ((0.01, 0.05), [0, 0, 0.01, 0.05, 0.05]),
        ((0.01, 0.02, 0.03, 0.04), [0, 0, 0.01, 0.02, 0.03]),
    ],
)
def test_ratios(given: tuple[float, ...], expected: list[float]) -> None:
    assert damping_ratios(VALUES, given).tolist() == expected


def test_only_rigid_motion() -> None:
    assert damping_ratios(np.zeros(2), (0.01,)).tolist() == [0.0, 0.0]


@pytest.mark.parametrize("stiff", [1.0, 1e4, 1e8])
def test_static_answers_have_the_damping_of_their_modes(stiff: float) -> None:
    """A chain, every mode of which has another ratio, beside the sum over all of its modes; of the
    answer of its ``stiff`` link, the last vector, hardly a mode is known then."""
    links, stretch = np.where(np.arange(29) == 20, stiff, 1.0), np.diff(np.eye(30), axis=0)
    stiffness = stretch.T @ (links[:, None] * stretch)
    loads = np.stack([np.eye(30)[0], stretch[20]], axis=1)
    basis = ritz_basis(np.eye(30), stiffness, 0.3, loads, np.ones((30, 1)))
    ratios = tuple(0.001 * k for k in range(1, 30))
    values, modes = eigh(stiffness)
    rates = modal_rates(np.append(0.0, values[1:]), ratios)
    expected = basis.vectors.T @ (modes * rates) @ modes.T @ basis.vectors
    found = own_damping(replace(uniform(1.0, 0.05), rotor_damping=ratios), basis)
    assert found[:-1, :-1] == pytest.approx(expected[:-1, :-1], rel=1e-6, abs=1e-9)


def test_other_motions_have_the_last_ratio() -> None:
    """Rods are damped as bending would be with that ratio alone, static answers included."""
    stretch = np.diff(np.eye(30), axis=0)
    basis = ritz_basis(
        np.eye(30), stretch.T @ stretch, 0.3, np.eye(30)[:, [0, 17]], np.ones((30, 1))
    )
    rotor = replace(uniform(1.0, 0.05), rotor_damping=(0.3, 0.2, 0.1))
    alone = own_damping(replace(rotor, rotor_damping=(0.1,)), basis)
    found = own_damping(rotor, basis, bending=False)
    assert np.array_equal(found, alone)
    assert not np.allclose(found, own_damping(rotor, basis))
    assert np.abs(found - np.diag(np.diagonal(found))).max() > 1e-3
