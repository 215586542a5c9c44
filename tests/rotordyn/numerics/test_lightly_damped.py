"""Poles refined from those of the conservative part, against the general form."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotordyn.numerics import lightly_damped, threads
from rotordyn.numerics import modes as module
from rotordyn.numerics.lightly_damped import lightly_damped_modes
from rotordyn.numerics.modes import modes, residual


def system(
    seed: int, size: int, damped: float, count: int = 5, uneven: float = 0.0
) -> tuple[np.ndarray, np.ndarray]:
    """Isotropic rotors at ascending speeds: whirl of one complex plane."""
    draw = np.random.default_rng(seed)
    root, half, loss, skew = draw.normal(size=(4, size, size))
    step = np.linspace(0.0, 1.0, count)[:, None, None]
    stiffness = root @ root.T + size * np.eye(size) + 0.3 * step * (half + half.T)
    stiffness = stiffness + uneven * skew
    rate = np.sqrt(np.abs(stiffness).max())
    damping = damped * rate * (loss @ loss.T / size + np.eye(size))
    return stiffness, damping - 1j * step * rate * (half + half.T) / size


@given(
    st.integers(0, 10**6), st.integers(1, 9), st.floats(1e-4, 0.02), st.sampled_from([0.0, 0.02])
)
def test_poles_and_receptances_are_those_of_the_general_form(
    seed: int, size: int, damped: float, uneven: float
) -> None:
    stiffness, damping = system(seed, size, damped, uneven=uneven)
    found = modes(stiffness, damping)
    assert residual(found, stiffness, damping) < 1e-12
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "lightly_damped_modes", _nothing)
        general = modes(stiffness, damping)
    # of vectors of one length; it follows the largest stiffness of the batch
    assert found.condition == pytest.approx(general.condition, rel=0.2)
    for ours, theirs in zip(found.pole, general.pole, strict=True):
        nearest = np.abs(ours[:, None] - theirs).argmin(axis=1)
        assert sorted(nearest.tolist()) == list(range(2 * size))
        assert np.abs(ours - theirs[nearest]).max() < 1e-11 * np.abs(ours).max()
    omega = np.linspace(-2.0, 2.0, 7) * np.abs(found.pole).max()
    ends = np.random.default_rng(seed).normal(size=(2, 4, size))
    here, there = found.receptance(omega, *ends), general.receptance(omega, *ends)
    assert np.abs(here - there).max() < 1e-9 * np.abs(there).max()


def _nothing(stiffness: np.ndarray, damping: np.ndarray) -> tuple[np.ndarray, ...]:
    """All left to the general form."""
    count, n = stiffness.shape[:2]
    pole = np.ones((count, 2 * n), dtype=complex)
    vector = np.ones((count, n, 2 * n), dtype=complex)
    return pole, vector, vector.swapaxes(1, 2).copy(), np.zeros(count, dtype=bool)


def test_most_lightly_damped_systems_are_found_so() -> None:
    found = [lightly_damped_modes(*system(k, 8, 5e-3))[-1].mean() for k in range(40)]
    assert np.mean(found) > 0.9


def test_what_is_damped_heavily_or_not_held_is_left_to_the_general_form() -> None:
    heavy = system(1, 6, 2.0)
    assert not lightly_damped_modes(*heavy)[-1].all()
    assert residual(modes(*heavy), *heavy) < 1e-12
    stiffness, damping = system(1, 6, 5e-3)
    free = stiffness.copy()
    free[2, 0], free[2, :, 0] = 0.0, 0.0
    assert lightly_damped_modes(free, damping)[-1].tolist() == [True, True, False, True, True]
    assert residual(modes(free, damping), free, damping) < 1e-12


@pytest.mark.parametrize("weak", [0.0, 1e-22, 1e-18])
def test_a_coordinate_that_almost_nothing_holds_is_left_to_the_general_form(weak: float) -> None:
    """Within a chain as well, whose other systems are held: its poles have no digits here."""
    stiffness, damping = system(2, 5, 5e-3, count=3)
    stiffness[:, 4], stiffness[:, :, 4] = 0.0, 0.0
    damping[:, 4], damping[:, :, 4] = 0.0, 0.0
    stiffness[:, 4, 4] = [1.0, weak, 1.0]
    assert lightly_damped_modes(stiffness, damping)[-1].tolist() == [True, False, True]


def test_a_coordinate_that_softens_along_a_chain_keeps_its_digits_or_is_left() -> None:
    """By 10⁻⁴ a system, so that each is near the one before."""
    stiffness, damping = system(5, 5, 2e-3, count=8)
    scale = np.ones((8, 5))
    scale[:, 4] = 0.3 ** np.arange(8.0) * 1e-6
    stiffness = stiffness * scale[:, :, None] * scale[:, None]
    damping = damping * scale[:, :, None] * scale[:, None]
    found = modes(stiffness, damping)
    size = np.abs(found.pole)
    assert (size.min(axis=1) > 1e-8 * size.max(axis=1))[
        lightly_damped_modes(stiffness, damping)[-1]
    ].all()
    omega, ends = np.array([0.7 * size.max()]), np.eye(5)
    here = found.receptance(omega, np.repeat(ends, 5, 0), np.tile(ends, (5, 1)))
    dynamic = stiffness + 1j * omega * damping - omega**2 * np.eye(5)
    expected = np.linalg.inv(dynamic).reshape(8, 25, 1)
    own = np.sqrt(np.abs(np.diagonal(expected.reshape(8, 5, 5), axis1=1, axis2=2)))
    measure = (own[:, :, None] * own[:, None]).reshape(8, 25, 1)
    assert (np.abs(here - expected) < 1e-7 * measure).all()


def test_two_equal_poles_are_found() -> None:
    """Two coordinates alike that nothing couples: any two vectors are theirs."""
    stiffness = np.tile(np.diag([4.0, 4.0, 9.0]), (2, 1, 1))
    damping = np.tile(0.01 * np.eye(3), (2, 1, 1)) - 1j * np.diag([0.1, 0.1, 0.2])
    found = modes(stiffness, damping)
    assert residual(found, stiffness, damping) < 1e-13
    omega = np.array([1.0, 2.1])
    ends = np.eye(3)
    dynamic = stiffness[0] + 1j * omega[:, None, None] * damping[0]
    dynamic = dynamic - omega[:, None, None] ** 2 * np.eye(3)
    expected = np.diagonal(np.linalg.inv(dynamic), axis1=1, axis2=2).T
    assert found.receptance(omega, ends, ends)[0] == pytest.approx(expected, rel=1e-10)


def test_threads_do_not_change_a_digit(monkeypatch: pytest.MonkeyPatch) -> None:
    many = system(3, 7, 5e-3, count=4 * lightly_damped.CHAIN + 3)
    monkeypatch.setattr(threads, "processors", lambda: 1)
    alone = lightly_damped_modes(*many)
    monkeypatch.setattr(threads, "processors", lambda: 4)
    for one, other in zip(alone, lightly_damped_modes(*many), strict=True):
        assert np.array_equal(one, other)


def test_each_chain_begins_again() -> None:
    """A system that cannot be refined in between changes nothing of those of other chains."""
    stiffness, damping = system(4, 6, 5e-3, count=2 * lightly_damped.CHAIN)
    other = damping.copy()
    other[lightly_damped.CHAIN - 1] = 50.0
    one, two = (lightly_damped_modes(stiffness, each) for each in (damping, other))
    for ours, theirs in zip(one, two, strict=True):
        assert np.array_equal(ours[lightly_damped.CHAIN :], theirs[lightly_damped.CHAIN :])


@pytest.mark.parametrize("size", [10, 30])
def test_vectors_keep_their_digits_where_damping_couples_all_of_them_a_little(size: int) -> None:
    """Every vector has the same small share of every other one, so that their errors add up."""
    omega = np.linspace(1.0, 2.5, size) * 1e3
    stiffness = np.stack([np.diag(omega**2)] * 2)
    for share in np.geomspace(1e-5, 1e-3, 25):
        coupled = share * (np.abs(omega[:, None] - omega) + 1500.0 / size)
        damping = coupled * [[[1.0]], [[1.01]]] + 0j
        pole, vector, _, known = lightly_damped_modes(stiffness, damping)
        assert known.all()
        rest = pole[:, None] ** 2 * vector + pole[:, None] * (damping @ vector) + stiffness @ vector
        size_of = np.linalg.norm(stiffness @ vector, axis=1)
        assert (np.linalg.norm(rest, axis=1) / size_of).max() < 1e-12
