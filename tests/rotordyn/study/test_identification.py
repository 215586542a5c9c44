"""Identification from synthetic data; values that the data do not determine are named."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rotordyn
from rotordyn import NoLoad, Numbers, Predicted, Unknown, identify
from rotordyn.analyses import AxialCycleSpec
from rotordyn.case.case import Case
from rotordyn.errors import InvalidInput
from rotordyn.study.identification import search as searching
from rotordyn.study.identification.along_axis import RPM
from rotordyn.study.identification.certainty import certainty
from rotordyn.study.identification.measurement import Data
from rotordyn.study.identification.problem import Problem
from rotordyn.study.identification.read import read_identification
from rotordyn.study.identification.search import Fit
from rotordyn.study.identification.solve import identified
from rotordyn.study.identification.trial import Trial
from rotordyn.study.identification.unknown import sought
from rotordyn.study.identification.weighing import Weighing
from rotordyn.study.optimum.criterion import Criterion, Reading
from tests.rotordyn.study.axial_twin import (
    FRONT,
    KNOWN,
    REAR,
    SPEEDS,
    SPRINGS,
    STUDIES,
    TRUE,
    Array,
    curve,
    twin,
)


@pytest.fixture(scope="module")
def case() -> Case:
    return rotordyn.load("mfw2310_identification")


@pytest.mark.long
def test_five_synthetic_machines_are_identified(case: Case) -> None:
    """95 % intervals: all but a few of 20 hold; three misses or fewer have a chance of 98 %."""
    inside = []
    for seed in range(5):
        problem = twin(case, seed)
        fit = searching.search(problem, problem.start)
        sure = certainty(problem, fit)
        inside += [(sure.interval[:, 0] <= TRUE) & (sure.interval[:, 1] >= TRUE)]
        assert 0.5 < sure.reduced < 1.7
        assert set(sure.words) == {"identifiable"}
    assert np.sum(inside) >= 17


def test_nuisances_projected_are_nuisances_sought() -> None:
    """Against ordinary least squares with tare and drift as unknowns beside the others."""
    rng = np.random.default_rng(1)
    columns, slopes, y = rng.normal(size=(20, 2)), rng.normal(size=(20, 3)), rng.normal(size=20)
    noise, prior = rng.uniform(0.5, 2.0, 20), np.array([0.7, np.inf])
    data = Data(
        "made up", y, noise, "", 1.0, np.arange(20.0), "", ("",) * 20, columns, prior, ("a", "b")
    )
    weighing = Weighing(data)
    seeking = np.linalg.lstsq(weighing.weighed(slopes), weighing.weighed(y), rcond=None)[0]
    rows = np.concatenate([np.hstack([slopes, columns]) / noise[:, None], [[0, 0, 0, 1 / 0.7, 0]]])
    whole = np.linalg.lstsq(rows, np.append(y / noise, 0.0), rcond=None)[0]
    assert seeking == pytest.approx(whole[:3], rel=1e-12)
    assert weighing.nuisances(slopes @ seeking) == pytest.approx(whole[3:], rel=1e-10)
    sum_of_squares = np.sum((rows @ whole - np.append(y / noise, 0.0)) ** 2)
    left = weighing.weighed(y - slopes @ seeking)
    assert left @ left == pytest.approx(sum_of_squares, rel=1e-12)


def test_shaft_alone_cannot_tell_the_preloads_apart(case: Case) -> None:
    problem = twin(case, 3)
    alone = replace(problem, measurements=problem.measurements[:1])
    predicted = alone.predicted(TRUE)
    assert predicted is not None
    sure = certainty(alone, Fit(TRUE, 1.0, predicted))
    both = certainty(problem, Fit(TRUE, 1.0, problem.predicted(TRUE) or []))
    size = sure.covariance[:2, :2] * np.outer(alone.scale[:2], alone.scale[:2])
    ones, signs = np.ones(2), np.array([1.0, -1.0])
    assert ones @ size @ ones < 0.01 * (signs @ size @ signs)  # the sum, the difference
    assert both.correlation[0, 1] > sure.correlation[0, 1] < -0.98


@pytest.mark.long
def test_growth_and_three_shifts_are_not_distinguished() -> None:
    """Together with all other unknowns; with the shifts known, growth is."""
    asked = read_identification(STUDIES / "mfw2310_twin.yaml").searches
    path = "spindle.shortening.shift"
    shift = {"a": 0.0, "b": 0.0, "c": -0.305e-6, "d": -42.8e-6, "e": -42.8e-6}
    case = rotordyn.vary(asked.models[0].case, {path: shift})
    shifts = {
        f"{path}.a": Unknown("-20 um", "20 um", also=(f"{path}.b",), name="shift a b"),
        f"{path}.c": Unknown("-20 um", "20 um", name="shift c"),
        f"{path}.d": Unknown("-80 um", "20 um", also=(f"{path}.e",), name="shift d e"),
    }
    known = asked.models[0].unknowns
    true = np.array([574.0, 528.0, 6.2e6, 5.49e6, 52.2e-6, 80.9, 43.2e-6, 7.3e-6, 0.571])
    words = {}
    for more in ((), sought(case, shifts)):
        problem = Problem(case, (*known, *more), asked.measurements, known=KNOWN)
        values = np.append(true, [0.0, -0.305e-6, -42.8e-6][: len(more)])
        fit = Fit(values, float(problem.count), problem.predicted(values) or [])
        sure = certainty(problem, fit)
        words[len(more)] = {u.name: w for u, w in zip(problem.unknowns, sure.words, strict=True)}
    assert words[0]["Δu24"] == "identifiable"
    vague = {name for name, word in words[3].items() if word == "unidentifiable"}
    assert vague == {"Δu24", "shift a b", "shift c", "shift d e"}
    assert len(sure.directions) == 1
    assert np.abs(sure.directions[0][[7, 9, 10, 11]]).min() > 0.2
    assert np.abs(sure.directions[0][[0, 1, 2, 3, 4, 5, 6, 8]]).max() < 0.15


@pytest.mark.long
def test_first_model_of_the_story_is_insufficient() -> None:
    """Of the story in the thesis: 5.47 µm and three values on their bounds (D. Noël, 2013, 3.2)."""
    asked = read_identification(STUDIES / "mfw2310_phases.yaml")
    first = replace(asked.searches, models=asked.searches.models[:1], absolute=False)

    found = identified(replace(asked, searches=first), workers=1)
    assert 4.0 < found.mean_difference < 6.5
    assert not found.sufficient
    assert "allowed 1" in found.verdict[0]
    assert "the model lacks a phenomenon" in found.verdict[0]
    assert found.explained.on_bounds


def test_hypotheses_are_ranked(case: Case) -> None:
    """Without friction no machine explains a loop."""
    problem = twin(case, 1)
    asked = {path: each for path, each in SPRINGS.items() if "friction" not in path}
    found = identify(
        case,
        asked,
        problem.measurements,
        hypotheses={FRONT + "friction": [0.0, 80.9]},
        workers=1,
    )
    assert found.surviving == ["friction 80.9 N"]
    assert found.evidence[1] > 100.0
    assert "no machine" not in found.summary


def test_absolute_differences_bear_outliers(case: Case) -> None:
    """Without noise the machine is found exactly beside a few wrong points."""
    asked = {FRONT + "friction": SPRINGS[FRONT + "friction"]}
    exact = curve("shaft", tare=0.0).predicted(Trial(case, axial_speeds=SPEEDS, known=KNOWN))
    exact[22:25] += 3e-6
    measured = [curve("shaft", exact, tare=0.0)]
    off = {
        how: abs(
            identify(case, asked, measured, minimise=how, workers=1).values[FRONT + "friction"]
            - 80.9
        )
        for how in ("squares", "absolute")
    }
    assert off["squares"] > 2.0
    assert off["absolute"] < 0.1


def test_prior_joins_the_data(case: Case) -> None:
    """Inverse variances add."""
    asked = {FRONT + "friction": SPRINGS[FRONT + "friction"]}
    problem = twin(case, 2, asked, TRUE[-1:])
    free = identify(case, asked, problem.measurements, workers=1).explained.sure
    prior = {FRONT + "friction": replace(asked[FRONT + "friction"], prior="70 N", deviation="1 N")}
    held = identify(case, prior, problem.measurements, workers=1).explained.sure
    variance = (free.deviation[0] / free.birge) ** 2
    mean = (free.values[0] / variance + 70.0) / (1.0 / variance + 1.0)
    assert held.values[0] == pytest.approx(mean, abs=0.1)
    assert held.deviation[0] / held.birge == pytest.approx((1.0 / variance + 1.0) ** -0.5, rel=0.02)


def test_figures_draw_the_machine_between_the_points_too(case: Case) -> None:
    """The same cycle, so that it goes through what is predicted at the points."""
    asked = {FRONT + "friction": SPRINGS[FRONT + "friction"]}
    shaft = twin(case, 1, asked, TRUE[-1:]).measurements[:1]
    found = identify(case, asked, shaft, workers=1)
    (given,), (exact,) = found.explained.problem.measurements, found.explained.fit.predicted
    axes = found.plot("measured").axes[0]
    assert axes.get_ylabel() == "measured [µm]"
    drawn = [each for each in axes.lines if each.get_linestyle() == "-"]
    series = list(dict.fromkeys(given.data.series))
    assert len(drawn) == len(series) == 2 * len(SPEEDS)
    for line, name in zip(drawn, series, strict=True):
        here = np.array(given.data.series) == name
        x, y = line.get_data()
        assert len(x) > 60 > here.sum()
        through = [y[np.argmin(np.abs(x - force))] for force in given.force[here]]
        np.testing.assert_allclose(through, exact[here] * 1e6, atol=1e-4)


def test_a_speed_may_be_measured_several_times(case: Case) -> None:
    """As one point of their mean, whose noise is √2 lower."""
    asked = {FRONT + "spring.preload": Unknown("450 N", "700 N", start="500 N")}
    given: dict[str, Any] = {"name": "idle", "of": "shaft"}
    noise = [3e-7, 4.242640687e-7]
    twice = NoLoad(speed=[1600.0] * 2, displacement=[-9e-6, -10e-6], deviation=noise[1], **given)
    once = NoLoad(speed=[1600.0], displacement=[-9.5e-6], deviation=noise[0], **given)
    found = [identify(case, asked, [each], workers=1).explained for each in (twice, once)]
    values = [each.fit.values[0] for each in found]
    assert values[0] == pytest.approx(values[1], rel=1e-6)


def test_prediction_follows_what_was_measured(case: Case) -> None:
    """One unknown by one measured number: its prediction has the interval of the measurement."""
    plain = replace(case, analyses={"preload": case.analyses["preload"]}, speeds=(24000.0 * RPM,))
    plain = rotordyn.vary(plain, {FRONT + "stop_travel": np.inf, FRONT + "friction": 0.0})
    asked = {REAR + "spring.preload": Unknown("450 N", "650 N")}
    load = Numbers(
        name="load",
        of="preload: sum",
        speed=np.array([24000.0]) * RPM,
        values=np.array([2190.0]),
        deviation=20.0,
        unit="N",
    )
    wanted = [Predicted("preload: sum"), Predicted("preload: stop")]
    found = identify(plain, asked, [load], predict=wanted, workers=1)
    (one, none), sure = found.predictions, found.explained.sure
    assert "preload: stop [rpm] none –" in " ".join(found.summary.split())
    assert "\n1 point, 1 unknown, " in found.summary
    assert np.isnan([none.value, none.low, none.high]).all()
    assert one.value == pytest.approx(2190.0, abs=0.1)
    assert 0.5 * (one.high - one.low) == pytest.approx(sure.quantile * 20.0, rel=1e-2)


def test_words_are_held_at_their_own_speed(case: Case) -> None:
    """Headline numbers are those of the first and the last speed of all that are measured."""
    plain = replace(case, analyses={"preload": case.analyses["preload"]})
    sums = Numbers(
        name="sums", of="preload: sum", speed=np.array([24000.0, 0.0]) * RPM, values=np.ones(2),
        deviation=1.0, unit="N",
    )  # fmt: skip
    slow = replace(sums, name="slow", speed=np.array([0.0, 4000.0]) * RPM)
    trial = Trial(plain, (0.0, 24000.0 * RPM), {"preload": case.analyses["preload"]})
    whole = Criterion("preload: sum").read(plain, trial.results).values
    assert sums.predicted(trial) == pytest.approx(whole[::-1])
    one = replace(sums, speed=sums.speed[:1], values=np.ones(1))
    assert one.predicted(trial) == pytest.approx(whole[1:])
    with pytest.raises(
        InvalidInput, match=r"0 and 24000 rpm, .* at 4000 rpm: .* words: .* position, "
    ):
        slow.predicted(trial)


def test_a_number_without_a_speed_is_measured_at_any(case: Case) -> None:
    """When a stop is met, whatever speed it was noted at."""
    asked = {"preload": case.analyses["preload"]}
    trial = Trial(replace(case, analyses=asked), (*SPEEDS, 24000.0 * RPM), asked)
    stop = Numbers(
        name="stop", of="preload: stop", speed=SPEEDS[1:], values=np.ones(1), deviation=9.0,
        unit="rpm",
    )  # fmt: skip
    (value,) = Criterion("preload: stop").read(trial.case, trial.results).values
    assert stop.predicted(trial) == pytest.approx([value * RPM])
    two = replace(stop, speed=np.array(SPEEDS), values=np.ones(2))
    with pytest.raises(InvalidInput, match=r"has 1 value for 2 measured$"):
        two.predicted(trial)
    assert "words" not in str([*replace(stop, of="preload").faults(case)])


def test_a_whole_name_is_not_another_that_begins_so() -> None:
    """`nose_face` is in µm, `nose_face at` in rpm."""
    case = rotordyn.load(STUDIES.parent / "mfw2310_unbalance.yaml")
    few = rotordyn.vary(case, {"speeds": [100.0, 1000.0]})
    trial = Trial(few, few.speeds, few.analyses)
    one = Numbers(
        name="nose", of="unbalance: nose_face", speed=np.array([1000.0]), values=np.ones(1),
        deviation=1.0, unit="um",
    )  # fmt: skip
    result = trial.results["unbalance"]
    wanted = np.nanmax(result.fine_major_axis[:, list(result.point).index("nose_face")])
    assert one.predicted(trial) == pytest.approx([wanted])


def test_two_ends_without_a_speed_are_the_first_and_the_last(
    case: Case, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked = {"preload": case.analyses["preload"]}
    trial = Trial(replace(case, analyses=asked), (*SPEEDS, 24000.0 * RPM), asked)
    reading = Reading(np.array([1.0, 2.0]), "N", ("sum", "sum"), (None, None))
    monkeypatch.setattr(Criterion, "read", lambda *_: reading)
    ends = np.array([SPEEDS[0], 24000.0 * RPM])
    sums = Numbers(
        name="sums", of="preload: sum", speed=ends, values=np.ones(2), deviation=1.0, unit="N"
    )
    assert sums.predicted(trial) == pytest.approx([1.0, 2.0])
    for speed in (ends[::-1], np.array(SPEEDS)):
        with pytest.raises(InvalidInput, match="last of all measured, 4000 rpm, 24000 rpm"):
            replace(sums, speed=speed).predicted(trial)


@pytest.mark.parametrize("conditions", ["films", "static"])
def test_axial_curves_are_those_of_the_conditions(conditions: str) -> None:
    """Displacements over one cycle of force, with balls on films or bearings as at rest."""
    given: Mapping[str, object] = {"conditions.bearings": "static"}
    if conditions == "films":
        oiled = rotordyn.load("mfw2310_films").variants["films"].conditions
        given = {"conditions.films": oiled.films}
    speed = 24000.0 * RPM
    plain = rotordyn.load("mfw2310_axial_cycle").vary(given)
    spec = AxialCycleSpec(lowest=-1800.0, highest=1600.0, steps=2)
    one = replace(plain, speeds=(speed,), variants={}, analyses={"axial_cycle": spec})
    wanted = rotordyn.run(one)["axial_cycle"]
    force = wanted.force.values
    falling, rising = Trial(one, axial_speeds=(speed,)).cycle(0, force[::-1], force, None, None)
    for branch, found in (("falling", falling[::-1]), ("rising", rising)):
        path = wanted.position.sel(branch=branch, body="shaft").values[0]
        assert np.diff(found[:, 0]) == pytest.approx(np.diff(path), abs=5e-9)


def test_nearest_mode(case: Case) -> None:
    modes = Numbers(
        name="modes",
        of="campbell.frequency",
        where={"mode": "bending*"},
        speed=np.array([4000.0, 4000.0]) * RPM,
        values=np.array([900.0, 1300.0]),
        deviation=20.0,
        unit="Hz",
        nearest=True,
    )
    assert not [*modes.faults(case)]
    trial = Trial(case, tuple(modes.speeds(case)), modes.analyses(case))
    found = modes.predicted(trial)
    every = trial.results["campbell"].frequency.ravel()
    every = every[np.isfinite(every)]
    assert found == pytest.approx([every[np.abs(every - f).argmin()] for f in (900.0, 1300.0)])
    read = Criterion("campbell.frequency", {"mode": "bending 1*"}).read(case, trial.results)
    whirls = ("backward", "forward")
    assert read.names == tuple(f"campbell.frequency bending 1 {whirl}" for whirl in whirls)


@pytest.mark.long
def test_interrupt_keeps_the_best_and_goes_on(
    case: Case, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    problem = twin(case, 4)
    asked = dict(measurements=problem.measurements, workers=1, folder=tmp_path)
    solved = Problem.predicted
    count = 0

    def stops(self: Problem, values: Array) -> Any:
        nonlocal count
        count += 1
        if count == 20:
            raise KeyboardInterrupt
        return solved(self, values)

    monkeypatch.setattr(Problem, "predicted", stops)
    half = identify(case, SPRINGS, **asked)
    monkeypatch.setattr(Problem, "predicted", solved)
    assert half.stopped
    assert "stopped before the end" in half.summary
    whole = identify(case, SPRINGS, **asked)
    assert not whole.stopped
    assert whole.explained.fit.cost < half.explained.fit.cost
    counted = whole.explained.searches[0].evaluations
    again = identify(case, SPRINGS, **asked)
    assert again.explained.searches[0].evaluations == counted  # read, not searched
    assert again.explained.fit.values == pytest.approx(whole.explained.fit.values, rel=1e-12)
    journal = tmp_path / "searches.jsonl"
    head, *lines = [json.loads(line) for line in journal.read_text().splitlines()]
    failed = [line | {"values": [], "sentence": "no state"} for line in lines]
    journal.write_text("".join(json.dumps(line) + "\n" for line in [head, *failed]))
    anew = identify(case, SPRINGS, **asked)
    assert anew.explained.fit.values == pytest.approx(whole.explained.fit.values, rel=1e-6)
    shaft, rear = problem.measurements
    front: dict[str, Any] = {"measurements": (shaft, replace(rear, of="front"))}  # points as before
    for unknowns, other in ((dict(list(SPRINGS.items())[:2]), {}), (SPRINGS, front)):
        with pytest.raises(InvalidInput, match="another identification"):
            identify(case, unknowns, **asked | other)
