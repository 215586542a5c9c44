"""What holds the shaft: bearing seats, sliding sleeves, linear supports."""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Annotated

from bearings.ball.law import KINEMATICS, MOMENT_SHARING, Law
from bearings.bearing import BallBearing
from rotordyn.description import Description, doubled
from rotordyn.errors import InvalidInput
from rotordyn.machine.growth import InterferenceFit, RingGrowth
from rotordyn.quantity import (
    Choice,
    Damping,
    Friction,
    LossFactor,
    Mass,
    Name,
    Preload,
    Rigidity,
    Speed,
    Station,
    StopTravel,
)

FREEDOMS = ("x", "y", "z", "thx", "thy", "thz")
SPINDLE, GROUND = "spindle", "ground"  # ends of a support that are no further rotor
Freedom = Annotated[str, Choice(FREEDOMS)]

# The motions that a straight rotor keeps apart, by the freedoms of its nodes.
MOTIONS = {
    "x": "axial",
    "y": "bending",
    "z": "bending",
    "thx": "torsion",
    "thy": "bending",
    "thz": "bending",
}
Value = float | tuple[float, ...]
Entries = Mapping[tuple[Freedom, Freedom], Value]
TILTS = frozenset({"thy", "thz"})
BEYOND = ("refuse", "hold")  # what becomes of a speed that a table does not reach
TABLED = ("y", "z", "thy", "thz")  # freedoms whose entries may follow the speed
RPM = math.pi / 30.0
SYMMETRIC = 1e-9  # of an entry: less than that is rounding
MOST = {"stiffness": 1e20, "damping": 1e13}  # [SI] of any entry: beyond, rounding rules
LEAST_MASS, LEAST_HOLD = 1e-12, 1.0  # [kg], [N/m] of a sleeve: less is lost in rounding
SLACK = 1e-9  # of the highest speed of a table, by which a speed may lie beside it


def entry_name(row: str, column: str) -> str:
    """An entry of a 6×6 matrix as files write it: ``yy``, ``y_thz``."""
    return row + column if len(row) == len(column) == 1 else f"{row}_{column}"


@dataclass(frozen=True, slots=True)
class BearingSeat(Description):
    """A bearing of any kind at station ``x`` [m].

    ``thrust`` is +1 where pushing the shaft towards +x loads the balls, −1 where −x does; of a kind
    that takes thrust both ways it says along which its axial load is positive, and which way a
    spring of its sleeve loads it; 0 stands for +1 there. ``kinematics``, ``moment_sharing`` and
    ``friction`` (infinite: no limit) of its balls, as in ``Law``; None: those of the conditions.
    ``radial_damping`` and ``axial_damping`` [N·s/m] act between its rings; tilt is not damped.
    """

    name: Name
    bearing: BallBearing
    x: Station
    thrust: Annotated[int, Choice((1, -1))] = 0
    growth: RingGrowth = field(default_factory=RingGrowth)
    radial_damping: Damping = 0.0
    axial_damping: Damping = 0.0
    model: str = ""
    kinematics: Annotated[str, Choice(KINEMATICS)] | None = None
    moment_sharing: Annotated[str, Choice(MOMENT_SHARING)] | None = None
    friction: Friction | None = None

    def __post_init__(self) -> None:
        given: object = self.thrust
        if given == 0 and type(given) is int and isinstance(self.bearing, BallBearing):
            if not self.bearing.both_ways:
                raise InvalidInput(
                    f"BearingSeat {self.name}: thrust must be given, 1 or -1: a "
                    f"{type(self.bearing).__name__} takes thrust one way only"
                )
            object.__setattr__(self, "thrust", 1)
        Description.__post_init__(self)

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

    def _faults(self) -> Iterator[str]:
        fit, room = self.growth.centrifugal, self.bearing.largest_static_growth
        if self.growth.static > room:
            yield (
                f"growth.static takes the whole contact angle: given {self.growth.static:.6g} m; "
                f"allowed: up to {room:.6g} m"
            )
        race = 2.0 * self.bearing.inner_raceway_radius
        if isinstance(fit, InterferenceFit) and fit.bore_diameter >= race:
            yield (
                f"no ring left beside the balls: bore_diameter {fit.bore_diameter:.6g} m; "
                f"allowed: below {race:.6g} m"
            )


@dataclass(frozen=True, slots=True)
class Spring(Description):
    """Preload spring: ``preload`` [N] at rest, ``stiffness`` [N/m]; infinite = rigid preload."""

    preload: Preload
    stiffness: Rigidity = math.inf


@dataclass(frozen=True, slots=True)
class Sleeve(Description):
    """A sliding sleeve that carries the outer rings of ``bearings`` and is pushed by ``spring``.

    The spring pushes the way that loads the bearings. ``stop_travel`` [m]: how far the sleeve can
    move against its spring from its place at rest before it meets the end stop; infinite = no stop.
    ``mass`` [kg] and ``radial_stiffness`` [N/m] (infinite = held rigidly by the housing bore).
    """

    name: Name
    bearings: tuple[Name, ...]
    spring: Spring
    stop_travel: StopTravel = math.inf
    mass: Mass = 0.0
    radial_stiffness: Rigidity = math.inf

    def _faults(self) -> Iterator[str]:
        if not self.bearings:
            yield "a sleeve carries at least one bearing"
        if 0.0 < self.mass < LEAST_MASS:
            yield (
                f"mass out of range: given {self.mass:g} kg; allowed: 0, or from {LEAST_MASS:g} kg"
            )
        if self.radial_stiffness < LEAST_HOLD:
            yield (
                f"radial_stiffness out of range: given {self.radial_stiffness:g} N/m; allowed: "
                f"from {LEAST_HOLD:g} N/m, or infinite"
            )
        for name in doubled(self.bearings):
            yield f"bearing '{name}' is named twice"


@dataclass(frozen=True, slots=True)
class LinearSupport(Description):
    """Stiffness and damping to ground at station ``x``, or freedoms held ``rigid``.

    It ``holds`` the spindle's shaft or a further rotor, ``against`` ground (a housing, where one
    carries it) or another rotor. Matrices are of the fixed frame, whatever turns.

    ``stiffness`` [N/m, N/rad …] and ``damping`` map a pair of node freedoms (load, displacement),
    such as ``("y", "y")`` or ``("y", "thz")``, to the entry of the 6×6 matrix; freedoms are
    x, y, z, thx, thy, thz. Entries not named are zero; nothing is symmetrised. Freedoms in
    ``rigid`` do not move at all and have no stiffness.
    An entry among y, z, thy and thz may be a tuple of values, one at each of ``speeds`` [rad/s],
    linear in between; ``beyond`` the first and the last they are not known (``"refuse"``), or those
    of the nearest end (``"hold"``). ``loss_factor`` [-]: hysteretic damping, of its stiffness.
    """

    name: Name
    x: Station
    stiffness: Entries = field(default_factory=dict)
    damping: Entries = field(default_factory=dict)
    rigid: tuple[Freedom, ...] = ()
    speeds: tuple[Speed, ...] = ()
    holds: Name = SPINDLE
    against: Name = GROUND
    loss_factor: LossFactor = 0.0
    beyond: Annotated[str, Choice(BEYOND)] = "refuse"

    def _faults(self) -> Iterator[str]:
        found = [*table_faults(self.stiffness, self.damping, self.speeds)]
        yield from (sentence for _, sentence in found)
        if not found:
            yield from loss_faults(self.stiffness, self.loss_factor)
        yield from _too_large(self.stiffness, self.damping)
        yield from hold_faults(self.beyond, self.speeds)
        if any(b <= a for a, b in pairwise(self.speeds)):
            yield "the speeds of its table must ascend without repeats"
        for freedom in doubled(self.rigid):
            yield f"rigid: repeated: given '{freedom}'"
        yield from rigid_and_elastic(self.rigid, (*self.stiffness, *self.damping))

    @property
    def tilts(self) -> bool:
        """True where it answers to tilt, or with a moment that tilts."""
        return any(not TILTS.isdisjoint(pair) for pair in (*self.stiffness, *self.damping))

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
        for end, own in (
            (self.speeds[:1], [speed for speed in beside if speed < self.speeds[0]]),
            (self.speeds[-1:], [speed for speed in beside if speed > self.speeds[-1]]),
        ):
            if own:
                low, high = (f"{each / RPM:.6g} rpm" for each in (min(own), max(own)))
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


def _too_large(stiffness: Entries, damping: Entries) -> Iterator[str]:
    for which, entries in (("stiffness", stiffness), ("damping", damping)):
        for pair, value in entries.items():
            worst = max(value if isinstance(value, tuple) else (value,), key=abs, default=0.0)
            if abs(worst) > MOST[which]:
                instead = ", or rigid: no give at all" if which == "stiffness" else ""
                yield (
                    f"{which} {entry_name(*pair)} out of range: given {worst:.6g}; allowed: "
                    f"from {-MOST[which]:.0e} to {MOST[which]:.0e}{instead}"
                )


def table_faults(
    stiffness: Entries, damping: Entries, speeds: Sequence[float]
) -> Iterator[tuple[tuple[str, ...], str]]:
    """What is wrong with entries over speed: the way to the key, and a sentence."""
    rows = 0
    for which, entries in (("stiffness", stiffness), ("damping", damping)):
        for pair, value in entries.items():
            if not isinstance(value, tuple):
                continue
            rows, name = rows + 1, entry_name(*pair)
            if not set(pair) <= set(TABLED):
                yield (
                    (which, name),
                    f"{which} {name} takes one value for all speeds: given {len(value)}; allowed "
                    f"over speed: entries of {', '.join(TABLED)}",
                )
            elif len(value) != len(speeds):
                yield (
                    (which, name),
                    f"{which} {name} needs one value for each of speeds: given {len(value)} values "
                    f"for {len(speeds)} speeds",
                )
    if len(speeds) == 1:
        yield ("speeds",), "a table needs at least two speeds: given 1"
    if speeds and not rows:
        yield ("speeds",), "speeds without a table: no entry has a list of values"


def hold_faults(beyond: str, speeds: Sequence[float]) -> Iterator[str]:
    """A sentence where there is no table whose ends could be held."""
    if beyond == "hold" and not speeds:
        yield "beyond: hold is of a table over speed, and there is none"


def loss_faults(stiffness: Entries, loss_factor: float) -> Iterator[str]:
    """A sentence where a loss factor has no spring whose energy it could be a share of."""
    if loss_factor == 0.0:
        return
    if not any(acts(value) for value in stiffness.values()):
        yield "loss_factor is of a stiffness, and there is none"
        return
    rows = max(len(value) if isinstance(value, tuple) else 1 for value in stiffness.values())
    for k in range(rows):
        own = {p: v[k] if isinstance(v, tuple) else v for p, v in stiffness.items()}
        for (row, column), value in own.items():
            other = own.get((column, row), 0.0)
            if abs(value - other) > SYMMETRIC * max(abs(value), abs(other)):
                yield (
                    "loss_factor is of a spring, and its stiffness is not symmetric: given "
                    f"{entry_name(row, column)} {value:.6g} and {entry_name(column, row)} "
                    f"{other:.6g}"
                )
                return
        if not _resists(own):
            yield "loss_factor is of a spring, and there is a motion that its stiffness drives"
            return


def _resists(entries: Mapping[tuple[str, str], float]) -> bool:
    """No motion is driven by a symmetric matrix; by elimination, freedoms in their own measure."""
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


def rigid_and_elastic(rigid: Iterable[str], entries: Iterable[tuple[str, str]]) -> Iterator[str]:
    """A sentence for every freedom that is held rigidly and has ``entries`` of a matrix as well."""
    named = {freedom for pair in entries for freedom in pair}
    for freedom in dict.fromkeys(rigid):
        if freedom in named:
            yield f"{freedom} is held rigidly and has entries of stiffness or damping: one of both"


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
