"""Poles of systems without damping by their symmetric form, against the general one."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotordyn.numerics import modes as module
from rotordyn.numerics.conservative import _root, conservative_modes
from rotordyn.numerics.modes import modes, residual

KINDS = st.sampled_from(["plain", "two planes", "one complex plane", "coupled complex"])


def system(seed: int, size: int, kind: str) -> tuple[np.ndarray, np.ndarray]:
    """A batch of three, held everywhere."""
    draw = np.random.default_rng(seed)
    root, half = draw.normal(size=(2, 3, size, size))
    if kind == "coupled complex":
        root = root + 1j * draw.normal(size=root.shape)
    stiffness = root @ root.swapaxes(1, 2).conj() + 0.1 * np.eye(size)
    turning = {
        "plain": 0.0 * half,
        "two planes": half - half.swapaxes(1, 2),
        "one complex plane": -1j * (half + half.swapaxes(1, 2)),
        "coupled complex": root - root.swapaxes(1, 2).conj(),
    }
    return stiffness, turning[kind]


@given(st.integers(0, 10**6), st.integers(1, 8), KINDS)
def test_poles_and_receptances_are_those_of_the_general_form(
    seed: int, size: int, kind: str
) -> None:
    stiffness, damping = system(seed, size, kind)
    assert conservative_modes(stiffness, damping) is not None
    found = modes(stiffness, damping)
    assert (found.pole.real == 0.0).all()
    assert residual(found, stiffness, damping) < 1e-13
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "conservative_modes", lambda *_: None)
        general = modes(stiffness, damping)
    rates = (np.sort(each.pole.imag, axis=-1) for each in (found, general))
    assert np.abs(np.subtract(*rates)).max() < 1e-11 * np.abs(found.pole).max()
    omega = np.linspace(-2.0, 2.0, 7) * np.abs(found.pole).max()
    ends = np.random.default_rng(seed).normal(size=(2, 4, size))
    ours, theirs = found.receptance(omega, *ends), general.receptance(omega, *ends)
    near = np.abs(omega - found.pole.imag[..., None]).min(axis=1)[:, None]
    assert (np.abs(ours - theirs) * near < 1e-8 * np.abs(ours * near).max()).all()


def test_slow_poles_beside_stiff_coordinates_keep_their_digits() -> None:
    """Stiffnesses 10¹⁰ : 1; each slow pair balances to the last digits of its own row."""
    draw = np.random.default_rng(1)
    scale = np.geomspace(1.0, 1e5, 12)
    root = np.eye(12) + 0.1 * draw.normal(size=(12, 12))
    stiffness = root @ root.T * scale * scale[:, None]
    half = 100.0 * draw.normal(size=(12, 12))
    turning = half + half.T
    pole, vector, _ = conservative_modes(stiffness, -1j * turning)
    slow = np.abs(pole).argsort()[:4]
    rate, shape = pole[slow].imag, vector[:, slow]
    rest = stiffness @ shape + turning @ shape * rate - shape * rate**2
    assert (np.abs(rest) < 1e-13 * (np.abs(stiffness) @ np.abs(shape))).all()


@pytest.mark.parametrize(
    ("stiffness", "damping"),
    [
        (np.diag([1.0, 2.0]), np.diag([1e-9, 0.0])),
        (np.array([[1.0, 0.1], [-0.1, 1.0]]), np.zeros((2, 2))),
        (np.diag([1.0, 0.0]), np.zeros((2, 2))),
        (np.array([[1.0, 1.0], [1.0, 1.0 + 1e-9]]), np.zeros((2, 2))),
        (np.diag([1.0, -1.0]), np.zeros((2, 2))),
        (np.diag([1.0, 1e-18]), np.zeros((2, 2))),
    ],
    ids=["damped", "circulatory", "free", "nearly free", "unstable", "far apart"],
)
def test_other_systems_are_left_to_the_general_form(
    stiffness: np.ndarray, damping: np.ndarray
) -> None:
    assert conservative_modes(stiffness, damping) is None


@pytest.mark.parametrize("unit", [1e-8, 1.0, 1e8])
@pytest.mark.parametrize(("left", "clear"), [(1e-5, True), (1e-7, False)])
def test_stiffness_is_clearly_held_in_any_unit(unit: float, left: float, *, clear: bool) -> None:
    """Of two coordinates whose coupling leaves the second a share of its stiffness."""
    coupled = np.sqrt(1.0 - left)
    root = _root(unit * np.array([[[1.0, coupled], [coupled, 1.0]]]))
    assert (root is not None) == clear
