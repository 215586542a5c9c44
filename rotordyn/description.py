"""Base of frozen descriptions: fields and the rules between them are checked at construction.

Rules between fields are written once, in ``_faults``: a path of keys, as in files, and a sentence
in which ``{given}`` is replaced by the value at the path as written. A description built in Python
raises the first fault; of a file all faults are reported, each with its line.
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
    """Build descriptions inside without checks; reading a file does these itself.

    This way a file with faulty values can be checked against all other rules: faulty values are
    NaN, an empty text or None, with which no comparison is true.
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
        """Yield contradictions between valid fields: path of keys and a sentence."""
        return ()

    def _last_faults(self) -> Faults:
        """Yield contradictions whose test is a computation, which needs valid fields."""
        return ()

    def _called(self) -> str:
        name, kind = getattr(self, "name", ""), type(self).__name__
        return f"{kind} {printable(name):.60}" if isinstance(name, str) and name else kind


def require(description: Description, faults: Faults) -> None:
    """Raise the first of ``faults`` of a description as InvalidInput, unless ``unchecked``."""
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
    """Fill in a sentence: ``{given}``: the value at the path as written; ``{before}``: the previous
    item; ``{given:from}``: the value under that key of the same mapping."""

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
    """Path with the names of items, value at the path, and its quantity."""
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
    """Quantity of the values of a field, also of those in a tuple or mapping."""
    within = map(quantity_of, get_args(bare(annotation)))
    return found_in(annotation, Quantity) or next(filter(None, within), None)


def repeated(key: str, names: Iterable[str], *inner: str, said: str = "repeated: given") -> Faults:
    """Yield path and sentence for each repeated name of a list; empty names do not count.

    ``inner``: keys of the name within an item.
    """
    seen: set[str] = set()
    for index, name in enumerate(names):
        if name and name in seen:
            yield (key, index, *inner), f"{said} '{name}'"
        seen.add(name)


def named_twice(key: str, items: Iterable[Any]) -> Faults:
    """Path and sentence for each item of a list with the name of an earlier one."""
    return repeated(key, (item.name for item in items), "name", said="name given twice:")


def ascending(key: str, values: Sequence[float]) -> Faults:
    """Yield path and sentence for each value of a list that does not exceed the previous one."""
    for index, (before, value) in enumerate(pairwise(values), start=1):
        if value <= before:
            how = "repeated" if value == before else "not in ascending order"
            yield (key, index), f"{how}: given {{given}} after {{before}}"


def within(path: Path, faults: Faults) -> Faults:
    """Prefix the paths of faults with ``path``."""
    for way, sentence in faults:
        yield (*path, *way), sentence


def known(value: float | None) -> bool:
    """Whether a number is given and not faulty (NaN)."""
    return value is not None and not math.isnan(value)
