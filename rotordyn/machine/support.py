"""What holds the shaft: bearing seats, sliding sleeves, linear supports."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from bearings.angular_contact import AngularContactBallBearing
from rotordyn.machine.growth import RingGrowth

# The motions that a straight rotor keeps apart, by the freedoms of its nodes.
MOTIONS = {
    "x": "axial",
    "y": "bending",
    "z": "bending",
    "thx": "torsion",
    "thy": "bending",
    "thz": "bending",
}
Entries = Mapping[tuple[str, str], float]


def entry_name(row: str, column: str) -> str:
    """An entry of a 6×6 matrix as files write it: ``yy``, ``y_thz``."""
    return row + column if len(row) == len(column) == 1 else f"{row}_{column}"


@dataclass(frozen=True, slots=True)
class BearingSeat:
    """An angular-contact bearing at station ``x`` [m].

    ``thrust`` is +1 where pushing the shaft towards +x loads the balls, −1 where −x does.
    ``radial_damping`` and ``axial_damping`` [N·s/m] act between its rings; tilt is not damped.
    """

    name: str
    bearing: AngularContactBallBearing
    x: float
    thrust: int
    growth: RingGrowth = field(default_factory=RingGrowth)
    radial_damping: float = 0.0
    axial_damping: float = 0.0
    model: str = ""


@dataclass(frozen=True, slots=True)
class Spring:
    """Preload spring: ``preload`` [N] at rest, ``stiffness`` [N/m]; infinite = rigid preload."""

    preload: float
    stiffness: float = math.inf


@dataclass(frozen=True, slots=True)
class Sleeve:
    """A sliding sleeve that carries the outer rings of ``bearings`` and is pushed by ``spring``.

    The spring pushes the way that loads the bearings. ``stop_travel`` [m]: how far the sleeve can
    move against its spring from its place at rest before it meets the end stop; infinite = no stop.
    ``mass`` [kg] and ``radial_stiffness`` [N/m] (infinite = held rigidly by the housing bore).
    """

    name: str
    bearings: tuple[str, ...]
    spring: Spring
    stop_travel: float = math.inf
    mass: float = 0.0
    radial_stiffness: float = math.inf


@dataclass(frozen=True, slots=True)
class LinearSupport:
    """Constant stiffness and damping to ground at station ``x``.

    ``stiffness`` [N/m, N/rad …] and ``damping`` map a pair of node freedoms (load, displacement),
    such as ``("y", "y")`` or ``("y", "thz")``, to the entry of the 6×6 matrix; freedoms are
    x, y, z, thx, thy, thz. Entries not named are zero; nothing is symmetrised.
    """

    name: str
    x: float
    stiffness: Entries
    damping: Entries = field(default_factory=dict)

    @property
    def sideways(self) -> tuple[tuple[str, str], ...]:
        """Entries of ``stiffness`` that turn a displacement along x into other loads."""
        return tuple(pair for pair in self._stiff if pair[1] == "x" and pair[0] != "x")

    @property
    def out_of_plane(self) -> tuple[tuple[str, str], ...]:
        """Entries of ``stiffness`` that couple plane y, the axis and all else to one another."""
        part = {"y": "plane", "thz": "plane", "x": "axis"}
        return tuple(pair for pair in self._stiff if part.get(pair[0]) != part.get(pair[1]))

    @property
    def _stiff(self) -> tuple[tuple[str, str], ...]:
        return tuple(pair for pair, value in self.stiffness.items() if abs(value) > 0.0)


def coupled_motions(supports: Iterable[LinearSupport]) -> frozenset[str]:
    """Those of ``"bending"``, ``"axial"`` and ``"torsion"`` that supports couple to another one."""
    pairs = (
        (MOTIONS[row], MOTIONS[column])
        for support in supports
        for entries in (support.stiffness, support.damping)
        for (row, column), value in entries.items()
        if value != 0.0
    )
    return frozenset(motion for pair in pairs if pair[0] != pair[1] for motion in pair)
