"""Modal damping lands on the flexible modes, in order, the last ratio repeated."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import eigh

from rotordyn.equation import reduce as reduction
from rotordyn.equation.damping import modal_damping
from rotordyn.equation.reduce import reduce
from rotordyn.machine.rotor import RayleighDamping
from tests.oracles.rotors import uniform

VALUES = np.array([0.0, 0.0, 1.0, 4.0, 9.0])
ROTOR = uniform(1.0, 0.05)


@pytest.mark.parametrize(
    ("given", "bending", "expected"),
    [
        ((), True, [0, 0, 0, 0, 0]),
        ((0.01,), True, [0, 0, 0.01, 0.01, 0.01]),
        ((0.01, 0.05), True, [0, 0, 0.01, 0.05, 0.05]),
        ((0.01, 0.02, 0.03, 0.04), True, [0, 0, 0.01, 0.02, 0.03]),
        ((0.01, 0.05), False, [0, 0, 0.05, 0.05, 0.05]),
    ],
)
def test_ratios(given: tuple[float, ...], bending: bool, expected: list[float]) -> None:
    """Axial motion and torsion have the last one."""
    roots = np.diag(np.sqrt(VALUES))
    found = modal_damping(replace(ROTOR, rotor_damping=given), VALUES, roots, bending=bending)
    assert found == pytest.approx(2.0 * np.diag(expected) * roots)


def test_rayleigh_damping_is_that_of_mass_and_stiffness() -> None:
    rotor = replace(ROTOR, rayleigh=RayleighDamping(3.0, 0.5))
    found = modal_damping(rotor, VALUES, np.diag(np.sqrt(VALUES)), bending=True)
    assert found == pytest.approx(np.diag(3.0 + 0.5 * VALUES))


@pytest.mark.parametrize("stiff", [1.0, 1e4])
def test_static_modes_have_the_damping_of_the_modes_they_are_made_of(stiff: float) -> None:
    """A chain with one ratio for all modes, beside the sum over all of its modes."""
    links, stretch = np.where(np.arange(29) == 20, stiff, 1.0), np.diff(np.eye(30), axis=0)
    stiffness = stretch.T @ (links[:, None] * stretch)
    loads = np.stack([np.eye(30)[0], stretch[20]], axis=1)
    basis = reduce(np.eye(30), stiffness, np.ones((30, 1)), loads, 0.3)
    values, modes = eigh(stiffness)
    rates = 2.0 * 0.05 * np.sqrt(np.append(0.0, values[1:]))
    expected = basis.vectors.T @ (modes * rates) @ modes.T @ basis.vectors
    rotor = replace(ROTOR, rotor_damping=(0.05,))
    found = modal_damping(rotor, basis.values, basis.roots, bending=True)
    assert found == pytest.approx(expected, rel=1e-6, abs=1e-8 * expected.max())


def test_static_modes_of_a_large_body_are_taken_for_modes(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its modes beyond the cut-off are not known, so that each has the root of its own value."""
    monkeypatch.setattr(reduction, "LARGE", 1)
    monkeypatch.setattr(reduction, "MOST_DENSE", 1)
    stretch = np.diff(np.eye(60), axis=0)
    basis = reduce(np.eye(60), stretch.T @ stretch, np.ones((60, 1)), np.eye(60)[:, :2], 0.2)
    assert (~basis.modes).sum() == 2
    assert basis.roots == pytest.approx(np.diag(np.sqrt(basis.values)), abs=1e-12)
