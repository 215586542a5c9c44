"""Static loads on the nodes and elements of a shaft, and whether they balance."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from rotordyn.analyses.section_forces.spec import SectionForcesSpec
from rotordyn.arrays import Array
from rotordyn.equation.mesh import Mesh, build_mesh, station_mesh
from rotordyn.equation.restraint import (
    on_nodes,
    require_balance,
    rigid_motion,
    unrestrained_motions,
)
from rotordyn.machine.spindle import Spindle
from rotordyn.scene.at_rest import weight
from rotordyn.scene.conditions import Conditions


@dataclass(frozen=True, eq=False, slots=True)
class StaticLoads:
    """Loads ``point`` (nodes, 6) [N, N·m] and ``line`` (elements, 2, 3) [N/m], at both ends of each
    element and linear in between; ``turning`` (nodes, 6) per unit of Ω² [kg·m]."""

    point: Array
    turning: Array
    line: Array


def loaded_mesh(
    spindle: Spindle, spec: SectionForcesSpec, element_length: float | None = None
) -> Mesh:
    """Mesh with the nodes of ``build_mesh`` and at all places of the spec."""
    return build_mesh(_marked(spindle, spec), element_length)


def _marked(spindle: Spindle, spec: SectionForcesSpec) -> Spindle:
    places = {f"place {k}": spindle.place(at).x for k, at in enumerate(spec.places)}
    return replace(spindle, points={**spindle.points, **places})


def static_loads(
    spindle: Spindle, mesh: Mesh, spec: SectionForcesSpec, conditions: Conditions
) -> StaticLoads:
    """All loads of the spec, and those of the conditions that no preload state carries."""
    point, turning = np.zeros((2, mesh.nodes, 6))
    for load in spec.loads:
        _put(point, mesh, spindle.place(load.at).x, np.array(load.on_axis))
    for unbalance in spec.unbalances:
        unit = np.array([0.0, math.cos(unbalance.angle), math.sin(unbalance.angle), 0.0, 0.0, 0.0])
        _put(turning, mesh, spindle.place(unbalance.at).x, unbalance.unbalance * unit)
    line = np.zeros((mesh.nodes - 1, 2, 3))
    for span in spec.line_loads:
        ends = [spindle.place(at).x for at in (span.start, span.to)]
        covered = (ends[0] < mesh.middle) & (mesh.middle < ends[1])
        line[covered] += (span.qx, span.qy, span.qz)
    # with bearings the preload state carries the gravity of the conditions
    for gravity in (spec.gravity, "none" if spindle.seats else conditions.gravity):
        on_bodies, on_lines = weight(spindle, mesh, gravity)
        point, line = point + on_bodies, line + on_lines
    if not spindle.seats:
        for x, force in _along(spindle, conditions):
            point[mesh.node_of(x), 0] += force
    return StaticLoads(point, turning, line)


def _put(point: Array, mesh: Mesh, x: float, load: Array) -> None:
    """Add a load at ``x`` to its node, with its moment about the node where both differ."""
    node = mesh.node_of(x)
    point[node] += rigid_motion(np.array(x), float(mesh.x[node])).T @ load


def _along(spindle: Spindle, conditions: Conditions) -> Iterator[tuple[float, float]]:
    """Stations and axial forces of the conditions that a preload state would carry."""
    yield spindle.shaft.start, conditions.axial_force - conditions.tension
    yield spindle.shaft.end, conditions.tension
    if bar := spindle.drawbar:
        yield bar.start, bar.force
        yield bar.end, -bar.force


def require_held(spindle: Spindle, spec: SectionForcesSpec, conditions: Conditions) -> None:
    """Check that the loads balance along motions that nothing holds.

    Raises
    ------
    InvalidInput : they do not: the shaft is a free body
    """
    if not unrestrained_motions(spindle).shape[1]:
        return
    mesh = station_mesh(_marked(spindle, spec))
    loads = static_loads(spindle, mesh, spec, conditions)
    require_balance(spindle, mesh.x, (on_nodes(loads.point, loads.line, mesh.x), loads.turning))
