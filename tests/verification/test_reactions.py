"""Reactions of the shaft at rest against those of the equation of motion in its coordinates."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import block_diag

from rotordyn.equation.assemble import assemble
from rotordyn.equation.static_equation import LoadCase
from rotordyn.scene.at_rest import at_rest
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.stepped_rotors import stepped_rotor


def _assembled(scene: Scene, load: np.ndarray) -> np.ndarray:
    """Loads (connections, 6) of supports on the shaft under forces ``load`` (nodes, 6), from
    K q − Bᵀ r = f and r + S B q = 0, or B q = 0 where rigid, in the coordinates of the equation."""
    bending = [c for c in scene.rotor.components if c.way in ("y", "z")]
    linear = assemble(scene.rotor, bending, scene.state)
    moved = np.concatenate([each.motions for each in linear.connections])
    rigid = np.concatenate([each.rigid for each in linear.connections])[:, None]
    springs = block_diag(*(each.matrices.stiffness[0] for each in linear.connections))
    held = np.where(rigid > 0.0, moved, springs @ moved)
    bodies = block_diag(*(c.stiffness for c in bending))
    matrix = np.block([[bodies, -moved.T], [held, np.diag(1.0 - rigid[:, 0])]])
    right = np.zeros(len(matrix))
    right[: linear.size] = np.einsum("ni,nic->c", load, linear.motion)
    size = np.abs(matrix).max(axis=1) + 1e-300
    matrix, right = matrix / size[:, None], right / size
    answer = np.linalg.solve(matrix, right)
    answer += np.linalg.solve(matrix, right - matrix @ answer)
    return answer[linear.size :].reshape(-1, 6)


@pytest.mark.parametrize("seed", [1, 2, 4])
@pytest.mark.parametrize("held", ["drawn", "rigid", "apart"])
def test_reactions_are_those_of_the_equation_of_motion(seed: int, held: str) -> None:
    """Stepped shafts on springs as drawn, two of them rigid, or 10¹³ beside 10³ N/m."""
    rng = np.random.default_rng(seed)
    spindle = stepped_rotor(rng, isotropic=False, sections=8)
    supports = list(spindle.supports)
    for k, each in enumerate(supports):
        if held == "rigid" and k < 2:
            supports[k] = replace(each, stiffness={}, rigid=("y", "z"))
        if held == "apart":
            supports[k] = replace(each, stiffness=dict.fromkeys(each.stiffness, (1e13, 1e3)[k % 2]))
    spindle = replace(spindle, supports=tuple(supports))
    scene = Scene(spindle, Conditions(), np.array([0.0]), 50.0)
    load = np.zeros((scene.mesh.nodes, 6))
    load[:, 1:3] = rng.normal(size=(scene.mesh.nodes, 2))
    case = LoadCase(load[None], np.zeros((scene.mesh.nodes - 1, 2, 3)))
    found = at_rest(scene, scene.mesh, [case])[0].push[0]
    known = _assembled(scene, load)
    assert np.abs(found - known).max() < 1e-11 * np.abs(known).max()
