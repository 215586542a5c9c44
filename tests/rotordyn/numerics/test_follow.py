"""Modes followed by shape through a sweep."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from rotordyn.numerics import follow as module
from rotordyn.numerics.follow import LEAST_MAC, doubts, follow, mac
from tests.oracles.steps import steps_of


def unit(size: int, *columns: int) -> np.ndarray:
    return np.eye(size, dtype=complex)[:, columns]


def test_modal_assurance_criterion() -> None:
    a = np.array([[1.0, 0.0], [0.0, 1.0]], dtype=complex)
    b = np.array([[2j, 1.0], [0.0, 1.0]], dtype=complex)
    assert mac(a, b) == pytest.approx(np.array([[1.0, 0.5], [0.0, 0.5]]))


def test_crossing_values_do_not_swap_shapes() -> None:
    """Two orthogonal shapes whose values cross: columns are sorted by value, paths are not."""
    values = [np.array([1.0 + 0.1 * k, 2.0 - 0.1 * k]) for k in range(11)]
    vectors, sorted_values = [], []
    for pair in values:
        order = np.argsort(pair)
        vectors.append(unit(2, *order))
        sorted_values.append(pair[order])
    path = follow(steps_of(vectors, sorted_values))
    found = np.array([v[p] for v, p in zip(sorted_values, path, strict=True)])
    assert found == pytest.approx(np.array(values))


@settings(max_examples=50)
@given(st.integers(0, 10**6), st.integers(2, 6))
def test_shuffled_columns_and_phases_are_undone(seed: int, count: int) -> None:
    draw = np.random.default_rng(seed)
    base, _ = np.linalg.qr(draw.normal(size=(8, count)) + 1j * draw.normal(size=(8, count)))
    value = draw.uniform(1, 2, count)
    orders = [np.arange(count), *(draw.permutation(count) for _ in range(4))]
    vectors = [base[:, o] * np.exp(2j * np.pi * draw.random(count)) for o in orders]
    path = follow(steps_of(vectors, [value[o] for o in orders]))
    for order, row in zip(orders, path, strict=True):
        assert (order[row] == np.arange(count)).all()


def test_slow_rotation_is_followed_further_than_any_single_step() -> None:
    """A shape that turns by 90° in small steps is still the same mode."""
    turns = np.linspace(0.0, np.pi / 2, 12)
    vectors = [
        np.array([[np.cos(t), -np.sin(t)], [np.sin(t), np.cos(t)]], dtype=complex) for t in turns
    ]
    path = follow(steps_of(vectors, [np.array([1.0, 1.1])] * 12))
    assert (path == [0, 1]).all()


def test_vector_that_leaves_is_lost_and_found_again() -> None:
    vectors = [unit(3, 0, 1), unit(3, 0), unit(3, 1, 0)]
    values = [np.array([1.0, 2.0]), np.array([1.0]), np.array([2.0, 1.0])]
    path = follow(steps_of(vectors, values))
    assert path.tolist() == [[0, 1], [0, -1], [1, 0]]


def test_nothing_at_a_step_loses_all_for_that_step() -> None:
    vectors = [unit(2, 0, 1), unit(2), unit(2, 0, 1)]
    path = follow(steps_of(vectors, [np.array([1.0, 2.0]), np.array([]), np.array([1.0, 2.0])]))
    assert path.tolist() == [[0, 1], [-1, -1], [0, 1]]


def test_unlike_vectors_begin_a_path_of_their_own() -> None:
    assert LEAST_MAC > 0.0
    path = follow(steps_of([unit(3, 0), unit(3, 1)], [np.array([1.0]), np.array([1.0])]))
    assert path.tolist() == [[0, -1], [-1, 0]]


def test_equally_alike_goes_to_the_nearer_value() -> None:
    both = np.ones((1, 2), dtype=complex)
    path = follow(steps_of([both[:, :1], both], [np.array([1.0]), np.array([5.0, 1.1])]))
    assert path[1, 0] == 1


def test_modes_of_one_shape_are_distinguished_by_their_damping() -> None:
    """Their frequencies change places from one step to the next."""
    both = np.ones((1, 2), dtype=complex)
    poles = [np.array([-0.6 + 0.99j, -0.01 + 1.0j]), np.array([-0.01 + 0.99j, -0.6 + 1.0j])]
    assert follow(steps_of([both, both], poles)).tolist() == [[0, 1], [1, 0]]


@settings(max_examples=60)
@example(7285, 5, 0.0, True)
@given(st.integers(0, 10**6), st.integers(1, 6), st.floats(0.0, 1.0), st.booleans())
def test_all_steps_at_once_are_compared_as_each_with_its_next(
    seed: int, size: int, turned: float, twins: bool
) -> None:
    """Steps of other counts, of shapes that turn more or less, with values that cross or repeat."""
    draw = np.random.default_rng(seed)
    vectors, values = [], []
    whole = np.linalg.qr(draw.normal(size=(size, size)) + 1j * draw.normal(size=(size, size)))[0]
    for _ in range(6):
        whole = np.linalg.qr(whole + 0.5 * turned * draw.normal(size=(size, size)))[0]
        count = int(draw.integers(0, size + 1))
        vectors.append(whole[:, draw.permutation(size)[:count]] * draw.uniform(0.1, 9.0))
        value = 1.0 + 0.3 * draw.normal(size=count)
        values.append(np.sort(np.round(value, 0 if twins else 9)))
    alike = steps_of(vectors, values).alike
    for k in range(5):
        one, other = values[k : k + 2]
        alone = module._shared(vectors[k], one, vectors[k + 1], other)
        assert alike[k, : len(one), : len(other)] == pytest.approx(alone, abs=1e-12)
        assert not alike[k, len(one) :].any()
        assert not alike[k, :, len(other) :].any()


@settings(max_examples=60)
@given(st.integers(0, 10**6), st.integers(1, 6), st.floats(0.0, 1.0), st.booleans())
def test_steps_matched_together_are_matched_as_one_by_one(
    seed: int, size: int, turned: float, leave: bool
) -> None:
    """Greedy matching of each step with what was last seen of every path, in plain loops."""
    draw, vectors, values = np.random.default_rng(seed), [], []
    whole = np.eye(size, dtype=complex)
    for _ in range(8):
        whole = np.linalg.qr(whole + 0.7 * turned * draw.normal(size=(size, size)))[0]
        chosen = draw.permutation(size)[: int(draw.integers(0, size + 1)) if leave else size]
        vectors.append(whole[:, chosen])
        frequency = np.sort(1.0 + 0.1 * draw.normal(size=len(chosen)))
        values.append(-0.2 * draw.random(len(chosen)) + 1j * frequency)
    steps = steps_of(vectors, values)
    ahead = steps.poles + 0.05 * draw.normal(size=steps.poles.shape)
    known = [(0, k) for k in range(len(values[0]))]
    wanted = [list(range(len(known)))]
    for step in range(1, 8):
        pairs = [
            (mac(vectors[at][:, [k]], vectors[step][:, [j]]).item() - 0.3 * apart, path, j)
            for path, (at, k) in enumerate(known)
            for j, value in enumerate(values[step])
            for apart in [abs(value - ahead[at, k]) / (abs(value) + abs(ahead[at, k]))]
        ]
        row, left = [-1] * len(known), set(range(len(values[step])))
        for score, path, j in sorted(pairs, reverse=True):
            if score >= LEAST_MAC and row[path] < 0 and j in left:
                row[path] = j
                left.remove(j)
        known = [(step, j) if j >= 0 else was for j, was in zip(row, known, strict=True)]
        known += [(step, j) for j in sorted(left)]
        wanted.append([*row, *sorted(left)])
    found = follow(steps, ahead)
    assert found.shape[1] == len(wanted[-1])
    for path, row in zip(found.tolist(), wanted, strict=True):
        assert path == row + [-1] * (len(path) - len(row))


def test_a_basis_of_repeated_values_is_any_basis() -> None:
    """Both vectors at rest are nearly the forward one: the backward one is no stranger for that."""
    forward, backward = np.array([1.0, -1j]), np.array([1.0, 1j])
    at_rest = np.column_stack([forward + 0.1 * backward, forward - 0.2j * backward])
    turning = np.column_stack([backward, forward])
    path = follow(steps_of([at_rest, turning], [np.array([5.0, 5.0]), np.array([4.9, 5.1])]))
    assert path.shape == (2, 2)
    assert sorted(path[1]) == [0, 1]


@pytest.mark.parametrize(
    ("ends", "meet"), [([4.0, 1.0], 4.0), ([1.1, 1.05], 6.5), ([301.0, 1.0], 3.5)]
)
def test_the_step_requested_is_where_two_straight_lines_meet(
    ends: list[float], meet: float
) -> None:
    """From 1 and 2 at 3 to the ``ends`` at 7; never nearer to a step than 0.5."""
    order = np.argsort(ends)
    vectors, values = [unit(2, 0, 1), unit(2, *order)], [np.array([1.0, 2.0]), np.sort(ends)]
    assert doubts(np.array([3.0, 7.0]), steps_of(vectors, values), 1e3, 0.5) == pytest.approx(
        [meet]
    )


def test_no_step_becomes_smaller_than_the_narrowest() -> None:
    """Where lines meet a hundredth from a step, half of the narrowest step is no place to look."""
    vectors, values = [unit(2, 0, 1), unit(2, 1, 0)], [np.array([1.0, 1.1]), np.array([1.0, 10.0])]
    for at in (np.array([3.0, 7.0]), np.array([1003.0, 1007.0])):
        assert doubts(at, steps_of(vectors, values), 1e3, 1.5) == pytest.approx([at[0] + 1.5])


@pytest.mark.parametrize("scale", [1.0, 1e3])
@pytest.mark.parametrize(("ahead", "behind"), [(1.0, 1.0), (0.01, 0.04), (0.09, 0.01)])
def test_a_veering_is_sought_where_its_gap_is_the_mean_in_ratio(
    scale: float, ahead: float, behind: float
) -> None:
    """A gap that goes straight from one step to the next is the geometric mean of both there."""
    values = [scale * np.array([1.0, 1.0 + gap, 9.0]) for gap in (ahead, behind)]
    share = module._veering(values, [np.array([0]), np.array([1])])
    assert ahead + (behind - ahead) * share == pytest.approx(np.sqrt(ahead * behind))


@pytest.mark.parametrize(("step", "splits"), [(1.9, False), (2.1, True)])
def test_a_step_of_twice_the_narrowest_can_be_split(step: float, *, splits: bool) -> None:
    vectors, values = [unit(2, 0, 1), unit(2, 1, 0)], [np.array([1.0, 2.0])] * 2
    found = doubts(np.array([5.0, 5.0 + step]), steps_of(vectors, values), 9.0, 1.0)
    assert found == (pytest.approx([5.0 + step / 2.0]) if splits else [])
