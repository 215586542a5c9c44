"""Housings under supports and bearings, as coordinates of unit mass beside those of the rotor.

A bearing or support on a housing answers to the motion of its node against that of its place,
d = R q − Φ η, instead of R q. Beside what it adds to the rotor alone, this is −Rᵀ K Φ, −Φᵀ K R and
Φᵀ K Φ.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.elements.node import FREEDOMS, position
from rotordyn.elements.support import node_matrix
from rotordyn.errors import InvalidInput
from rotordyn.machine.housing import Housing, ReducedHousing, RigidHousing
from rotordyn.machine.spindle import Spindle

Array = NDArray[np.float64]
SYMMETRIC = 1e-6  # of the largest entry: a mass matrix that differs more from its transpose is none


@dataclass(frozen=True, eq=False, slots=True)
class Foundation:
    """All housings of a machine: η̈ + ``damping`` η̇ + ``stiffness`` η = f, each (k, k).

    ``under`` (connections, 6, k): motion of the place under each bearing, then each support.
    """

    stiffness: Array
    damping: Array
    under: Array

    @property
    def size(self) -> int:
        """Coordinates."""
        return len(self.stiffness)


def foundation(spindle: Spindle) -> Foundation:
    """The housings of a spindle, in order.

    Raises
    ------
    InvalidInput : the mass matrix of a housing is not symmetric and positive definite
    """
    named = [(seat.name, seat.x) for seat in spindle.seats]
    named += [(support.name, support.x) for support in spindle.supports]
    names, stations = [name for name, _ in named], dict(named)
    parts = [_normalised(housing, stations) for housing in spindle.housings]
    size = sum(len(part.stiffness) for part in parts)
    whole = Foundation(
        np.zeros((size, size)), np.zeros((size, size)), np.zeros((len(names), 6, size))
    )
    begin = 0
    for part, housing in zip(parts, spindle.housings, strict=True):
        own = slice(begin, begin + part.size)
        whole.stiffness[own, own], whole.damping[own, own] = part.stiffness, part.damping
        for name, rows in zip(housing.carries, part.under, strict=True):
            whole.under[names.index(name), :, own] = rows
        begin = own.stop
    return whole


def _normalised(housing: Housing, stations: dict[str, float]) -> Foundation:
    """One housing in coordinates of unit mass, ``under`` in the order of what it carries."""
    if isinstance(housing, RigidHousing):
        mass, stiffness, damping, under = _rigid(housing, stations)
    else:
        mass, stiffness, damping, under = _reduced(housing)
    if np.abs(mass - mass.T).max() > SYMMETRIC * np.abs(mass).max():
        raise InvalidInput(f"housing '{housing.name}': its mass matrix is not symmetric")
    try:
        factor = np.linalg.cholesky((mass + mass.T) / 2.0)
    except np.linalg.LinAlgError:
        raise InvalidInput(
            f"housing '{housing.name}': its mass matrix is not positive definite; leave out "
            "coordinates without mass"
        ) from None
    inverse = np.linalg.inv(factor)
    return Foundation(
        inverse @ stiffness @ inverse.T, inverse @ damping @ inverse.T, under @ inverse.T
    )


def _rigid(housing: RigidHousing, stations: dict[str, float]) -> tuple[Array, Array, Array, Array]:
    places = [position(freedom) for freedom in housing.freedoms]
    translation, polar, diametral = housing.mass, housing.polar_inertia, housing.diametral_inertia
    every = np.array([translation] * 3 + [polar] + [diametral] * 2)
    own = np.ix_(places, places)
    under = []
    for name in housing.carries:
        lever = stations[name] - housing.x
        motion = np.eye(6)
        motion[position("y"), position("thz")] = lever
        motion[position("z"), position("thy")] = -lever
        under.append(motion[:, places])
    return (
        np.diag(every[places]),
        node_matrix(housing.stiffness)[own],
        node_matrix(housing.damping)[own],
        np.array(under),
    )


def _reduced(housing: ReducedHousing) -> tuple[Array, Array, Array, Array]:
    mass, stiffness, damping, shape = (
        np.array(getattr(housing, name), dtype=float)
        for name in ("mass", "stiffness", "damping", "shape")
    )
    under = np.zeros((len(housing.carries), len(FREEDOMS), len(mass)))
    for place, row in zip(housing.places, shape, strict=True):
        name, _, direction = place.rpartition(".")
        under[housing.carries.index(name), position(direction)] = row
    return mass, stiffness, damping, under
