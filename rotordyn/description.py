"""What frozen descriptions have in common: fields and the rules between them, checked when one is
built.

Rules between fields are written once, in ``_faults``: a path of keys, as files write them, and a
sentence, in which ``{given}`` stands for what is at the path as it was written. A description built
in Python raises the first of them; of a file all are reported, each with its line.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import is_dataclass
from functools import cache, partial
from itertools import pairwise
from typing import Any, get_args

from rotordyn.errors import InvalidInput, printable
from rotordyn.field import Check, Refused, bare, check_of, declared, found_in, parts_of, shown
from rotordyn.frozen import frozen
from rotordyn.quantity import Quantity

Path = tuple[str | int, ...]
Faults = Iterable[tuple[Path, str]]

_PLACES = re.compile(r"\{(given|before)(?::(\w+))?\}")
_checked: ContextVar[bool] = ContextVar("checked", default=True)


@contextmanager
def unchecked() -> Iterator[None]:
    """Descriptions built within are not checked: their fields are, and their rules will be.

    So a file of which some values are faulty can be held against all other rules: what is not known
    is NaN, an empty word or None, on which no comparison takes hold.
    """
    token = _checked.set(False)
    try:
        yield
    finally:
        _checked.reset(token)


class Description:
    """Base of every frozen description.

    Raises
    ------
    InvalidInput : a field does not take its value, or the fields contradict one another
    """

    __slots__ = ()

    def __post_init__(self) -> None:
        kind: Any = type(self)
        if not _checked.get():
            for name in _mappings(kind):
                object.__setattr__(self, name, frozen(getattr(self, name)))
            return
        for name, check in _checks(kind):
            given = getattr(self, name)
            try:
                taken = check(given)
            except Refused as refusal:
                where = f"{self._called()}: {name}{refusal.place}"
                raise InvalidInput(f"{where}: {refusal.why}") from None
            if taken is not given:
                object.__setattr__(self, name, taken)
        require(self, self._faults())
        require(self, self._last_faults())

    def _faults(self) -> Faults:
        """What contradicts itself although every field is fine: path of keys and a sentence."""
        return ()

    def _last_faults(self) -> Faults:
        """The same, where it takes a computation and all else must be right."""
        return ()

    def _called(self) -> str:
        name, kind = getattr(self, "name", ""), type(self).__name__
        return f"{kind} {printable(name):.60}" if isinstance(name, str) and name else kind


def require(description: Description, faults: Faults) -> None:
    """Raises the first of ``faults`` of a description as InvalidInput; nothing while unchecked."""
    for path, sentence in faults if _checked.get() else ():
        where = _walked(description, path)[0]
        words = filled(sentence, path, partial(_written, description))
        raise InvalidInput(": ".join(filter(None, (description._called(), where, words))))


@cache
def _checks(kind: Any) -> tuple[tuple[str, Check], ...]:
    return tuple((field.name, check_of(field.annotation)) for field in declared(kind))


@cache
def _mappings(kind: Any) -> tuple[str, ...]:
    return tuple(f.name for f in declared(kind) if parts_of(f.annotation, Mapping))


def filled(sentence: str, path: Path, written: Callable[[Path], str]) -> str:
    """``{given}``: the value at the path as it was written; ``{before}``: the item before it;
    ``{given:from}``: what stands beside it under that key."""

    def value(match: re.Match[str]) -> str:
        last = path[-1] if path else ""
        if match[1] == "before" and isinstance(last, int):
            return written((*path[:-1], last - 1))
        return written((*path[:-1], match[2]) if match[2] else path)

    return _PLACES.sub(value, sentence)


def _written(holder: object, path: Path) -> str:
    _, value, quantity = _walked(holder, path)
    return quantity.written(value) if quantity and isinstance(value, float) else shown(value)


def _walked(holder: Any, path: Path) -> tuple[str, Any, Quantity | None]:
    """The path with items called by their names, the value there, and its quantity."""
    words: list[str] = []
    value, annotation, within = holder, None, ""
    for step in path:
        if isinstance(step, int):
            value = value[step] if isinstance(value, Sequence) and step < len(value) else None
            name = getattr(value, "name", "")
            words[-1:] = [*words[-1:], name] if name else [f"{words[-1]}.{step + 1}"]
            continue
        words.append(step)
        if isinstance(value, Mapping):
            value = value.get(step)
        elif is_dataclass(value):
            keys = (within, step) if within else (step,)
            kind: Any = type(value)
            field = next((f for f in declared(kind) if f.keys == keys), None)
            within = step if field is None else ""
            if field is not None:
                value, annotation = getattr(value, field.name), field.annotation
    return ".".join(words), value, quantity_of(annotation)


def quantity_of(annotation: Any) -> Quantity | None:
    """The quantity that the values of a field are, also where they stand in a row or mapping."""
    within = map(quantity_of, get_args(bare(annotation)))
    return found_in(annotation, Quantity) or next(filter(None, within), None)


def repeated(key: str, names: Iterable[str], *inner: str, said: str = "repeated: given") -> Faults:
    """Path and sentence for each name of a list that came before; empty ones aside.

    ``inner``: where in each item they stand.
    """
    seen: set[str] = set()
    for index, name in enumerate(names):
        if name and name in seen:
            yield (key, index, *inner), f"{said} '{name}'"
        seen.add(name)


def named_twice(key: str, items: Iterable[Any]) -> Faults:
    """Path and sentence for each item of a list that bears the name of an earlier one."""
    return repeated(key, (item.name for item in items), "name", said="name given twice:")


def ascending(key: str, values: Sequence[float]) -> Faults:
    """Path and sentence for each value of a list that is not above the one before it."""
    for index, (before, here) in enumerate(pairwise(values), start=1):
        if here <= before:
            how = "repeated" if here == before else "not in ascending order"
            yield (key, index), f"{how}: given {{given}} after {{before}}"


def within(path: Path, faults: Faults) -> Faults:
    """The same faults of what stands at ``path``."""
    for way, sentence in faults:
        yield (*path, *way), sentence


def known(value: float | None) -> bool:
    """A number whose fault is not reported already."""
    return value is not None and not math.isnan(value)
