"""What a field of a description takes, read off its annotation: one grammar for Python and files.

An annotation says the type and, by ``Annotated``, the range, words, number of items or form of name
that go with it (``rotordyn.quantity``), what files call it (``Key``), and in a plain text what it
means. Sequences become tuples and numbers of numpy plain ones; text with a unit is read where the
annotation tells the unit. A mark may say what else is written for a value (``meant``), a
description how it is read from text (``from_text``).
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
    """A value that a field does not take.

    ``why``, and what is allowed, in one sentence; ``place``: where in the value, as ``[2].length``.
    """

    def __init__(self, why: str, place: str = "") -> None:
        super().__init__(why)
        self.why, self.place = why, place


@dataclass(frozen=True, slots=True)
class Field:
    """One field of a description, or one further key of its files.

    ``name``: of the attribute, empty where there is none; ``keys``: what files and paths call it,
    one word or two, none where it is no key; ``default``: in files, ``REQUIRED`` where they must
    give it.
    """

    name: str
    keys: tuple[str, ...]
    annotation: Any
    meaning: str
    default: Any = REQUIRED
    missing: str = "it must be given"


@cache
def declared(kind: Any) -> tuple[Field, ...]:
    """Every field of a dataclass, in order; of a bearing with what it measures."""
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
    """What stands beside the type in ``Annotated``."""
    return annotation.__metadata__ if get_origin(annotation) is Annotated else ()


def bare(annotation: Any) -> Any:
    """The type without what stands beside it."""
    return get_args(annotation)[0] if get_origin(annotation) is Annotated else annotation


def found_in(annotation: Any, kind: type) -> Any:
    """What of one kind stands beside one of the forms of a type; None if nothing does."""
    for member in members(annotation):
        for each in metadata(member):
            if isinstance(each, kind):
                return each
    return None


def members(annotation: Any) -> tuple[Any, ...]:
    """The forms that a value may have, None aside; the annotation alone where it has one form.

    What stands beside a union stands beside each of its forms.
    """
    inner, beside = bare(annotation), metadata(annotation)
    if get_origin(inner) not in (Union, types.UnionType):
        return (annotation,)
    forms = (member for member in get_args(inner) if member is not type(None))
    return tuple(Annotated[(form, *beside)] if beside else form for form in forms)


def parts_of(annotation: Any, origin: Any) -> tuple[Any, ...]:
    """Arguments of that form of an annotation which is a ``tuple`` or a ``Mapping`` (``origin``);
    none where no form is."""
    forms = map(bare, members(annotation))
    return next((get_args(form) for form in forms if get_origin(form) is origin), ())


def optional(annotation: Any) -> bool:
    """None is one of the values that are taken."""
    return type(None) in get_args(bare(annotation))


def accept(annotation: Any, value: object) -> Any:
    """``value`` as a field of this annotation keeps it; raises Refused."""
    return check_of(annotation)(value)


@cache
def check_of(annotation: Any) -> Check:
    """What a field of this annotation does with a value: keeps it or raises Refused."""
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
    """A refusal of this form is about the value itself, not about its type."""
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
    """The one value of an array without axes, of numpy or xarray."""
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
    """Why a text is refused: a character in it that results have no form for; empty where there is
    none."""
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
    """A value as quoted in a message, cut to a readable length."""
    if is_dataclass(value) and not isinstance(value, type):
        return f"a {type(value).__name__}"
    return errors.shown(value, 40)


def descriptions(annotation: Any) -> Iterator[type]:
    """The dataclasses that a value may be, or hold in its items."""
    inner = bare(annotation)
    if isinstance(inner, type) and is_dataclass(inner):
        yield inner
    for part in get_args(inner):
        yield from descriptions(part)


def kinds_of(annotation: Any) -> list[type]:
    """The descriptions that a value itself may be."""
    kinds = map(bare, members(annotation))
    return [kind for kind in kinds if isinstance(kind, type) and is_dataclass(kind)]
