"""The rotor from frequency responses: synthetic data, and the signs of wrong models."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rotordyn
from rotordyn.machine.joint import Joint
from rotordyn.study.identification.problem import Problem
from rotordyn.study.identification.read import read_identification
from rotordyn.study.identification.responses import Responses
from rotordyn.study.identification.search import search
from rotordyn.study.identification.solve import identify
from rotordyn.study.identification.trial import Trial
from rotordyn.study.identification.unknown import Unknown, sought
from tests.rotordyn.page.conftest import array, held
from tests.rotordyn.study.rotor_twin import (
    DAMPING,
    FREQUENCY,
    OUTER,
    case,
    frequencies,
    measured,
    spindle,
    unknowns,
)

pytestmark = pytest.mark.filterwarnings("ignore:unclosed file:ResourceWarning")
WHIRLS = (  # 0.6 and 3.9 Hz apart
    "several modes of the machine lie where one is measured, whose deviations are too small: "
    "357.4 Hz (6685 rpm), 984.0 Hz (6685 rpm)"
)


@pytest.mark.long
def test_sections_and_dampings_from_20_percent_off(taps: Responses, tmp_path: Path) -> None:
    """Frequencies of a speed that was not measured within 0.5 %; every true value in its interval
    of four deviations; χ² as the noise stated."""
    found = identify(case(spindle()), unknowns(0.2), [taps], workers=1)
    best = found.explained
    assert found.sufficient
    assert best.sure.reduced == pytest.approx(1.0, abs=0.12)
    true = np.array([OUTER[0], OUTER[2], OUTER[4], *DAMPING])
    assert (np.abs(best.fit.values - true) < 4.0 * best.sure.deviation).all()
    assert found.best.spindle is not None
    pair = frequencies(spindle()), frequencies(found.best.spindle)
    assert len(pair[0]) > 5
    np.testing.assert_allclose(pair[1], pair[0], rtol=5e-3)
    (beside,) = best.beside
    assert beside.remarks == (WHIRLS,)
    assert all(float(row[-1]) > 0.98 for row in beside.rows)
    assert {"taps_responses", "correlation"} <= set(found.figures)
    assert "machine [Hz]" in found.summary
    pytest.importorskip("plotly", reason="the extra report is not installed")
    found.save(tmp_path, draw=False)
    page = rotordyn.write_report(tmp_path, tmp_path / "page.html").read_text(encoding="utf-8")
    assert ">taps modes</" in page
    content, numbers = held(page)
    chart = next(c for c in content.values() if len(c["traces"]) == 4 and c["controls"])
    assert chart["controls"][0]["options"][1] == "tail.y / tip.y, 0 rpm"
    x, y = (array(chart["traces"][0]["moving"][key], numbers) for key in "xy")
    size = np.hypot(taps.responses[1].real, taps.responses[1].imaginary)
    np.testing.assert_allclose(x[1], FREQUENCY, rtol=1e-6)
    np.testing.assert_allclose(y[1], size * 1e6, rtol=1e-5)


@pytest.mark.long
def test_stiffness_of_a_joint_is_found() -> None:
    """Tilt as of half a diameter of shaft, beside a diameter, from twice and 10 % off."""
    true = 2.1e11 * np.pi / 64.0 * 0.05**4 / 0.025
    jointed = replace(spindle(), joints=(Joint("joint", 0.24, tilt=true),))
    asked = {path: each for path, each in unknowns(0.1).items() if ".s2." in path}
    asked["spindle.joints.joint.tilt"] = Unknown(0.2 * true, 5.0 * true, start=2.0 * true)
    found = identify(case(jointed), asked, [measured(jointed, 5)], workers=1)
    best = found.explained.sure
    assert found.sufficient
    assert (np.abs(best.values - [OUTER[2], true]) < 4.0 * best.deviation).all()
    assert best.deviation[1] < 0.05 * true


def test_both_stiffnesses_of_an_anisotropic_support_are_found() -> None:
    """80 and 50 N/µm from 65 both, taps in both directions."""
    front, rear = spindle().supports
    pair = {("y", "y"): 8e7, ("z", "z"): 5e7}
    unlike = replace(spindle(), supports=(replace(front, stiffness=pair), rear))
    path = "spindle.supports.front.stiffness."
    asked = {path + way: Unknown(2e7, 2e8, start=6.5e7) for way in ("yy", "zz")}
    taps = measured(unlike, 6, ways="yz")
    found = identify(case(unlike), asked, [taps], workers=1)
    best = found.explained.sure
    assert found.sufficient
    assert (np.abs(best.values - [*pair.values()]) < 4.0 * best.deviation).all()
    assert (best.deviation < 0.02 * best.values).all()


@pytest.mark.long
def test_without_blurred_responses_the_search_stops_at_other_peaks(taps: Responses) -> None:
    """So that what leads it there is needed: the same start, samples alone."""
    asked = sought(case(spindle()), unknowns(0.2))
    sharp = replace_blurred(taps)
    found = search(problem := Problem(case(spindle()), asked, (sharp,)), problem.start)
    assert found.cost > 10.0 * problem.count


def replace_blurred(of: Responses) -> Responses:
    class Sharp(Responses):
        blurred = ()

    return Sharp(name=of.name, responses=of.responses, noise=of.noise)


def test_a_joint_that_the_model_lacks_is_found_out() -> None:
    """Tilt as of half a diameter of shaft."""
    bending = 2.1e11 * np.pi / 64.0 * 0.05**4
    joint = Joint("joint", 0.24, tilt=bending / 0.025)
    taps = measured(replace(spindle(), joints=(joint,)))
    few = {path: each for path, each in unknowns(0.1).items() if ".s2." in path}
    found = identify(case(spindle()), few, [taps], workers=1)
    assert not found.sufficient
    assert "times the stated noise" in found.verdict[0]
    assert f"at {found.explained.problem.count - 1} degrees of freedom" in found.verdict[0]


def test_a_mode_that_the_machine_lacks_is_named(taps: Responses) -> None:
    """Beside a machine without its disc, and one without supports of the rear."""
    light = replace(spindle(), discs=())
    remarks = taps.beside(Trial(case(light))).remarks
    right = taps.beside(Trial(case(spindle()))).remarks
    assert right == (WHIRLS,)
    assert any("lacks" in each or "not measured" in each for each in remarks)


def test_noise_above_the_stated_one_is_said() -> None:
    noisy = measured(spindle(), noise=0.05)
    remarks = noisy.beside(Trial(case(spindle()))).remarks
    assert any("scatter 2.5 times" in each or "scatter 2.4 times" in each for each in remarks)


def test_gains_of_sensors_are_taken_out(taps: Responses) -> None:
    """A response 5 % too large costs nothing where gains are unknown by 5 %."""
    first = taps.responses[0]
    large = replace(
        first,
        real=tuple(1.05 * v for v in first.real),
        imaginary=tuple(1.05 * v for v in first.imaginary),
    )
    responses = (large, *taps.responses[1:])
    costs = []
    for gain in (0.0, 0.05):
        of = Responses(name="taps", responses=responses, noise=0.02, gain=gain)
        problem = Problem(case(spindle()), sought(case(spindle()), unknowns(0.0)), (of,))
        predicted = problem.predicted(np.array([OUTER[0], OUTER[2], OUTER[4], *DAMPING]))
        assert predicted is not None
        rows = of.data.observed - predicted[0]
        weighed = problem.weighings[0].weighed(rows)
        costs.append(float(weighed @ weighed) / len(rows))
    assert costs[0] > 1.5
    assert costs[1] == pytest.approx(1.0, abs=0.15)


def test_the_modes_of_the_shipped_synthetic_responses() -> None:
    """At the true values of docs/generate/synthetic_responses.py: all modes, χ² of the noise."""
    asked = read_identification("cases/identification/grinding_spindle_taps.yaml")
    problem = asked.searches.problem(0)
    true = np.array([88e-3, 74e-3, 46e-3, 36e-3, 1.85, 800.0, 350.0])
    predicted = problem.predicted(true)
    assert predicted is not None
    rows = problem.rows(predicted, true)
    assert float(rows @ rows) / len(rows) == pytest.approx(1.0, abs=0.1)
    trial = problem.trial(true)
    for each in problem.measurements:
        assert isinstance(each, Responses)
        assert not each.beside(trial).remarks
