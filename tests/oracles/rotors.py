"""Published and made-up rotors, as the tests describe them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from bearings.materials import Material
from rotordyn.equation.mesh import Mesh
from rotordyn.equation.support import node_matrix
from rotordyn.machine.lumped import PointMass
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from tests.oracles.dense_rotor.assemble import RotorMatrices, add_at_nodes
from tests.oracles.dense_rotor.selection import ALL, Selection

Array = NDArray[np.float64]

STEEL = Material("steel", 2.1e11, 0.3, 7800.0)


def uniform(
    length: float,
    diameter: float,
    material: Material = STEEL,
    *,
    inner: float = 0.0,
    shear: str | float = "cowper",
    masses: Sequence[PointMass] = (),
    supports: Sequence[LinearSupport] = (),
) -> Spindle:
    """A cylinder from x = 0."""
    section = Section(length, diameter, inner, material)
    return Spindle(
        "uniform",
        Shaft(0.0, (section,), shear),
        masses=tuple(masses),
        supports=tuple(supports),
    )


def support(name: str, x: float, stiffness: Sequence[float], damping: float = 0.0) -> LinearSupport:
    """Radial only; ``stiffness`` is (ky, kz) or (ky, kz, kyz), cross terms equal."""
    ky, kz, *cross = stiffness
    entries = {("y", "y"): ky, ("z", "z"): kz}
    for value in cross:
        entries |= {("y", "z"): value, ("z", "y"): value}
    return LinearSupport(name, x, entries, {("y", "y"): damping, ("z", "z"): damping})


def on_supports(
    rotor: RotorMatrices, spindle: Spindle, mesh: Mesh, selection: Selection = ALL
) -> tuple[Array, Array]:
    """(damping, stiffness) with the spindle's linear supports."""
    nodes = [mesh.node_of(s.x) for s in spindle.supports]
    springs = _blocks((s.stiffness for s in spindle.supports), selection)
    dampers = _blocks((s.damping for s in spindle.supports), selection)
    damping = add_at_nodes(np.zeros_like(rotor.mass), nodes, dampers)
    return damping, add_at_nodes(rotor.stiffness, nodes, springs)


def _blocks(entries: Iterable[object], selection: Selection) -> Array:
    return selection.take(np.array([node_matrix(e) for e in entries]).reshape(-1, 6, 6))


STEPPED = Spindle(
    "stepped",
    Shaft(
        -0.05,
        (
            Section(0.05, 0.032, 0.012, STEEL),
            Section(0.10, 0.070, 0.040, Material("light", 7.1e10, 0.33, 2800.0)),
            Section(0.14, 0.100, 0.040, STEEL),
            Section(0.03, 0.060, 0.0, STEEL),
        ),
    ),
    masses=(
        PointMass("draw bar", 0.06, 1.4, 3e-4, 4.4e-4),
        PointMass("ring", 0.06, 0.3, 5e-4, 2.6e-4),
        PointMass("tail", 0.24, 2.2, 6.8e-4, 8e-4),
    ),
    points={"nose": 0.0, "tip": -0.05},
)
"""An unsymmetric rotor with steps, bore, two materials, and two masses on one node."""
