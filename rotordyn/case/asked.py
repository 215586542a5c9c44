"""Check the uncertainties of a case against it: hypotheses, tolerances, their faults."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, replace
from itertools import product
from math import prod
from typing import Any

from rotordyn.case.case import Case
from rotordyn.case.paths import found_at, places
from rotordyn.case.tolerance import Tolerance, tolerance
from rotordyn.case.uncertain import ALL, Uncertain
from rotordyn.case.usual import HYPOTHESES, ground_plays, usual_of
from rotordyn.case.vary import vary
from rotordyn.description import Faults, unchecked
from rotordyn.errors import InvalidInput
from rotordyn.field import Refused, accept, declared, found_in
from rotordyn.quantity import Choice, suggestion
from rotordyn.scene.conditions import Conditions
from rotordyn.units import shown

MOST_COMBINATIONS = 1024
STEP = "± 0.5 %"  # of sensitivities: 1 % in all, as in the thesis
FINEST = 1e-9  # resolution of the search for the last valid value, over the tolerance
OFF_BOUND = 0.1  # distance kept from a bound that is itself invalid, such as grooves of 0.5 D
NARROWEST = 1e-3  # least width of a reduced tolerance, over the usual one
STATIC, MOMENTLESS = "static", ("frozen", "centrifugal")


@dataclass(frozen=True, slots=True)
class Hypothesis:
    """A discrete choice: the value of the case at ``path``, and all alternatives."""

    path: str
    nominal: Any
    values: tuple[Any, ...]

    @property
    def name(self) -> str:
        """Short path: ``kinematics``, ``a.kinematics``."""
        room, _, rest = self.path.partition(".")
        inner = self.path.removeprefix("spindle.").removeprefix("bearings.")
        return rest if room == "conditions" else inner


@dataclass(frozen=True, slots=True)
class Asked:
    """Uncertainties of a case; ``steps`` and ``ranges`` of sensitivities.

    ``narrowed``: sentences on usual tolerances that were reduced to the allowed range.
    """

    hypotheses: tuple[Hypothesis, ...]
    tolerances: tuple[Tolerance, ...]
    steps: tuple[Tolerance, ...] = ()
    ranges: tuple[Tolerance, ...] = ()
    narrowed: tuple[str, ...] = ()

    @property
    def paths(self) -> tuple[str, ...]:
        """Paths of the sensitivities."""
        return tuple(each.path for each in self.steps)

    @property
    def combinations(self) -> Iterator[dict[str, Any]]:
        """Yield values by path of every combination of hypotheses, that of the case included."""
        for values in product(*(each.values for each in self.hypotheses)):
            yield dict(zip((each.path for each in self.hypotheses), values, strict=True))


def certain(case: Case) -> Case:
    """Return the case without uncertainties and variants."""
    with unchecked():
        return replace(case, variants={}, uncertain=None)


def asked_of(case: Case) -> Asked:
    """Uncertainties of ``case``; the usual ones if it states none.

    Raises
    ------
    InvalidInput : the first of ``faults_of``
    """
    for way, sentence in faults_of(case):
        raise InvalidInput(f"{'.'.join(map(str, way))}: {sentence}")
    given, case = case.uncertain or Uncertain(as_usual=True), certain(case)
    hypotheses = dict(given.hypotheses)
    tolerances = [tolerance(case, path, text) for path, text in given.tolerances.items()]
    narrowed: list[str] = []
    if given.as_usual:
        known = {_full(name) for name in hypotheses}
        hypotheses |= {path: each for path, each in HYPOTHESES.items() if path not in known}
        stated = {place for path in given.tolerances for place in _places(case, path)}
        for entry in usual_of(case):
            if not stated & _places(case, entry.path):
                usual = _usual(case, entry.path, entry.text, stated)
                tolerances += [usual] if isinstance(usual, Tolerance) else []
                narrowed += [_left(usual, entry.path, entry.text)]
    choices = (_hypothesis(case, name, values) for name, values in hypotheses.items())
    return Asked(
        tuple(each for each in choices if len(each.values) > 1 and _matters(case, each.path)),
        tuple(tolerances),
        *_differences(case, given.sensitivities),
        tuple(filter(None, narrowed)),
    )


def _usual(case: Case, path: str, text: str, stated: Set[str]) -> Tolerance | str:
    """Usual tolerance at a path, reduced to values of valid machines; a sentence if there are
    none. ``stated``: places for which the case states a tolerance."""
    try:
        usual = tolerance(case, path, text, beyond=True)
    except InvalidInput as refusal:
        return str(refusal)
    usual = replace(usual, beside=ground_plays(case, usual.ends, stated))
    if all(_made(case, usual, end) for end in (0.0, 1.0)):
        return usual
    low, high = (_farthest(case, usual, end) for end in (0.0, 1.0))
    if usual.levels or high - low < NARROWEST:
        return _refusal(case, path, text)
    return usual.within(low, high, f"{text}, as far as allowed")


def _made(case: Case, uncertain: Tolerance, share: float) -> bool:
    """Whether the machine at a share of the tolerance is valid."""
    try:
        vary(case, uncertain.at(share))
    except InvalidInput:
        return False
    return True


def _farthest(case: Case, uncertain: Tolerance, end: float) -> float:
    """Share of the tolerance towards an end up to which machines are valid, by bisection."""
    if _made(case, uncertain, end):
        return end
    inside, outside = uncertain.nominal, end
    while abs(outside - inside) > FINEST:
        middle = (inside + outside) / 2.0
        inside, outside = (middle, outside) if _made(case, uncertain, middle) else (inside, middle)
    bound = uncertain.quantity.below if end else uncertain.quantity.above
    return inside + (OFF_BOUND * (uncertain.nominal - inside) if bound else 0.0)


def _left(result: Tolerance | str, path: str, text: str) -> str:
    """Sentence on a usual tolerance that is omitted or reduced; empty if it applies."""
    if isinstance(result, str):
        return f"{path} {text} is omitted: {result.removeprefix(f'{path}: ')}"
    if result.text == text:
        return ""
    ends = ", ".join(dict.fromkeys(map(result.shown, result.ends)))
    return f"{path} {text} exceeds the allowed range: taken from {ends}"


def within_case(case: Case, sensitivities: Mapping[str, str | None]) -> Asked:
    """Sensitivities by path and range, without uncertainties.

    Raises
    ------
    InvalidInput : a path without a nonzero number, a range that is no tolerance
    """
    return Asked((), (), *_differences(case, sensitivities))


def _differences(
    case: Case, given: Mapping[str, str | None]
) -> tuple[tuple[Tolerance, ...], tuple[Tolerance, ...]]:
    steps, ranges = [], []
    for path, text in given.items():
        try:
            ranges += [tolerance(case, path, text)] if text else []
            steps.append(tolerance(case, path, STEP))
        except InvalidInput as refusal:
            raise InvalidInput(f"{path}: {refusal}") from None
    return tuple(steps), tuple(ranges)


def faults_of(case: Case) -> Faults:
    """Yield faults of the uncertainties of a case: path of keys and a sentence."""
    given = case.uncertain
    if given is None:
        return
    case = certain(case)
    yield from _hypotheses(case, given.hypotheses)
    for key in ("tolerances", "sensitivities"):
        for path, text in getattr(given, key).items():
            if why := _refusal(case, path, STEP if text is None else text):
                yield ("uncertain", key, path), why.removeprefix(f"{path}: ").replace("{", "(")
    yield from _twice(case, given.hypotheses, given.tolerances)


def _twice(case: Case, hypotheses: Mapping[str, Any], tolerances: Mapping[str, Any]) -> Faults:
    """Yield faults of values that two entries change."""
    changed_by = {place: name for name in hypotheses for place in _places(case, _full(name))}
    for path in tolerances:
        paths = _places(case, path)
        if other := next((changed_by[place] for place in sorted(paths & {*changed_by})), None):
            yield (
                ("uncertain", "tolerances", path),
                f"is varied by '{other}' too: leave one of the two out",
            )
        changed_by |= dict.fromkeys(paths, path)


def _hypotheses(case: Case, given: Mapping[str, Any]) -> Faults:
    accepted = []
    for name, values in given.items():
        try:
            accepted.append(_hypothesis(case, name, values))
        except InvalidInput as refusal:
            yield ("uncertain", "hypotheses", name), str(refusal)
    count = prod(len(each.values) for each in accepted)
    if count > MOST_COMBINATIONS:
        yield (
            ("uncertain", "hypotheses"),
            f"{count} combinations: allowed are up to {MOST_COMBINATIONS}, take fewer values",
        )


def _hypothesis(case: Case, name: str, values: Sequence[Any] | str) -> Hypothesis:
    """Build a hypothesis from a name or path, its nominal value first.

    Raises
    ------
    InvalidInput : there is no such hypothesis, or it has no such value
    """
    path = _full(name)
    fields = found_at(case, path)
    if not fields:
        known = [*_of_conditions(), "spindle.bearings.*.kinematics"]
        listed = f"allowed: {', '.join(known)}, or another dotted path"
        raise InvalidInput(f"unknown hypothesis '{name}': {listed}{suggestion(name, known)}")
    nominal, annotation = fields[0]
    choice = found_in(annotation, Choice)
    if isinstance(values, str):
        if values != ALL or choice is None:
            raise InvalidInput(f"a list of values is needed, or {ALL}: given {shown(values)}")
        values = choice.allowed
    accepted = []
    for value in values:
        try:
            accepted.append(accept(annotation, value))
        except Refused as refusal:
            raise InvalidInput(refusal.why) from None
    if len({*map(str, accepted)}) < len(accepted):
        raise InvalidInput(f"a value is given twice: {', '.join(map(str, accepted))}")
    if len({nominal, *accepted}) < 2:
        raise InvalidInput(f"at least two values are needed: given {shown(str(nominal))}")
    if nominal is None and choice is not None:
        nominal = getattr(case.conditions, path.rpartition(".")[2], None)
    return Hypothesis(path, nominal, tuple(dict.fromkeys((nominal, *accepted))))


def _full(name: str) -> str:
    return f"conditions.{name}" if name in _of_conditions() else name


def _of_conditions() -> list[str]:
    """Names of the conditions with a choice of words."""
    return [f.name for f in declared(Conditions) if found_in(f.annotation, Choice) is not None]


def _refusal(case: Case, path: str, text: str) -> str:
    """Reason why a tolerance gives no valid machine; empty if it does."""
    try:
        uncertain = tolerance(case, path, text)
        for share in (0.0, 1.0):
            vary(case, uncertain.at(share))
    except InvalidInput as refusal:
        return str(refusal)
    return ""


def _places(case: Case, path: str) -> set[str]:
    return {place for place, _, _ in places(case, path)}


def _matters(case: Case, path: str) -> bool:
    """Whether a hypothesis on ball kinematics or moment sharing affects the case."""
    name, conditions = path.rpartition(".")[2], case.conditions
    if name not in ("kinematics", "moment_sharing"):
        return True
    balls = case.bearing is not None or (case.spindle is not None and bool(case.spindle.seats))
    if not balls or conditions.bearings == STATIC or not any(case.speeds):
        return False
    return name == "kinematics" or conditions.dynamics not in MOMENTLESS


def conflicts(case: Case, variants: Mapping[str, Case]) -> Faults:
    """Yield faults of uncertain values that variants replace by another nominal value."""
    given = case.uncertain
    if given is None:
        return
    for key, paths in (("hypotheses", given.hypotheses), ("tolerances", given.tolerances)):
        for name in paths:
            path = _full(name) if key == "hypotheses" else name
            nominal = [value for value, _ in found_at(case, path)]
            for variant, other in variants.items():
                if [value for value, _ in found_at(other, path)] != nominal:
                    yield (
                        ("uncertain", key, name),
                        f"is replaced by the variant {variant}: uncertain values must be the same "
                        "in all variants; leave one of the two out",
                    )
                    break
