"""Vectors of repeated values."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rotordyn.numerics.repeated import continued_vectors, groups, spanning


def unitary(draw: np.random.Generator, size: int) -> np.ndarray:
    return np.linalg.qr(draw.normal(size=(size, size)) + 1j * draw.normal(size=(size, size)))[0]


@settings(max_examples=40)
@given(st.integers(0, 10**6), st.integers(2, 4))
def test_vectors_of_one_pole_are_those_of_the_nearest_speed_where_it_parts(
    seed: int, twins: int
) -> None:
    """Six shapes that turn a little from step to step; some have one pole at two steps."""
    draw = np.random.default_rng(seed)
    at, length = np.array([0.0, 1.0, 5.0, 7.0, 8.0]), draw.uniform(0.1, 9.0)
    turn = 1e-2 * draw.normal(size=(8, 8))
    base = unitary(draw, 8)[:, :6]
    vectors = np.stack([np.linalg.qr(base + x * turn @ base)[0] for x in at])
    vectors *= length * np.exp(2j * np.pi * draw.random((5, 1, 6)))
    poles = 1j * np.linspace(1.0, 2.0, 6) + 0.1 * np.arange(5)[:, None]
    group = np.sort(draw.permutation(6)[:twins])
    mixed = vectors.copy()
    for step in (1, 2):
        poles[step, group] = poles[step, group[0]]
        mixed[step][:, group] = vectors[step][:, group] @ unitary(draw, twins)
    found = continued_vectors(at, poles, mixed)
    for step, nearest in ((1, 0), (2, 3)):
        span, one = (v[step][:, group] / length for v in (mixed, found))
        held = span.conj().T @ vectors[nearest][:, group]
        assert one == pytest.approx(span @ (held / np.linalg.norm(held, axis=0)))
        assert np.abs(one - vectors[nearest][:, group] / length).max() < 0.2
    rest = np.ones(mixed.shape, dtype=bool)
    rest[np.ix_([1, 2], range(8), group)] = False
    assert (found[rest] == mixed[rest]).all()


def test_a_speed_at_which_one_of_them_is_lost_tells_nothing() -> None:
    """Of four with one pole, two are lost and two are one at the next step."""
    poles = np.array([[1j, 1j, 1j, 1j], [2j, 2j, np.nan, np.nan], [1j, 2j, 3j, 4j]])
    vectors = np.stack([unitary(np.random.default_rng(k), 4) for k in range(3)])
    vectors[1, :, 2:] = np.nan
    found = continued_vectors(np.array([0.0, 1.0, 2.0]), poles, vectors)
    assert found[0] == pytest.approx(vectors[2])
    assert np.isnan(found[1][:, 2:]).all()
    assert np.isfinite(found[1][:, :2]).all()


def test_vectors_of_poles_that_never_part_stay() -> None:
    poles = np.full((3, 2), 1j)
    vectors = np.stack([unitary(np.random.default_rng(k), 2) for k in range(3)])
    assert (continued_vectors(np.arange(3.0), poles, vectors) == vectors).all()


def test_vectors_stay_where_the_nearest_step_has_nothing_like_them() -> None:
    """One of both is there, the other is orthogonal to all that they span."""
    base = np.eye(4, dtype=complex)
    poles = np.array([[1j, 1j], [1j, 2j]])
    vectors = np.stack([base[:, :2], base[:, [0, 2]]])
    assert (continued_vectors(np.array([0.0, 1.0]), poles, vectors) == vectors).all()


def test_values_are_one_by_those_between_them() -> None:
    """A chain of steps of 0.8e-6; a single one; one that is none."""
    values = np.array([1.0, 3.0, 1.0 + 1.6e-6, np.nan, 1.0 + 0.8e-6, 3.0 + 6e-6])
    assert [group.tolist() for group in groups(values)] == [[0, 2, 4]]


def test_the_basis_of_a_span_is_orthonormal_there_alone() -> None:
    vectors = np.array([[1.0, 1.0, 2.0], [0.0, 1.0, 2.0], [0.0, 0.0, 2.0]], dtype=complex)
    found = spanning(vectors, np.array([1.0, 1.0, 2.0]))
    assert found[:, :2].conj().T @ found[:, :2] == pytest.approx(np.eye(2))
    assert found[2, :2] == pytest.approx([0.0, 0.0])
    assert (found[:, 2] == vectors[:, 2]).all()
