"""What holds the shaft: bearing seats, sliding sleeves, linear supports."""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Annotated

from bearings.ball.law import KINEMATICS, MOMENT_SHARING, Law
from bearings.bearing import BallBearing
from bearings.kinds import kind_of
from rotordyn.description import Description, Faults, ascending, repeated
from rotordyn.errors import InvalidInput
from rotordyn.machine.ball_guide import BallGuide
from rotordyn.machine.fits import Fits
from rotordyn.machine.growth import RingGrowth
from rotordyn.machine.misalignment import Misalignment
from rotordyn.quantity import (
    HIDDEN,
    Choice,
    Damping,
    Friction,
    Items,
    Key,
    LossFactor,
    Mass,
    Name,
    Preload,
    Quantity,
    Rigidity,
    RingOffset,
    Speed,
    Station,
    StopTravel,
    Words,
)
from rotordyn.units import format_quantity

DOFS = ("x", "y", "z", "thx", "thy", "thz")
SPINDLE, GROUND = "spindle", "ground"  # ends of a support that are no further rotor
Dof = Annotated[str, Choice(DOFS)]

# The motions that a straight rotor keeps apart, by the DOF of its nodes.
MOTIONS = {
    "x": "axial",
    "y": "bending",
    "z": "bending",
    "thx": "torsion",
    "thy": "bending",
    "thz": "bending",
}
Value = float | tuple[float, ...]
Entries = Mapping[tuple[Dof, Dof], Value]
THRUST = Words((("+x", 1), ("-x", -1)), silent=0)
BEYOND = ("refuse", "hold")  # what becomes of a speed that a table does not reach
TABLED = ("y", "z", "thy", "thz")  # DOF whose entries may follow the speed
RPM = math.pi / 30.0
SYMMETRIC = 1e-9  # of an entry: less than that is rounding
MOST = {"stiffness": 1e20, "damping": 1e13}  # [SI] of any entry: beyond, rounding rules
LEAST_MASS, LEAST_HOLD = 1e-12, 1.0  # [kg], [N/m] of a sleeve: less is lost in rounding
SLACK = 1e-9  # of the highest speed of a table, by which a speed may lie beside it
_UNITS = {"stiffness": ("N/m", "N/rad", "N m/rad"), "damping": ("N s/m", "N s/rad", "N m s/rad")}


@dataclass(frozen=True, slots=True)
class Matrix:
    """Marks entries of a 6×6 ``"stiffness"`` or ``"damping"`` matrix by pair (load, displacement).

    Files write them by name (``yy``, ``y_thz``), or whole, with the DOF of rows and columns.
    """

    kind: str

    def quantity(self, row: str, column: str) -> Quantity:
        """What an entry takes, by how many of its two DOF are rotations."""
        return _entry(self.kind, sum(len(dof) > 1 for dof in (row, column)))

    def refusal(self, entries: Entries) -> str:
        """Why an entry is not taken; empty where all are."""
        for pair, value in entries.items():
            quantity = self.quantity(*pair)
            for each in value if isinstance(value, tuple) else (value,):
                if why := quantity.refusal(each):
                    return f"{entry_name(*pair)}: {why}"
        return ""


@cache
def _entry(kind: str, rotations: int) -> Quantity:
    names, limit = (kind, f"coupling {kind}", f"tilt {kind}"), f"{MOST[kind]:g}"
    bound = f"{limit} {_UNITS[kind][rotations]}"
    instead = ", or rigid: no give at all" if kind == "stiffness" else ""
    return Quantity(names[rotations], at_least=f"-{bound}", at_most=bound, instead=instead)


STIFFNESS, DAMPING = Matrix("stiffness"), Matrix("damping")


def entry_name(row: str, column: str) -> str:
    """An entry of a 6×6 matrix as files write it: ``yy``, ``y_thz``."""
    return row + column if len(row) == len(column) == 1 else f"{row}_{column}"


@dataclass(frozen=True, slots=True)
class BearingSeat(Description):
    """A bearing on the shaft.

    ``thrust``: of a kind that takes thrust both ways it says along which its axial load is
    positive, and which way a spring of its sleeve loads it; 0 stands for +1 there. What is assumed
    of its balls is that of the conditions of the case unless given here; friction ``none`` or
    infinite: no limit. Damping [N·s/m] acts between its rings; tilt is not damped.
    """

    name: Annotated[Name, "of this bearing"]
    bearing: Annotated[BallBearing, Key("model"), "name or path of a bearing model, or a mapping"]
    x: Annotated[Station, "station of the circle of inner groove centres"]
    thrust: Annotated[
        int,
        THRUST,
        "the way the shaft pushes the inner ring to load the balls; of kinds that take thrust both "
        "ways only needed on a sleeve",
    ] = 0
    growth: Annotated[RingGrowth, "instead of that of the spindle"] = field(
        default_factory=RingGrowth
    )
    fits: Annotated[
        Fits | None,
        "fits of its rings, from which the growth follows instead ([theory](theory/rings.md))",
    ] = None
    radial_damping: Annotated[Damping, Key("damping.radial"), "between the rings"] = 0.0
    axial_damping: Annotated[Damping, Key("damping.axial"), "between the rings"] = 0.0
    model: Annotated[str, HIDDEN] = ""
    kinematics: Annotated[
        Annotated[str, Choice(KINEMATICS)] | None, "instead of that of the conditions"
    ] = None
    moment_sharing: Annotated[
        Annotated[str, Choice(MOMENT_SHARING)] | None, "instead of that of the conditions"
    ] = None
    friction: Annotated[Friction | None, "instead of that of the conditions"] = None
    misalignment: Annotated[
        Misalignment, "of the bore that its outer ring sits in ([how](theory/loads.md))"
    ] = field(default_factory=Misalignment)

    def __post_init__(self) -> None:
        given, bearing = self.thrust, self._known_bearing
        if given == 0 and type(given) is int and bearing is not None:
            object.__setattr__(self, "thrust", int(bearing.both_ways))
        Description.__post_init__(self)

    @property
    def _known_bearing(self) -> BallBearing | None:
        """The bearing; None where the faults of its file are reported already."""
        given: object = self.bearing
        return given if isinstance(given, BallBearing) else None

    def law(self, common: Law) -> Law:
        """What is assumed of its balls: its own where given, the rest in ``common``."""
        friction = common.friction
        if self.friction is not None:
            friction = None if math.isinf(self.friction) else self.friction
        return replace(
            common,
            kinematics=self.kinematics or common.kinematics,
            moment_sharing=self.moment_sharing or common.moment_sharing,
            friction=friction,
        )

    def _faults(self) -> Faults:
        bearing = self._known_bearing
        if bearing is None:
            return
        if self.thrust == 0 and not bearing.both_ways:
            yield (
                ("thrust",),
                f"missing key: kind {kind_of(bearing)} takes thrust one way only; allowed: "
                "+x, -x, the way the shaft pushes the inner ring to load the balls",
            )
        yield from self._fit_faults(bearing)
        room = bearing.largest_static_growth
        if self.growth.static > room:
            yield (
                ("growth", "static"),
                "takes the whole contact angle: given {given}; allowed: up to "
                f"{format_quantity(room, 'um')}",
            )
        race, fit = 2.0 * bearing.inner_raceway_radius, self.growth.fitted
        if fit is not None and fit.bore_diameter >= race:
            yield (
                ("growth", "fit"),
                f"the bore of bearing {self.name} leaves no ring beside the balls: given "
                f"{format_quantity(fit.bore_diameter, 'mm')}; allowed: below "
                f"{format_quantity(race, 'mm')}",
            )

    def _fit_faults(self, bearing: BallBearing) -> Faults:
        if self.fits is None:
            return
        if self.growth != RingGrowth():
            yield (
                ("fits",),
                f"bearing {self.name} has fits beside a given growth, which contradict one "
                "another: growth follows from the fits; leave one of both out",
            )
        races = 2.0 * bearing.inner_raceway_radius, 2.0 * bearing.outer_raceway_radius
        bore, outside = self.fits.bore_diameter, self.fits.outside_diameter
        if bore is not None and bore >= races[0]:
            yield (
                ("fits",),
                f"the bore of bearing {self.name} leaves no ring beside the balls: given "
                f"{format_quantity(bore, 'mm')}; allowed: below {format_quantity(races[0], 'mm')}",
            )
        if outside is not None and outside <= races[1]:
            yield (
                ("fits",),
                f"the outside of bearing {self.name} leaves no ring beside the balls: given "
                f"{format_quantity(outside, 'mm')}; allowed: above "
                f"{format_quantity(races[1], 'mm')}",
            )


@dataclass(frozen=True, slots=True)
class Spring(Description):
    """Preload spring [N], [N/m]; ``rigid`` or infinite locks the sleeve in its place at rest."""

    preload: Annotated[Preload, "force at rest"]
    stiffness: Annotated[
        Rigidity, Key(required=True), "`rigid` locks the sleeve in its place at rest"
    ] = math.inf
    offset: Annotated[
        RingOffset | None,
        "of a rigid preload, instead of its force: axial offset of the free rings, or difference "
        "of spacers",
    ] = None
    free: Annotated[
        bool, "the preload is that of a pair of such bearings before it is mounted, as of a class"
    ] = False

    @property
    def words(self) -> str:
        """What preloads, in a few words."""
        if self.offset is not None:
            return f"offset of {self.offset * 1e6:.4g} µm"
        return f"{self.preload:.6g} N" + " by class" * self.free

    def _faults(self) -> Faults:
        if (self.free or self.offset is not None) and math.isfinite(self.stiffness):
            key = "offset" if self.offset is not None else "free"
            yield (key,), "is of a rigid preload: given beside a stiffness; allowed: with rigid"
        if self.offset is not None and (self.preload > 0.0 or self.free):
            yield ("offset",), "given beside a preload: one gives the other; leave one of both out"


@dataclass(frozen=True, slots=True)
class Sleeve(Description):
    """A sliding sleeve that carries the outer rings of bearings, its spring and its end stop.

    The spring pushes the way that loads the bearings. [m], [kg], [N/m]; infinite: no stop, held
    rigidly by the housing bore.
    """

    name: Annotated[Name, "of the sleeve"]
    bearings: Annotated[tuple[Name, ...], Items(), "whose outer rings it carries"]
    spring: Annotated[Spring, "that loads these bearings"]
    stop_travel: Annotated[StopTravel, "way against the spring, from rest to the end stop"] = (
        math.inf
    )
    mass: Annotated[Mass, "of the sleeve"] = 0.0
    radial_stiffness: Annotated[Rigidity, "between sleeve and housing"] = math.inf
    ball_guide: Annotated[
        BallGuide | None,
        "balls between sleeve and housing, which give that stiffness instead "
        "([theory](theory/supports.md#ball-guides))",
    ] = None
    friction: Annotated[
        Preload, "limit of the dry friction in its bore ([which analyses](theory/network.md))"
    ] = 0.0

    @property
    def radially(self) -> float:
        """Stiffness between sleeve and housing, infinite where the bore is rigid [N/m]."""
        return self.radial_stiffness if self.ball_guide is None else self.ball_guide.law.stiffness

    def _faults(self) -> Faults:
        if self.ball_guide is not None and self.radial_stiffness < math.inf:
            yield ("radial_stiffness",), "given beside ball_guide, which gives it: one of both"
        if 0.0 < self.mass < LEAST_MASS:
            yield ("mass",), f"out of range: given {{given}}; allowed: 0, or from {LEAST_MASS:g} kg"
        if self.radial_stiffness < LEAST_HOLD:
            yield (
                ("radial_stiffness",),
                f"out of range: given {{given}}; allowed: from {LEAST_HOLD:g} N/m, or infinite",
            )
        for index, sentence in repeated(self.bearings):
            yield ("bearings", index), sentence


@dataclass(frozen=True, slots=True)
class LinearSupport(Description):
    """A linear support to ground or to another rotor, by its matrices; nothing is made symmetric.

    Matrices [N/m, N/rad …] are of the fixed frame, whatever turns, by pairs of DOF (load,
    displacement) such as ``("y", "thz")``; entries not named are zero. An entry among y, z, thy and
    thz may be a list, one value at each of ``speeds``, straight lines in between. DOF in
    ``rigid`` do not move at all and have no stiffness.
    """

    name: Annotated[Name, "of the support"]
    x: Annotated[Station, "station"]
    stiffness: Annotated[Entries, STIFFNESS, "between its two ends, 6×6, in the fixed frame"] = (
        field(default_factory=dict)
    )
    damping: Annotated[Entries, DAMPING, "between its two ends, 6×6, in the fixed frame"] = field(
        default_factory=dict
    )
    rigid: Annotated[tuple[Dof, ...], "DOF that do not move, instead of a stiffness"] = ()
    speeds: Annotated[tuple[Speed, ...], "of the values in lists, ascending"] = ()
    holds: Annotated[Name, "the rotor at one end; `spindle` is its shaft"] = SPINDLE
    against: Annotated[
        Name, "what is at the other end: `ground` (or a housing), `spindle` or another rotor"
    ] = GROUND
    loss_factor: Annotated[
        LossFactor,
        "η of its stiffness: hysteretic damping in the fixed frame, without further rotors "
        "([how](theory/damping.md#hysteretic-damping))",
    ] = 0.0
    beyond: Annotated[
        str,
        Choice(BEYOND),
        "at speeds outside a table: `refuse` the case, or `hold` the values of its nearest end, "
        "with a warning",
    ] = "refuse"

    def _faults(self) -> Faults:
        if not (self.stiffness or self.damping or self.rigid):
            yield ("stiffness",), "missing key: it must be given, or rigid"
        faults = [*self._table_faults()]
        yield from faults
        if not faults and self.loss_factor != 0.0:
            yield from ((("loss_factor",), why) for why in _no_spring(self.stiffness))
        if self.beyond == "hold" and not self.speeds:
            yield ("beyond",), "hold is of a table over speed, and there is none"
        yield from ascending("speeds", self.speeds)
        for index, sentence in repeated(self.rigid):
            yield ("rigid", index), sentence
        named = {dof for pair in (*self.stiffness, *self.damping) for dof in pair}
        for dof in dict.fromkeys(self.rigid):
            if dof in named:
                yield (
                    ("rigid",),
                    f"{dof} is held rigidly and has entries of stiffness or damping: one of both",
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
        """What it joins: a rotor, and a rotor or ground."""
        return self.holds, self.against

    @property
    def along(self) -> float:
        """Stiffness along the axis, xx [N/m]."""
        value = self.stiffness.get(("x", "x"), 0.0)
        return value if isinstance(value, float) else math.nan

    def at(self, speed: float) -> LinearSupport:
        """The support as it is at ``speed`` [rad/s], without a table.

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
        """A sentence where the first of ``speeds`` [rad/s] lies that its table does not know."""
        for speed in self._beside(speeds)[:1] if self.beyond == "refuse" else ():
            yield (
                f"support '{self.name}' is not known at that speed: given "
                f"{speed / RPM:.6g} rpm; allowed: {self.speeds[0] / RPM:.6g} rpm to "
                f"{self.speeds[-1] / RPM:.6g} rpm, the range of its table; or beyond: hold"
            )

    def held_at(self, speeds: Iterable[float]) -> Iterator[str]:
        """A sentence about those of ``speeds`` [rad/s] at which an end of its table is held."""
        beside = self._beside(speeds) if self.beyond == "hold" else []
        for end, end_speeds in (
            (self.speeds[:1], [speed for speed in beside if speed < self.speeds[0]]),
            (self.speeds[-1:], [speed for speed in beside if speed > self.speeds[-1]]),
        ):
            if end_speeds:
                low, high = (f"{each / RPM:.6g} rpm" for each in (min(end_speeds), max(end_speeds)))
                at = low if low == high else f"{low} to {high}"
                yield (
                    f"support '{self.name}' is held beyond its table as at {end[0] / RPM:.6g} rpm, "
                    f"at {at}: extend the table"
                )

    def _beside(self, speeds: Iterable[float]) -> list[float]:
        """Speeds [rad/s] that its table does not reach."""
        if not self.speeds:
            return []
        low, high = self.speeds[0], self.speeds[-1]
        return [s for s in speeds if not low - SLACK * high <= s <= high + SLACK * high]

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
        return tuple(pair for pair, value in self.stiffness.items() if acts(value))


def acts(value: Value) -> bool:
    """False for an entry that is zero at all speeds."""
    return any(value) if isinstance(value, tuple) else value != 0.0


def _no_spring(stiffness: Entries) -> Iterator[str]:
    """A sentence where a loss factor has no spring whose energy it could be a share of."""
    if not any(acts(value) for value in stiffness.values()):
        yield "loss_factor is of a stiffness, and there is none"
        return
    rows = max(len(value) if isinstance(value, tuple) else 1 for value in stiffness.values())
    for k in range(rows):
        entries = {p: v[k] if isinstance(v, tuple) else v for p, v in stiffness.items()}
        for (row, column), value in entries.items():
            other = entries.get((column, row), 0.0)
            if abs(value - other) > SYMMETRIC * max(abs(value), abs(other)):
                yield (
                    "loss_factor is of a spring, and its stiffness is not symmetric: given "
                    f"{entry_name(row, column)} {value:.6g} and {entry_name(column, row)} "
                    f"{other:.6g}"
                )
                return
        if not _resists(entries):
            yield "loss_factor is of a spring, and there is a motion that its stiffness drives"
            return


def _resists(entries: Mapping[tuple[str, str], float]) -> bool:
    """No motion is driven by a symmetric matrix; by elimination, DOF in their own measure."""
    names = list(dict.fromkeys(row for row, _ in entries))
    size = {name: entries.get((name, name), 0.0) for name in names}
    if any(size[r] <= 0.0 or size[c] <= 0.0 for (r, c), v in entries.items() if v != 0.0):
        return False
    held = [name for name in names if size[name] > 0.0]
    rest = [[entries.get((r, c), 0.0) / math.sqrt(size[r] * size[c]) for c in held] for r in held]
    while rest:
        (pivot, *across), below = rest[0], rest[1:]
        if pivot < -SYMMETRIC:
            return False
        if pivot <= SYMMETRIC:
            if any(abs(value) > math.sqrt(SYMMETRIC) for value in across):
                return False
            across = [0.0 for _ in across]
        rest = [
            [v - row[0] * a / (pivot or 1.0) for v, a in zip(row[1:], across, strict=True)]
            for row in below
        ]
    return True


def _between(speeds: tuple[float, ...], value: Value, speed: float) -> float:
    """Of a table, linear between its speeds; beside it, its end."""
    if not isinstance(value, tuple):
        return value
    k = min(max(bisect_left(speeds, speed), 1), len(speeds) - 1)
    share = min(max((speed - speeds[k - 1]) / (speeds[k] - speeds[k - 1]), 0.0), 1.0)
    return (1.0 - share) * value[k - 1] + share * value[k]


def coupled_motions(supports: Iterable[LinearSupport]) -> frozenset[str]:
    """Those of ``"bending"``, ``"axial"`` and ``"torsion"`` that supports couple to another one."""
    pairs = (
        (MOTIONS[row], MOTIONS[column])
        for support in supports
        for entries in (support.stiffness, support.damping)
        for (row, column), value in entries.items()
        if acts(value)
    )
    return frozenset(motion for pair in pairs if pair[0] != pair[1] for motion in pair)
