"""Rotors on one axis without any reduction, and the published co-axial rotor."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag, eigvals

from bearings.materials import Material
from rotordyn.equation.mesh import build_mesh
from rotordyn.equation.support import node_matrix
from rotordyn.machine.lumped import PointMass
from rotordyn.machine.rotor import Rotor
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from tests.oracles.dense_rotor.assemble import rotor_matrices
from tests.oracles.dense_rotor.selection import ALL

Array = NDArray[np.float64]
STEEL = Material("steel of the book", 207e9, 0.3, 8300.0)


def disc(name: str, x: float, mass: float, diametral: float) -> PointMass:
    """A thin one, Jp = 2 Jd."""
    return PointMass(name, x, mass, 2.0 * diametral, diametral)


def bearing(name: str, x: float, ky: float, kz: float, *ends: str) -> LinearSupport:
    """Radial; ``ends``: what it holds, and against what."""
    held = dict(zip(("holds", "against"), ends, strict=False))
    return LinearSupport(name, x, {("y", "y"): ky, ("z", "z"): kz}, **held)


INNER = Spindle(
    name="co-axial",
    shaft=Shaft(0.0, (Section(0.508, 0.030, 0.0, STEEL),)),
    masses=(disc("d1", 0.076, 10.5, 0.043), disc("d4", 0.457, 7.0, 0.034)),
    points={"d1": 0.076, "d4": 0.457},
)
OUTER = Rotor(
    name="outer",
    speed_ratio=1.5,
    shaft=Shaft(0.152, (Section(0.254, 0.060, 0.050, STEEL),)),
    masses=(disc("d2", 0.203, 7.0, 0.021), disc("d3", 0.356, 3.5, 0.013)),
    points={"d2": 0.203, "d3": 0.356},
)
COAXIAL = replace(
    INNER,
    rotors=(OUTER,),
    supports=(
        bearing("b1", 0.0, 26e6, 52e6),
        bearing("b2", 0.152, 18e6, 36e6, "outer"),
        bearing("b3", 0.406, 9e6, 9e6, "spindle", "outer"),
        bearing("b4", 0.508, 18e6, 36e6),
    ),
)
"""Friswell, Penny, Garvey, Lees: Dynamics of Rotating Machines (2010), Tables 6.1 and 6.2."""


class Together:
    """Every freedom of every node of every rotor at one speed, dense."""

    def __init__(self, spindle: Spindle, longest: float, speed: float) -> None:
        own = [replace(spindle, rotors=(), supports=())]
        for rotor in spindle.rotors:
            own.append(Spindle(rotor.name, rotor.shaft, masses=rotor.masses, discs=rotor.discs))
        stations = {rotor.name: tuple(rotor.points.values()) for rotor in spindle.rotors}
        stations["spindle"] = tuple(spindle.points.values())
        for support in spindle.supports:
            for end in {support.holds, support.against} - {"ground"}:
                stations[end] = (*stations[end], support.x)
        names = ["spindle", *(rotor.name for rotor in spindle.rotors)]
        parts = [
            replace(part, points={f"p{k}": x for k, x in enumerate(stations[name])})
            for part, name in zip(own, names, strict=True)
        ]
        meshes = [build_mesh(part, longest) for part in parts]
        free = [rotor_matrices(part, mesh) for part, mesh in zip(parts, meshes, strict=True)]
        first = np.cumsum([0, *(6 * mesh.nodes for mesh in meshes)])
        self.row = {
            (name, freedom): lambda x, f=f, m=mesh, b=begin: int(b + 6 * m.node_of(x) + f)
            for name, mesh, begin in zip(names, meshes, first, strict=False)
            for f, freedom in enumerate(ALL.names)
        }
        ratios = [1.0, *(rotor.speed_ratio for rotor in spindle.rotors)]
        self.mass = block_diag(*(one.mass for one in free))
        self.stiffness = block_diag(*(one.stiffness for one in free))
        self.damping = speed * block_diag(
            *(ratio * one.gyroscopic for ratio, one in zip(ratios, free, strict=True))
        )
        self._inverse: dict[float, NDArray[np.complex128]] = {}
        for support in spindle.supports:
            reach = np.zeros((6, len(self.mass)))
            for sign, end in ((1.0, support.holds), (-1.0, support.against)):
                if end != "ground":
                    for k, freedom in enumerate(ALL.names):
                        reach[k, self.row[end, freedom](support.x)] += sign
            self.stiffness += reach.T @ node_matrix(support.stiffness) @ reach
            self.damping += reach.T @ node_matrix(support.damping) @ reach

    def poles(self, highest: float) -> NDArray[np.complex128]:
        """Swinging ones up to ``highest`` [Hz], by imaginary part."""
        inverse = np.linalg.inv(self.mass)
        size, scale = len(self.mass), math.sqrt(np.abs(inverse @ self.stiffness).max())
        k, c = inverse @ self.stiffness / scale**2, inverse @ self.damping / scale
        found = scale * eigvals(np.block([[np.zeros_like(k), np.eye(size)], [-k, -c]]))
        found = found[(found.imag > 1.0) & (found.imag < 2.0 * math.pi * highest)]
        return found[np.argsort(found.imag)]

    def receptance(self, response: int, excitation: int, omega: float) -> complex:
        """Displacement of a row per unit load on another."""
        if omega not in self._inverse:
            dynamic = self.stiffness + 1j * omega * self.damping - omega**2 * self.mass
            self._inverse[omega] = np.linalg.inv(dynamic)
        return complex(self._inverse[omega][response, excitation])
