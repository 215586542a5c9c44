"""What frozen descriptions have in common: every field is checked when one is built."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import fields
from functools import cache
from itertools import pairwise
from typing import Any, get_type_hints

from rotordyn.errors import InvalidInput
from rotordyn.field import Check, Refused, check_of
from rotordyn.measures import measured_fields


class Description:
    """Base of every frozen description.

    Raises
    ------
    InvalidInput : a field does not take its value, or the fields contradict one another
    """

    __slots__ = ()

    def __post_init__(self) -> None:
        kind: Any = type(self)
        for name, check in _checks(kind):
            given = getattr(self, name)
            try:
                taken = check(given)
            except Refused as refusal:
                where = f"{self._called()}: {name}{refusal.place}"
                raise InvalidInput(f"{where}: {refusal.why}") from None
            if taken is not given:
                object.__setattr__(self, name, taken)
        for fault in self._faults():
            raise InvalidInput(f"{self._called()}: {fault}")

    def _faults(self) -> Iterable[str]:
        """What contradicts itself although every field is fine, a sentence each."""
        return ()

    def _called(self) -> str:
        name, kind = getattr(self, "name", ""), type(self).__name__
        return f"{kind} {name}" if isinstance(name, str) and name else kind


@cache
def declared(kind: Any) -> dict[str, Any]:
    """Annotation of every field of a dataclass, in order; of a bearing with what it measures."""
    hints = {**get_type_hints(kind, include_extras=True), **measured_fields(kind)}
    return {field.name: hints[field.name] for field in fields(kind)}


@cache
def _checks(kind: Any) -> tuple[tuple[str, Check], ...]:
    return tuple((name, check_of(hint)) for name, hint in declared(kind).items())


def doubled(names: Iterable[str]) -> Iterator[str]:
    """Names that come again; empty ones aside."""
    seen: set[str] = set()
    for name in names:
        if name and name in seen:
            yield name
        seen.add(name)


def ascending(what: str, values: Sequence[float]) -> Iterator[str]:
    """A sentence for each value that is not above the one before it."""
    for before, here in pairwise(values):
        if here <= before:
            how = "repeated" if here == before else "not in ascending order"
            yield f"{what}: {how}: given {here:.6g} after {before:.6g}"
