"""What a case says is uncertain, held against the case: hypotheses, tolerances, their faults."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, replace
from itertools import product
from math import prod
from typing import Any

from rotordyn.case.case import Case
from rotordyn.case.tolerance import Tolerance, tolerance
from rotordyn.case.uncertain import ALL, Uncertain
from rotordyn.case.usual import HYPOTHESES, ground_plays, usual_of
from rotordyn.case.varied import found_at, places
from rotordyn.case.vary import vary
from rotordyn.description import Faults, unchecked
from rotordyn.errors import InvalidInput
from rotordyn.field import Refused, accept, declared, found_in
from rotordyn.quantity import Choice, suggestion
from rotordyn.scene.conditions import Conditions
from rotordyn.units import shown

MOST_COMBINATIONS = 1024
STEP = "± 0.5 %"  # of sensitivities: 1 % in all, as in the thesis
FINEST = 1e-9  # of the way between both ends: how finely the last machine is looked for
OFF_BOUND = 0.1  # of the way to a bound that is itself not allowed, as of grooves of 0.5 D
NARROWEST = 1e-3  # of the way: what is left is no tolerance
STATIC, MOMENTLESS = "static", ("frozen", "centrifugal")


@dataclass(frozen=True, slots=True)
class Hypothesis:
    """A discrete choice: the value of the case at ``path``, and all that it may be."""

    path: str
    nominal: Any
    values: tuple[Any, ...]

    @property
    def name(self) -> str:
        """Its path without what is clear: ``kinematics``, ``a.kinematics``."""
        room, _, rest = self.path.partition(".")
        return rest if room == "conditions" else self.path.removeprefix("spindle.bearings.")


@dataclass(frozen=True, slots=True)
class Asked:
    """What is uncertain of a case; of sensitivities the ``steps`` of differences, and ranges.

    ``narrowed``: sentences on what is usual and leaves what is allowed.
    """

    hypotheses: tuple[Hypothesis, ...]
    tolerances: tuple[Tolerance, ...]
    steps: tuple[Tolerance, ...] = ()
    ranges: tuple[Tolerance, ...] = ()
    narrowed: tuple[str, ...] = ()

    @property
    def paths(self) -> tuple[str, ...]:
        """Of sensitivities."""
        return tuple(each.path for each in self.steps)

    @property
    def combinations(self) -> Iterator[dict[str, Any]]:
        """Values by path of every combination of hypotheses, that of the case among them."""
        for values in product(*(each.values for each in self.hypotheses)):
            yield dict(zip((each.path for each in self.hypotheses), values, strict=True))


def certain(case: Case) -> Case:
    """The case without what is uncertain, and without its variants."""
    with unchecked():
        return replace(case, variants={}, uncertain=None)


def asked_of(case: Case) -> Asked:
    """What ``case`` says is uncertain; what is usually so where it says nothing.

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
        held = {place for path in given.tolerances for place in _places(case, path)}
        for entry in usual_of(case):
            if not held & _places(case, entry.path):
                found = _usual(case, entry.path, entry.text, held)
                tolerances += [found] if isinstance(found, Tolerance) else []
                narrowed += [_left(found, entry.path, entry.text)]
    choices = (_hypothesis(case, name, values) for name, values in hypotheses.items())
    return Asked(
        tuple(each for each in choices if len(each.values) > 1 and _matters(case, each.path)),
        tuple(tolerances),
        *_differences(case, given.sensitivities),
        tuple(filter(None, narrowed)),
    )


def _usual(case: Case, path: str, text: str, held: Set[str]) -> Tolerance | str:
    """What is usual at a path, as far from the value of the case as is allowed; why there is no
    such machine at all. ``held``: places that the case says a tolerance of itself."""
    try:
        found = tolerance(case, path, text, beyond=True)
    except InvalidInput as refusal:
        return str(refusal)
    found = replace(found, beside=ground_plays(case, found.ends, held))
    if all(_made(case, found, end) for end in (0.0, 1.0)):
        return found
    low, high = (_farthest(case, found, end) for end in (0.0, 1.0))
    if found.levels or high - low < NARROWEST:
        return _refusal(case, path, text)
    return found.within(low, high, f"{text}, as far as allowed")


def _made(case: Case, found: Tolerance, share: float) -> bool:
    """Whether there may be a machine at a share of the way."""
    try:
        vary(case, found.at(share))
    except InvalidInput:
        return False
    return True


def _farthest(case: Case, found: Tolerance, end: float) -> float:
    """Share of the way towards an end up to which there are machines."""
    if _made(case, found, end):
        return end
    inside, outside = found.nominal, end
    while abs(outside - inside) > FINEST:
        middle = (inside + outside) / 2.0
        inside, outside = (middle, outside) if _made(case, found, middle) else (inside, middle)
    bound = found.quantity.below if end else found.quantity.above
    return inside + (OFF_BOUND * (found.nominal - inside) if bound else 0.0)


def _left(found: Tolerance | str, path: str, text: str) -> str:
    """A sentence on what is not as usual; empty where it is."""
    if isinstance(found, str):
        return f"{path} {text} is left out: {found.removeprefix(f'{path}: ')}"
    if found.text == text:
        return ""
    ends = ", ".join(dict.fromkeys(map(found.shown, found.ends)))
    return f"{path} {text} leaves what is allowed: taken from {ends}"


def within_case(case: Case, sensitivities: Mapping[str, str | None]) -> Asked:
    """Sensitivities alone, by path and range.

    Raises
    ------
    InvalidInput : a path that leads to no number that has a share, a range that is none
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
    """What is wrong with what a case says is uncertain: path of keys and a sentence."""
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
    """Numbers that two entries move."""
    moved = {place: name for name in hypotheses for place in _places(case, _full(name))}
    for path in tolerances:
        here = _places(case, path)
        if other := next((moved[place] for place in sorted(here & {*moved})), None):
            yield (
                ("uncertain", "tolerances", path),
                f"is moved by '{other}' too: one of both",
            )
        moved |= dict.fromkeys(here, path)


def _hypotheses(case: Case, given: Mapping[str, Any]) -> Faults:
    found = []
    for name, values in given.items():
        try:
            found.append(_hypothesis(case, name, values))
        except InvalidInput as refusal:
            yield ("uncertain", "hypotheses", name), str(refusal)
    count = prod(len(each.values) for each in found)
    if count > MOST_COMBINATIONS:
        yield (
            ("uncertain", "hypotheses"),
            f"{count} combinations: allowed are up to {MOST_COMBINATIONS}, take fewer values",
        )


def _hypothesis(case: Case, name: str, values: Sequence[Any] | str) -> Hypothesis:
    """A hypothesis of a name or a path, its nominal value first.

    Raises
    ------
    InvalidInput : there is no such hypothesis, or it has no such value
    """
    path = _full(name)
    found = found_at(case, path)
    if not found:
        known = [*_of_conditions(), "spindle.bearings.*.kinematics"]
        listed = f"allowed: {', '.join(known)}, or another dotted path"
        raise InvalidInput(f"unknown hypothesis '{name}': {listed}{suggestion(name, known)}")
    nominal, annotation = found[0]
    choice = found_in(annotation, Choice)
    if isinstance(values, str):
        if values != ALL or choice is None:
            raise InvalidInput(f"a list of values is needed, or {ALL}: given {shown(values)}")
        values = choice.allowed
    taken = []
    for value in values:
        try:
            taken.append(accept(annotation, value))
        except Refused as refusal:
            raise InvalidInput(refusal.why) from None
    if len({*map(str, taken)}) < len(taken):
        raise InvalidInput(f"a value is given twice: {', '.join(map(str, taken))}")
    if len({nominal, *taken}) < 2:
        raise InvalidInput(f"one value is no choice: given {shown(str(nominal))}")
    if nominal is None and choice is not None:
        nominal = getattr(case.conditions, path.rpartition(".")[2], None)
    return Hypothesis(path, nominal, tuple(dict.fromkeys((nominal, *taken))))


def _full(name: str) -> str:
    return f"conditions.{name}" if name in _of_conditions() else name


def _of_conditions() -> list[str]:
    """Names of the conditions that are a choice of words."""
    return [f.name for f in declared(Conditions) if found_in(f.annotation, Choice) is not None]


def _refusal(case: Case, path: str, text: str) -> str:
    """Why a tolerance leads to no machine that there may be; empty where it does."""
    try:
        found = tolerance(case, path, text)
        for share in (0.0, 1.0):
            vary(case, found.at(share))
    except InvalidInput as refusal:
        return str(refusal)
    return ""


def _places(case: Case, path: str) -> set[str]:
    return {place for place, _, _ in places(case, path)}


def _matters(case: Case, path: str) -> bool:
    """Whether there are balls that turn, and where moments are shared, have one."""
    name, conditions = path.rpartition(".")[2], case.conditions
    if name not in ("kinematics", "moment_sharing"):
        return True
    balls = case.bearing is not None or (case.spindle is not None and bool(case.spindle.seats))
    if not balls or conditions.bearings == STATIC or not any(case.speeds):
        return False
    return name == "kinematics" or conditions.dynamics not in MOMENTLESS


def conflicts(case: Case, variants: Mapping[str, Case]) -> Faults:
    """Uncertain values that variants replace: their range would be that of another value."""
    given = case.uncertain
    if given is None:
        return
    for key, paths in (("hypotheses", given.hypotheses), ("tolerances", given.tolerances)):
        for name in paths:
            path = _full(name) if key == "hypotheses" else name
            here = [value for value, _ in found_at(case, path)]
            for variant, other in variants.items():
                if [value for value, _ in found_at(other, path)] != here:
                    yield (
                        ("uncertain", key, name),
                        f"is replaced by the variant {variant}: what is uncertain is the same in "
                        "all variants; leave one of both out",
                    )
                    break
