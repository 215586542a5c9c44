"""A link between two coordinates: the force that its springs and dampers put on what it holds."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rotordyn.equation.connection import Connection
from rotordyn.equation.structure import Structure
from rotordyn.equation.term import Link, LinkMatrices
from rotordyn.scene.scene import Scene
from tests.oracles.spindles import conditions, mfw2310

STIFFNESS, DAMPING, LOSS = 3e7, 400.0, 0.6


@pytest.mark.parametrize("omega", [900.0, -900.0])
def test_force_of_springs_with_loss_and_dampers(omega: float) -> None:
    """−(K (1 + i η sgn ω) + i ω C) of what one coordinate moves against the other."""
    matrices = LinkMatrices(np.array([[[STIFFNESS]]]), np.array([[[DAMPING]]]))
    link = Link("link", np.arange(2), np.eye(2)[:1], lambda _: matrices, LOSS)
    found = Connection(link, np.array([[1.0, -1.0]]), matrices).force(
        np.array([omega]), np.array([[2e-6 + 1e-6j, -1e-6]])
    )
    loss = LOSS if omega > 0 else -LOSS
    dynamic = STIFFNESS * (1.0 + 1j * loss) + 1j * omega * DAMPING
    assert found[0, 0] == pytest.approx(-dynamic * (3e-6 + 1e-6j), rel=1e-12)


def test_a_sleeve_that_moves_with_the_shaft_does_not_strain_its_bearings() -> None:
    """The motion between the rings is that of the shaft less that of the sleeve."""
    scene = Scene(mfw2310(), conditions(), np.zeros(1))
    structure: Structure = scene.rotor
    sleeved = [link for link in structure.seats if len(link.dofs) > 6]
    assert len(sleeved) == 3
    for link in sleeved:
        shaft, sleeve = link.motions[:, :6], link.motions[:, 6:]
        for column in sleeve.T:
            (row,) = np.flatnonzero(column)
            assert column[row] == -1.0
            assert shaft[row].sum() == 1.0
    alone = replace(mfw2310(), sleeves=())
    assert all(len(link.dofs) == 6 for link in Scene(alone, conditions(), np.zeros(1)).rotor.seats)


def test_strained_motions_are_those_of_large_stiffness_the_largest_first() -> None:
    """By the coordinates, k times the square of a row; at the speed where it is largest."""
    values = np.array([np.diag([1.0, 50.0, 3.0, 8.0]), np.diag([1.0, 20.0, 9.0, 8.0])])
    matrices = LinkMatrices(values, np.zeros((1, 4, 4)))
    rows = np.array([[9.0, 0.0], [0.0, 1.0], [1.0, 3.0], [0.5, 0.5]])
    link = Link("link", np.arange(4), np.eye(4), lambda _: matrices)
    found = Connection(link, rows, matrices).strained(50.0)  # 81, 50, 90 and 4
    assert found.tolist() == rows[[2, 0, 1]].tolist()
