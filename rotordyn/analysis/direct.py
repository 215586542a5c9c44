"""Receptances of bending without modes: ``system.dynamic_stiffness`` of a scene."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rotordyn.analysis.formulation import ROTATING, SOFTENED
from rotordyn.analysis.specs import Port
from rotordyn.machine.support import SPINDLE
from rotordyn.system.dofs import BOTH_PLANES
from rotordyn.system.dynamic_stiffness.end import End
from rotordyn.system.dynamic_stiffness.links import Links
from rotordyn.system.dynamic_stiffness.receptance import DirectBending
from rotordyn.system.dynamic_stiffness.shafts import Shafts
from rotordyn.system.dynamic_stiffness.supports import Supported
from rotordyn.system.dynamic_stiffness.whirling_shaft import WhirlingShaft
from rotordyn.system.lateral import are_alike, circular, connection_blocks
from rotordyn.system.lateral_rotor import bending_elements

if TYPE_CHECKING:
    from rotordyn.analysis.scene import Scene

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


def direct_bending(scene: Scene) -> DirectBending:
    """The assembled rotors of ``scene`` on their supports at the usable speeds."""
    spindle, mesh, speed = scene.spindle, scene.mesh, scene.speed[scene.usable]
    force = scene.bending_force()
    if force is not None:
        force = force[scene.bearing_row[scene.usable]]
    pulled = force is not None and bool(force.any())
    shafts = {}
    for name, ratio in spindle.ratios.items():
        part, own = spindle.part(name), mesh.of_rotors[name]
        fineness = replace(scene.fineness, spin=abs(ratio) * scene.fineness.spin)
        shafts[name] = WhirlingShaft(
            part,
            bending_elements(part, own, fineness),
            ratio,
            spindle.loss_factor,
            own if pulled and name == SPINDLE else None,
        )
    formulation = scene.conditions.formulation
    blocks = connection_blocks(spindle, speed, scene.seat_stiffness)
    alike = all(are_alike(block) for block in blocks)
    held, damped = (circular(block) for block in blocks) if alike else blocks
    losses = np.array(spindle.connection_losses)
    return DirectBending(
        Shafts(mesh, shafts),
        Links.of(spindle, mesh, pulled=force is not None),
        speed,
        [Supported(k, c, losses) for k, c in zip(held, damped, strict=True)],
        force,
        formulation == SOFTENED,
        speed if formulation == ROTATING else np.zeros_like(speed),
    )


def end(scene: Scene, port: Port) -> End:
    """Where a port is, and its direction."""
    place = BOTH_PLANES.names.index(port.direction)
    return End(scene.node(port.point), place % 2, place // 2, BOTH_PLANES.signs[place])


def receptance(direct: DirectBending, omega: Array, pairs: Sequence[tuple[End, End]]) -> Complex:
    """Receptances at every speed (speeds, pairs, f), as ``DirectBending.receptance``."""
    rows = range(len(direct.speed))
    return np.stack([direct.receptance(row, omega, pairs) for row in rows])
