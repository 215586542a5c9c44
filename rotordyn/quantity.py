"""Limits of the values of descriptions: ranges of quantities, whole numbers, words, names.

They hold for files and for descriptions built in Python. Bounds are written with their unit.
"""

from __future__ import annotations

import difflib
import math
import re
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, Any

from bearings import errors
from rotordyn import units
from rotordyn.errors import InvalidInput

NAME = re.compile(r"[^\W\d][\w \-]{0,199}")


class Limit:
    """Limit of a single value, in Python and in files."""

    def refusal(self, value: Any, given: str = "") -> str:
        """Reason why ``value``, in a file written as ``given``, is refused; empty if valid."""
        raise NotImplementedError

    def read(self, given: object) -> Any:
        """Read the value from a file; raises InvalidInput."""
        if why := self.refusal(given, units.shown(given)):
            raise InvalidInput(why)
        return given


@dataclass(frozen=True)
class Quantity(Limit):
    """A range of values of one ``kind`` of unit (a key of ``units.KINDS``), open or closed.

    ``infinite``: word for an infinite value in a file; empty if it must be finite. ``instead``: an
    alternative that messages on values out of range name.
    """

    kind: str
    above: str = ""
    at_least: str = ""
    below: str = ""
    at_most: str = ""
    infinite: str = ""
    instead: str = ""

    @cached_property
    def low(self) -> float:
        """Lower bound [SI]."""
        bound = self.above or self.at_least
        return units.parse(bound, self.kind) if bound else -math.inf

    @cached_property
    def high(self) -> float:
        """Upper bound [SI]."""
        bound = self.below or self.at_most
        return units.parse(bound, self.kind) if bound else math.inf

    @property
    def allowed(self) -> str:
        """Text of the range: ``"above 0 m up to 100 m"``."""
        bounds = {"above": self.above, "from": self.at_least}
        bounds |= {"below": self.below, "up to": self.at_most}
        return " ".join(f"{word} {bound}" for word, bound in bounds.items() if bound)

    @property
    def coherent_unit(self) -> str:
        """SI unit of the quantity, as written; empty for a plain number."""
        coherent = (u for u in units.KINDS[self.kind] if units.parse_unit(u).scale == 1.0)
        return next(coherent, "")

    def holds(self, value: float) -> bool:
        """Whether ``value`` [SI] lies in the range; false for NaN."""
        if math.isinf(value):
            return value > 0.0 and bool(self.infinite)
        above = value > self.low if self.above else value >= self.low
        return above and (value < self.high if self.below else value <= self.high)

    def refusal(self, value: float, given: str = "") -> str:
        """Reason why ``value`` [SI], written as ``given``, is refused; empty if it is valid.

        For a bare number that would be valid in another unit it asks whether that was meant.
        """
        if self.holds(value):
            return ""
        allowed = (self.allowed or "a finite number") + self.instead
        if given:
            likely = self._likely_unit(value, given)
            return f"{self.kind} out of range: given {given}; allowed: {allowed}{likely}"
        words = f"{allowed}, or infinite" if self.infinite else allowed
        return (
            f"{self.kind} out of range: given {self.written(value)}; allowed: {words}"
            f"{self._likely(value)}"
        )

    def _likely(self, value: float) -> str:
        """Question whether another unit was meant, in which the number would lie in the range."""
        for unit in self._other_units:
            scaled = value * units.parse_unit(unit).scale
            if scaled != value and math.isfinite(scaled) and self._usual(scaled):
                return f" (did you mean {value:.6g} {unit} = {self.written(scaled)}?)"
        return ""

    @property
    def _other_units(self) -> tuple[str, ...]:
        """Units in which a number may be meant."""
        return (*units.KINDS[self.kind], *(("lb/in^3",) if self.kind == "density" else ()))

    def _usual(self, value: float) -> bool:
        """Whether a value in another unit is likely; no part of a machine floats."""
        return self.holds(value) and not (self.kind == "density" and value < 1000.0)

    def _likely_unit(self, value: float, given: str) -> str:
        """Question whether the number ``given`` with one unit was meant in another one."""
        unit = units.unit_of(given.strip("'"))
        number = units.in_unit(value, unit)
        for other in self._other_units:
            meant = number * units.parse_unit(other).scale
            if other != unit and not math.isclose(meant, value) and self._usual(meant):
                words = f"{number:.6g} {other}".strip()
                return f" (did you mean {words}?)"
        return ""

    def written(self, value: float) -> str:
        """Text of ``value`` [SI] in the SI unit, as a file takes it."""
        if math.isinf(value):
            return self.infinite or f"{value} {self.coherent_unit}".rstrip()
        return f"{value:.6g} {self.coherent_unit}".rstrip()

    def as_bounds(self, value: float) -> str:
        """Text of ``value`` [SI] in the unit of the bounds, for messages."""
        bound = self.at_least or self.above or self.at_most or self.below
        unit = units.unit_of(bound) if bound and math.isfinite(value) else ""
        return f"{units.in_unit(value, unit):.6g} {unit}" if unit else self.written(value)

    def read(self, given: object) -> float:
        """Read a value [SI] from text such as ``"25 mm"``, or from a number if it has no unit.

        Raises
        ------
        InvalidInput : another quantity, or out of range
        """
        if self.infinite and given == self.infinite:
            return math.inf
        try:
            value = units.parse(given, self.kind)
        except InvalidInput as error:
            word = self.infinite
            also = f", or {word}{suggestion(given, (word,))}" if word else ""
            raise InvalidInput(f"{error}{also}") from None
        if why := self.refusal(value, units.shown(given)):
            raise InvalidInput(why)
        return value


@dataclass(frozen=True)
class Choice(Limit):
    """One of a few words or numbers."""

    allowed: tuple[object, ...]

    def refusal(self, value: object, given: str = "") -> str:
        if any(type(value) is type(word) and value == word for word in self.allowed):
            return ""
        return _no_choice(value, [str(word) or '""' for word in self.allowed], given)


@dataclass(frozen=True)
class Whole(Limit):
    """A whole number from ``at_least`` to ``at_most``."""

    at_least: int
    at_most: int

    def refusal(self, value: object, given: str = "") -> str:
        if type(value) is int and self.at_least <= value <= self.at_most:
            return ""
        what = "not a whole number in its range" if given else "out of range"  # the type is known
        allowed = f"{self.at_least} to {self.at_most}"
        return f"{what}: given {given or errors.shown(value)}; allowed: {allowed}"


@dataclass(frozen=True)
class Named(Limit):
    """A name, usable in paths and messages.

    ``optional``: may be empty; ``dotted``: may consist of two names joined by a dot.
    """

    optional: bool = False
    dotted: bool = False

    def refusal(self, value: object, given: str = "") -> str:
        text = value if isinstance(value, str) else "."  # what is no text is no name
        parts = text.split(".", 1) if self.dotted else [text]
        if all(NAME.fullmatch(part) for part in parts) or (self.optional and not text):
            return ""
        shown = given or errors.shown(value)
        if self.dotted:
            return f"no name of a point: given {shown}; allowed: POINT, or ROTOR.POINT"
        allowed = "a letter or _, then up to 199 letters, digits, spaces, _ and -"
        return f"not a name: given {shown}; allowed: {allowed}"


@dataclass(frozen=True)
class Items:
    """Limit of the number of items of a list."""

    at_least: int = 1
    at_most: int = 100_000

    def refusal(self, value: tuple[object, ...], given: str = "") -> str:
        """Reason why ``value`` is refused; empty if it is valid."""
        if len(value) < self.at_least:
            few = "one item" if self.at_least == 1 else f"{self.at_least} items"
            return f"too few items: given {given or len(value)}; allowed: at least {few}"
        if len(value) > self.at_most:
            return f"too many items: given {len(value)}; allowed: up to {self.at_most}"
        return ""


@dataclass(frozen=True)
class Words(Limit):
    """Words for a few values, such as ``"+x"`` for 1; ``silent``: the value without a word."""

    values: tuple[tuple[str, object], ...]
    silent: object = None

    def refusal(self, value: object, given: str = "") -> str:
        known = (self.silent, *(meant for _, meant in self.values))
        if isinstance(value, str | int | float | tuple | None) and value in known:
            return ""
        return _no_choice(value, [word for word, _ in self.values], given)

    def read(self, given: object) -> object:
        """Value of a word; raises InvalidInput."""
        words = dict(self.values)
        if isinstance(given, str) and given in words:
            return words[given]
        shown = units.shown(given)
        raise InvalidInput(self.refusal(given if isinstance(given, str) else (), shown))

    def word(self, value: object) -> object:
        """Word for a value; the value itself if it has none."""
        return next((word for word, meant in self.values if meant == value), value)


@dataclass(frozen=True)
class Key:
    """Key of a field in files and paths, where it differs from the name of the field.

    ``name``: dotted if the key is inside a mapping; empty: the name of the field. ``hidden``: the
    field has no key. ``default``: default in files, where Python has none. ``required``: files must
    give it although Python need not. ``missing``: message if it is not given.
    """

    name: str = ""
    hidden: bool = False
    default: object = None
    required: bool = False
    missing: str = "it must be given"


HIDDEN = Key(hidden=True)


@dataclass(frozen=True)
class Sweep:
    """Marks a list of ascending values that files may write as a range: from, to, step or count."""


def _no_choice(value: object, words: list[str], given: str) -> str:
    shown, hint = given or errors.shown(value), suggestion(value, words)
    return f"not one of its choices: given {shown}; allowed: {', '.join(words)}{hint}"


def suggestion(given: object, allowed: Iterable[str]) -> str:
    """Text ``" (did you mean …?)"``; empty if no allowed word is similar."""
    lower = {word.lower(): word for word in allowed}
    close = difflib.get_close_matches(str(given).lower(), list(lower), n=1, cutoff=0.6)
    return f" (did you mean {lower[close[0]]}?)" if close else ""


LENGTH = Quantity("length", above="0 m", at_most="100 m")
FREQUENCY = Quantity("frequency", above="0 Hz", at_most="1000 kHz")
MASS = Quantity("mass", at_least="0 kg", at_most="100000 kg")
RIGIDITY = Quantity("stiffness", above="0 N/m", at_most="1e6 MN/m", infinite="rigid")
DAMPING_RATIO = Quantity("ratio", at_least="0 %", below="100 %")
SHEAR_COEFFICIENT = Quantity("number", above="0", at_most="1")

Station = Annotated[float, Quantity("length", at_least="-100 m", at_most="100 m")]
ToolStation = Annotated[
    float, Quantity("length", at_least="-100 m", at_most="100 m", infinite="front")
]
Length = Annotated[float, LENGTH]
Amplitude = Annotated[float, Quantity("ratio", above="0 %", at_most="20 %")]
Accuracy = Annotated[float, Quantity("number", at_least="1e-8", at_most="0.01")]
Friction = Annotated[float, Quantity("number", at_least="0.001", at_most="10", infinite="none")]
MassDamping = Annotated[float, Quantity("rate", at_least="0 1/s", at_most="1000000 1/s")]
StiffnessDamping = Annotated[float, Quantity("time", at_least="0 s", at_most="1 s")]
RadialShare = Annotated[float, Quantity("number", at_least="0", at_most="10")]
SpeedRatio = Annotated[float, Quantity("number", at_least="-100", at_most="100")]
EngineOrder = Annotated[float, Quantity("number", at_least="0.001", at_most="1000")]
Diameter = Annotated[float, Quantity("length", above="0.1 mm", at_most="10 m")]
Bore = Annotated[float, Quantity("length", at_least="0 m", at_most="10 m")]
Growth = Annotated[float, Quantity("length", at_least="-1 mm", at_most="1 mm")]
RingOffset = Annotated[float, Quantity("length", above="0 um", at_most="1 mm")]
Interference = Annotated[float, Quantity("length", at_least="0 um", at_most="1 mm")]
Travel = Annotated[float, Quantity("length", at_least="0 um", at_most="100 mm")]
StopStiffness = Annotated[float, Quantity("stiffness", at_least="1 N/um", at_most="1e5 N/um")]
StopTravel = Annotated[
    float, Quantity("length", at_least="0 um", at_most="100 mm", infinite="none")
]
Speed = Annotated[float, Quantity("speed", at_least="0 rpm", at_most="1000000 rpm")]
TopSpeed = Annotated[float, Quantity("speed", above="0 rpm", at_most="1000000 rpm")]
Frequency = Annotated[float, FREQUENCY]
Mass = Annotated[float, MASS]
Inertia = Annotated[float, Quantity("inertia", at_least="0 kg m^2", at_most="100000 kg m^2")]
Force = Annotated[float, Quantity("force", at_least="-10000 kN", at_most="10000 kN")]
Moment = Annotated[float, Quantity("moment", at_least="-10000 kN m", at_most="10000 kN m")]
LineForce = Annotated[float, Quantity("line load", at_least="-100000 kN/m", at_most="100000 kN/m")]
UnbalanceSize = Annotated[float, Quantity("unbalance", at_least="0 g mm", at_most="1000 kg m")]
BalanceQuality = Annotated[float, Quantity("balance quality", above="0 mm/s", at_most="10000 mm/s")]
Eccentricity = Annotated[float, Quantity("length", at_least="0 um", at_most="100 mm")]
Viscosity = Annotated[float, Quantity("viscosity", above="0 Pa s", at_most="1000 Pa s")]
OilViscosity = Annotated[
    float, Quantity("kinematic viscosity", above="0.5 mm^2/s", at_most="100000 mm^2/s")
]
Temperature = Annotated[float, Quantity("temperature", at_least="-60 degC", at_most="300 degC")]
CoolTemperature = Annotated[  # hotter bearings count as running away
    float, Quantity("temperature", at_least="-60 degC", at_most="250 degC")
]
TemperatureDifference = Annotated[
    float, Quantity("temperature difference", at_least="-200 K", at_most="200 K")
]
ThermalExpansion = Annotated[
    float, Quantity("thermal expansion", at_least="-1e-4 1/K", at_most="1e-3 1/K")
]
ThermalConductance = Annotated[
    float, Quantity("thermal conductance", at_least="0 W/K", at_most="100000 W/K")
]
HeatCapacity = Annotated[float, Quantity("heat capacity", at_least="0.1 J/K", at_most="1e9 J/K")]
Instant = Annotated[float, Quantity("time", at_least="0 s", at_most="1000 s")]
LastInstant = Annotated[float, Quantity("time", at_least="0 s", at_most="1000 s", infinite="none")]
TimeSpan = Annotated[float, Quantity("time", above="0 s", at_most="1000 s")]
Duration = Annotated[float, Quantity("duration", above="0 h", at_most="1e9 h")]
SlidingFriction = Annotated[float, Quantity("number", at_least="0.001", at_most="1")]
Cleanness = Annotated[float, Quantity("number", at_least="0", at_most="1")]
Roughness = Annotated[float, Quantity("length", above="0 um", at_most="10 um")]
EccentricityRatio = Annotated[float, Quantity("ratio", at_least="0 %", below="100 %")]
Angle = Annotated[float, Quantity("angle", at_least="-360 deg", at_most="360 deg")]
SmallAngle = Annotated[float, Quantity("angle", at_least="-1 deg", at_most="1 deg")]
TwistAngle = Annotated[float, Quantity("angle", above="0 deg", at_most="360 deg")]
Load = Annotated[float, Quantity("force", above="0 N", at_most="10000 kN")]
LightLoad = Annotated[float, Quantity("force", at_least="0.001 N", at_most="10000 kN")]
Preload = Annotated[float, Quantity("force", at_least="0 N", at_most="10000 kN")]
Pull = Annotated[float, Quantity("force", at_least="0 N", at_most="100000 kN")]
Rigidity = Annotated[float, RIGIDITY]
TiltRigidity = Annotated[
    float, Quantity("tilt stiffness", above="0 N m/rad", at_most="1e6 MN m/rad", infinite="rigid")
]
TiltDamping = Annotated[
    float, Quantity("tilt damping", at_least="0 N m s/rad", at_most="1e6 kN m s/rad")
]
Damping = Annotated[float, Quantity("damping", at_least="0 N s/m", at_most="1e6 kN s/m")]
DampingRatio = Annotated[float, DAMPING_RATIO]
LossFactor = Annotated[float, Quantity("ratio", at_least="0 %", at_most="100 %")]
Share = Annotated[float, Quantity("ratio", at_least="0 %", at_most="100 %")]
Name = Annotated[str, Named()]
PointName = Annotated[str, Named(dotted=True)]
OptionalName = Annotated[str, Named(optional=True)]
