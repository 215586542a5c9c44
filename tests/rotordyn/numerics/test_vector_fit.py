"""Vector fitting: sums of known poles are found again, from starts that are far off."""

from __future__ import annotations

import numpy as np
import pytest

from rotordyn.numerics.vector_fit import vector_fit

OMEGA = np.linspace(20.0, 1000.0, 400)
POLE = np.array([-4.0 + 150j, -9.0 + 480j, -3.0 + 820j])
RESIDUE = -1j * np.array([[3.0, 0.5], [-4.0, 2.0], [1.0, -5.0]])
CONSTANT = np.array([0.02, -0.3])
EVEN = np.ones((len(OMEGA), 1))


def samples(omega: np.ndarray = OMEGA) -> np.ndarray:
    s = 1j * omega[:, None]
    parts = [
        (1.0 / (s - pole)) * residue + (1.0 / (s - pole.conjugate())) * residue.conj()
        for pole, residue in zip(POLE, RESIDUE, strict=True)
    ]
    return np.asarray(sum(parts) + CONSTANT)


@pytest.mark.parametrize("off", [0.8, 1.0, 1.25])
@pytest.mark.parametrize("unit", [1e-3, 1.0, 1e3])
def test_exact_samples_give_their_poles(unit: float, off: float) -> None:
    """And residues and constants, from poles a quarter off, whatever the unit of time."""
    start = unit * off * (1j - 0.01) * POLE.imag
    values = samples() / unit
    found = vector_fit(unit * OMEGA, values, EVEN, start)
    order = np.argsort(found.pole.imag)
    assert found.pole[order] == pytest.approx(unit * POLE, rel=1e-8)
    assert found.residue[order] == pytest.approx(RESIDUE, rel=1e-7)
    assert found.constant == pytest.approx(CONSTANT / unit, rel=1e-6)
    assert np.abs(found.error).max() < 1e-9 * np.abs(values).max()
    between = np.array([33.3, 481.0])
    assert found(unit * between) == pytest.approx(samples(between) / unit, rel=1e-8)


def test_a_real_pole_represents_itself() -> None:
    """R/(s − p) once, not with a conjugate."""
    s = 1j * OMEGA[:, None]
    values = samples()[:, :1] + 50.0 / (s + 60.0)
    start = np.append(1.1 * POLE, -100.0)
    found = vector_fit(OMEGA, values, EVEN, start)
    order = np.argsort(found.pole.imag)
    assert found.pole[order] == pytest.approx(np.append(-60.0, POLE), rel=1e-7)
    assert found.residue[order][0] == pytest.approx(25.0, rel=1e-6)  # half, twice
    assert np.abs(found.error).max() < 1e-9
