"""Single values as files write them, and placeholders of faulty values."""

from __future__ import annotations

import math
import types
from collections.abc import Mapping
from dataclasses import is_dataclass
from functools import cache
from itertools import product
from typing import Any, get_args, get_origin

from bearings.bearing import BallBearing
from bearings.materials import Material
from rotordyn import units
from rotordyn.case.keys import keys_of
from rotordyn.errors import InvalidInput
from rotordyn.field import Refused, bare, members, metadata, optional, unwritable
from rotordyn.machine.matrix import DOFS, Matrix
from rotordyn.quantity import Choice, Limit, Named, Quantity


def is_kind(inner: Any) -> bool:
    """Whether a type is a description."""
    return isinstance(inner, type) and is_dataclass(inner)


def limit_of(annotation: Any) -> Any:
    """Limit of a value; its type if there is none."""
    return next((m for m in metadata(annotation) if isinstance(m, Limit)), bare(annotation))


def wanted(annotation: Any) -> str:
    """Short text on the values of a form."""
    limit, inner = limit_of(annotation), bare(annotation)
    if isinstance(limit, Quantity):
        return f"a {limit.kind} such as 1 {units.KINDS[limit.kind][0]}".rstrip()
    if isinstance(limit, Choice):
        return ", ".join(map(str, limit.allowed))
    if isinstance(limit, Named):
        return "a name"
    if get_origin(inner) is tuple:
        return "a list"
    return "text" if inner is str else "a mapping (key: value)"


def leaf(annotation: Any, value: object) -> Any:
    """Read a single value as written in a file; raises Refused."""
    limit = limit_of(annotation)
    if not isinstance(limit, Limit):
        return _plain(bare(annotation), value, units.shown(value))
    try:
        return limit.read(value)
    except InvalidInput as refusal:
        raise Refused(str(refusal)) from None


def _plain(inner: Any, value: object, given: str) -> Any:
    if inner is str and not isinstance(value, str):
        raise Refused(f"not text: given {given}; allowed: text, in quotes where it is a number")
    if inner is str and (why := unwritable(str(value))):
        raise Refused(why)
    if inner is bool and not isinstance(value, bool):
        raise Refused(f"not a yes or no: given {given}; allowed: true, false")
    if inner is float:
        if isinstance(value, bool) or not isinstance(value, int | float) or value != value:
            raise Refused(f"not a number: given {given}; allowed: a plain number")
        return float(value)
    return value


_UNKNOWN = {float: math.nan, str: "", int: 0, bool: False, Mapping: types.MappingProxyType({})}


def unknown(annotation: Any) -> Any:
    """Placeholder of a value whose fault is already reported."""
    if optional(annotation):
        return None
    inner = bare(members(annotation)[0])
    if any(isinstance(beside, Matrix) for beside in metadata(annotation)):
        return dict.fromkeys(product(DOFS, DOFS), math.nan)
    if is_kind(inner):
        return _nothing_known(inner)
    if get_origin(inner) is tuple:
        item = get_args(inner)[0]
        return (unknown(item),) if is_kind(bare(item)) or bare(item) is float else ()
    return _UNKNOWN.get(get_origin(inner) or inner)


def is_unknown(value: Any) -> bool:
    """Whether a value contains the placeholder of a faulty number (NaN)."""
    if isinstance(value, Material):
        return math.isnan(value.young_modulus)
    several = value if isinstance(value, tuple) else (value,)
    return any(isinstance(each, float) and math.isnan(each) for each in several)


@cache
def _nothing_known(kind: Any) -> Any:
    if issubclass(kind, BallBearing):
        return None
    made = object.__new__(kind)  # which checks nothing
    for field in keys_of(kind):
        if field.name:
            object.__setattr__(made, field.name, unknown(field.annotation))
    return made
