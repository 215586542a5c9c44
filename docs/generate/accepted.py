"""Text on the values that a key of a file accepts, from the annotation by which files are read."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import is_dataclass
from typing import Any, get_args, get_origin

from bearings.bearing import BallBearing
from bearings.materials import Material
from rotordyn.analyses.measured_response import Pair, Port
from rotordyn.case.case import ByName
from rotordyn.case.keys import Range
from rotordyn.case.schema import default_of, title
from rotordyn.field import REQUIRED, Field, bare, members, metadata
from rotordyn.machine.matrix import Matrix
from rotordyn.quantity import Choice, Named, Quantity, Sweep, Whole, Words


def accepted(annotation: Any) -> str:
    """The type, range and unit of a value in words."""
    marks = {type(beside): beside for beside in metadata(annotation)}
    if Matrix in marks:
        kind = marks[Matrix].kind
        return f"entries by name such as `yy`, `y_thz`: {kind}; or `dof` with a `matrix`"
    if ByName in marks:
        return "an analysis by its name -> its keys"
    if Pair in marks:
        return "`response` and `excitation`, each `POINT.DIRECTION`"
    forms = members(annotation)
    if len(forms) > 1:
        return ", or ".join(dict.fromkeys(map(accepted, forms)))
    ranged = f"{_link(Range)}, or " if Sweep in marks else ""
    return ranged + _of_one(forms[0])


def _of_one(annotation: Any) -> str:
    inner = bare(annotation)
    if inner is Port:
        return "`POINT.DIRECTION`"
    if isinstance(inner, type) and is_dataclass(inner):
        return _link(inner)
    if get_origin(inner) is tuple:
        return _several(inner)
    if get_origin(inner) is Mapping:
        entry = get_args(inner)[1]
        return "mapping: new values" if entry is Any else f"mapping of names to: {accepted(entry)}"
    return _single(annotation)


def default(field: Field) -> str:
    """The default as written in a file, or ``required``."""
    if field.default is REQUIRED:
        return "required"
    if isinstance(field.default, Material):
        return f"`{field.default.name.replace(' ', '_')}`"
    value = default_of(field)
    if value is None:
        return "its defaults" if is_dataclass(field.default) else "–"
    if isinstance(value, list):
        one = f"{value[0]:g}" if isinstance(value[0], float) else value[0]
        return "all" if len(value) > 1 else f"`[{one}]`"
    return f"`{str(value).lower() if isinstance(value, bool) else value}`"


def anchor(kind: type) -> str:
    """The heading's link target."""
    return title(kind).replace(" ", "-")


def _link(kind: type) -> str:
    whole = BallBearing if issubclass(kind, BallBearing) else kind
    name = "bearing" if whole is BallBearing else title(whole)
    return f"[{name}](#{name.replace(' ', '-')})"


def _several(inner: Any) -> str:
    return f"list: {accepted(get_args(inner)[0])}"


def _single(annotation: Any) -> str:
    for limit in metadata(annotation):
        if isinstance(limit, Quantity):
            word = f", or `{limit.infinite}`" if limit.infinite else ""
            return ", ".join(filter(None, (limit.kind, limit.allowed))) + word
        if isinstance(limit, Choice):
            return _choices(list(map(str, limit.allowed)))
        if isinstance(limit, Words):
            return _choices([word for word, _ in limit.values])
        if isinstance(limit, Whole):
            return f"whole number, {limit.at_least} to {limit.at_most}"
        if isinstance(limit, Named):
            return "name of a point" if limit.dotted else "name"
    return {str: "text", bool: "`true` or `false`", Any: "see meaning"}.get(
        bare(annotation), "a value with its unit"
    )


def _choices(words: list[str]) -> str:
    quoted = [f"`{word}`" for word in words]
    return quoted[0] if len(quoted) == 1 else "one of " + ", ".join(quoted)
