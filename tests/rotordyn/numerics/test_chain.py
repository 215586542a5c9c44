"""A chain eliminated node by node gives what its assembled matrix gives."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotordyn.numerics.chain import Chain, Piece, without_inner

KINDS = "abc"
FREQUENCIES = 3


def made(rng: np.random.Generator, order: str, bodies: list[int], *, complex_: bool) -> tuple:
    """Pieces, bodies, and the matrix of the whole chain (f, 2·nodes, 2·nodes)."""

    def random(*shape: int) -> np.ndarray:
        real = rng.normal(size=(*shape, FREQUENCIES))
        return real + 1j * rng.normal(size=real.shape) if complex_ else real

    elements = {kind: random(4, 4) + 5.0 * np.eye(4)[..., None] for kind in KINDS}
    at = {node: random(2, 2)[..., : rng.choice([1, FREQUENCIES])] for node in bodies}
    nodes = len(order) + 1
    whole = np.zeros((2 * nodes, 2 * nodes, FREQUENCIES), dtype=complex)
    for k, kind in enumerate(order):
        whole[2 * k : 2 * k + 4, 2 * k : 2 * k + 4] += elements[kind]
    for node, body in at.items():
        whole[2 * node : 2 * node + 2, 2 * node : 2 * node + 2] += body
    return {k: Piece.of(e) for k, e in elements.items()}, at, np.moveaxis(whole, -1, 0)


@given(
    order=st.text(KINDS, min_size=1, max_size=24),
    seed=st.integers(0, 10_000),
    complex_=st.booleans(),
    data=st.data(),
)
def test_answers_are_those_of_the_whole_chain(
    order: str, seed: int, complex_: bool, data: st.DataObject
) -> None:
    """Forces on the kept nodes; motion of every node, the free ends included."""
    node = st.integers(0, len(order))
    kept = sorted(data.draw(st.sets(node, min_size=1, max_size=4)))
    bodies = sorted(data.draw(st.sets(node, max_size=4)))
    rng = np.random.default_rng(seed)
    pieces, at, whole = made(rng, order, bodies, complex_=complex_)
    chain = Chain(pieces, order, at, kept, np.ones(FREQUENCIES))
    condensed = chain.condensed()
    assert np.iscomplexobj(condensed) == complex_
    few = np.moveaxis(condensed.reshape(2 * len(kept), 2 * len(kept), -1), -1, 0)
    force = rng.normal(size=(2 * len(kept), 2))
    rows = [2 * n + k for n in kept for k in (0, 1)]
    right = np.zeros((whole.shape[-1], 2))
    right[rows] = force
    expected = np.linalg.solve(whole, right)
    scale = np.abs(expected).max() * max(chain.doubt.max(), np.linalg.cond(whole).max())
    moved = np.moveaxis(np.linalg.solve(few, force), 0, -1).reshape(len(kept), 2, 2, -1)
    found = dict(chain.motion(moved, range(len(order) + 1)))
    assert sorted(found) == list(range(len(order) + 1))
    for n, motion in found.items():
        own = np.moveaxis(expected[:, 2 * n : 2 * n + 2], 0, -1)
        assert np.abs(motion - own).max() <= 1e-13 * scale


def test_parts_that_are_alike_are_joined_once() -> None:
    """Sixty elements of one kind take as many steps as sixty has binary digits, about twice."""
    pieces, at, _ = made(np.random.default_rng(0), "a", [], complex_=False)
    calls = []

    class Counted(Chain):
        def _inverse(self, matrix: np.ndarray) -> np.ndarray:
            calls.append(1)
            return super()._inverse(matrix)

    Counted(pieces, "a" * 60, at, [0, 60], np.ones(FREQUENCIES)).condensed()
    assert len(calls) <= 10


@pytest.mark.parametrize(("apart", "doubt"), [(1e-9, 2e9), (1.0, 3.0)])
def test_doubt_is_how_much_of_a_pivot_cancels(apart: float, doubt: float) -> None:
    """Two springs and a body between them, clamped at both ends, near a frequency of its own."""
    spring = np.zeros((4, 4, 1))
    spring[[0, 1, 2, 3], [0, 1, 2, 3]] = 1.0
    spring[0, 2] = spring[2, 0] = -1.0
    pivot = np.array([[1.0, 1.0], [1.0, 1.0 + apart]])
    body = (pivot - np.diag([2.0, 2.0]))[..., None]
    chain = Chain({"s": Piece.of(spring)}, "ss", {1: body}, [0, 2], np.ones(1))
    chain.condensed()
    assert chain.doubt == pytest.approx(doubt, rel=1e-3)


@pytest.mark.parametrize("kind", [float, complex])
def test_inner_freedoms_are_condensed(kind: type) -> None:
    rng = np.random.default_rng(1)
    matrix = rng.normal(size=(9, 9, 4)).astype(kind) + 6.0 * np.eye(9)[..., None]
    each = np.moveaxis(matrix, -1, 0)
    a, b = slice(4), slice(4, None)
    expected = each[:, a, a] - each[:, a, b] @ np.linalg.solve(each[:, b, b], each[:, b, a])
    doubt = np.ones(4)
    found = without_inner(matrix.copy(), 4, doubt)
    assert np.moveaxis(found, -1, 0) == pytest.approx(expected, rel=1e-11)
    assert (doubt >= 1.0).all()
