"""Models that are compared: combinations of hypotheses, and phases with different unknowns."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import product
from typing import Any

from rotordyn.case.case import Case
from rotordyn.case.paths import found_at
from rotordyn.case.varied import usual_unit
from rotordyn.case.vary import vary
from rotordyn.description import quantity_of
from rotordyn.errors import InvalidInput
from rotordyn.field import shown
from rotordyn.quantity import suggestion
from rotordyn.study.identification.unknown import Sought
from rotordyn.units import parse_unit

MOST = 200


@dataclass(frozen=True, slots=True)
class Phase:
    """A phase of an identification: the ``unknowns`` sought in it, by path or name, None for all;
    fixed ``values`` by path."""

    unknowns: tuple[str, ...] | None = None
    values: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, eq=False, slots=True)
class Model:
    """A ``case``, the ``unknowns`` sought in it, and fixed values that it ``holds``, by path."""

    name: str
    case: Case
    unknowns: tuple[Sought, ...]
    holds: Mapping[str, Any] = field(default_factory=dict)


def models(
    case: Case,
    unknowns: tuple[Sought, ...],
    hypotheses: Mapping[str, Sequence[Any]],
    phases: Mapping[str, Phase],
) -> tuple[Model, ...]:
    """Models of every combination of hypotheses, in every phase.

    Raises
    ------
    InvalidInput : an invalid path or value, a name that is no unknown, too many models
    """
    for path, values in hypotheses.items():
        if isinstance(values, str) or not len(values):
            raise InvalidInput(f"{path}: a list of values is needed, got {shown(values)}")
        if twice := [value for value in values if list(values).count(value) > 1]:
            raise InvalidInput(f"{path}: {shown(twice[0])} is given twice: once is a hypothesis")
        if not found_at(case, path):
            vary(case, {path: values[0]})  # raises with the part of the path that does not exist
        if any(path in (each.path, *each.also) for each in unknowns):
            raise InvalidInput(f"{path}: is an unknown and a hypothesis: leave one of the two out")
    all_phases = phases or {"": Phase()}
    combined = [dict(zip(hypotheses, each, strict=True)) for each in product(*hypotheses.values())]
    if len(all_phases) * len(combined) > MOST:
        raise InvalidInput(f"{len(all_phases) * len(combined)} models: allowed are up to {MOST}")
    return tuple(
        _model(case, unknowns, name, phase, chosen)
        for name, phase in all_phases.items()
        for chosen in combined
    )


def _model(
    case: Case, unknowns: tuple[Sought, ...], name: str, phase: Phase, chosen: Mapping[str, Any]
) -> Model:
    known = {**{each.name: each for each in unknowns}, **{each.path: each for each in unknowns}}
    for word in phase.unknowns or ():
        if word not in known:
            names = [each.name for each in unknowns]
            raise InvalidInput(
                f"phase {name}: no unknown {shown(word)}; allowed: {', '.join(names)}"
                f"{suggestion(word, names)}"
            )
    wanted = unknowns if phase.unknowns is None else tuple(known[word] for word in phase.unknowns)
    held = {each.path for each in wanted} & {*phase.values}
    if held:
        raise InvalidInput(
            f"phase {name}: {min(held)} is both an unknown and fixed: leave one of the two out"
        )
    words = [_said(case, path, value) for path, value in chosen.items()]
    label = ", ".join(part for part in (name, *words) if part) or "the case"
    holds = {**phase.values, **chosen}
    try:
        return Model(label, vary(case, holds), wanted, holds)
    except InvalidInput as refusal:
        raise InvalidInput(f"phase {name}: {refusal}" if name else str(refusal)) from None


def _said(case: Case, path: str, value: Any) -> str:
    """Short text of a hypothesis."""
    name = path.rsplit(".", 1)[-1].replace("_", " ")
    quantity = quantity_of(found_at(case, path)[0][1])
    if quantity is None or not isinstance(value, float | int):
        return f"{name} {value}"
    if math.isinf(value):
        return f"{name} {quantity.infinite or value}"
    unit = usual_unit(quantity, [float(value)])
    scale = parse_unit(unit).scale if unit else 1.0
    return f"{name} {value / scale:.4g} {unit}".rstrip()
