"""Warnings of shifts of the shaft along its axis that the axial loads of bearings do not follow."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from bearings.materials import STEEL
from rotordyn.arrays import Array, Indices
from rotordyn.preload.added_loads import shift_load, shortening_load, stretch
from rotordyn.preload.housing_expansion import expansions_in_fits
from rotordyn.results.display import RPM

if TYPE_CHECKING:
    from rotordyn.scene.scene import Scene

RULE = 0.1  # of the largest axial load at a speed
UNFELT = 10.0  # N, of a bearing along its axis
ALUMINIUM = 23.5e-6  # 1/K, thermal expansion: of usual materials of housings the largest


class Added(NamedTuple):
    """Load that a shift adds to the ``load`` of a bearing along its axis [N] at a state."""

    added: float
    load: float
    bearing: str
    rpm: float

    def __str__(self) -> str:
        return (
            f"about {self.added:.0f} N to the {self.load:.0f} N of axial load of bearing "
            f"{self.bearing} at {self.rpm:.0f} rpm"
        )


def missing_shifts(scene: Scene) -> Iterator[str]:
    """Yield warnings of centrifugal shortening, forces in the shaft and an expansion of the housing
    that are not in the axial loads, where they would change these by more than a tenth."""
    if not scene.spindle.seats:
        return
    rows = np.flatnonzero(scene.preload.usable & scene.has_temperatures)
    if rows.size:
        yield from _shortening(scene, rows)
        yield from _forces(scene, rows)
        yield from _housing(scene, rows)


def _largest(scene: Scene, load_of: Callable[[int], Array], rows: Indices) -> Added | None:
    """Return the largest addition of ``load_of`` a row at ``rows`` in proportion to the axial
    loads there; None where none is above a tenth, or can be felt."""
    state, loads = scene.preload, scene.preload.seat_load()
    largest, found = 1.0, None
    for row in rows:
        added = load_of(row)
        worst = int(np.abs(added).argmax())
        share = abs(added[worst]) / max(RULE * np.abs(loads[row]).max(), UNFELT)
        if share > largest:
            name, rpm = scene.spindle.seats[worst].name, state.speed[row] * RPM.factor
            largest, found = share, Added(added[worst], loads[row, worst], name, rpm)
    return found


def _shortening(scene: Scene, rows: Indices) -> Iterator[str]:
    if scene.spindle.shortening is not None:
        return
    if most := _largest(scene, lambda row: shortening_load(scene.preload, row), rows[-1:]):
        yield (
            "no centrifugal shortening of the shaft is given; computed from its sections it adds "
            f"{most}: give shortening with shift: computed"
        )


def _forces(scene: Scene, rows: Indices) -> Iterator[str]:
    """Warn of drawbar and tension, which change the length of the shaft between its bearings."""
    spindle, state, tension = scene.grounded, scene.preload, scene.conditions.tension
    causes = [name for name, acts in (("drawbar", spindle.drawbar), ("tension", tension)) if acts]
    if not causes:
        return

    def load_of(row: int) -> Array:
        return shift_load(state, row, lambda stations: stretch(spindle, tension, stations))

    if most := _largest(scene, load_of, rows):
        stations = [seat.x for seat in spindle.seats]
        first, last = stretch(spindle, tension, [min(stations), max(stations)]) * 1e6
        yield (
            f"{' and '.join(causes)} make{'s' * (len(causes) == 1)} the shaft "
            f"{abs(last - first):.2g} µm {'shorter' if last < first else 'longer'} between its "
            f"bearings, and the given preloads do not include that; it adds {most}, to first "
            "order: unless they include it already, give the preload, or the offset of its spring, "
            "under this force"
        )


def _housing(scene: Scene, rows: Indices) -> Iterator[str]:
    """Warn of a housing that is taken to expand along its axis as steel by default, where the
    expansion of aluminium would change the loads of bearings."""
    temperatures, spindle, state = scene.temperatures, scene.grounded, scene.preload
    if temperatures is None or temperatures.housing_expansion is not None:
        return
    if expansions_in_fits(spindle):
        return
    first = spindle.seats[0]
    rise = temperatures.rises(first.name, state.speed).housing
    more = ALUMINIUM - STEEL.expansion

    def load_of(row: int) -> Array:
        lag = -more * rise[row]
        return shift_load(state, row, lambda stations: lag * (np.array(stations) - first.x))

    if most := _largest(scene, load_of, rows):
        where = "temperatures" if scene.conditions.temperatures is not None else "heat_flow"
        yield (
            "along its axis the housing is taken to expand as steel, "
            f"{STEEL.expansion:.3g} 1/K; one of aluminium would add {most}, to first order: "
            f"give housing_expansion in {where}"
        )
