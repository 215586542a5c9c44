"""What a field of a description takes, read off its annotation.

The annotation says the type, and by ``Annotated`` the range, words or form of name that go with it
(``rotordyn.quantity``). Sequences become tuples and numbers of numpy plain ones.
"""

from __future__ import annotations

import math
import types
from collections.abc import Callable, Iterable, Mapping
from dataclasses import is_dataclass
from functools import cache
from numbers import Integral, Real
from typing import Annotated, Any, Union, get_args, get_origin

from rotordyn import units
from rotordyn.errors import InvalidInput
from rotordyn.quantity import Choice, Quantity, suggestion

Check = Callable[[Any], Any]


class Refused(Exception):
    """A value that a field does not take.

    ``why``, and what is allowed, in one sentence; ``place``: where in the value, as ``[2].length``.
    """

    def __init__(self, why: str, place: str = "") -> None:
        super().__init__(why)
        self.why, self.place = why, place


def accept(annotation: Any, value: object) -> Any:
    """``value`` as a field of this annotation keeps it; raises Refused."""
    return check_of(annotation)(value)


def in_si(annotation: Any, value: object) -> Any:
    """``value`` with text such as ``"8 N/um"`` read, wherever the annotation tells the unit.

    Raises Refused where the text is no such quantity.
    """
    quantity = _quantity_of(annotation)
    if isinstance(value, str) and quantity is not None:
        return _read(annotation, quantity, value)
    origin, inner = get_origin(annotation), get_args(annotation)
    if origin is tuple and inner[-1] is ... and isinstance(value, list | tuple):
        return tuple(in_si(inner[0], item) for item in value)
    if origin is Mapping and isinstance(value, Mapping):
        return {key: in_si(inner[1], item) for key, item in value.items()}
    return value


def _read(annotation: Any, quantity: Quantity, text: str) -> Any:
    try:
        return accept(annotation, text)
    except Refused:
        pass
    if text and text == quantity.infinite:
        return float("inf")
    try:
        return units.parse(text, quantity.kind)
    except InvalidInput as error:
        word = quantity.infinite
        also = f", or {word}{suggestion(text, (word,))}" if word else ""
        raise Refused(str(error) + also) from None


def _quantity_of(annotation: Any) -> Quantity | None:
    origin = get_origin(annotation)
    if origin is Annotated:
        return next((m for m in annotation.__metadata__ if isinstance(m, Quantity)), None)
    if origin in (Union, types.UnionType):
        found = (_quantity_of(member) for member in get_args(annotation))
        return next((quantity for quantity in found if quantity is not None), None)
    return None


@cache
def check_of(annotation: Any) -> Check:
    """What a field of this annotation does with a value: keeps it or raises Refused."""
    origin, inner = get_origin(annotation), get_args(annotation)
    if origin is Annotated:
        return _bounded(_number if inner[0] is float else check_of(inner[0]), inner[1:])
    if origin in (Union, types.UnionType):
        return _one_of(inner)
    if origin is tuple:
        return _row(inner)
    if origin is Mapping:
        return _mapping(check_of(inner[0]), check_of(inner[1]))
    return _PLAIN.get(annotation) or _instance(annotation)


def _bounded(check: Check, limits: tuple[Any, ...]) -> Check:
    choices = [limit for limit in limits if isinstance(limit, Choice)]

    def bounded(value: Any) -> Any:
        try:
            taken = check(value)
        except Refused as refusal:
            said = choices[0].refusal(value) if choices else ""
            raise Refused(said or refusal.why, refusal.place) from None
        for limit in limits:
            if why := limit.refusal(taken):
                raise Refused(why)
        return taken

    return bounded


def _one_of(members: tuple[Any, ...]) -> Check:
    checks = {member: check_of(member) for member in members}

    def one(value: Any) -> Any:
        about_the_value = []
        for member, check in checks.items():
            try:
                return check(value)
            except Refused as refusal:
                about_the_value += [refusal] if _fits(value, member) else []
        if about_the_value:
            raise about_the_value[0]
        raise Refused(_kind_wanted(value, " or ".join(map(_noun, members))))

    return one


def _fits(value: object, member: Any) -> bool:
    """A refusal of this member is about the value itself, not about its type."""
    bare = get_args(member)[0] if get_origin(member) is Annotated else member
    if bare is float:
        return isinstance(value, Real) and not isinstance(value, bool)
    return isinstance(bare, type) and isinstance(value, bare)


def _row(inner: tuple[Any, ...]) -> Check:
    endless = inner[-1] is ...
    checks = [check_of(member) for member in inner if member is not ...]

    def row(value: Any) -> tuple[Any, ...]:
        if isinstance(value, str | bytes | Mapping) or not isinstance(value, Iterable):
            raise Refused(_kind_wanted(value, "a tuple"))
        items = tuple(value)
        if not endless and len(items) != len(checks):
            raise Refused(f"{len(checks)} items are needed: given {len(items)}")
        return tuple(_item(checks[0 if endless else k], v, k) for k, v in enumerate(items))

    return row


def _item(check: Check, value: object, index: object) -> Any:
    try:
        return check(value)
    except Refused as refusal:
        raise Refused(refusal.why, f"[{index}]{refusal.place}") from None


def _mapping(key: Check, entry: Check) -> Check:
    def mapping(value: Any) -> dict[Any, Any]:
        if not isinstance(value, Mapping):
            raise Refused(_kind_wanted(value, "a mapping"))
        return {key(k): _item(entry, v, k) for k, v in value.items()}

    return mapping


def _number(value: Any) -> float:
    if type(value) is float and value == value:
        return value
    if isinstance(value, bool) or not isinstance(value, Real):
        raise Refused(_kind_wanted(value, "a number in SI units"))
    if value != value:
        raise Refused("not a number: given nan; allowed: a number in SI units")
    return float(value)


def _finite(value: Any) -> float:
    number = _number(value)
    if math.isinf(number):
        raise Refused(f"not finite: given {number}; allowed: a finite number in SI units")
    return number


def _whole(value: Any) -> int:
    if type(value) is int:
        return value
    if isinstance(value, bool) or not isinstance(value, Integral):
        raise Refused(_kind_wanted(value, "a whole number"))
    return int(value)


def _instance(kind: type) -> Check:
    def instance(value: Any) -> Any:
        if isinstance(value, kind):
            return value
        raise Refused(_kind_wanted(value, _noun(kind)))

    return instance


_PLAIN: dict[Any, Check] = {float: _finite, int: _whole}
_NOUNS = {str: "text", bool: "True or False", float: "a number in SI units", int: "a whole number"}


def _noun(kind: Any) -> str:
    bare = get_args(kind)[0] if get_origin(kind) is Annotated else kind
    if bare is type(None):
        return "None"
    return _NOUNS.get(bare) or str(getattr(bare, "__name__", bare))


def _kind_wanted(value: object, wanted: str) -> str:
    return f"wrong type: given {shown(value)}; allowed: {wanted}"


def shown(value: object) -> str:
    """A value as quoted in a message, cut to a readable length."""
    if is_dataclass(value) and not isinstance(value, type):
        return f"a {type(value).__name__}"
    text = " ".join(repr(value).split())
    return text if len(text) <= 40 else text[:37] + "..."
