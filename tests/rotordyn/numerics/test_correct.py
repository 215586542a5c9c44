"""Single eigenpairs by Newton's method, beside all of them by the dense solver."""

import numpy as np

from rotordyn.numerics.correct import corrected, participation
from rotordyn.numerics.modes import modes


def test_near_starts_lead_to_the_eigenpairs_of_the_dense_solver() -> None:
    """Damped gyroscopic systems, every mode started a little off: poles to 11 digits, parallel
    vectors, and the equation of motion met."""
    draw = np.random.default_rng(3)
    root, skew = draw.standard_normal((2, 6, 8, 8))
    stiffness = 100.0 * (root @ np.swapaxes(root, 1, 2) + np.eye(8))
    damping = 0.1 * root @ np.swapaxes(root, 1, 2) + skew - np.swapaxes(skew, 1, 2)
    for known in (modes(k, d) for k, d in zip(stiffness, damping, strict=True)):
        vector = known.vector.T / np.linalg.norm(known.vector.T, axis=1, keepdims=True)
        noise = draw.standard_normal(vector.shape)
        pole, found, met = corrected(
            np.broadcast_to(known.stiffness, (16, 8, 8)),
            np.broadcast_to(known.damping, (16, 8, 8)),
            1.002 * known.pole,
            vector + 0.01 * noise,
        )
        assert met.all()
        assert np.abs(pole - known.pole).max() < 1e-11 * np.abs(pole).max()
        assert np.abs(np.abs((vector.conj() * found).sum(axis=1)) - 1.0).max() < 1e-9


def test_without_an_eigenvalue_near_nothing_converges() -> None:
    """A vector that no mode has any part in: P⁻¹ does not move it, steps do not vanish."""
    nothing = np.zeros((1, 2, 2))
    pole, _, met = corrected(nothing, nothing, np.array([0j]), np.array([[1.0 + 0j, 0.0]]))
    assert not met.any()
    assert pole[0] == 0.0


def test_left_vectors_are_those_of_the_dense_solver_where_poles_are_close() -> None:
    """Pairs of poles 2 % apart, vectors far from symmetric: all left vectors to 10 digits."""
    draw = np.random.default_rng(8)
    turn = draw.standard_normal((8, 8))
    stiffness = turn @ np.diag(100.0 * np.array([1, 1.04, 4, 4.16, 9, 9.36, 16, 16.6]))
    stiffness = stiffness @ np.linalg.inv(turn)
    known = modes(stiffness, 0.02 * np.linalg.inv(turn).T @ turn.T + 0.3 * np.eye(8))
    found = participation(known.stiffness, known.damping, known.pole, known.vector.T)
    size = np.abs(known.participation).max(axis=1, keepdims=True)
    assert np.abs(found / size - known.participation / size).max() < 1e-8
