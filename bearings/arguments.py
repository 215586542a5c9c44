"""Check of the arguments of public functions against their annotations, before any computation.

``float``, ``int``: one number; ``ArrayLike``, ``Array``: real numbers of any shape, NaN where there
are none; ``str``, ``bool``; a class by its name. Numbers beyond any unit are refused: their powers
would overflow.
"""

from __future__ import annotations

import inspect
import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields
from functools import cache, wraps
from itertools import chain
from numbers import Integral, Rational, Real
from typing import TYPE_CHECKING, Any, ParamSpec, TypeGuard, TypeVar

from bearings.errors import InvalidBearing, shown

if TYPE_CHECKING:
    from bearings.arrays import Array

MOST = 1e50  # SI units
P = ParamSpec("P")
R = TypeVar("R")
Check = Callable[[Any], bool]


def checked(function: Callable[P, R]) -> Callable[P, R]:
    """Make ``function`` raise InvalidBearing for arguments that its annotations exclude, whose
    shapes do not agree, or for which it has no finite value."""
    call = typed(InvalidBearing)(function)

    @wraps(function)
    def guarded(*args: P.args, **kwargs: P.kwargs) -> R:
        import numpy as np

        try:
            with np.errstate(over="raise", divide="raise", invalid="raise"):
                return call(*args, **kwargs)
        except InvalidBearing:
            raise
        except (ArithmeticError, ValueError, IndexError) as error:
            raise InvalidBearing(f"{function.__name__}: {error}: see the arguments") from error

    return guarded


def typed(
    refuse: Callable[[str], Exception], besides: Sequence[str] = ()
) -> Callable[[Callable[P, R]], Callable[P, R]]:
    """Return a decorator: the function raises ``refuse(sentence)`` for an argument that its
    annotations exclude; ``besides``: names of arguments that it checks itself."""

    def decorate(function: Callable[P, R]) -> Callable[P, R]:
        parameters = inspect.signature(function).parameters
        tests = {name: _test(str(parameter.annotation)) for name, parameter in parameters.items()}
        tests |= dict.fromkeys(besides, ("", ()))
        order = tuple(tests)

        @wraps(function)
        def call(*args: P.args, **kwargs: P.kwargs) -> R:
            for name, value in chain(zip(order, args, strict=False), kwargs.items()):
                if name in tests and (why := _refusal(value, *tests[name])):
                    raise refuse(f"{function.__name__}: {name} {why}")
            return function(*args, **kwargs)

        return call

    return decorate


def one_each(values: Any, shape: tuple[int, ...], name: str) -> Array:
    """Return values for a batch of states of a ``shape`` as an array: one each, or one for all.

    Raises InvalidBearing for other shapes.
    """
    import numpy as np

    array = np.asarray(values, float)
    try:
        fits = np.broadcast_shapes(array.shape, shape) == shape
    except ValueError:
        fits = False
    if not fits:
        states = f"a batch of shape {shape}" if shape else "a single state"
        raise InvalidBearing(
            f"{name} of shape {array.shape} does not fit {states}: give one for all, or one each"
        )
    return array


def check_fields(description: Any) -> None:
    """Raise InvalidBearing for a field of a dataclass that its annotation excludes."""
    for field in fields(description):
        if why := _refusal(getattr(description, field.name), *_test(str(field.type))):
            raise InvalidBearing(f"{type(description).__name__}: {field.name} {why}")


def _refusal(value: object, words: str, tests: Sequence[Check]) -> str:
    taken = not tests or any(test(value) for test in tests)
    return "" if taken else f"must be {words}, got {shown(value)}"


@cache
def _test(annotation: str) -> tuple[str, tuple[Check, ...]]:
    """Describe what an annotation accepts, with a test per form of it; no test if it is open."""
    forms = re.split(r" \| (?![^\[]*\])", annotation)
    entries = [_FORMS.get(form) or _class(form) for form in forms]
    if None in entries:
        return "", ()
    known = [entry for entry in entries if entry is not None]
    return " or ".join(words for words, _ in known), tuple(test for _, test in known)


def _class(form: str) -> tuple[str, Check] | None:
    """Return text and test of a mapping, of a list of instances, or of an instance of a class named
    ``form``, whose module need not be loaded."""
    if form.startswith("Mapping["):
        return "a mapping", lambda value: isinstance(value, Mapping)
    if listed := re.fullmatch(r"(?:Sequence|Iterable)\[(\w+)\]", form):
        item = _FORMS.get(listed[1]) or _class(listed[1])
        if item is None:
            return None
        return f"a list, each {item[0]}", lambda value: _listed(value) and all(map(item[1], value))
    if not re.fullmatch(r"[A-Z]\w+", form) or form == "Any":
        return None
    return f"a {form}", lambda value: any(base.__name__ == form for base in type(value).__mro__)


def _listed(value: object) -> bool:
    return isinstance(value, list | tuple | range | set | dict) or getattr(value, "ndim", 0) == 1


def finite(value: object) -> TypeGuard[float]:
    """Whether a value is a finite real number that a float can hold."""
    if isinstance(value, bool) or not isinstance(value, Real):
        return False
    try:
        return math.isfinite(value)
    except (OverflowError, ValueError):
        return False


def _number(value: Any) -> bool:
    """Whether a value is 0 or a number whose powers neither overflow nor vanish."""
    fraction = isinstance(value, Rational) and not isinstance(value, Integral)
    if fraction or not finite(value):
        return False
    return value == 0.0 or 1.0 / MOST <= abs(float(value)) <= MOST


def _flag(value: Any) -> bool:
    return isinstance(value, bool) or type(value).__name__ == "bool"


def _whole(value: Any) -> bool:
    return isinstance(value, Integral) and finite(value) and abs(value) < 2**31


def real_numbers(value: Any) -> Array | None:
    """Convert to an array of floats, NaN for None; return None for text, True or False in it."""
    import numpy as np

    try:
        array = np.asarray(value)
        if array.dtype.kind not in "fiu" or isinstance(value, list | tuple):
            for item in np.asarray(value, dtype=object).flat:
                if item is not None and (isinstance(item, bool) or not isinstance(item, Real)):
                    return None
        return array.astype(float, copy=False)
    except (TypeError, ValueError, OverflowError):
        return None


def _numbers(value: Any) -> bool:
    if type(value) is float:
        return not abs(value) > MOST or math.isinf(value)
    array = real_numbers(value)
    return array is not None and not ((abs(array) > MOST) & (abs(array) < math.inf)).any()


def _row(value: Any, absent: bool) -> bool:
    listed = isinstance(value, list | tuple) or getattr(value, "ndim", 0) == 1
    return listed and all(_number(item) or (absent and item is None) for item in value)


def _pair(value: Any) -> bool:
    return _row(value, absent=False) and len(value) == 2


_FORMS: dict[str, tuple[str, Check]] = {
    "float": ("a number", _number),
    "int": ("a whole number", _whole),
    "str": ("text", lambda value: isinstance(value, str)),
    "bool": ("True or False", _flag),
    "Progress": ("a function", callable),
    "None": ("None", lambda value: value is None),
    "ArrayLike": ("numbers", _numbers),
    "Array": ("numbers", _numbers),
    "tuple[float, float]": ("two numbers", _pair),
    "Sequence[float]": ("numbers", lambda value: _row(value, absent=False)),
    "Sequence[float | None]": ("numbers or None", lambda value: _row(value, absent=True)),
    "tuple[float, ...]": ("numbers", lambda value: _row(value, absent=False)),
    "tuple[float | None, ...]": ("numbers or None", lambda value: _row(value, absent=True)),
}
