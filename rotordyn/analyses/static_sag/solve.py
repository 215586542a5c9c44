"""Sag under weight and runout of the nose, statics of the shaft on its bearings.

A ring whose groove is eccentric by e (half its runout) on the shaft displaces the shaft until the
forces of all bearings balance, at slow speed without any force of inertia. At a turn ψ its
eccentricity is e (cos(φ + ψ), sin(φ + ψ)), and a gauge at rest reads the swing of the displacement.

Theory: docs/theory/statics.md#sag-and-runout-of-the-nose.
"""

from __future__ import annotations

import numpy as np

from rotordyn.analyses.static_sag.result import StaticSagResult
from rotordyn.analyses.static_sag.spec import StaticSagSpec
from rotordyn.arrays import Array, Complex
from rotordyn.equation.dofs import position
from rotordyn.scene.at_rest import at_rest, weight
from rotordyn.scene.conditions import gravity_vector
from rotordyn.scene.scene import Scene

DIRECTIONS = ("y", "z")
DEFLECTION = [position("y"), position("z")]


def answer(scene: Scene, spec: StaticSagSpec) -> StaticSagResult:
    """At every speed with a solution.

    Raises
    ------
    InvalidInput : the shaft is a free body, or its reactions are not determined
    """
    spindle, mesh = scene.spindle, scene.mesh
    node, gauges = mesh.node_of(spindle.points[spec.point]), np.array(spec.gauges)
    down = spec.weight_of(scene.conditions)
    moved = at_rest(scene, mesh, *weight(spindle, mesh, down)).moved
    turned = [_turned(scene, ring.bearing, node, gauges) for ring in spec.ring_runouts]
    swing = np.zeros((len(moved), len(gauges), len(turned), 2), dtype=complex)
    for k, (ring, unit) in enumerate(zip(spec.ring_runouts, turned, strict=True)):
        swing[:, :, k] = ring.runout * np.exp(1j * ring.angle) * unit
    named = {ring.bearing for ring in spec.ring_runouts}
    tabled = [
        each.name
        for each in spindle.supports
        if any(isinstance(value, tuple) for value in each.stiffness.values())
    ]
    share = np.abs(swing)
    return StaticSagResult(
        point=spec.point,
        speed=scene.speed,
        station=mesh.x,
        gauge=gauges,
        direction=DIRECTIONS,
        ring=tuple(ring.bearing for ring in spec.ring_runouts),
        true_ring=tuple(seat.name for seat in spindle.seats if seat.name not in named),
        follows_speed=(*(seat.name for seat in spindle.seats), *tabled),
        weight=np.sign(gravity_vector(down)[1:]),
        outcome=scene.outcome,
        deflection=scene.scattered(moved[..., DEFLECTION]),
        slope=scene.scattered(_slope(moved[:, node])),
        sag=scene.scattered(_on_bar(moved[:, node], gauges)),
        runout=scene.scattered(np.abs(swing.sum(axis=2))),
        highest_runout=scene.scattered(share.sum(axis=2)),
        ring_share=scene.scattered(share),
    )


def _turned(scene: Scene, bearing: str, node: int, gauges: Array) -> Complex:
    """Displacement at the gauges (usable, gauges, 2) that turns with e^(iψ), per eccentricity of
    an inner ring along y at ψ = 0."""
    mesh, held = scene.mesh, scene.spindle.connections
    ring = next(k for k, each in enumerate(held) if each.name == bearing)
    none = np.zeros((mesh.nodes, 6)), np.zeros((mesh.nodes - 1, 2, 3))
    parts = []
    for way in DEFLECTION:
        offset = np.zeros((len(scene.usable), len(held), 6))
        offset[:, ring, way] = 1.0
        parts.append(_on_bar(at_rest(scene, mesh, *none, offset).moved[:, node], gauges))
    # y and z of the eccentricity are the real parts of e^(iψ) and −i e^(iψ)
    return np.asarray(parts[0] - 1j * parts[1])


def _slope(moved: Array) -> Array:
    """dy/dx and dz/dx (usable, 2) of a bar that turns with a section displaced by (usable, 6)."""
    return np.stack([moved[:, position("thz")], -moved[:, position("thy")]], axis=-1)


def _on_bar(moved: Array, gauges: Array) -> Array:
    """Displacement (usable, gauges, 2) of a straight bar in that section, in front of it."""
    return np.asarray(moved[:, None, DEFLECTION] - gauges[:, None] * _slope(moved)[:, None])
