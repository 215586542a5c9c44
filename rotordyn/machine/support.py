"""Linear supports of the shaft: matrices, constant or over speed."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Annotated

from rotordyn.description import Description, Faults, ascending, repeated
from rotordyn.errors import InvalidInput
from rotordyn.machine.matrix import (
    DAMPING,
    STIFFNESS,
    Dof,
    Entries,
    Value,
    acts,
    entry_name,
    no_spring,
)
from rotordyn.quantity import Choice, LossFactor, Name, Speed, Station

SPINDLE, GROUND = "spindle", "ground"  # ends of a support other than further rotors
# Motions that are uncoupled in a straight rotor, by the DOF of its nodes.
MOTIONS = {
    "x": "axial",
    "y": "bending",
    "z": "bending",
    "thx": "torsion",
    "thy": "bending",
    "thz": "bending",
}
BEYOND = ("refuse", "hold")  # treatment of a speed outside a table
TABLED = ("y", "z", "thy", "thz")  # DOF whose entries may follow the speed
RPM = math.pi / 30.0
SLACK = 1e-9  # of the highest speed of a table, by which a speed may lie outside it


@dataclass(frozen=True, slots=True)
class LinearSupport(Description):
    """A linear support to ground or to another rotor, by its matrices; nothing is made symmetric.

    Matrices [N/m, N/rad …] are of the fixed frame, whatever turns, by pairs of DOF (load,
    displacement) such as ``("y", "thz")``; entries not named are zero. An entry among y, z, thy and
    thz may be a list, one value at each of ``speeds``, linear in between. DOF in
    ``rigid`` do not move at all and have no stiffness.
    """

    name: Annotated[Name, "name of the support"]
    x: Annotated[Station, "station"]
    stiffness: Annotated[Entries, STIFFNESS, "between its two ends, 6×6, in the fixed frame"] = (
        field(default_factory=dict)
    )
    damping: Annotated[Entries, DAMPING, "between its two ends, 6×6, in the fixed frame"] = field(
        default_factory=dict
    )
    rigid: Annotated[tuple[Dof, ...], "DOF that do not move, instead of a stiffness"] = ()
    speeds: Annotated[tuple[Speed, ...], "speeds of the values in lists, ascending"] = ()
    holds: Annotated[Name, "the rotor at one end; `spindle` is its shaft"] = SPINDLE
    against: Annotated[
        Name, "body at the other end: `ground` (or a housing), `spindle` or another rotor"
    ] = GROUND
    loss_factor: Annotated[
        LossFactor,
        "η of its stiffness: hysteretic damping in the fixed frame, without further rotors "
        "([how](theory/damping.md#hysteretic-damping))",
    ] = 0.0
    beyond: Annotated[
        str,
        Choice(BEYOND),
        "treatment of speeds outside a table: `refuse` the case, or `hold` the values "
        "of its nearest end, with a warning",
    ] = "refuse"

    def _faults(self) -> Faults:
        if not (self.stiffness or self.damping or self.rigid):
            yield ("stiffness",), "missing key: it must be given, or rigid"
        faults = [*self._table_faults()]
        yield from faults
        if not faults and self.loss_factor != 0.0:
            yield from ((("loss_factor",), why) for why in no_spring(self.stiffness))
        if self.beyond == "hold" and not self.speeds:
            yield ("beyond",), "hold needs a table over speed: none is given"
        yield from ascending("speeds", self.speeds)
        yield from repeated("rigid", self.rigid)
        named = {dof for pair in (*self.stiffness, *self.damping) for dof in pair}
        for dof in dict.fromkeys(self.rigid):
            if dof in named:
                yield (
                    ("rigid",),
                    f"{dof} is rigid and has entries of stiffness or damping: leave one of the two "
                    "out",
                )

    def _table_faults(self) -> Faults:
        rows = 0
        for which, entries in (("stiffness", self.stiffness), ("damping", self.damping)):
            for pair, value in entries.items():
                if not isinstance(value, tuple):
                    continue
                rows, name = rows + 1, entry_name(*pair)
                if not set(pair) <= set(TABLED):
                    yield (
                        (which, name),
                        f"{which} {name} takes one value for all speeds: given {len(value)}; "
                        f"allowed over speed: entries of {', '.join(TABLED)}",
                    )
                elif len(value) != len(self.speeds):
                    yield (
                        (which, name),
                        f"{which} {name} needs one value for each of speeds: given {len(value)} "
                        f"values for {len(self.speeds)} speeds",
                    )
        if len(self.speeds) == 1:
            yield ("speeds",), "a table needs at least two speeds: given 1"
        if self.speeds and not rows:
            yield ("speeds",), "speeds without a table: no entry has a list of values"

    @property
    def ends(self) -> tuple[str, str]:
        """Its two ends: a rotor, and a rotor or ground."""
        return self.holds, self.against

    @property
    def along(self) -> float:
        """Stiffness along the axis, xx [N/m]."""
        value = self.stiffness.get(("x", "x"), 0.0)
        return value if isinstance(value, float) else math.nan

    @property
    def has_negative_stiffness(self) -> bool:
        """Whether a diagonal stiffness is negative at some speed, as of the field of a motor."""
        diagonal = (value for (row, column), value in self.stiffness.items() if row == column)
        return any(min(each if isinstance(each, tuple) else (each,)) < 0.0 for each in diagonal)

    def at(self, speed: float) -> LinearSupport:
        """Return the support at ``speed`` [rad/s], without a table.

        Raises
        ------
        InvalidInput : the table does not reach there
        """
        if not self.speeds:
            return self
        for sentence in self.unknown_at((speed,)):
            raise InvalidInput(sentence)
        stiffness, damping = (
            {pair: _between(self.speeds, value, speed) for pair, value in entries.items()}
            for entries in (self.stiffness, self.damping)
        )
        return replace(self, stiffness=stiffness, damping=damping, speeds=(), beyond="refuse")

    def unknown_at(self, speeds: Iterable[float]) -> Iterator[str]:
        """Yield a sentence with the first of ``speeds`` [rad/s] outside its table."""
        for speed in beside(self.speeds, speeds)[:1] if self.beyond == "refuse" else ():
            yield (
                f"support '{self.name}' has no values at that speed: given {speed / RPM:.6g} rpm; "
                f"allowed: {self.speeds[0] / RPM:.6g} rpm to {self.speeds[-1] / RPM:.6g} rpm, the "
                "range of its table; or beyond: hold"
            )

    def held_at(self, speeds: Iterable[float]) -> Iterator[str]:
        """Yield a sentence on those of ``speeds`` [rad/s] at which an end of its table is held."""
        outside = beside(self.speeds, speeds) if self.beyond == "hold" else []
        for end, end_speeds in (
            (self.speeds[:1], [speed for speed in outside if speed < self.speeds[0]]),
            (self.speeds[-1:], [speed for speed in outside if speed > self.speeds[-1]]),
        ):
            if end_speeds:
                low, high = (
                    f"{limit / RPM:.6g} rpm" for limit in (min(end_speeds), max(end_speeds))
                )
                at = low if low == high else f"{low} to {high}"
                yield (
                    f"support '{self.name}' keeps its values at {end[0] / RPM:.6g} rpm beyond its "
                    f"table, at {at}: extend the table"
                )

    @property
    def axial_coupling(self) -> tuple[tuple[str, str], ...]:
        """Entries of ``stiffness`` that couple a displacement along x to other loads."""
        return tuple(pair for pair in self._stiff if pair[1] == "x" and pair[0] != "x")

    @property
    def out_of_plane(self) -> tuple[tuple[str, str], ...]:
        """Entries of ``stiffness`` that couple plane y, the axis and all else to each other."""
        part = {"y": "plane", "thz": "plane", "x": "axis"}
        return tuple(pair for pair in self._stiff if part.get(pair[0]) != part.get(pair[1]))

    @property
    def _stiff(self) -> tuple[tuple[str, str], ...]:
        return tuple(pair for pair, value in self.stiffness.items() if acts(value))


def beside(table: Sequence[float], speeds: Iterable[float]) -> list[float]:
    """Return those of ``speeds`` [rad/s] outside an ascending table; none without a table."""
    if not table:
        return []
    low, high = table[0] - SLACK * table[-1], table[-1] + SLACK * table[-1]
    return [speed for speed in speeds if speed < low or speed > high]


def _between(speeds: tuple[float, ...], value: Value, speed: float) -> float:
    """Interpolate a table linearly over its speeds; beyond them, return its end."""
    import numpy as np

    if not isinstance(value, tuple):
        return value
    return float(np.interp(speed, speeds, value))


def coupled_motions(supports: Iterable[LinearSupport]) -> frozenset[str]:
    """Return those of ``"bending"``, ``"axial"``, ``"torsion"`` that supports couple to others."""
    pairs = (
        (MOTIONS[row], MOTIONS[column])
        for support in supports
        for entries in (support.stiffness, support.damping)
        for (row, column), value in entries.items()
        if acts(value)
    )
    return frozenset(motion for pair in pairs if pair[0] != pair[1] for motion in pair)
