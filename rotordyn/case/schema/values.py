"""Readers of single values: each takes what YAML gave and returns SI, or says what is wrong.

``UNKNOWN`` (a value whose fault is reported already) becomes NaN or an empty word, on which no
comparison of the later checks takes hold.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from typing import Annotated, Any

from pydantic import PlainValidator
from pydantic_core import PydanticCustomError

from rotordyn import units
from rotordyn.case.library import suggestion
from rotordyn.case.node import UNKNOWN
from rotordyn.errors import InvalidInput

Reader = Callable[[Any], Any]
_NAME = re.compile(r"[^\W\d][\w \-]*")


def wrong(message: str) -> PydanticCustomError:
    """The error that carries a finished sentence of ours through pydantic."""
    return PydanticCustomError("rotordyn", "{sentence}", {"sentence": message})


def given(value: object) -> str:
    """A value as quoted in a message."""
    return units.shown(value)


def quantity(
    kind: str,
    *,
    above: str = "",
    at_least: str = "",
    below: str = "",
    at_most: str = "",
    words: Mapping[str, float] | None = None,
) -> PlainValidator:
    """Reads a quantity of ``kind``, bounded; ``words`` may stand in for a value (``rigid``)."""
    low = units.parse(above or at_least, kind) if above or at_least else -math.inf
    high = units.parse(below or at_most, kind) if below or at_most else math.inf
    bounds = _bounds(above, at_least, below, at_most)

    def read(value: Any) -> float:
        if value is UNKNOWN:
            return math.nan
        if words and isinstance(value, str) and value in words:
            return words[value]
        try:
            number = units.parse(value, kind)
        except InvalidInput as error:
            raise wrong(str(error) + _or_words(words, value)) from None
        if number < low or number > high or (above and number == low) or (below and number == high):
            raise wrong(f"{kind} out of range: given {given(value)}; allowed: {bounds}")
        return number

    return PlainValidator(read, json_schema_input_type=str | float)


def _bounds(above: str, at_least: str, below: str, at_most: str) -> str:
    parts = [("above", above), ("from", at_least), ("below", below), ("up to", at_most)]
    return " ".join(f"{word} {bound}" for word, bound in parts if bound)


def _or_words(words: Mapping[str, float] | None, value: object) -> str:
    return f", or {', '.join(words)}{suggestion(value, tuple(words))}" if words else ""


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

    return PlainValidator(read, json_schema_input_type=str)


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

    return PlainValidator(read, json_schema_input_type=int)


def _name(value: Any) -> str:
    if value is UNKNOWN:
        return ""
    if not isinstance(value, str) or _NAME.fullmatch(value) is None:
        raise wrong(
            f"not a name: given {given(value)}; allowed: a letter, then letters, digits, _, -"
        )
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


Name = Annotated[str, PlainValidator(_name, json_schema_input_type=str)]
Text = Annotated[str, PlainValidator(_text, json_schema_input_type=str)]
Flag = Annotated[bool, PlainValidator(_flag, json_schema_input_type=bool)]

Station = Annotated[float, quantity("length", at_least="-100 m", at_most="100 m")]
Length = Annotated[float, quantity("length", above="0 m", at_most="100 m")]
Diameter = Annotated[float, quantity("length", above="0.1 mm", at_most="10 m")]
Bore = Annotated[float, quantity("length", at_least="0 m", at_most="10 m")]
Growth = Annotated[float, quantity("length", at_least="-1 mm", at_most="1 mm")]
Speed = Annotated[float, quantity("speed", at_least="0 rpm", at_most="1000000 rpm")]
TopSpeed = Annotated[float, quantity("speed", above="0 rpm", at_most="1000000 rpm")]
Frequency = Annotated[float, quantity("frequency", above="0 Hz", at_most="1000 kHz")]
Mass = Annotated[float, quantity("mass", at_least="0 kg", at_most="100000 kg")]
Inertia = Annotated[float, quantity("inertia", at_least="0 kg m^2", at_most="100000 kg m^2")]
Force = Annotated[float, quantity("force", at_least="-10000 kN", at_most="10000 kN")]
Load = Annotated[float, quantity("force", above="0 N", at_most="10000 kN")]
Damping = Annotated[float, quantity("damping", at_least="0 N s/m", at_most="1e6 kN s/m")]
DampingRatio = Annotated[float, quantity("ratio", at_least="0 %", below="100 %")]
