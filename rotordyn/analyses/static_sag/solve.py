"""Sag under weight and runout of the nose, statics of the shaft on its bearings.

A ring whose groove is eccentric by e (half its runout) on the shaft displaces the shaft until the
forces of all bearings balance, at slow speed without any force of inertia. At an angle ψ
of rotation its eccentricity is e (cos(φ + ψ), sin(φ + ψ)), and a gauge at rest reads the
peak-to-peak displacement.

Theory: docs/theory/statics.md#sag-and-runout-of-the-nose.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rotordyn.analyses.static_sag.result import StaticSagResult
from rotordyn.analyses.static_sag.spec import StaticSagSpec
from rotordyn.arrays import Array
from rotordyn.equation.dofs import position
from rotordyn.equation.static_equation import LoadCase
from rotordyn.scene.at_rest import at_rest, weight
from rotordyn.scene.conditions import gravity_vector
from rotordyn.scene.scene import Scene

DIRECTIONS = ("y", "z")
DEFLECTION = [position("y"), position("z")]


def solve(scene: Scene, spec: StaticSagSpec) -> StaticSagResult:
    """Sag, slope and runout at every speed with a solution.

    Raises
    ------
    InvalidInput : the shaft is a free body, or its reactions are not determined
    """
    spindle, mesh = scene.spindle, scene.mesh
    node, gauges = mesh.node_of(spindle.points[spec.point]), np.array(spec.gauges)
    down = spec.weight_of(scene.conditions)
    point, line = weight(spindle, mesh, down)
    cases = [LoadCase(point[None], line)]
    cases += [each for ring in spec.ring_runouts for each in _eccentric(scene, ring.bearing)]
    displacement, *by_ring = (rest.displacement for rest in at_rest(scene, mesh, cases))
    on_bar = [_on_bar(moved[:, node], gauges) for moved in by_ring]
    # y and z of the eccentricity are the real parts of e^(iψ) and −i e^(iψ)
    per_eccentricity = [y - 1j * z for y, z in zip(on_bar[::2], on_bar[1::2], strict=True)]
    readings = np.zeros((len(displacement), len(gauges), len(per_eccentricity), 2), dtype=complex)
    for k, (ring, unit) in enumerate(zip(spec.ring_runouts, per_eccentricity, strict=True)):
        readings[:, :, k] = ring.runout * np.exp(1j * ring.angle) * unit
    with_runout = {ring.bearing for ring in spec.ring_runouts}
    tabled = [
        support.name
        for support in spindle.supports
        if any(isinstance(value, tuple) for value in support.stiffness.values())
    ]
    share = np.abs(readings)
    return StaticSagResult(
        point=spec.point,
        speed=scene.speed,
        station=mesh.x,
        gauge=gauges,
        direction=DIRECTIONS,
        ring=tuple(ring.bearing for ring in spec.ring_runouts),
        true_ring=tuple(seat.name for seat in spindle.seats if seat.name not in with_runout),
        follows_speed=(*(seat.name for seat in spindle.seats), *tabled),
        weight=np.sign(gravity_vector(down)[1:]),
        outcome=scene.outcome,
        deflection=scene.scattered(displacement[..., DEFLECTION]),
        slope=scene.scattered(_slope(displacement[:, node])),
        sag=scene.scattered(_on_bar(displacement[:, node], gauges)),
        runout=scene.scattered(np.abs(readings.sum(axis=2))),
        highest_runout=scene.scattered(share.sum(axis=2)),
        ring_share=scene.scattered(share),
    )


def _eccentric(scene: Scene, bearing: str) -> Iterator[LoadCase]:
    """Yield an inner ring that is eccentric by 1 m along y, and along z, without loads."""
    mesh, connections = scene.mesh, scene.spindle.connections
    ring = next(k for k, each in enumerate(connections) if each.name == bearing)
    for direction in DEFLECTION:
        offset = np.zeros((len(connections), 6))
        offset[ring, direction] = 1.0
        yield LoadCase(np.zeros((1, mesh.nodes, 6)), np.zeros((mesh.nodes - 1, 2, 3)), offset)


def _slope(displacement: Array) -> Array:
    """dy/dx and dz/dx (usable, 2) of a bar fixed in a section displaced by (usable, 6)."""
    return np.stack([displacement[:, position("thz")], -displacement[:, position("thy")]], axis=-1)


def _on_bar(displacement: Array, gauges: Array) -> Array:
    """Displacement (usable, gauges, 2) of a straight bar fixed in a section, in front of it."""
    return np.asarray(
        displacement[:, None, DEFLECTION] - gauges[:, None] * _slope(displacement)[:, None]
    )
