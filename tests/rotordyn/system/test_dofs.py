"""The order of freedoms."""

from __future__ import annotations

import numpy as np
import pytest

from tests.oracles.dense_rotor.selection import (
    ALL,
    AXIAL,
    LATERAL,
    PLANE_Y,
    PLANE_Z,
    TORSION,
    Selection,
)

SELECTIONS = (ALL, LATERAL, PLANE_Y, PLANE_Z, AXIAL, TORSION)


@pytest.mark.parametrize("selection", SELECTIONS)
def test_rows_run_node_by_node(selection: Selection) -> None:
    rows = [selection.row(node, name) for node in range(5) for name in selection.names]
    assert rows == list(range(selection.size(5)))
    for name in selection.names:
        expected = [selection.row(node, name) for node in range(5)]
        assert selection.rows(name, 5).tolist() == expected


@pytest.mark.parametrize("selection", SELECTIONS)
def test_take_is_a_signed_submatrix(selection: Selection) -> None:
    node = np.arange(36.0).reshape(6, 6)
    taken = selection.take(node)
    for a in selection.names:
        for b in selection.names:
            sign = selection.sign(a) * selection.sign(b)
            expected = sign * node[ALL.row(0, a), ALL.row(0, b)]
            assert taken[selection.row(0, a), selection.row(0, b)] == expected


def test_take_from_elements() -> None:
    element = np.arange(288.0).reshape(2, 12, 12)
    taken = PLANE_Z.take(element)
    assert taken.shape == (2, 4, 4)
    assert taken[1, 1, 2] == -element[1, ALL.row(0, "thy"), ALL.row(1, "z")]


def test_take_a_coupling_block() -> None:
    node = np.arange(36.0).reshape(6, 6)
    block = PLANE_Y.take(node, PLANE_Z)
    assert block[1, 1] == -node[ALL.row(0, "thz"), ALL.row(0, "thy")]
    assert block[0, 0] == node[ALL.row(0, "y"), ALL.row(0, "z")]


def test_freedom_not_selected() -> None:
    with pytest.raises(ValueError, match="no freedom 'x'"):
        PLANE_Y.row(0, "x")
