"""Bending of the shaft without discretisation: modes at every speed, receptances.

The elements' poles are the starts; how many there are is counted in the exact equations. Modes are
given by weighted displacements of the nodes of the mesh, so that they are followed by likeness.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rotordyn.analysis.display import RPM
from rotordyn.analysis.specs import Port
from rotordyn.elements.node import FREEDOMS, position
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.exact.box import Box
from rotordyn.exact.circular import PLANES, load, response
from rotordyn.exact.poles import ExactMode
from rotordyn.exact.receptance import receptance
from rotordyn.exact.rotor import ExactRotor, exact_rotor
from rotordyn.exact.shooting import Shooting
from rotordyn.exact.spectrum import modes_inside
from rotordyn.machine.cross_section import area, second_moment
from rotordyn.machine.spindle import Spindle
from rotordyn.numerics.modes import Modes
from rotordyn.system.mesh import Mesh, station_mesh
from rotordyn.system.whirl_in_planes import are_apart, planes_of

if TYPE_CHECKING:
    from rotordyn.analysis.scene import Scene

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
MOST_NODES = 3000  # memory grows with their square
NEAR = 1.2  # the band of the search ends in the widest gap of the elements' poles up to this beyond
LOWEST = 1e-5  # of the band, where it begins at the latest
SWINGING = 1e-6  # of |ω|: less real part than that is no vibration


@dataclass(frozen=True, eq=False, slots=True)
class ExactBending:
    """The exact rotor at every usable speed.

    ``x`` (nodes,) [m]: where modes are given; ``weight`` (nodes, 2): root of the mass and of the
    inertia that a node stands for, ``sleeves`` (s,): of the mass of each sprung sleeve, which make
    modes alike by their kinetic energy. ``frame`` (speeds,) [rad/s]: the speed at which the
    coordinates turn.
    """

    rotors: tuple[ExactRotor, ...]
    x: Array
    weight: Array
    sleeves: Array
    frame: Array

    @property
    def isotropic(self) -> bool:
        """True where forward and backward whirl are apart."""
        return self.rotors[0].planes == 1

    @property
    def planar(self) -> NDArray[np.bool_]:
        """Speeds (speeds,) at which nothing couples the planes, of the complex form."""
        stiffness = np.stack([rotor.terms.stiffness for rotor in self.rotors])
        damping = np.stack([rotor.terms.damping for rotor in self.rotors])
        return are_apart(stiffness, damping, np.array([rotor.spin for rotor in self.rotors]))

    @property
    def motion(self) -> Array:
        """Displacements of the nodes (nodes, 6, 2n) by the coordinates of both planes.

        Those of a plane: deflection and tilt node by node, then the sleeves.
        """
        nodes = len(self.x)
        motion = np.zeros((nodes, len(FREEDOMS), 2, 2 * nodes + len(self.sleeves)))
        every = np.arange(nodes)
        for place, (name, sign) in enumerate(zip(PLANES.names, PLANES.signs, strict=True)):
            plane, kind = divmod(place, 2)
            motion[every, position(name), plane, 2 * every + kind] = sign / self.weight[:, kind]
        return motion.reshape(nodes, len(FREEDOMS), -1)

    def modes(self, near: Modes, highest: float) -> ExactModes:
        """All modes up to ``highest`` [rad/s]; ``near``: those of the elements.

        Raises
        ------
        NoSolution : at some speed not as many were reached as there are
        """
        free = near.at_rest(self.frame)
        found = [
            self._at(rotor, near.pole[row, ~free[row]] + 1j * self.frame[row], highest)
            for row, rotor in enumerate(self.rotors)
        ]
        most = max(len(pole) for pole, _ in found)
        size = found[0][1].shape[0]
        pole = np.full((len(found), most), complex(np.nan, np.nan))
        vector = np.full((len(found), size, most), complex(np.nan, np.nan))
        for row, (own, vectors) in enumerate(found):
            pole[row, : len(own)], vector[row, :, : len(own)] = own, vectors
        return ExactModes(pole - 1j * self.frame[:, None], vector)

    def _at(self, rotor: ExactRotor, near: Complex, highest: float) -> tuple[Complex, Complex]:
        """Poles (k,) and vectors (n, k) at one speed, in the fixed frame."""
        omega = -1j * near
        found: list[ExactMode] = []
        shapes = [np.zeros((0, len(self.x), rotor.width), dtype=complex)]
        for side in (-1.0, 1.0) if rotor.planes == 1 else (1.0,):
            box = _box(omega, side, highest)
            fine = rotor.up_to(max(abs(box.low), abs(box.high)))
            equations = Shooting.of(fine)
            starts = np.array([w for w in omega if w in box])
            try:
                own = modes_inside(equations, box, starts)
            except NoSolution as error:
                raise NoSolution(f"at {rotor.spin * RPM.factor:.0f} rpm: {error}") from None
            found += own
            for mode in own:
                whirl = np.array([mode.omega])
                shapes.append(equations.displacement(mode.unknowns[None], whirl, self.x))
        vector = self._coordinates(np.concatenate(shapes), rotor.planes)
        return 1j * np.array([mode.omega for mode in found]), vector.T

    def _coordinates(self, shape: Complex, planes: int) -> Complex:
        """Of one circular part (modes, n), or of both planes (modes, 2n)."""
        parts = []
        for side in range(planes):
            own = shape[..., 2 * side : 2 * side + 2] * self.weight
            carried = shape[:, 0, 2 * planes + side :: planes][:, : len(self.sleeves)]
            flat = own.reshape(len(shape), 2 * len(self.x))
            parts.append(np.concatenate([flat, carried * self.sleeves], axis=1))
        if planes == 2:
            parts = list(planes_of(*parts))
        return np.concatenate(parts, axis=1)

    def receptance(self, omega: Array, pairs: list[tuple[float, Port, float, Port]]) -> Complex:
        """Receptance (speeds, pairs, k) at ``omega`` (k,) [rad/s] of the frame.

        A pair is station and port of the response, then of the excitation. In the complex form both
        are those of plane y, to be turned by the caller.
        """
        values = []
        stations = sorted({pair[0] for pair in pairs})
        forces = sorted({(pair[2], pair[3].direction) for pair in pairs})
        for rotor, frame in zip(self.rotors, self.frame, strict=True):
            given = [(x, load(name, rotor.planes)) for x, name in forces]
            found = receptance(rotor, omega + frame, np.array(stations), given)
            values.append(
                [
                    found[forces.index((at, excitation.direction)), :, stations.index(x)]
                    @ response(answer.direction, rotor.planes)
                    for x, answer, at, excitation in pairs
                ]
            )
        return np.array(values)


@dataclass(frozen=True, eq=False, slots=True)
class ExactModes:
    """``pole`` (speeds, k) [rad/s], ``vector`` (speeds, n, k), NaN beyond the modes of a speed."""

    pole: Complex
    vector: Complex

    def at_rest(self, frame: Array) -> NDArray[np.bool_]:
        """No pole at zero is among them (speeds, k), whatever the ``frame``."""
        return np.zeros(self.pole.shape, dtype=bool)


def exact_bending(scene: Scene) -> ExactBending:
    """The exact rotor of a scene at its usable speeds.

    Raises
    ------
    InvalidInput : what the exact shaft cannot describe (``shaft.obstacles``), or too many pieces
    """
    from rotordyn.analysis.shaft import obstacles

    spindle = scene.spindle
    damping = spindle.damped, spindle.loss_factor
    for sentence in obstacles(scene.conditions, *damping, spindle.supports):
        raise InvalidInput(sentence)
    if spindle.housings:
        raise InvalidInput("the exact shaft takes no housings: take shaft: elements")
    if spindle.joints:
        raise InvalidInput("the exact shaft takes no joints: take shaft: elements")
    # weight differs along a section: constant within elements only
    mesh = scene.mesh if scene.gravity else station_mesh(spindle)
    if mesh.nodes > MOST_NODES:
        raise InvalidInput(
            f"too many pieces for the exact shaft: given {mesh.nodes - 1}; allowed: up to "
            f"{MOST_NODES - 1}; join sections that are alike, or take shaft: elements"
        )
    force = np.zeros((1, 0))
    if scene.conditions.axial_stiffening:
        force = scene.shaft_force.bending(mesh.middle)
    rows = scene.bearing_row[scene.usable]
    rotors = tuple(
        exact_rotor(
            spindle.at_speed(float(spin)),
            float(spin),
            tangents,
            mesh,
            force[row] if scene.conditions.axial_stiffening else None,
        )
        for spin, tangents, row in zip(
            scene.speed[scene.usable], scene.seat_stiffness, rows, strict=True
        )
    )
    sprung = [s.mass for s in spindle.sleeves if math.isfinite(s.radial_stiffness)]
    weight, sleeves = _weight(spindle, scene.mesh), np.sqrt(np.array(sprung))
    return ExactBending(rotors, scene.mesh.x, weight, sleeves, scene.bending.frame)


def _weight(spindle: Spindle, mesh: Mesh) -> Array:
    ring, bent = (f(mesh.outer_diameter, mesh.inner_diameter) for f in (area, second_moment))
    weight = np.zeros((mesh.nodes, 2))
    for kind, section in enumerate((ring, bent)):
        half = 0.5 * mesh.density * section * mesh.length
        weight[:-1, kind] += half
        weight[1:, kind] += half
    for body in spindle.lumped:
        weight[mesh.node_of(body.x)] += (body.mass, body.diametral_inertia)
    return np.sqrt(weight)


def _box(omega: Complex, side: float, highest: float) -> Box:
    """Around the elements' whirl frequencies of one direction up to ``highest`` [rad/s].

    What grows or decays faster than e^(``highest`` t) is no vibration of the band. The edges lie in
    gaps between the elements' poles, so that a small difference puts no pole across.
    """
    turning, edge = side * omega.real, NEAR * highest
    slowest = turning[turning > SWINGING * np.abs(omega)].min(initial=highest)
    begin = min(LOWEST * highest, 0.5 * float(slowest))
    near = (turning > begin) & (turning < edge) & (np.abs(omega.imag) < edge)
    across, decay = turning[near], omega.imag[near]
    end = _gap(across[across > highest], highest, edge)
    inside = np.append(decay[(across < end) & (np.abs(decay) < highest)], 0.0)
    low = -_gap(-decay[decay < inside.min()], -float(inside.min()), edge)
    high = _gap(decay[decay > inside.max()], float(inside.max()), edge)
    ends = sorted((side * begin, side * end))
    return Box(complex(ends[0], low), complex(ends[1], high))


def _gap(values: Array, low: float, high: float) -> float:
    """Middle of the widest gap between ``low`` and ``high``."""
    edges = np.concatenate([[low], np.sort(values), [high]])
    widest = int(np.argmax(np.diff(edges)))
    return float(0.5 * (edges[widest] + edges[widest + 1]))
