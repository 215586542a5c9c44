"""Housings under bearings and supports: rigid bodies on springs, or reduced models.

Theory: docs/theory/supports.md#housings.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rotordyn.arrays import Array, Indices
from rotordyn.equation.dofs import DIRECTIONS, Dofs, position
from rotordyn.equation.support import node_matrix
from rotordyn.equation.term import Part
from rotordyn.errors import InvalidInput
from rotordyn.machine.housing import Housing, ReducedHousing, RigidHousing
from rotordyn.machine.spindle import Spindle

SYMMETRIC = 1e-6  # of the largest entry: largest difference of a mass matrix from its transpose


class Foundation:
    """One housing: its ``dofs`` (k,) and, by name of what it carries, the motion (6, k) under it.

    Raises
    ------
    InvalidInput : its mass matrix is not symmetric and positive definite
    """

    def __init__(self, dofs: Dofs, spindle: Spindle, housing: Housing) -> None:
        stations = {seat.name: seat.x for seat in spindle.seats}
        stations |= {support.name: support.x for support in spindle.supports}
        if isinstance(housing, RigidHousing):
            names: tuple[str, ...] = housing.dofs
            mass, stiffness, damping, under = _of_rigid(housing, stations)
        else:
            names = ("",) * len(housing.mass)
            mass, stiffness, damping, under = _of_reduced(housing)
        _require_mass(housing, mass)
        self.dofs: Indices = dofs.add(f"housing {housing.name}", names)[0]
        sign = dofs.sign[self.dofs]
        self.mass, self.stiffness, self.damping = (
            sign[:, None] * matrix * sign for matrix in (mass, stiffness, damping)
        )
        self.under = {name: motion * sign for name, motion in under.items()}

    def parts(self) -> Iterator[Part]:
        """Yield mass, stiffness and damping."""
        rows = self.dofs[None]
        for name in ("mass", "stiffness", "damping"):
            yield Part(name, rows, rows, getattr(self, name)[None])


def _of_rigid(
    housing: RigidHousing, stations: dict[str, float]
) -> tuple[Array, Array, Array, dict[str, Array]]:
    indices = [position(name) for name in housing.dofs]
    polar, diametral = housing.polar_inertia, housing.diametral_inertia
    inertia = np.array([*[housing.mass] * 3, polar, diametral, diametral])
    square, under = np.ix_(indices, indices), {}
    for name in housing.carries:
        motion, lever = np.eye(6), stations[name] - housing.x
        motion[position("y"), position("thz")] = lever
        motion[position("z"), position("thy")] = -lever
        under[name] = motion[:, indices]
    stiffness, damping = (
        node_matrix(housing.stiffness)[square],
        node_matrix(housing.damping)[square],
    )
    return np.diag(inertia[indices]), stiffness, damping, under


def _of_reduced(housing: ReducedHousing) -> tuple[Array, Array, Array, dict[str, Array]]:
    mass, stiffness, damping, shape = (
        np.array(getattr(housing, name), dtype=float)
        for name in ("mass", "stiffness", "damping", "shape")
    )
    under = {name: np.zeros((len(DIRECTIONS), len(mass))) for name in housing.carries}
    for place, row in zip(housing.places, shape, strict=True):
        name, _, direction = place.rpartition(".")
        under[name][position(direction)] = row
    return mass, stiffness, damping, under


def _require_mass(housing: Housing, mass: Array) -> None:
    if np.abs(mass - mass.T).max() > SYMMETRIC * np.abs(mass).max():
        raise InvalidInput(f"housing '{housing.name}': its mass matrix is not symmetric")
    try:
        np.linalg.cholesky((mass + mass.T) / 2.0)
    except np.linalg.LinAlgError:
        raise InvalidInput(
            f"housing '{housing.name}': its mass matrix is not positive definite; leave out "
            "coordinates without mass"
        ) from None
