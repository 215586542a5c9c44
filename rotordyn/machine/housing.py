"""What supports and bearings stand on where that gives way: a rigid body on springs, or a model."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Protocol

from rotordyn.description import Description, doubled
from rotordyn.machine.support import FREEDOMS, MOTIONS, Freedom, entry_name
from rotordyn.quantity import Inertia, Mass, Name, Station, suggestion

Matrix = tuple[tuple[float, ...], ...]
LEAST = 1e-12  # [kg], [kg·m²]
INERTIAS = {"thx": "polar_inertia", "thy": "diametral_inertia", "thz": "diametral_inertia"}


@dataclass(frozen=True, slots=True)
class RigidHousing(Description):
    """A rigid body between ground and what it ``carries``: a pedestal, or one housing for several.

    Its reference is its centre of gravity at station ``x`` [m] on the axis, where ``stiffness`` and
    ``damping`` act against ground, by pairs of freedoms as in ``LinearSupport``. It moves in the
    freedoms that its stiffness names and in no other. ``mass`` [kg]; inertias [kg·m²] about x and
    about y or z.
    """

    name: Name
    carries: tuple[Name, ...]
    x: Station
    mass: Mass
    stiffness: Mapping[tuple[Freedom, Freedom], float]
    damping: Mapping[tuple[Freedom, Freedom], float] = field(default_factory=dict)
    polar_inertia: Inertia = 0.0
    diametral_inertia: Inertia = 0.0

    def _faults(self) -> Iterator[str]:
        yield from carried_faults(self.carries)
        yield from (sentence for _, sentence in rigid_faults(self))

    @property
    def freedoms(self) -> tuple[str, ...]:
        """Those in which it moves, in the usual order."""
        return moved(self.stiffness)

    @property
    def directions(self) -> frozenset[str]:
        """In which what it carries is moved: a tilt moves stations beside ``x`` across as well."""
        own = set(self.freedoms)
        return frozenset(own | {"z"} & self._levered("thy") | {"y"} & self._levered("thz"))

    def _levered(self, tilt: str) -> set[str]:
        return {"y", "z"} if tilt in self.freedoms else set()


@dataclass(frozen=True, slots=True)
class ReducedHousing(Description):
    """An elastic housing as a reduced model of coordinates q, under what it ``carries``.

    ``mass`` q̈ + ``damping`` q̇ + ``stiffness`` q = forces, SI, each n × n; ``places``:
    ``"front.y"``, the direction y under the support or bearing front, moves by the row of ``shape``
    (places × n). With modes of unit modal mass, q are modal coordinates.
    """

    name: Name
    carries: tuple[Name, ...]
    places: tuple[str, ...]
    shape: Matrix
    mass: Matrix
    stiffness: Matrix
    damping: Matrix

    def _faults(self) -> Iterator[str]:
        yield from carried_faults(self.carries)
        yield from place_faults(self.places, self.carries)
        n = len(self.mass)
        for what in ("mass", "stiffness", "damping"):
            rows = getattr(self, what)
            if [len(row) for row in rows] != [n] * n or not n:
                yield f"{what}: a square matrix of {n} coordinates is needed"
        if [len(row) for row in self.shape] != [n] * len(self.places):
            yield f"shape: {len(self.places)} rows (places) of {n} coordinates are needed"

    @property
    def directions(self) -> frozenset[str]:
        """In which what it carries is moved."""
        return frozenset(place.rpartition(".")[2] for place in self.places)


Housing = RigidHousing | ReducedHousing


def moved(stiffness: Mapping[tuple[str, str], float]) -> tuple[str, ...]:
    """The freedoms that the entries of a housing's stiffness name."""
    named = {freedom for pair in stiffness for freedom in pair}
    return tuple(freedom for freedom in FREEDOMS if freedom in named)


def housed_motions(housings: Iterable[Housing]) -> frozenset[str]:
    """Those of ``"bending"``, ``"axial"`` and ``"torsion"`` that housings take part in."""
    return frozenset(MOTIONS[name] for housing in housings for name in housing.directions)


class Rigid(Protocol):
    """A rigid housing, as it is given or as it is read."""

    @property
    def mass(self) -> float: ...
    @property
    def polar_inertia(self) -> float: ...
    @property
    def diametral_inertia(self) -> float: ...
    @property
    def stiffness(self) -> Mapping[tuple[str, str], float]: ...
    @property
    def damping(self) -> Mapping[tuple[str, str], float]: ...


def rigid_faults(housing: Rigid) -> Iterator[tuple[str, str]]:
    """What is wrong with a rigid housing: the key, and a sentence."""
    freedoms = moved(housing.stiffness)
    if not freedoms:
        yield "stiffness", "a housing needs the stiffness of at least one freedom"
    for freedom in freedoms:
        key = INERTIAS.get(freedom, "mass")
        own = getattr(housing, key)
        if own < LEAST:
            yield (
                key,
                f"a housing that moves in {freedom} needs {key}: given {own:g}; allowed: at least "
                f"{LEAST:g}",
            )
    for pair in housing.damping:
        if not set(pair) <= set(freedoms):
            yield (
                "damping",
                f"damping {entry_name(*pair)} where the housing does not move; allowed: entries of "
                f"{', '.join(freedoms)}, those of its stiffness",
            )


def carried_faults(carries: tuple[str, ...]) -> Iterator[str]:
    """It carries something, and nothing twice."""
    if not carries:
        yield "carries: a housing carries at least one support or bearing"
    for name in doubled(carries):
        yield f"carries: '{name}' is named twice"


def place_faults(places: Iterable[str], carries: tuple[str, ...]) -> Iterator[str]:
    """Places are directions under what is carried, each once, and none of that is left out."""
    listed = tuple(places)
    for place in listed:
        name, _, direction = place.rpartition(".")
        if direction not in FREEDOMS or name not in carries:
            allowed = ", ".join(carries)
            yield (
                f"unknown place '{place}'; allowed: NAME.DIRECTION with the names {allowed} and "
                f"the directions {', '.join(FREEDOMS)}{suggestion(name, carries)}"
            )
    for place in doubled(listed):
        yield f"place '{place}' is given twice"
    for name in carries:
        if not any(place.rpartition(".")[0] == name for place in listed):
            yield f"no place under '{name}', which the housing carries"
