"""Supports and bearings as node matrices."""

from __future__ import annotations

import numpy as np
import pytest

from rotordyn.equation.dofs import position
from rotordyn.equation.seat import turn
from rotordyn.equation.support import node_matrix


def own_frame() -> np.ndarray:
    return np.arange(1.0, 26.0).reshape(5, 5)


def test_entries_land_where_named() -> None:
    matrix = node_matrix({("y", "y"): 3.0, ("y", "thz"): -2.0, ("x", "thx"): 1.0})
    assert matrix[position("y"), position("y")] == 3.0
    assert matrix[position("y"), position("thz")] == -2.0
    assert matrix[position("thz"), position("y")] == 0.0
    assert matrix[position("x"), position("thx")] == 1.0
    assert np.count_nonzero(matrix) == 3


def test_unknown_freedom() -> None:
    with pytest.raises(ValueError, match="phi"):
        node_matrix({("phi", "y"): 1.0})


@pytest.mark.parametrize("thrust", [1, -1])
def test_spin_is_free(thrust: int) -> None:
    turned = turn(own_frame(), thrust)
    assert not turned[position("thx")].any()
    assert not turned[:, position("thx")].any()


def test_own_frame_of_positive_thrust_is_the_spindles() -> None:
    turned = turn(own_frame(), 1)
    assert turned[position("z"), position("thy")] == own_frame()[2, 3]
    assert np.delete(np.delete(turned, 3, 0), 3, 1).tolist() == own_frame().tolist()


def test_half_turn_about_y() -> None:
    """Force and displacement turned as vectors: x and z, and the moment about z, change sign."""
    rotation = np.diag([-1.0, 1.0, -1.0])
    both = np.zeros((6, 6))
    both[:3, :3] = both[3:, 3:] = rotation
    places = [0, 1, 2, 4, 5]
    whole = np.zeros((6, 6))
    whole[np.ix_(places, places)] = own_frame()
    assert turn(own_frame(), -1) == pytest.approx(both @ whole @ both.T)
    signs = turn(own_frame(), -1) / np.where(whole == 0, 1.0, whole)
    assert signs[position("y"), position("thz")] == -1.0
    assert signs[position("z"), position("thy")] == -1.0
    assert signs[position("y"), position("y")] == 1.0


def test_leading_dimensions() -> None:
    many = turn(np.broadcast_to(own_frame(), (3, 2, 5, 5)), -1)
    assert many.shape == (3, 2, 6, 6)
    assert many[2, 1] == pytest.approx(turn(own_frame(), -1))
