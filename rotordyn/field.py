"""Fields of descriptions and the values they take, derived from annotations.

An annotation has the type and, by ``Annotated``, the range, words, number of items or form of name
(``rotordyn.quantity``), the key in files (``Key``), and a text with the meaning. Sequences become
tuples and numpy numbers plain ones; text with a unit is read if the annotation has a quantity. A
mark may convert other notations (``meant``), a description may be read from text (``from_text``).
"""

from __future__ import annotations

import math
import types
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import MISSING, dataclass, fields, is_dataclass
from functools import cache
from numbers import Integral, Real
from typing import Annotated, Any, Union, get_args, get_origin, get_type_hints

from bearings import errors
from rotordyn.errors import InvalidInput
from rotordyn.frozen import FrozenMapping
from rotordyn.measures import meaning_of, measured_fields
from rotordyn.quantity import Choice, Key, Quantity, Words

Check = Callable[[Any], Any]
REQUIRED: Any = type("Required", (), {"__repr__": lambda self: "REQUIRED"})()  # has no default


class Refused(Exception):
    """A field refuses a value.

    ``why``: one sentence with what is allowed; ``place``: position in the value, as ``[2].length``.
    """

    def __init__(self, why: str, place: str = "") -> None:
        super().__init__(why)
        self.why, self.place = why, place


@dataclass(frozen=True, slots=True)
class Field:
    """A field of a description, or a further key of its files.

    ``name``: of the attribute, empty for a further key; ``keys``: its one or two keys in files and
    paths, empty if it has none; ``default``: in files, ``REQUIRED`` if there is none.
    """

    name: str
    keys: tuple[str, ...]
    annotation: Any
    meaning: str
    default: Any = REQUIRED
    missing: str = "it must be given"


@cache
def declared(kind: Any) -> tuple[Field, ...]:
    """All fields of a dataclass, in order; those of a bearing with their measures."""
    hints = {**get_type_hints(kind, include_extras=True), **measured_fields(kind)}
    return tuple(_declared(field, hints[field.name]) for field in fields(kind))


def _declared(field: Any, annotation: Any) -> Field:
    marks = metadata(annotation)
    key = next((m for m in marks if isinstance(m, Key)), Key())
    default = REQUIRED if field.default is MISSING else field.default
    if field.default_factory is not MISSING:
        default = field.default_factory()
    if key.required:
        default = REQUIRED
    elif default is REQUIRED and key.default is not None:
        default = key.default
    meaning = next((m for m in marks if isinstance(m, str)), "") or meaning_of(field)
    keys = () if key.hidden else tuple((key.name or field.name).split("."))
    return Field(field.name, keys, annotation, meaning, default, key.missing)


def metadata(annotation: Any) -> tuple[Any, ...]:
    """Metadata of an ``Annotated`` type."""
    return annotation.__metadata__ if get_origin(annotation) is Annotated else ()


def bare(annotation: Any) -> Any:
    """The type without metadata."""
    return get_args(annotation)[0] if get_origin(annotation) is Annotated else annotation


def found_in(annotation: Any, kind: type) -> Any:
    """First metadata of a ``kind`` in any form of a type; None if there is none."""
    for member in members(annotation):
        for each in metadata(member):
            if isinstance(each, kind):
                return each
    return None


def members(annotation: Any) -> tuple[Any, ...]:
    """Members of a union, without None; the annotation itself if it is no union.

    Metadata of the union is repeated for each member.
    """
    inner, beside = bare(annotation), metadata(annotation)
    if get_origin(inner) not in (Union, types.UnionType):
        return (annotation,)
    forms = (member for member in get_args(inner) if member is not type(None))
    return tuple(Annotated[(form, *beside)] if beside else form for form in forms)


def parts_of(annotation: Any, origin: Any) -> tuple[Any, ...]:
    """Type arguments of that member of an annotation whose origin is ``tuple`` or ``Mapping``;
    empty if there is none."""
    forms = map(bare, members(annotation))
    return next((get_args(form) for form in forms if get_origin(form) is origin), ())


def optional(annotation: Any) -> bool:
    """Whether None is allowed."""
    return type(None) in get_args(bare(annotation))


def accept(annotation: Any, value: object) -> Any:
    """Check and convert ``value`` for a field with this annotation; raises Refused."""
    return check_of(annotation)(value)


@cache
def check_of(annotation: Any) -> Check:
    """Function that converts values for a field with this annotation, or raises Refused."""
    inner, limits = bare(annotation), [m for m in metadata(annotation) if hasattr(m, "refusal")]
    measured = inner is float and any(isinstance(limit, Quantity) for limit in limits)
    check = _number if measured else _unlimited(inner)
    return _bounded(check, limits) if limits else check


def _unlimited(annotation: Any) -> Check:
    origin, inner = get_origin(annotation), get_args(annotation)
    if origin is Annotated:
        return check_of(annotation)
    if origin in (Union, types.UnionType):
        return _one_of(inner)
    if origin is tuple:
        return _row(inner)
    if origin is Mapping:
        return _mapping(check_of(inner[0]), check_of(inner[1]))
    return _PLAIN.get(annotation) or _instance(annotation)


def _bounded(check: Check, limits: list[Any]) -> Check:
    choices = [limit for limit in limits if isinstance(limit, Choice | Words)]
    spoken = [limit for limit in limits if isinstance(limit, Quantity | Words)]
    written = [limit for limit in limits if hasattr(limit, "meant")]

    def bounded(value: Any) -> Any:
        try:
            meant = spoken[0].read(value) if spoken and isinstance(value, str) else value
            taken = check(written[0].meant(meant) if written else meant)
        except InvalidInput as refusal:
            raise Refused(str(refusal)) from None
        except Refused as refusal:
            words = choices[0].refusal(value) if choices else ""
            raise Refused(words or refusal.why, refusal.place) from None
        for limit in limits:
            if why := limit.refusal(taken):
                raise Refused(why)
        return taken

    return bounded


def _one_of(forms: tuple[Any, ...]) -> Check:
    checks = {form: check_of(form) for form in forms}

    def one(value: Any) -> Any:
        about_the_value = []
        for form, check in checks.items():
            try:
                return check(value)
            except Refused as refusal:
                about_the_value += [refusal] if _fits(value, form) else []
        if about_the_value:
            raise about_the_value[-1] if isinstance(value, str) else about_the_value[0]
        raise Refused(_kind_wanted(value, " or ".join(map(_noun, checks))))

    return one


def _fits(value: object, form: Any) -> bool:
    """Whether a value has the type of a form, so that its refusal concerns the value."""
    inner = bare(form)
    if inner is float:
        measured = isinstance(value, str) and any(c.isdigit() for c in value)
        return measured or (isinstance(value, Real) and not isinstance(value, bool))
    if get_origin(inner) is tuple:
        return isinstance(value, list | tuple)
    return isinstance(inner, type) and isinstance(value, inner)


def _row(inner: tuple[Any, ...]) -> Check:
    endless = inner[-1] is ...
    checks = [check_of(member) for member in inner if member is not ...]

    def row(value: Any) -> tuple[Any, ...]:
        scalar = getattr(value, "ndim", 1) == 0  # of numpy, which calls it iterable
        if isinstance(value, Mapping):
            raise Refused(_kind_wanted(value, "values one by one, as a list or tuple"))
        if scalar or isinstance(value, str | bytes) or not isinstance(value, Iterable):
            raise Refused(_kind_wanted(value, "a list or tuple"))
        items = tuple(value)
        if not endless and len(items) != len(checks):
            raise Refused(f"{len(checks)} items are needed: given {len(items)}")
        return tuple(
            _item(checks[0 if endless else k], v, f".{k + 1}") for k, v in enumerate(items)
        )

    return row


def _item(check: Check, value: object, place: str) -> Any:
    try:
        return check(value)
    except Refused as refusal:
        raise Refused(refusal.why, f"{place}{refusal.place}") from None


def _mapping(key: Check, entry: Check) -> Check:
    def mapping(value: Any) -> FrozenMapping:
        if not isinstance(value, Mapping):
            raise Refused(_kind_wanted(value, "a mapping"))
        return FrozenMapping((key(k), _item(entry, v, f"[{k}]")) for k, v in value.items())

    return mapping


def _number(value: Any) -> float:
    if type(value) is float and value == value:
        return value
    value = _alone(value)
    if isinstance(value, bool) or not isinstance(value, Real):
        raise Refused(_kind_wanted(value, "a number in SI units"))
    if value != value:
        raise Refused("not a number: given nan; allowed: a number in SI units")
    try:
        return float(value)
    except OverflowError:
        raise Refused(f"too large: given {shown(value)}; allowed: up to 1e308") from None


def _alone(value: Any) -> Any:
    """Plain value of a numpy or xarray scalar; other values unchanged."""
    return value.item() if getattr(value, "ndim", None) == 0 else value


def _finite(value: Any) -> float:
    number = _number(value)
    if math.isinf(number):
        raise Refused(f"not finite: given {number}; allowed: a finite number in SI units")
    return number


def _whole(value: Any) -> int:
    if type(value) is int:
        return value
    value = _alone(value)
    if isinstance(value, bool) or not isinstance(value, Integral):
        raise Refused(_kind_wanted(value, "a whole number"))
    return int(value)


def unwritable(text: str) -> str:
    """Reason why a text is refused: a character that files cannot store; empty if there is none."""
    letter = next((each for each in text if each == "\0" or "\ud800" <= each <= "\udfff"), "")
    if not letter:
        return ""
    return f"given {shown(text)} with the character U+{ord(letter):04X}; allowed: text without it"


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise Refused(_kind_wanted(value, _NOUNS[str]))
    if why := unwritable(value):
        raise Refused(why)
    return value


def _instance(kind: type) -> Check:
    read = getattr(kind, "from_text", None)

    def instance(value: Any) -> Any:
        if isinstance(value, kind):
            return value
        if read is not None and isinstance(value, str):
            try:
                return read(value)
            except InvalidInput as refusal:
                raise Refused(str(refusal)) from None
        raise Refused(_kind_wanted(value, _noun(kind)))

    return instance


_PLAIN: dict[Any, Check] = {float: _finite, int: _whole, str: _text, Any: lambda value: value}
_NOUNS = {str: "text", bool: "True or False", float: "a number in SI units", int: "a whole number"}


def _noun(form: Any) -> str:
    kind = bare(form)
    if kind is type(None):
        return "None"
    if choice := next((m for m in metadata(form) if isinstance(m, Choice)), None):
        return " or ".join(map(repr, choice.allowed))
    return _NOUNS.get(kind) or str(getattr(kind, "__name__", kind))


def _kind_wanted(value: object, wanted: str) -> str:
    return f"wrong type: given {shown(value)}; allowed: {wanted}"


def shown(value: object) -> str:
    """Text of a value for messages, limited in length."""
    if is_dataclass(value) and not isinstance(value, type):
        return f"a {type(value).__name__}"
    return errors.shown(value, 40)


def descriptions(annotation: Any) -> Iterator[type]:
    """Yield the dataclasses of a value or of its items."""
    inner = bare(annotation)
    if isinstance(inner, type) and is_dataclass(inner):
        yield inner
    for part in get_args(inner):
        yield from descriptions(part)


def kinds_of(annotation: Any) -> list[type]:
    """Descriptions that the value itself may be."""
    kinds = map(bare, members(annotation))
    return [kind for kind in kinds if isinstance(kind, type) and is_dataclass(kind)]
