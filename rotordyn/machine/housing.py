"""Flexible housings under supports and bearings: a rigid body on springs, or a reduced model."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Annotated

from rotordyn.description import Description, Faults, known, repeated
from rotordyn.machine.matrix import DAMPING, DOFS, STIFFNESS, Dof, entry_name
from rotordyn.machine.support import MOTIONS
from rotordyn.quantity import HIDDEN, Inertia, Items, Mass, Name, Station, suggestion

Rows = tuple[tuple[float, ...], ...]
LEAST = 1e-12  # [kg], [kg·m²]
INERTIAS = {"thx": "polar_inertia", "thy": "diametral_inertia", "thz": "diametral_inertia"}
OneValue = Mapping[tuple[Dof, Dof], float]
Carried = Annotated[
    tuple[Name, ...],
    Items(),
    "supports (none between two rotors) and bearings on this housing; all others are on ground",
]
HousingName = Annotated[
    Name, "name of the housing, different from those of supports, bearings and rotors"
]


@dataclass(frozen=True, slots=True)
class RigidHousing(Description):
    """A rigid body on springs between ground and the supports and bearings that it carries.

    A pedestal, or one housing for several. It moves in the DOF that its stiffness names and in
    no other; matrices are by pairs of DOF as in ``LinearSupport``. [kg], [kg·m²].
    """

    name: HousingName
    carries: Carried
    x: Annotated[Station, "station of its centre of gravity, where stiffness and damping act"]
    mass: Annotated[Mass, "mass of the body"]
    stiffness: Annotated[
        OneValue,
        STIFFNESS,
        "stiffness of the body against ground, 6×6; it moves in the DOF named here",
    ]
    damping: Annotated[OneValue, DAMPING, "damping of the body against ground, 6×6"] = field(
        default_factory=dict
    )
    polar_inertia: Annotated[Inertia, "moment of inertia about the axis"] = 0.0
    diametral_inertia: Annotated[
        Inertia, "moment of inertia about y or z through its centre of gravity"
    ] = 0.0

    def _faults(self) -> Faults:
        yield from repeated("carries", self.carries, said="named twice:")
        if not self.stiffness:
            yield ("stiffness",), "a housing needs the stiffness of at least one DOF"
        for dof in self.dofs:
            key = INERTIAS.get(dof, "mass")
            value = getattr(self, key)
            if value < LEAST:
                yield (
                    (key,),
                    f"a housing that moves in {dof} needs {key}: given {value:g}; allowed: at "
                    f"least {LEAST:g}",
                )
        for pair in self.damping if self.dofs else ():
            if not set(pair) <= set(self.dofs):
                yield (
                    ("damping",),
                    f"damping {entry_name(*pair)} where the housing does not move; allowed: "
                    f"entries of {', '.join(self.dofs)}, those of its stiffness",
                )

    @property
    def dofs(self) -> tuple[str, ...]:
        """DOF in which it moves, in the order of ``DOFS``."""
        named = {dof for pair, k in self.stiffness.items() if known(k) for dof in pair}
        return tuple(dof for dof in DOFS if dof in named)

    @property
    def directions(self) -> frozenset[str]:
        """Directions in which it moves its load: a tilt moves stations off ``x`` laterally too."""
        across = {"thy": "z", "thz": "y"}
        return frozenset((*self.dofs, *(across[dof] for dof in self.dofs if dof in across)))


@dataclass(frozen=True, slots=True)
class ReducedHousing(Description):
    """An elastic housing as a reduced model of coordinates q, under what it carries.

    ``mass`` q̈ + ``damping`` q̇ + ``stiffness`` q = forces, SI, each n × n; ``places``:
    ``"front.y"``, the direction y under the support or bearing front, moves by the row of ``shape``
    (places × n). With modes of unit modal mass, q are modal coordinates.
    """

    name: HousingName
    carries: Carried
    places: Annotated[tuple[str, ...], HIDDEN]
    shape: Annotated[Rows, HIDDEN]
    mass: Annotated[Rows, HIDDEN]
    stiffness: Annotated[Rows, HIDDEN]
    damping: Annotated[Rows, HIDDEN]

    def _faults(self) -> Faults:
        yield from repeated("carries", self.carries, said="named twice:")
        yield from ((("model",), sentence) for sentence in self._place_faults())
        n = len(self.mass)
        for what in ("mass", "stiffness", "damping"):
            rows = getattr(self, what)
            if [len(row) for row in rows] != [n] * n:
                yield ("model",), f"{what}: a square matrix of {n} coordinates is needed"
        if [len(row) for row in self.shape] != [n] * len(self.places):
            yield (
                ("model",),
                f"shape: {len(self.places)} rows (places) of {n} coordinates are needed",
            )

    def _place_faults(self) -> Iterable[str]:
        """Yield faults of places: each a direction under a carried part, one per part at least."""
        for place in self.places:
            name, _, direction = place.rpartition(".")
            if direction not in DOFS or name not in self.carries:
                allowed = ", ".join(self.carries)
                yield (
                    f"unknown place '{place}'; allowed: NAME.DIRECTION with the names {allowed} "
                    f"and the directions {', '.join(DOFS)}{suggestion(name, self.carries)}"
                )
        yield from (why for _, why in repeated("places", self.places, said="given twice: place"))
        for name in self.carries if self.places else ():
            if not any(place.rpartition(".")[0] == name for place in self.places):
                yield f"no place under '{name}', which the housing carries"

    @property
    def directions(self) -> frozenset[str]:
        """Directions in which carried parts move."""
        return frozenset(place.rpartition(".")[2] for place in self.places)


Housing = RigidHousing | ReducedHousing


def housed_motions(housings: Iterable[Housing]) -> frozenset[str]:
    """Return those of ``"bending"``, ``"axial"`` and ``"torsion"`` that housings take part in."""
    return frozenset(
        MOTIONS[name] for housing in housings for name in housing.directions if name in MOTIONS
    )
