"""Readers of single values: each takes what YAML gave and returns SI, or says what is wrong.

``UNKNOWN`` (a value whose fault is reported already) becomes NaN or an empty word, on which no
comparison of the later checks takes hold.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated, Any

from pydantic import PlainValidator, WithJsonSchema
from pydantic_core import PydanticCustomError

from rotordyn import quantity as limits
from rotordyn import units
from rotordyn.case.node import UNKNOWN
from rotordyn.case.schema import shapes
from rotordyn.errors import InvalidInput
from rotordyn.quantity import NAME, Named, Quantity, suggestion

Reader = Callable[[Any], Any]


def wrong(message: str) -> PydanticCustomError:
    """The error that carries a finished sentence of ours through pydantic."""
    return PydanticCustomError("rotordyn", "{sentence}", {"sentence": message})


def given(value: object) -> str:
    """A value as quoted in a message."""
    return units.shown(value)


@dataclass(frozen=True)
class QuantityReader:
    """Reads text such as ``"25 mm"`` as a value [SI] within the range of ``quantity``."""

    quantity: Quantity

    def __call__(self, value: Any) -> float:
        """The value [SI]; a faulty one is an error that says what is allowed."""
        kind, word = self.quantity.kind, self.quantity.infinite
        if value is UNKNOWN:
            return math.nan
        if word and value == word:
            return math.inf
        try:
            number = units.parse(value, kind)
        except InvalidInput as error:
            raise wrong(str(error) + _or_word(word, value)) from None
        if not self.quantity.holds(number):
            allowed = self.quantity.allowed
            raise wrong(f"{kind} out of range: given {given(value)}; allowed: {allowed}")
        return number

    def written(self, value: float) -> str:
        """``value`` [SI] as one would write it into a file."""
        if math.isinf(value):
            return self.quantity.infinite
        return f"{value:g} {self.quantity.coherent_unit}".strip()


def reads(within: Quantity) -> PlainValidator:
    """Reads a quantity within its range."""
    shape = _shaped(shapes.quantity(within))
    return PlainValidator(QuantityReader(within), json_schema_input_type=shape)


def _shaped(shape: dict[str, Any]) -> Any:
    return Annotated[Any, WithJsonSchema(shape)]


def quantity(
    kind: str, *, above: str = "", at_least: str = "", below: str = "", at_most: str = ""
) -> PlainValidator:
    """Reads a quantity of ``kind`` within bounds that only files have."""
    return reads(Quantity(kind, above, at_least, below, at_most))


def _or_word(word: str, value: object) -> str:
    return f", or {word}{suggestion(value, (word,))}" if word else ""


def choice(*allowed: str) -> PlainValidator:
    """Reads one of a few words."""

    def read(value: Any) -> str:
        if value is UNKNOWN:
            return ""
        if not isinstance(value, str) or value not in allowed:
            raise wrong(
                f"not one of its choices: given {given(value)}; allowed: {', '.join(allowed)}"
                + suggestion(value, allowed)
            )
        return value

    return PlainValidator(read, json_schema_input_type=_shaped(shapes.choice(allowed)))


def whole(at_least: int, at_most: int) -> PlainValidator:
    """Reads a whole number within bounds."""

    def read(value: Any) -> int:
        if value is UNKNOWN:
            return at_least
        if (
            isinstance(value, bool)
            or not isinstance(value, int)
            or not at_least <= value <= at_most
        ):
            raise wrong(
                f"not a whole number in its range: given {given(value)}; "
                f"allowed: {at_least} to {at_most}"
            )
        return value

    shape = shapes.whole(at_least, at_most)
    return PlainValidator(read, json_schema_input_type=_shaped(shape))


def _name(value: Any) -> str:
    if value is UNKNOWN:
        return ""
    if not isinstance(value, str) or NAME.fullmatch(value) is None:
        raise wrong(
            f"not a name: given {given(value)}; allowed: a letter, then letters, digits, _, -"
        )
    return value


def _point(value: Any) -> str:
    if value is UNKNOWN:
        return ""
    if not isinstance(value, str) or Named(dotted=True).refusal(value):
        raise wrong(f"no name of a point: given {given(value)}; allowed: POINT, or ROTOR.POINT")
    return value


def _text(value: Any) -> str:
    if value is UNKNOWN:
        return ""
    if not isinstance(value, str):
        raise wrong(
            f"not text: given {given(value)}; allowed: text, in quotes where it is a number"
        )
    return value


def _flag(value: Any) -> bool:
    if value is UNKNOWN:
        return False
    if not isinstance(value, bool):
        raise wrong(f"not a yes or no: given {given(value)}; allowed: true, false")
    return value


def none_if_unknown(value: Any) -> Any:
    """A model that was not found (reported already) is left out."""
    return None if value is UNKNOWN else value


Name = Annotated[str, PlainValidator(_name, json_schema_input_type=_shaped(shapes.NAME))]
PointName = Annotated[str, PlainValidator(_point, json_schema_input_type=_shaped(shapes.POINT))]
Text = Annotated[str, PlainValidator(_text, json_schema_input_type=str)]
Flag = Annotated[bool, PlainValidator(_flag, json_schema_input_type=bool)]

Station = Annotated[float, reads(limits.STATION)]
SpeedRatio = Annotated[float, reads(limits.SPEED_RATIO)]
EngineOrder = Annotated[float, reads(limits.ENGINE_ORDER)]
Length = Annotated[float, reads(limits.LENGTH)]
Amplitude = Annotated[float, reads(limits.AMPLITUDE)]
Accuracy = Annotated[float, reads(limits.ACCURACY)]
Friction = Annotated[float, reads(limits.FRICTION)]
MassDamping = Annotated[float, reads(limits.MASS_DAMPING)]
StiffnessDamping = Annotated[float, reads(limits.STIFFNESS_DAMPING)]
RadialShare = Annotated[float, reads(limits.RADIAL_SHARE)]
Diameter = Annotated[float, reads(limits.DIAMETER)]
Bore = Annotated[float, reads(limits.BORE)]
Growth = Annotated[float, reads(limits.GROWTH)]
Interference = Annotated[float, reads(limits.INTERFERENCE)]
Travel = Annotated[float, reads(limits.TRAVEL)]
StopTravel = Annotated[float, reads(limits.STOP_TRAVEL)]
Speed = Annotated[float, reads(limits.SPEED)]
TopSpeed = Annotated[float, reads(limits.TOP_SPEED)]
Frequency = Annotated[float, reads(limits.FREQUENCY)]
Mass = Annotated[float, reads(limits.MASS)]
Inertia = Annotated[float, reads(limits.INERTIA)]
Force = Annotated[float, reads(limits.FORCE)]
Moment = Annotated[float, reads(limits.MOMENT)]
LineForce = Annotated[float, reads(limits.LINE_FORCE)]
UnbalanceSize = Annotated[float, reads(limits.UNBALANCE)]
BalanceQuality = Annotated[float, reads(limits.BALANCE_QUALITY)]
Eccentricity = Annotated[float, reads(limits.ECCENTRICITY)]
Viscosity = Annotated[float, reads(limits.VISCOSITY)]
EccentricityRatio = Annotated[float, reads(limits.ECCENTRICITY_RATIO)]
Angle = Annotated[float, reads(limits.ANGLE)]
TwistAngle = Annotated[float, reads(limits.TWIST_ANGLE)]
Load = Annotated[float, reads(limits.LOAD)]
LightLoad = Annotated[float, reads(limits.LIGHT_LOAD)]
Preload = Annotated[float, reads(limits.PRELOAD)]
Pull = Annotated[float, reads(limits.PULL)]
Rigidity = Annotated[float, reads(limits.RIGIDITY)]
TiltRigidity = Annotated[float, reads(limits.TILT_RIGIDITY)]
TiltDamping = Annotated[float, reads(limits.TILT_DAMPING)]
Damping = Annotated[float, reads(limits.DAMPING)]
DampingRatio = Annotated[float, reads(limits.DAMPING_RATIO)]
LossFactor = Annotated[float, reads(limits.LOSS_FACTOR)]
Share = Annotated[float, reads(limits.SHARE)]
