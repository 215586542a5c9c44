"""Optima: closed forms and brute force met, limits kept, honest where nothing keeps them."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq, minimize

import rotordyn
from rotordyn import Goal, Limit, Span, model, optimise
from rotordyn.analyses.headline import headline_numbers
from rotordyn.case.case import Case
from rotordyn.case.paths import found_at
from rotordyn.case.varied import unlike
from rotordyn.case.vary import vary
from rotordyn.cli import main
from rotordyn.errors import InvalidInput
from rotordyn.job.solving import restricted
from rotordyn.results.headline import Number
from rotordyn.study.neighbours import Neighbours
from rotordyn.study.optimum import criterion, search, trials
from rotordyn.study.optimum.criterion import Criterion, Reading, _alike, _places, amount
from rotordyn.study.optimum.deliver import _write_best
from rotordyn.study.optimum.figures import figures
from rotordyn.study.optimum.problem import Problem, Trial, as_it_stands
from rotordyn.study.optimum.solve import UNSETTLED, Optimum, problem_of
from rotordyn.study.optimum.summary import summary
from rotordyn.study.parameter import parameters

SPRING = "spindle.sleeves.rear.spring.preload"
MIDDLE = "spindle.shaft.sections.middle.outer_diameter"
MODEL = "spindle.bearings.*.model"
STIFF = Goal(highest="stiffness.tangent", where={"variant": "nonlinear"})

# A spindle on two springs with an overhang: the span of least deflection is known.
OVERHANG, INNER, OUTER, FRONT, REAR = 0.12, 0.0, 0.08, 250e6, 120e6
SPAN_CASE = """
title: span of two springs
spindle:
  shaft:
    start: 0 mm
    shear_coefficient: none
    material: {{name: steel, young_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3}}
    sections: [{{name: all, length: 1.2 m, outer_diameter: {outer} m}}]
  supports:
    - {{name: front, x: {overhang} m, stiffness: {{yy: {front} N/m, zz: {front} N/m}}}}
    - {{name: rear, x: 0.5 m, stiffness: {{yy: {rear} N/m, zz: {rear} N/m}}}}
  points: {{nose: 0 m}}
speeds: [0 rpm]
analyses:
  frf:
    frequencies: [0.1 Hz]
    pairs: [{{response: nose.y, excitation: nose.y}}]
"""


@pytest.fixture(scope="module")
def case() -> Case:
    whole = rotordyn.load("grinding_spindle")
    return rotordyn.vary(whole, {"speeds": (0.0, 400.0 * math.pi)})


def test_a_trial_whose_answer_ends_early_has_none(
    case: Case, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A machine whose temperatures run away on the way is not that of the lowest peak of load."""
    problem = Problem(case, (), (Goal(lowest="warm_up: load"),), ())
    ended = SimpleNamespace(outcome=("", ""), ending=("", "temperatures run away"))
    answers = SimpleNamespace(results={"warm_up": ended}, warnings=())
    monkeypatch.setattr(Neighbours, "solve", lambda self, case: (answers, None))
    monkeypatch.setattr(Criterion, "read", lambda *_: Reading(np.array([5.0]), "N", ("a",), (1.0,)))
    monkeypatch.setattr("rotordyn.study.optimum.problem.result_warnings", lambda _: ())
    found = as_it_stands(problem)
    assert found.sentence == "temperatures run away"
    assert not found.feasible


def test_span_of_least_deflection(tmp_path: Path) -> None:
    """An overhung beam on two springs: δ/F = a³/3EI + a²L/3EI + (1 + a/L)²/k₁ + (a/L)²/k₂."""
    path = tmp_path / "span.yaml"
    how = dict(outer=OUTER, overhang=OVERHANG, front=FRONT, rear=REAR)
    path.write_text(SPAN_CASE.format(**how), encoding="utf-8")
    case = rotordyn.load(path)
    bending, a = 210e9 * math.pi * OUTER**4 / 64.0, OVERHANG

    def slope(span: float) -> float:
        springs = 2.0 * a / span**2 * ((1.0 + a / span) / FRONT + a / span / REAR)
        return a * a / (3.0 * bending) - springs

    best = brentq(slope, 0.01, 5.0)
    springs = (1.0 + a / best) ** 2 / FRONT + (a / best) ** 2 / REAR
    stiffness = 1.0 / (a * a * (a + best) / (3.0 * bending) + springs)
    found = optimise(
        case,
        {"spindle.supports.rear.x": Span("150 mm", "1.1 m")},
        [Goal(lowest="frf.receptance", where={"frequency": "0.1 Hz"})],
        trials=80,
        workers=1,
    )
    assert found.best is not None
    assert found.best.goals[0] == pytest.approx(1e6 / stiffness, rel=1e-4)  # µm/N
    assert found.values["spindle.supports.rear.x"] - a == pytest.approx(best, rel=0.02)
    assert found.binding == []
    (line,) = (line for line in summary(found).splitlines() if "frf.receptance" in line)
    assert line.split()[-1] == f"{found.best.goals[0]:.3g}"


@pytest.fixture(scope="module")
def overhung(tmp_path_factory: pytest.TempPathFactory) -> tuple[Case, Any]:
    """Case and results of the two springs, with a moment beside the force."""
    path = tmp_path_factory.mktemp("span") / "span.yaml"
    text = SPAN_CASE.format(outer=OUTER, overhang=OVERHANG, front=FRONT, rear=REAR)
    pairs = "{response: nose.y, excitation: nose.y}"
    text = text.replace(pairs, f"{pairs}, {{response: nose.thz, excitation: nose.thz}}")
    path.write_text(text, encoding="utf-8")
    case = rotordyn.load(path)
    return case, Neighbours().solve(case)[0].results


@pytest.mark.parametrize("of", ["frf.receptance", "frf.peak_value"])
def test_a_limit_on_a_response_takes_units_of_its_pair(of: str, overhung: Any) -> None:
    """Any of a displacement over a force, and a number in SI; rotations have another."""
    case, results = overhung
    size = 2e-7
    for pair, (unit, factor), texts in (
        ("nose.y / nose.y", ("µm/N", 1e6), ("2e-7 m/N", "2e-4 mm/N", "0.2 um/N", "0.2 µm/N", size)),
        (
            "nose.thz*",
            ("rad/(N·m)", 1.0),
            ("2e-7 rad/(N·m)", "2e-7 rad/N/m", "2e-4 mrad/(N m)", size),
        ),
    ):
        reading = Criterion(of, {"pair": pair}).read(case, results)
        assert reading.unit == unit
        if of == "frf.receptance":
            value = np.abs(results["frf"].receptance[0, 0 if "y" in pair else 1, 0])
            assert reading.values == pytest.approx([value * factor])
        for given in texts:
            assert amount(given, reading.unit) == pytest.approx(size * factor, rel=1e-12)
            assert Limit(of, at_most=given).margin(Reading(np.array([0.0]), unit))[0] == 1.0
        with pytest.raises(
            InvalidInput, match=rf"limit of '{of}': expected a number in {unit[:3]}"
        ):
            Limit(of, at_most="1 N").margin(reading)


def test_responses_of_several_units_are_not_compared(overhung: Any) -> None:
    with pytest.raises(
        InvalidInput, match=r"several units, µm/N, rad/\(N·m\): choose by where: {pair"
    ):
        Criterion("frf.receptance").read(*overhung)


@pytest.mark.parametrize("of", ["frf.measured_response", "frf.measured_peak_amplitude"])
def test_measured_responses_that_a_case_lacks_are_absent(of: str, overhung: Any) -> None:
    reading = Criterion(of).read(*overhung)
    assert not reading.values.size


def test_a_machine_unstable_at_every_speed_breaks_a_limit_on_the_threshold() -> None:
    """The lowest speed bounds the threshold; a stable machine has none and keeps the limit."""
    whole = rotordyn.load("friswell_internal_damping").variants["viscous"]
    limit = Limit("campbell: unstable from", at_least="3900 rpm", absent=True)
    for rpm, kept in (((3000.0, 3500.0), False), ((100.0, 200.0), True)):
        case = replace(whole, variants={}, speeds=tuple(n * math.pi / 30.0 for n in rpm))
        reading = limit.criterion.read(case, Neighbours().solve(case)[0].results)
        assert (reading.values.tolist() == []) == kept
        assert (limit.margin(reading)[0] > 0.0) == kept


def test_an_analysis_without_headline_numbers_names_its_variables(overhung: Any) -> None:
    with pytest.raises(InvalidInput, match=r"no headline numbers; allowed: .*, frf\.receptance$"):
        Criterion("frf: receptance").read(*overhung)
    with pytest.raises(InvalidInput, match=r"allowed: its variables, frf\.unstable, .*receptance$"):
        Criterion("frf: amplitude").read(*overhung)


def test_a_machine_without_critical_speed_keeps_a_limit_that_says_so(tmp_path: Path) -> None:
    """The unchanged case has none, nor the stiffest of the choices; a limit that does not say
    so leaves the one that has."""
    path = tmp_path / "span.yaml"
    text = SPAN_CASE.format(outer=OUTER, overhang=OVERHANG, front=FRONT, rear=REAR)
    text = text.replace("speeds: [0 rpm]", "speeds: [0 rpm, 4000 rpm]")
    text = text.replace("analyses:\n", "analyses:\n  campbell: {max_frequency: 400 Hz}\n")
    path.write_text(text, encoding="utf-8")
    case, outer = rotordyn.load(path), "spindle.shaft.sections.all.outer_diameter"
    for of, where, bound in (
        ("campbell: critical 1× bending", {}, {"outside": ("3000 rpm", "4000 rpm")}),
        ("campbell.frequency", {"mode": "bending 2*"}, {"at_least": "90 Hz"}),
    ):
        for absent, best in ((True, 0.08), (False, 0.04)):
            found = optimise(
                case,
                {outer: ["40 mm", "80 mm"]},
                [Goal(lowest="frf.receptance", where={"frequency": "0.1 Hz"})],
                [Limit(of, where=where, absent=absent, **bound)],
                workers=1,
            )
            assert found.best is not None
            assert found.values[outer] == best
            assert not any(each.sentence for each in found.trials)


def test_a_headline_number_is_that_at_the_worst_speed() -> None:
    """Least where the stop is met, between the ends of the speeds; a table has the ends alone."""
    found = rotordyn.load("mfw2310").vary({"speeds": [f"{r} rpm" for r in (0, 18000, 24000)]})
    one = restricted(found, ("stiffness", "campbell"))
    results = Neighbours().solve(one)[0].results
    for words, variable, where in (
        ("stiffness: full", "stiffness.tangent", {"variant": "full"}),
        ("campbell: bending pair 2 forward", "campbell.frequency", {"mode": "bending 2 forward"}),
    ):
        asked = Criterion(words), Criterion(variable, where)
        number, values = (each.read(one, results) for each in asked)
        assert sorted(number.values) == pytest.approx(sorted(values.values))
        assert number.values.argmin() == 1
    heads = [each.heading for _, each in headline_numbers(one, results)]
    assert "full at 24000 rpm [N/µm]" in heads
    assert not [head for head in heads if "18000" in head]


def test_what_no_machine_has_is_refused(case: Case) -> None:
    results = Neighbours().solve(restricted(case, ("campbell",)))[0].results
    for of, mode in (
        ("campbell: critcal", ""),
        ("campbell: critical 7×", ""),
        ("campbell: critical 1× bendng", ""),
        ("campbell: bending 0", ""),
        ("campbell.frequency", "bendng 1*"),
        ("campbell.frequency", "bending 1 sideways"),
    ):
        with pytest.raises(InvalidInput, match=r"no such number|no mode"):
            Criterion(of, {"mode": mode} if mode else {}).read(case, results)


@pytest.mark.long
def test_brute_force_is_not_better(case: Case) -> None:
    """Continuous and listed choices with an active limit, against every point of a grid."""
    choices = {SPRING: Span("400 N", "2400 N"), MODEL: ["vex70", "kh6014e"]}
    limits = [Limit("preload: sum", at_most="1900 N")]
    goal = Goal(highest="preload.axial_load")
    found = optimise(case, choices, [goal], limits, trials=50, workers=1)
    grid = rotordyn.sweep(
        case,
        {**choices, SPRING: Span("400 N", "2400 N", 17)},
        analyses=["preload"],
        results=["preload"],
        workers=1,
    )
    kept = (grid["preload: sum at 0 rpm"] <= 1900.0) & (grid["preload: sum at 12000 rpm"] <= 1900.0)
    worst = grid["preload: axial_load"].min(("preload: speed", "preload: bearing"))
    assert found.best is not None
    assert found.best.feasible
    assert found.best.goals[0] >= 0.999 * float(worst.where(kept).max())
    assert found.binding == ["preload: sum at most 1900 N"]
    assert len(found.trials) <= 50
    alone = rotordyn.run(found.case)["preload"]["axial_load"]
    assert float(alone.min()) == pytest.approx(found.best.goals[0], rel=1e-12)


def test_few_choices_are_all_tried(case: Case) -> None:
    choices = {MODEL: ["vex70", "s6014e", "kh6014e"], SPRING: ["800 N", "1600 N"]}
    goals = [Goal(lowest="preload.spring_force"), Goal(highest="preload: sum")]
    found = optimise(case, choices, goals, trials=8, workers=1)
    assert len(found.trials) == 6
    assert found.values[SPRING] == 800.0
    assert found.dataset().sizes["trial"] == 6


def test_all_trials_of_whole_numbers_are_spent(case: Case, monkeypatch: pytest.MonkeyPatch) -> None:
    """25 of 33 machines, no two alike; the best is at an end of both."""

    def tried(packed: bytes, place: tuple[float, ...], _: int = 1) -> Trial:
        return Trial(place, goals=(place[0] + 3.0 * place[1],), units=("N",))

    monkeypatch.setattr(trials, "solve_trial", tried)
    varied = {"spindle.bearings.*.model.balls": Span(15, 25), SPRING: ["500 N", "900 N", "1300 N"]}
    goal = Goal(lowest="preload.spring_force")
    for seed in range(3):
        found = optimise(case, varied, [goal], trials=25, seed=seed, workers=1)
        assert len({each.number for each in found.trials}) == 25
        assert found.best is not None
        assert found.best.number == (0.0, 0.0)


class _Machine:
    """Of random but smooth laws: what is gained and what it costs, in shares of two to four spans,
    and a limit on them that cuts some of it off."""

    def __init__(self, seed: int) -> None:
        draw = np.random.default_rng(seed)
        self.size = int(draw.integers(2, 5))
        self.best, self.bent, self.gain = draw.uniform([[0.2], [0.4], [0.2]], 1.0, (3, self.size))
        self.cost, self.power, self.load = draw.uniform(0.3, 1.5, (3, self.size))

    def __call__(self, share: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        gained = 2.0 + (self.gain * (1.0 - self.bent * (share - self.best) ** 2)).sum(axis=-1)
        cost = 1.0 + (self.cost * share**self.power).sum(axis=-1) + 0.2 * share.prod(axis=-1)
        return gained, cost, 1.0 - (self.load * share).sum(axis=-1) / (0.6 * self.load.sum())

    def most(self) -> float:
        """What can be gained within the limit."""
        found = minimize(
            lambda x: -float(self(x)[0]),
            np.full(self.size, 0.3),
            method="SLSQP",
            bounds=[(0.0, 1.0)] * self.size,
            constraints={"type": "ineq", "fun": lambda x: float(self(x)[2])},
        )
        assert found.success
        return -float(found.fun)

    def tried(self, packed: bytes, place: tuple[float, ...], _: int = 1) -> Trial:
        """In place of ``solve_trial``."""
        gained, cost, room = (float(v) for v in self(np.array(place)))
        return Trial(place, (gained, cost), (room,), (0.0,), ("N/um", "N", "N"))


PATHS = (
    "spindle.sleeves.rear.spring.preload",
    "spindle.sleeves.rear.spring.stiffness",
    "spindle.shaft.sections.middle.outer_diameter",
    "spindle.bearings.*.model.ball_diameter",
)


@pytest.mark.parametrize("seed", range(8))
def test_ends_of_a_trade_off_are_the_best_of_each_goal(
    case: Case, monkeypatch: pytest.MonkeyPatch, seed: int
) -> None:
    """Within 1 % by 25 trials a span, and with machines all the way between; with 20 in all it is
    said that more may go further."""
    machine = _Machine(seed)
    monkeypatch.setattr(trials, "solve_trial", machine.tried)
    spans = [Span("1 kN", "2 kN"), Span(10e6, 30e6), Span("74 mm", "84 mm"), Span(0.009, 0.011)]
    varied = dict(zip(PATHS[: machine.size], spans, strict=False))
    goals = [Goal(highest="preload.axial_load"), Goal(lowest="preload: sum")]
    limits = [Limit("preload: sum", at_most="90 kN")]
    found = optimise(case, varied, goals, limits, trials=25 * machine.size, workers=1)
    assert re.search(r"spring.preload [\d.]+ kN,", " ".join(summary(found).split()))
    front = np.array([each.goals for each in found.front])
    assert front[0, 0] > 0.99 * machine.most()
    assert front[-1, 1] < 1.01  # nothing spent: 1 N
    ways = np.diff(front, axis=0) / np.ptp(front, axis=0)
    assert np.abs(ways).max() < 0.5
    few = optimise(case, varied, goals[:1], limits, trials=20, workers=1)
    assert few.verdict[-1] == UNSETTLED
    for each in few.trials:
        assert each.goals[0] <= machine.most() * (1.0 + 1e-6) or not each.feasible
    enough = optimise(case, varied, goals[:1], limits, trials=60 * machine.size, workers=1)
    assert UNSETTLED not in enough.verdict
    assert enough.best is not None
    assert enough.best.goals[0] > 0.9999 * machine.most()


def test_the_unchanged_case_is_tried_first_or_said_to_be_better(case: Case) -> None:
    """A limit that it just keeps, which few trials would not find."""
    start = as_it_stands(Problem(case, (), (STIFF,), (Limit("preload: sum", at_most="90 kN"),)))
    limit = Limit("preload: sum", at_most=f"{start.readings[0]:.9g} N")
    choices = {SPRING: Span("400 N", "2400 N"), MODEL: ["s6014e", "vex70"]}
    found = optimise(case, choices, [STIFF], [limit], trials=3, workers=1)
    assert found.trials[0].goals == pytest.approx(found.start.goals, rel=1e-9)
    assert found.best is not None
    assert found.best.goals[0] >= found.start.goals[0] * (1.0 - 1e-9)
    assert not any("unchanged case" in line for line in found.verdict)
    held = Goal(lowest="preload.spring_force")
    found = optimise(case, {SPRING: Span("2 kN", "2.4 kN", log=True)}, [held], trials=3, workers=1)
    assert "The unchanged case is none of the choices, and better." in found.verdict


@pytest.mark.parametrize("granted", [1, 5, 11, 24])
@pytest.mark.parametrize("flat", [False, True])
def test_all_trials_are_spent_unless_the_search_has_settled(
    case: Case, monkeypatch: pytest.MonkeyPatch, granted: int, *, flat: bool
) -> None:
    """Also where one machine is the best in both goals, or nothing depends on what is chosen."""

    def tried(packed: bytes, place: tuple[float, ...], _: int = 1) -> Trial:
        return Trial(place, goals=(1.0,) * 2 if flat else (sum(place),) * 2, units=("N", "N"))

    monkeypatch.setattr(trials, "solve_trial", tried)
    varied = {SPRING: Span("1 kN", "2 kN"), MIDDLE: Span("74 mm", "84 mm")}
    goals = [Goal(lowest="preload.spring_force"), Goal(lowest="preload: sum")]
    for asked in (goals[:1], goals):
        found = optimise(case, varied, asked, trials=granted, workers=1)
        assert len(found.trials) == granted or found.settled
        assert (UNSETTLED in found.verdict) == (not found.settled)


def test_a_goal_without_bound_leaves_the_best_on_the_front(
    case: Case, monkeypatch: pytest.MonkeyPatch
) -> None:
    def tried(packed: bytes, place: tuple[float, ...], _: int = 1) -> Trial:
        return Trial(place, goals=(place[0], math.inf), units=("N", "N"))

    monkeypatch.setattr(trials, "solve_trial", tried)
    goals = [Goal(lowest="preload.spring_force"), Goal(lowest="preload: sum")]
    found = optimise(case, {SPRING: Span("1 kN", "2 kN")}, goals, trials=20, workers=1)
    assert found.front == (found.best,)


def test_a_local_search_goes_where_a_goal_has_no_bound(
    case: Case, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Largest towards the end of the span, and without bound beyond 0.9 of it."""

    def tried(packed: bytes, place: tuple[float, ...], _: int = 1) -> Trial:
        return Trial(place, goals=(place[0] if place[0] < 0.9 else math.inf,), units=("N",))

    monkeypatch.setattr(trials, "solve_trial", tried)
    problem = problem_of(case, {SPRING: Span("1 kN", "2 kN")}, [Goal(highest="preload: sum")])
    made = trials.Trials(problem, 20, 1, None, lambda *_: None)
    begin = made.at([problem.place(np.array([0.85]))])[0]
    search.local(problem, made, lambda t: -t.goals[0], begin, 12)
    last = [each.number[0] for each in made.made.values()][-4:]
    assert min(last) >= 0.9


@pytest.mark.parametrize(
    ("asked", "place"),
    [
        (Span("400 N", "1400 N"), 0.5),
        (Span("400 N", "2025 N", log=True), 0.5),
        (Span("1 kN", "2 kN"), None),
        (["800 N", "900 N"], 1.0),
        (["800 N", "1 kN"], None),
    ],
)
def test_place_of_the_unchanged_case(case: Case, asked: object, place: float | None) -> None:
    whole = vary(case, {SPRING: "900 N"})
    found = Problem(whole, tuple(parameters(whole, {SPRING: asked})), (STIFF,)).present
    assert (found and found[0]) == (None if place is None else pytest.approx(place))
    balls = {"spindle.bearings.*.model.balls": Span(15, 25)}
    count = {int(v) for v, _ in found_at(whole, "spindle.bearings.*.model.balls")}
    assert Problem(whole, tuple(parameters(whole, balls)), (STIFF,)).present == (
        float(count.pop() - 15),
    )


@pytest.mark.long
def test_whole_numbers(case: Case) -> None:
    """The number of balls is whole in every trial: more are stiffer at rest, fewer at speed."""
    balls = "spindle.bearings.*.model.balls"
    for rpm, best in (("0 rpm", 25), ("12000 rpm", 15)):
        goal = Goal(highest="stiffness.tangent", where={"variant": "nonlinear", "speed": rpm})
        found = optimise(case, {balls: Span(15, 25)}, [goal], trials=30, workers=1)
        assert len(found.trials) == 11
        assert found.values[balls] == best


def test_models_of_the_unchanged_case_are_named(case: Case) -> None:
    """By their choice, or by their own name where they are none of these; none if they differ."""
    rows = []
    for choices, machine in (
        (["vex70", "kh6014e"], case),
        (["kh6014e", "s6014e"], case),
        (["vex70", "kh6014e"], case.vary({"spindle.bearings.a.model": model("bearings", "vex75")})),
    ):
        found = optimise(machine, {MODEL: choices}, [STIFF], trials=2, workers=1)
        rows += [line for line in summary(found).splitlines() if line.startswith(MODEL)]
    assert [row.removeprefix(MODEL).rsplit(maxsplit=1)[0].strip() for row in rows] == [
        "vex70",
        "VEX 70",
        "–",
    ]


def test_nothing_keeps_the_limits(case: Case) -> None:
    limits = [Limit("preload: sum", at_least="90 kN"), Limit("preload: sum", at_most="500 kN")]
    goal = Goal(highest="preload.axial_load")
    found = optimise(case, {SPRING: Span("1 kN", "2 kN")}, [goal], limits, trials=20, workers=1)
    assert found.best is None
    assert found.verdict[0] == "No trial keeps all limits."
    assert "at least 90 kN: cannot be kept, the nearest value is" in found.verdict[1]
    assert len(found.verdict) == 2
    with pytest.raises(InvalidInput, match="at least 90 kN"):
        _ = found.case


@pytest.mark.long
def test_trade_off(case: Case) -> None:
    """Stiffness against the preload that it costs: a front that is ordered and not beaten."""
    goals = [Goal(highest="preload.axial_load"), Goal(lowest="preload: sum")]
    choices = {SPRING: Span("400 N", "2400 N"), MODEL: ["vex70", "kh6014e"]}
    found = optimise(case, choices, goals, trials=60, workers=1)
    front = np.array([each.goals for each in found.front])
    assert len(front) > 8
    assert found.best is found.front[0]
    assert f"that of the first goal, {found.problem.goals[0].words}" in " ".join(
        summary(found).split()
    )
    assert (np.diff(front[:, 0]) < 0.0).all()
    assert (np.diff(front[:, 1]) < 0.0).all()
    rest = np.array([each.goals for each in found.trials])
    beaten = (front[:, None, 0] < rest[:, 0]) & (front[:, None, 1] > rest[:, 1])
    assert not beaten.any()
    assert np.ptp(front[:, 1]) > 0.8 * np.ptp(rest[:, 1])


@pytest.mark.long
def test_goes_on_after_a_stop(case: Case, tmp_path: Path) -> None:
    """What was tried is not tried again, a line cut short is; the answer is the same."""
    how: Any = dict(
        varied={SPRING: Span("400 N", "2400 N"), MIDDLE: Span("72 mm", "90 mm")},
        goals=[Goal(highest="preload.axial_load")],
        limits=[Limit("preload: sum", at_most="1900 N")],
        trials=24,
        workers=1,
    )
    whole = optimise(case, **how)

    def stop(done: int, of: int) -> None:
        if done == 12:
            raise KeyboardInterrupt

    folder = tmp_path / "best"
    with pytest.raises(KeyboardInterrupt):
        optimise(case, **how, folder=folder, progress=stop)
    journal = folder / "trials.jsonl"
    journal.write_bytes(journal.read_bytes()[:-7])
    lines = journal.read_bytes().count(b"\n")
    again = optimise(case, **how, folder=folder)
    assert [t.number for t in again.trials] == [t.number for t in whole.trials]
    assert [t.goals for t in again.trials] == [t.goals for t in whole.trials]
    assert journal.read_bytes().count(b"\n") == 1 + len(whole.trials) > lines
    other = {**how, "goals": [Goal(lowest="preload: sum")]}
    with pytest.raises(InvalidInput, match="another optimum"):
        optimise(case, **other, folder=folder)


FILE = """
case: grinding_spindle
vary:
  spindle.sleeves.rear.spring.preload: {from: 400 N, to: 2400 N}
  spindle.bearings.*.model: [vex70, kh6014e]
goals:
  - {highest: preload.axial_load}
limits:
  - {of: "preload: sum", at_most: 1900 N}
  - {of: "preload: stop rear", at_least: 12000 rpm, absent: satisfies}
trials: 24
"""


def test_file_of_an_optimum(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "springs.yaml"
    path.write_text(FILE, encoding="utf-8")
    folder = tmp_path / "out"
    assert main(["optimise", str(path), "-o", str(folder), "--workers", "1"]) == 0
    printed = capsys.readouterr().out
    assert "at most 1900 N" in printed
    assert {p.name for p in folder.iterdir()} == {
        "best.yaml",
        "optimum.json",
        "optimum.png",
        "summary.txt",
        "trials.csv",
        "trials.jsonl",
    }
    assert str(tmp_path) not in (folder / "best.yaml").read_text(encoding="utf-8")
    best = rotordyn.run(rotordyn.load(folder / "best.yaml"))["preload"]
    rows = (folder / "trials.csv").read_text(encoding="utf-8-sig").splitlines()
    kept = [row.split(",") for row in rows[1:] if ",yes," in row]
    goal = rows[0].split(",").index("highest preload.axial_load [N]")
    assert float(best["axial_load"].min()) == pytest.approx(max(float(r[goal]) for r in kept))


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("preload.axial_load", "preload.axial_lod", "did you mean axial_load"),
        ("preload.axial_load", "preloads.axial_load", "did you mean preload"),
        ("preload.axial_load", "preload", "name a number, 'preload: words'"),
        ('"preload: sum"', '"preload: total"', "has no such number; allowed: sum"),
        ("1900 N", "1900 Hz", "9:5: limits.1: limit of 'preload: sum': expected a number in N"),
        ("1900 N", "1900", "expected a number in N: given '1900'"),
        (
            '"preload: sum", at_most: 1900 N',
            "preload.axial_load, at_most: 5 mm",
            "9:5: limits.1: limit of 'preload.axial_load': expected a number in N",
        ),
        ("at_most: 1900 N", "absent: satisfies", "give at_least, at_most or outside"),
        ("highest: preload.axial_load", "where: {}", "either highest or lowest"),
        ("trials: 24", "trials: 0", "trials"),
        (
            "[vex70, kh6014e]",
            "[vex70, kh6014e, vex70]",
            f"5:29: vary.{MODEL}: a value is listed twice: given vex70; allowed: once",
        ),
        (
            "highest: preload.axial_load",
            "highest: preload.axial_load, where: {bearing: z}",
            "no ",
        ),
    ],
)
def test_faults_of_a_file(tmp_path: Path, old: str, new: str, said: str) -> None:
    path = tmp_path / "springs.yaml"
    assert old in FILE
    path.write_text(FILE.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(InvalidInput) as caught:
        _ = main_of(path)
    assert said in str(caught.value)


def main_of(path: Path) -> Any:
    from rotordyn.study.optimum.deliver import deliver
    from rotordyn.study.read import read_optimum

    problem, how = read_optimum(path)
    return deliver(problem, path.parent / "out", **how, workers=1)


UNLIKE = [
    # what the spindle says of all its bearings, and a file of one, holds for no model that is tried
    ("mfw2310", "spindle.bearings.a.model.balls: 18", {"spindle.bearings.a.model": ["s6014e"]}),
    ("grinding_spindle", "", {"spindle.bearings.*.model.balls": [18], MODEL: ["s6014e"]}),
    ("grinding_spindle", "", {"spindle.sleeves.rear.spring.stiffness": ["rigid", 9e6]}),
    ("grinding_spindle", "", {"spindle.damping.rotor": [["2 %"]], "speeds": [["9 rpm"]]}),
    ("lacroix_r24_14", "", {"bearing.balls": [15]}),
]


@pytest.mark.parametrize(("machine", "override", "choices"), UNLIKE)
def test_the_best_as_a_case_is_the_machine_that_was_tried(
    tmp_path: Path, machine: str, override: str, choices: dict[str, Any]
) -> None:
    room = "bearing" if machine.startswith("lacroix") else "spindle"
    asked = "bearing: {loads: [2 kN]}" if room == "bearing" else "preload: {}"
    text = f"{room}: {machine}\nspeeds: [0 rpm]\nanalyses:\n  {asked}\n"
    if override:
        text += f"override: {{{override.removeprefix('spindle.')}}}\n"
    (tmp_path / "case.yaml").write_text(text)
    case = rotordyn.load(tmp_path / "case.yaml")
    problem = Problem(case, tuple(parameters(case, choices)), ())
    last = tuple(len(values) - 1.0 for values in choices.values())
    assert _write_best(problem, Trial(last), tmp_path / "best.yaml", tmp_path) == ""
    found, wanted = rotordyn.load(tmp_path / "best.yaml"), vary(case, problem.values(last))
    assert unlike(found, wanted) == {}
    assert found.speeds == wanted.speeds
    assert unlike(case, wanted)


@pytest.mark.parametrize("choices", [{"cut.runout.2": [5e-6]}, {"speeds.2": [300.0], "teeth": [3]}])
def test_the_best_as_a_case_has_items_of_lists(tmp_path: Path, choices: dict[str, Any]) -> None:
    """By their place from 1, as paths name them where they have no name."""
    (tmp_path / "case.yaml").write_text(
        "spindle: deep_groove_rear\nspeeds: [0 rpm, 9000 rpm]\nanalyses:\n  stability_lobes:\n"
        "    {point: nose, teeth: 3, diameter: 40 mm, tangential: 600 MPa, radial: 200 MPa,\n"
        "    cut: {depth: 1 mm, runout: [0 um, 1 um, 2 um]}, speeds: [20 rpm, 25 rpm, 3000 rpm]}\n"
    )
    case = rotordyn.load(tmp_path / "case.yaml")
    varied = {f"analyses.stability_lobes.{path}": values for path, values in choices.items()}
    problem = Problem(case, tuple(parameters(case, varied)), ())
    assert (
        _write_best(problem, Trial((0.0,) * len(choices)), tmp_path / "best.yaml", tmp_path) == ""
    )
    found = rotordyn.load(tmp_path / "best.yaml").analyses["stability_lobes"]
    wanted = vary(case, {path: values[0] for path, values in varied.items()})
    assert found == wanted.analyses["stability_lobes"]
    assert found != case.analyses["stability_lobes"]


def test_what_a_limit_may_be() -> None:
    reading = Reading(np.array([100.0]), "N")
    for how, said in (
        ({"at_most": math.nan}, "a bound is a number, got nan"),
        ({"at_least": "inf N"}, "a bound is a number"),
        ({"at_least": "9 mm"}, "limit of 'preload: sum': expected a number in N"),
        ({"outside": ("2 N", "1 N")}, "outside goes from low to high"),
        ({"outside": "2 N"}, r"outside takes \[from, to\]"),
    ):
        with pytest.raises(InvalidInput, match=said):
            Limit("preload: sum", **how).margin(reading)
    none = Reading(np.empty(0), "N", absent=1)
    with pytest.raises(InvalidInput, match="expected a number in N"):
        Limit("preload: sum", at_most="9 mm", absent=True).margin(none)
    with pytest.raises(InvalidInput, match="speed: expected a number in rpm"):
        _places("preload.axial_load", "speed", np.array([0.0]), "0 mm", "rpm")


def test_one_absent_number_of_several_breaks_a_limit(case: Case) -> None:
    """Unless that says ``absent``; then, and of goals, it is reported."""
    stop = "preload: stop"
    reading = Reading(np.array([9e3]), "rpm", ("stop rear",), (None,), absent=1)
    broken = Limit(stop, at_most="13000 rpm").margin(reading)
    assert broken[0] < 0.0
    assert math.isnan(broken[1])
    limit = Limit(stop, at_most="13000 rpm", absent=True)
    room, value = limit.margin(reading)
    assert (room, value) == (pytest.approx(4.0 / 13.0), 9e3)
    problem = Problem(case, (), (Goal(lowest=stop),), (limit,))
    trial = Trial((), (9e3,), (room,), (value,), ("rpm", "rpm"), (0, 1))
    (line,) = Optimum(problem, trial, (trial,), trial).verdict[1:]
    assert line == f"{limit.words}: 1 of the numbers it reads is absent."


def test_a_limit_that_absent_numbers_break_says_how_many_and_what_leaves_them_out(
    case: Case,
) -> None:
    """Such as a least life where one of the speeds is 0, at which there is none."""
    problem = Problem(case, (), (Goal(lowest="x"),), (Limit("life: set L10r", at_least="9 h"),))
    trial = Trial((), (1.0,), (-1.0,), (math.nan,), ("N", "h"), (0, 1))
    words = " ".join(Optimum(problem, trial, (trial,), None).verdict)
    assert "cannot be kept, 1 of the numbers it reads is absent (absent: satisfies leaves" in words


def test_trials_without_solution_are_counted_with_their_reasons(case: Case) -> None:
    problem = Problem(case, (), (Goal(lowest="preload: sum"),))
    trials = (Trial((), (1.0,), units=("N",)), *[Trial((), sentence="no state")] * 2)
    found = Optimum(problem, trials[0], trials, trials[0])
    assert "not solved (2 trials): no state" in summary(found)


@pytest.mark.parametrize("lost", [0, 2])
def test_the_figure_of_the_trials_says_how_many_have_no_goal(case: Case, lost: int) -> None:
    problem = Problem(case, (), (Goal(lowest="preload: sum"),))
    none = (Trial((), (math.nan,), units=("N",)), Trial((), sentence="no state"))
    found = (Trial((), (1.0,), units=("N",)), *none[:lost])
    ((_, draw),) = figures(Optimum(problem, found[0], found, found[0]))
    words = [each.get_text() for each in draw().legends[0].get_texts()]
    assert words[3:] == ["without a goal: 2 of 3"] * (lost > 0)


def test_a_goal_that_no_trial_has_is_said(case: Case) -> None:
    problem = Problem(case, (), (Goal(highest="preload: stop"),), (Limit("x", at_least=1.0),))
    trial = Trial((), (math.nan,), (-1.0,), (math.nan,), ("rpm", "rpm"))
    words = " ".join(Optimum(problem, trial, (trial,), None).verdict)
    assert "highest preload: stop: no trial has a value" in words
    assert "cannot be kept, the value is absent" in words


def test_numbers_whose_words_begin_others_are_read_alone(
    case: Case, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of a point ``nose``, not of ``nose_face`` too; of ``bending 1``, not of ``bending 10``."""
    values = {"nose": 1.0, "nose_face": 9.0, "bending 1": 2.0, "bending 10": 8.0}
    numbers = [Number(name, "µm", value, speed=0.0) for name, value in values.items()]
    made_up = SimpleNamespace(numbers=lambda result, case: numbers)
    monkeypatch.setattr(criterion, "analysis", lambda name: made_up)

    def read(words: str) -> list[float]:
        return Criterion(f"unbalance: {words}").read(case, {"unbalance": None}).values.tolist()

    assert read("nose") == [1.0]
    assert read("nose at 0 rpm [µm]") == [1.0]
    assert read("bending 1") == [2.0]
    assert read("bending") == [2.0, 8.0]
    assert read("no") == [1.0, 9.0]


def test_a_coordinate_that_is_not_there_is_answered_in_the_unit_asked_in() -> None:
    speeds = np.array([100.0, 200.0]) * math.pi
    with pytest.raises(InvalidInput, match=r"at '7000 rpm'; it goes from 3000 to 6000 rpm$"):
        _places("campbell.frequency", "speed", speeds, "7000 rpm", "rpm")
    with pytest.raises(InvalidInput, match=r"at 7000; it goes from 314.159 to 628.319 in SI units"):
        _places("campbell.frequency", "speed", speeds, 7000, "rpm")


def test_amounts() -> None:
    assert amount("3 kN", "N") == 3000.0
    assert amount(1e6, "N/µm") == 1.0
    assert amount("12000 rpm", "rpm") == pytest.approx(12000.0)
    assert amount("12000 rpm", "") == pytest.approx(400.0 * math.pi)
    with pytest.raises(InvalidInput, match="expected a number in Hz"):
        amount("3 N", "Hz")


@pytest.mark.parametrize(
    ("pattern", "word", "alike"),
    [
        ("bending 1*", "bending 1", True),
        ("bending 1*", "bending 1 forward", True),
        ("bending 1*", "bending 10", False),
        ("bending 1*f*", "bending 11 forward", False),
        ("bending 1*f*", "bending 1 forward", True),
        ("bending*", "bending 10", True),
        ("bending 12", "bending 12", True),
    ],
)
def test_a_number_in_a_pattern_ends_there(pattern: str, word: str, alike: bool) -> None:
    assert _alike(word, pattern) == alike
