"""A value at a path, on its way to the field that takes it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

from rotordyn.case.varied import Steps
from rotordyn.errors import InvalidInput
from rotordyn.field import Refused, accept, declared

WRITTEN = (str, int, float, Mapping, list, tuple)  # what a file may hold


@dataclass(frozen=True, slots=True)
class Change:
    """A new value, the whole path to it as given, and the remaining ``steps`` of the path."""

    value: object
    path: str
    steps: Steps

    def inside(self, count: int) -> Change:
        """The change without the first steps, which lead to what it is within."""
        return Change(self.value, self.path, self.steps[count:])

    def refused(self, why: str, place: str = "") -> InvalidInput:
        return InvalidInput(f"{self.path}{place}: {why}")


def value_of(annotation: Any, value: object) -> Any:
    """Convert a value: an object or number in SI units, or as files write it; raises Refused."""
    try:
        return accept(annotation, value)
    except Refused:
        listed = value if isinstance(value, list | tuple) else [value]
        if not all(each is None or isinstance(each, WRITTEN) for each in listed):
            raise
    from rotordyn.case.forms import in_python  # reads YAML, which vary seldom needs

    return in_python(annotation, value)


def taken(annotation: Any, change: Change) -> Any:
    try:
        return value_of(annotation, change.value)
    except Refused as refusal:
        raise change.refused(refusal.why, refusal.place) from None


def way_to(change: Change) -> str:
    """The part of the path up to the current value."""
    return change.path.removesuffix(".".join(change.steps)).rstrip(".")


@cache
def ways_of(kind: Any) -> dict[Steps, str]:
    """Fields of a description by the steps that lead to them."""
    fields = declared(kind)
    ways = {(field.name,): field.name for field in fields if not field.keys}
    return ways | {field.keys: field.name for field in fields if field.keys}
