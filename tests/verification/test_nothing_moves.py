"""Machines and responses of which nothing is left: no mode, no motion, no error of rounding."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.frf import solve as frf
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.measured_response import Port
from rotordyn.analyses.unbalance import solve as unbalance
from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.machine.rotor import Rotor
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.loads import Unbalance
from rotordyn.scene.scene import Scene
from tests.oracles.rotors import support, uniform

SPEEDS = np.array([0.0, 300.0])
TIP = Port("tip", "y")
K = 1e7


def held(*supports: LinearSupport) -> Spindle:
    return replace(uniform(0.5, 0.03, supports=list(supports)), points={"tip": 0.5})


@pytest.mark.parametrize(
    "supports",
    [
        [LinearSupport("a", 0.05, {}, {}, ("x", "y", "z", "thx", "thy", "thz"))],
        [
            LinearSupport("a", 0.05, {}, {}, ("x", "y", "z", "thx")),
            LinearSupport("b", 0.45, {}, {}, ("y", "z")),
        ],
    ],
)
def test_a_rigid_rotor_held_rigidly_has_no_modes_and_does_not_respond(
    supports: list[LinearSupport],
) -> None:
    scene = Scene(held(*supports), Conditions(rotor="rigid"), SPEEDS, 500.0, (0.5,))
    assert campbell.solve(scene, CampbellSpec(500.0)).mode == ()
    assert scene.warnings == ()
    answered = frf.solve(scene, FrfSpec((10.0, 100.0), ((TIP, TIP),)))
    assert not answered.receptance.any()
    spec = UnbalanceSpec(("tip",), (Unbalance("tip", 1e-5),))
    assert not unbalance.solve(scene, spec).displacement.any()


def test_unbalance_of_a_rotor_that_stands_still_moves_nothing() -> None:
    """Its speed ratio is 0: no force, and no critical speed is requested."""
    sleeve = Rotor("sleeve", 0.0, uniform(0.2, 0.06).shaft, points={"out": 0.1})
    ground = [
        replace(support(name, x, (K, K)), holds="sleeve") for name, x in (("s", 0.05), ("t", 0.15))
    ]
    machine = held(support("a", 0.05, (K, K)), support("b", 0.45, (K, K)))
    machine = replace(machine, supports=(*machine.supports, *ground), rotors=(sleeve,))
    scene = Scene(machine, Conditions(), SPEEDS, 500.0)
    spec = UnbalanceSpec(("sleeve.out",), (Unbalance("sleeve.out", 1e-5),))
    found = unbalance.solve(scene, spec)
    assert not found.displacement.any()
    assert found.critical == ()


def test_a_response_that_symmetry_makes_zero_has_no_error() -> None:
    """Across the middle of a symmetric rotor a tilt there moves nothing there."""
    machine = held(support("a", 0.1, (K, K)), support("b", 0.4, (K, K)))
    machine = replace(machine, points={"middle": 0.25})
    pair = Port("middle", "y"), Port("middle", "thz")
    scene = Scene(machine, Conditions(), SPEEDS[:1], 500.0, (0.25,))
    found = frf.solve(scene, FrfSpec((10.0, 300.0), (pair,)))
    assert np.abs(found.receptance).max() < 1e-15
    assert found.error.tolist() == [0.0]
