"""Operating points of a bearing, checked and flattened to a list."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from bearings.arguments import real_numbers
from bearings.arrays import Array, Flags, Index
from bearings.ball.law import Law
from bearings.ball.laws import Laws
from bearings.errors import InvalidBearing, shown
from bearings.geometry import Geometry, acting, geometry
from bearings.grooves import Grooves

LARGEST = {  # SI; far beyond any bearing
    "load": 1e12,
    "displacement": 1e6,
    "speed": 1e6,
    "static_growth": 1.0,
    "growth": 1.0,
}
PAIRS = ("Fx or δx", "Fy or δy", "Fz or δz", "My or θy", "Mz or θz")


@dataclass(frozen=True, eq=False, slots=True)
class Operation:
    """Bearing, hypotheses and operating points; ``shape`` is the caller's batch shape.

    Where ``free`` (5,) is true ``load`` (s, 5) is given, elsewhere ``displacement`` (s, 5); the
    other one is zero. ``speed`` without sign, ``static_growth``, ``growth`` (s,).
    """

    grooves: Grooves
    law: Law | Laws
    free: Flags
    load: Array
    displacement: Array
    speed: Array
    static_growth: Array
    growth: Array
    shape: tuple[int, ...]

    @property
    def geometry(self) -> Geometry:
        """Constants derived from the grooves, with the inertia that acts."""
        return acting(geometry(self.grooves), self.law.dynamics)

    @property
    def axial(self) -> Flags:
        """States without radial load or displacement and without tilt or moment (s,)."""
        return np.asarray(((self.load == 0.0) & (self.displacement == 0.0))[:, 1:].all(axis=1))

    @property
    def unloaded(self) -> Flags:
        """States without load whose inner ring is free along the axis (s,)."""
        return np.asarray(self.free[0] & (self.load == 0.0).all(axis=1))

    def repeated(self, index: int | Index, speeds: Array) -> Operation:
        """Repeat one point, or several (k,), at other ``speeds`` (k,)."""
        row = np.broadcast_to(index, speeds.shape)
        names = ("load", "displacement", "static_growth", "growth")
        parts: dict[str, Any] = {name: getattr(self, name)[row] for name in names}
        law = self.law.take(row)
        return replace(self, law=law, speed=speeds, shape=speeds.shape, **parts)

    def rows(self, index: Index | tuple[Index, ...]) -> Operation:
        """Select places of the batch by indices of its first axis, or of its axes as in numpy."""
        place = np.arange(len(self.speed)).reshape(self.shape)[index]
        return replace(self.repeated(place.ravel(), self.speed[place.ravel()]), shape=place.shape)

    def at(self, displacement: Array) -> Operation:
        """Set displacements (k, …, m, 5), m of them at each of the points (…), k times."""
        shape = displacement.shape[:-1]
        names = ("speed", "static_growth", "growth")
        wide = {name: getattr(self, name).reshape(*self.shape, 1) for name in names}
        parts: dict[str, Any] = {
            name: np.broadcast_to(a, shape).reshape(-1) for name, a in wide.items()
        }
        displacements = displacement.reshape(-1, 5)
        load, free = np.zeros_like(displacements), np.zeros(5, dtype=bool)
        return replace(self, free=free, load=load, displacement=displacements, shape=shape, **parts)


def operation(
    grooves: Grooves,
    law: Law | Laws,
    *,
    load: ArrayLike | None,
    displacement: ArrayLike | None,
    speed: ArrayLike,
    static_growth: ArrayLike,
    growth: ArrayLike | None,
) -> Operation:
    """Check and broadcast operating points; see ``BallBearing.equilibrium``.

    Raises
    ------
    InvalidBearing : over- or under-determined, shapes, numbers that are not finite
    """
    if load is None and displacement is None:
        raise InvalidBearing("give load or displacement, exactly one of each pair")
    force = five_numbers("load", load, some=True)
    move = five_numbers("displacement", displacement, some=True)
    if load is None or displacement is None:
        _check_whole(*(("load", force) if displacement is None else ("displacement", move)))
        free = np.full(5, displacement is None)
    else:
        free = _free(force, move)
    omega, static = finite_numbers("speed", speed), finite_numbers("static_growth", static_growth)
    total = static if growth is None else finite_numbers("growth", growth)
    shapes = (force.shape[:-1], move.shape[:-1], omega.shape, static.shape, total.shape)
    try:
        shape = np.broadcast_shapes(*shapes)
    except ValueError as error:
        listing = ", ".join(f"{name} {size}" for name, size in zip(LARGEST, shapes, strict=True))
        raise InvalidBearing(f"leading shapes do not fit together: {listing}") from error
    omega, static, total = (np.broadcast_to(a, shape).reshape(-1) for a in (omega, static, total))
    force, move = (np.where(np.isnan(a), 0.0, a) for a in (force, move))
    force, move = (np.broadcast_to(a, (*shape, 5)).reshape(-1, 5) for a in (force, move))
    return Operation(grooves, law, free, force, move, np.abs(omega), static, total, shape)


def _check_whole(name: str, values: Array) -> None:
    """Raise InvalidBearing for a load alone, or a displacement alone, with missing numbers."""
    missing = np.flatnonzero(np.isnan(values).reshape(-1, 5).any(axis=0))
    other, place = ("displacement", 1) if name == "load" else ("load", 0)
    if missing.size:
        other_names = ", ".join(PAIRS[k].split(" or ")[place] for k in missing)
        names = ", ".join(PAIRS[k].split(" or ")[1 - place] for k in missing)
        raise InvalidBearing(
            f"{name} has no number for {names}: give {other_names} by {other}, or a number there"
        )


def five_numbers(name: str, value: ArrayLike | None, some: bool = False) -> Array:
    """Convert to values (…, 5), NaN for None; single numbers may be NaN if ``some``.

    Raises
    ------
    InvalidBearing : another shape, or numbers that are not finite
    """
    if value is None:
        return np.full(5, np.nan)
    array = _numbers(name, value)
    if array.ndim < 1 or array.shape[-1] != 5:
        raise InvalidBearing(f"{name} must have shape (…, 5), got {array.shape}")
    if np.isinf(array).any() or (np.isnan(array).any() and not some):
        raise InvalidBearing(f"{name} must be finite, got {shown(value)}")
    return array


def finite_numbers(name: str, value: ArrayLike, *, single: bool = False) -> Array:
    """Convert to numbers of any shape; to one number, as (1,), if ``single``.

    Raises
    ------
    InvalidBearing : something else, or not finite
    """
    array = _numbers(name, value)
    if not np.isfinite(array).all():
        raise InvalidBearing(f"{name} must be finite, got {shown(value)}")
    if single and array.size != 1:
        raise InvalidBearing(f"{name} must be one number, got {shown(value)}")
    return array.reshape(1) if single else array


def _free(load: Array, displacement: Array) -> Flags:
    """Whether each of the five pairs is given by its load (5,), the same for every state."""
    by_load, by_move = (
        np.isfinite(a).reshape(-1, 5) if a.size else np.ones((1, 5), dtype=bool)
        for a in (load, displacement)
    )
    load_given, move_given = (np.asarray(a.all(axis=0)) for a in (by_load, by_move))
    unlike = (by_load.any(axis=0) != load_given) | (by_move.any(axis=0) != move_given)
    for k in unlike.nonzero()[0]:
        raise InvalidBearing(f"{PAIRS[k]}: give the same one for every state of a batch")
    for k in (load_given == move_given).nonzero()[0]:
        count = "both" if load_given[k] else "neither"
        raise InvalidBearing(f"{PAIRS[k]}: give exactly one, got {count}")
    return load_given


def _numbers(name: str, value: ArrayLike) -> Array:
    array = real_numbers(value)
    if array is None:
        raise InvalidBearing(f"{name} must be numbers, got {shown(value)}")
    size = np.abs(array)
    if ((size > LARGEST[name]) & (size < np.inf)).any():
        raise InvalidBearing(f"{name} beyond {LARGEST[name]:g} SI units: is the unit right?")
    return array
