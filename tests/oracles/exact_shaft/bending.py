"""Bending of a machine by the exact shaft: poles, shapes and receptances at its speeds.

The machine, its speeds, the tangents of its bearings and the axial force in its shaft are those of
a ``Scene``. Poles of its elements are the starts of the search; how many poles there are is counted
in the exact equations.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.measured_response import Port
from rotordyn.equation.mesh import station_mesh
from rotordyn.errors import InvalidInput
from rotordyn.machine.support import coupled_motions
from rotordyn.scene.scene import Scene
from tests.oracles.exact_shaft.box import Box
from tests.oracles.exact_shaft.circular import load, response
from tests.oracles.exact_shaft.poles import ExactMode
from tests.oracles.exact_shaft.receptance import receptance
from tests.oracles.exact_shaft.rotor import ExactRotor, exact_rotor
from tests.oracles.exact_shaft.shooting import Shooting
from tests.oracles.exact_shaft.spectrum import modes_inside

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
NEAR = 1.2  # the band of the search ends in the widest gap of the elements' poles up to this beyond
LOWEST = 1e-5  # of the band, where it begins at the latest
SWINGING = 1e-6  # of |ω|: less real part than that is no vibration


def exact_rotors(scene: Scene) -> tuple[ExactRotor, ...]:
    """The exact rotor at each usable speed.

    Raises
    ------
    InvalidInput : what the exact shaft cannot describe: damping of the rotor, loss factors,
        housings, joints, supports that couple bending with another motion
    """
    spindle = scene.spindle
    if spindle.housings or spindle.joints or spindle.rotors:
        raise InvalidInput("the exact shaft takes no housings, joints or further rotors")
    if "bending" in coupled_motions(spindle.supports):
        raise InvalidInput("the exact shaft takes no support that couples bending with the axis")
    # weight differs along a section: constant within elements only
    mesh = scene.mesh if scene.gravity else station_mesh(spindle)
    forces: list[Array | None] = [None] * len(scene.usable)
    if scene.conditions.axial_stiffening:
        forces = [*scene.shaft_force.bending(mesh.middle)[scene.bearing_row[scene.usable]]]
    rotors = []
    for spin, tangents, force in zip(
        scene.speed[scene.usable], scene.seat_stiffness, forces, strict=True
    ):
        supports = tuple(s.at(spin) if s.speeds else s for s in spindle.supports)
        own = replace(spindle, supports=supports)
        rotors.append(exact_rotor(own, float(spin), tangents, mesh, force))
    return tuple(rotors)


def exact_poles(scene: Scene, highest: float) -> Complex:
    """All poles up to ``highest`` [Hz] in the fixed frame, ascending (speeds, k) [rad/s].

    A little more than the band is searched. NaN beyond the poles of a speed. Of a rotor whose
    supports answer alike in all directions those of backward whirl have Im λ < 0; of others one of
    each conjugate pair is given.

    Raises
    ------
    NoSolution : at some speed fewer or more poles are reached than are counted
    """
    return exact_modes(scene, highest, np.zeros(0))[0]


def exact_modes(scene: Scene, highest: float, x: Array) -> tuple[Complex, Complex]:
    """Poles (speeds, k), as ``exact_poles``, and shapes (speeds, k, len(x), 2·planes).

    Shapes: deflection and tilt of each circular part at the stations ``x`` [m].
    """
    found = []
    for row, rotor in enumerate(exact_rotors(scene)):
        near = signed_poles(scene, row)
        found.append(_modes(rotor, -1j * near, 2.0 * math.pi * highest, x))
    most = max(len(pole) for pole, _ in found)
    poles = np.full((len(found), most), complex(np.nan, np.nan))
    shapes = np.full((*poles.shape, *found[0][1].shape[1:]), complex(np.nan, np.nan))
    for row, (pole, shape) in enumerate(found):
        poles[row, : len(pole)], shapes[row, : len(pole)] = pole, shape
    return poles, shapes


def signed_poles(scene: Scene, row: int) -> Complex:
    """Poles of the scene's own bending at a usable speed, rigid motions omitted; backward whirl
    has Im λ < 0, where planes are coupled both of each pair are given."""
    found = []
    for k in scene.with_motions(("bending",)):
        own = scene.system(k)
        kept = np.isfinite(own.pole[row]) & ~own.at_rest[row]
        pole, whirl = own.pole[row, kept], own.whirl[row, kept]
        found += [pole[whirl >= 0.0], pole[whirl <= 0.0].conj()]
    return np.concatenate(found)


def exact_receptance(scene: Scene, pairs: Sequence[tuple[Port, Port]], frequency: Array) -> Complex:
    """Receptance (speeds, pairs, f) at ``frequency`` (f,) [Hz] in the fixed frame.

    ``pairs``: (response, excitation).
    """
    points = scene.spindle.points
    stations = sorted({points[r.point] for r, _ in pairs})
    forces = sorted({(points[e.point], e.direction) for _, e in pairs})
    given = [(x, load(name, 2)) for x, name in forces]
    places = [
        (forces.index((points[e.point], e.direction)), stations.index(points[r.point]))
        for r, e in pairs
    ]
    answers = []
    for rotor in exact_rotors(scene):
        found = _answer(rotor, 2.0 * math.pi * frequency, np.array(stations), given)
        answers.append(
            [
                found[force, :, station] @ response(port.direction, 2)
                for (force, station), (port, _) in zip(places, pairs, strict=True)
            ]
        )
    return np.array(answers)


def _answer(
    rotor: ExactRotor, omega: Array, stations: Array, forces: list[tuple[float, Complex]]
) -> Complex:
    """Deflections and tilts (forces, f, stations, 4) of both circular parts under ``forces`` (4,).

    Where these are apart, the backward part at ω is the conjugate of the forward one at −ω.
    """
    if rotor.planes == 2:
        return receptance(rotor, omega, stations, forces)
    forward = [(x, force[:2]) for x, force in forces]
    backward = [(x, force[2:].conj()) for x, force in forces]
    one = receptance(rotor, omega, stations, forward)
    other = receptance(rotor, -omega, stations, backward).conj()
    return np.concatenate([one, other], axis=-1)


def _modes(rotor: ExactRotor, omega: Complex, highest: float, x: Array) -> tuple[Complex, Complex]:
    """Poles (k,) and shapes (k, len(x), 2·planes) at one speed; ``omega``: starts [rad/s]."""
    found: list[ExactMode] = []
    shapes = [np.zeros((0, len(x), 2 * rotor.planes), dtype=complex)]
    for side in (-1.0, 1.0) if rotor.planes == 1 else (1.0,):
        box = box_around(omega, side, highest)
        equations = Shooting.of(rotor.up_to(max(abs(box.low), abs(box.high))))
        modes = modes_inside(equations, box, np.array([w for w in omega if w in box]))
        found += modes
        for mode in modes:
            whirl = np.array([mode.omega])
            shape = equations.displacement(mode.unknowns[None], whirl, x)
            shapes.append(shape[..., : 2 * rotor.planes])
    return 1j * np.array([mode.omega for mode in found]), np.concatenate(shapes)


def box_around(omega: Complex, side: float, highest: float) -> Box:
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
