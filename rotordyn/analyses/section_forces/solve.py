"""Section forces, elastic line, stress and twist of the shaft under static loads.

Bearings are linear springs about their preload state, whose axial force acts on the bent shaft.
Axial forces of that state are part of N and of the reactions.
"""

from __future__ import annotations

import math

import numpy as np

from rotordyn.analyses.section_forces.outer_fibre import outer_fibre
from rotordyn.analyses.section_forces.result import SectionForcesResult
from rotordyn.analyses.section_forces.spec import SectionForcesSpec
from rotordyn.analyses.section_forces.static_loads import loaded_mesh, static_loads
from rotordyn.arrays import Array
from rotordyn.equation.mesh import Mesh
from rotordyn.equation.static_equation import LoadCase
from rotordyn.machine.inertia import mass_in_front
from rotordyn.machine.spindle import Spindle
from rotordyn.scene.at_rest import at_rest, cut_forces
from rotordyn.scene.linearity import departure, ring_displacements
from rotordyn.scene.loads import TwistLimit
from rotordyn.scene.scene import Scene

COMPONENTS = ("Fx", "Fy", "Fz", "Mx", "My", "Mz")


def solve(scene: Scene, spec: SectionForcesSpec) -> SectionForcesResult:
    """Section forces, elastic line, stress and twist at every speed with a solution.

    Raises
    ------
    InvalidInput : the shaft is a free body, or its reactions are not determined
    """
    spindle = scene.spindle
    mesh = loaded_mesh(spindle, spec, scene.conditions.element_length)
    loads = static_loads(spindle, mesh, spec, scene.conditions)
    speed = scene.speed[scene.usable]
    case = LoadCase(loads.point + (speed**2)[:, None, None] * loads.turning, loads.line)
    (rest,) = at_rest(scene, mesh, [case])
    forces, displacement, push = cut_forces(scene, mesh, case, rest), rest.displacement, rest.push
    at_ends = np.stack([forces.front, forces.rear], axis=-2)
    departures = np.full((len(at_ends), len(spindle.connections)), np.nan)
    if spindle.seats:
        seats = len(spindle.seats)
        rings = ring_displacements(scene, rest.strained[:, :seats])
        departures[:, :seats] = departure(scene, rings)
        at_ends[..., 0] += _preloaded(scene, mesh)
        push = push + _preload_push(scene)
    cut = scene.scattered(at_ends.reshape(len(at_ends), -1, 6))
    ends = np.stack([displacement[:, :-1] + rest.jump, displacement[:, 1:]], axis=2)
    line = scene.scattered(ends.reshape(len(displacement), -1, 6))
    outer, inner = (diameter.T.ravel() for diameter in (mesh.outer, mesh.inner))
    stress = outer_fibre(cut, outer, inner)
    supports = [(support.name, support.x) for support in spindle.connections]
    spans = [_span(limit, spindle, mesh) for limit in spec.twist_limits]
    twists = [ends[:, span.stop - 1, 1, 3] - ends[:, span.start, 0, 3] for span in spans]
    required = [
        _required_diameter(limit, mesh, at_ends, span)
        for limit, span in zip(spec.twist_limits, spans, strict=True)
    ]
    return SectionForcesResult(
        speed=scene.speed,
        cut=np.stack([mesh.x[:-1], mesh.x[1:]], axis=1).ravel(),
        support=tuple(name for name, _ in supports),
        component=COMPONENTS,
        twist_limit=tuple(limit.called for limit in spec.twist_limits),
        outcome=scene.outcome,
        outer_diameter=outer,
        inner_diameter=inner,
        normal_force=cut[..., 0],
        shear_force_y=cut[..., 1],
        shear_force_z=cut[..., 2],
        torque=cut[..., 3],
        bending_moment_y=cut[..., 4],
        bending_moment_z=cut[..., 5],
        axial_displacement=line[..., 0],
        deflection_y=line[..., 1],
        deflection_z=line[..., 2],
        twist=line[..., 3],
        slope_y=line[..., 4],
        slope_z=line[..., 5],
        normal_stress=stress.normal,
        torsion_stress=stress.torsion,
        von_mises_stress=stress.von_mises,
        support_station=np.array([x for _, x in supports]),
        reaction=scene.scattered(push),
        departure=scene.scattered(departures),
        allowed_twist=np.array([limit.limit for limit in spec.twist_limits]),
        bore=np.array([limit.bore for limit in spec.twist_limits]),
        twist_between=scene.scattered(np.reshape(twists, (-1, len(at_ends))).T),
        required_diameter=scene.scattered(np.reshape(required, (-1, len(at_ends))).T),
    )


def _preloaded(scene: Scene, mesh: Mesh) -> Array:
    """Axial force of the preload state at both ends of the elements (usable, elements, 2) [N]."""
    rows = scene.bearing_row[scene.usable]
    middle = scene.shaft_force.at(mesh.middle)[rows]
    edges = np.stack([mesh.x[:-1], mesh.middle, mesh.x[1:]])
    # N changes by the weight along the axis between the middle of an element and its ends
    front, half, rear = scene.gravity * mass_in_front(scene.spindle.shaft, edges)
    return np.stack([middle + (half - front), middle - (rear - half)], axis=-1)


def _preload_push(scene: Scene) -> Array:
    """Loads of bearings and supports on the shaft in the preload state (usable, k, 6) [N, N·m]."""
    spindle, push = scene.spindle, scene.shaft_force.push[scene.bearing_row[scene.usable]]
    force = np.zeros((len(push), len(spindle.connections), 6))
    elastic = len(spindle.seats) + len(spindle.supports)
    force[:, : len(spindle.seats), 0] = push[:, : len(spindle.seats)]
    force[:, len(spindle.seats) : elastic, 0] = push[:, push.shape[1] - len(spindle.supports) :]
    return force


def _span(limit: TwistLimit, spindle: Spindle, mesh: Mesh) -> slice:
    """The elements between the ends of ``limit``; start and stop are their outermost nodes."""
    first, last = (mesh.node_of(spindle.place(at).x) for at in (limit.start, limit.to))
    return slice(first, last)


def _required_diameter(limit: TwistLimit, mesh: Mesh, forces: Array, span: slice) -> Array:
    """Outer diameter of a uniform shaft whose twist is ``limit`` (usable,) [m].

    D⁴ = d⁴ + 32 |∫ Mt/G dx| / (π θ), regardless of the diameters in the case.
    """
    integral = (forces[:, span, 0, 3] * (mesh.length / mesh.shear_modulus)[span]).sum(axis=1)
    return np.asarray((limit.bore**4 + 32.0 / math.pi * np.abs(integral) / limit.limit) ** 0.25)
