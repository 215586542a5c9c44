"""Values that stand where their quantity ends, or where the study does."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest

import rotordyn
from rotordyn import Numbers, Predicted, Unknown, identify
from rotordyn.case.case import Case
from rotordyn.study.identification.along_axis import RPM
from rotordyn.study.identification.identification import Identification
from rotordyn.study.identification.trial import Trial
from tests.rotordyn.study.axial_twin import FRONT, REAR, Array
from tests.rotordyn.study.made_up import MadeUp

FRICTION = FRONT + "friction"


@dataclass(frozen=True, eq=False)
class Friction(MadeUp):
    """Friction of the front sleeve [N], read several times."""

    def predicted(self, trial: Trial) -> Array:
        assert trial.case.spindle is not None
        return np.full(len(self.observed), trial.case.spindle.sleeves[0].friction)


class FromHundred(Friction):
    """Nothing below 100 N is seen of it."""

    def predicted(self, trial: Trial) -> Array:
        return np.maximum(super().predicted(trial), 100.0)


@pytest.fixture(scope="module")
def case() -> Case:
    return rotordyn.load("mfw2310_identification")


def _found(case: Case, least: str, *, mean: float = -0.3) -> Identification:
    observed = mean + np.array([-1.0, 0.2, 1.1, -0.4])
    asked = {FRICTION: Unknown(least, "200 N", start="50 N", name="Ff")}
    return identify(case, asked, [Friction(observed, 1.0)], profiles="all", workers=1)


def test_a_value_at_its_physical_limit_suffices(case: Case) -> None:
    found = _found(case, "0 N")
    assert found.explained.on_bounds == ["Ff"]
    assert found.sufficient
    assert found.verdict[0].startswith("sufficient: ")
    assert found.verdict[0].endswith("; Ff at its physical limit")
    assert not any("departs" in line for line in found.verdict)


def test_a_value_at_an_end_of_the_study_does_not(case: Case) -> None:
    found = _found(case, "5 N", mean=4.7)
    assert not found.sufficient
    assert found.verdict[0].endswith("or the bound is too tight")


@pytest.mark.parametrize(
    ("start", "mean", "said"), [(50, 150, True), (140, 150, False), (50, 100, False)]
)
def test_other_starts_are_advised_where_nothing_follows_an_unknown(
    case: Case, start: float, mean: float, *, said: bool
) -> None:
    """And the machine found does not suffice."""
    asked = {FRICTION: Unknown("0 N", "200 N", start=f"{start} N", name="Ff")}
    measured = FromHundred(mean + np.array([-1.0, 0.2, 1.1, -0.4]), 1.0)
    found = identify(case, asked, [measured], workers=1)
    assert found.sufficient == (not said)
    advice = [line for line in found.verdict if line.startswith("no measurement depends on Ff ")]
    assert bool(advice) == said


def test_intervals_end_at_bounds(case: Case, tmp_path: Path) -> None:
    """0.6 ± 0.98 N: from 0 N, which is said."""
    found = _found(case, "0 N", mean=0.6)
    assert found.intervals[FRICTION] == pytest.approx((0.0, 0.575 + 1.96 * 0.5), rel=1e-3)
    assert " bound 0.00 to 1.55 bound 0.00 to 1.5" in " ".join(found.summary.split())
    found.save(tmp_path, draw=False)
    head, row = (tmp_path / "values.csv").read_text(encoding="utf-8-sig").splitlines()
    assert row.split(",")[head.split(",").index("lower end of 95 %")] == "0"
    pytest.importorskip("plotly", reason="the extra report is not installed")
    page = rotordyn.write_report(tmp_path, tmp_path / "page.html").read_text(encoding="utf-8")
    assert "bound 0.00 to 1.55" in page


def test_a_limit_excuses_no_difference(case: Case) -> None:
    found = _found(case, "0 N", mean=-9.0)
    assert not found.sufficient
    assert "Ff is on a bound" in found.verdict[0]


def test_predictions_by_a_value_on_a_bound_have_no_interval(case: Case, tmp_path: Path) -> None:
    plain = replace(case, analyses={"preload": case.analyses["preload"]}, speeds=(24000.0 * RPM,))
    plain = rotordyn.vary(plain, {FRONT + "stop_travel": np.inf, FRONT + "friction": 0.0})
    speed, value = np.array([24000.0]) * RPM, np.array([2190.0])
    load = Numbers(
        name="load", of="preload: sum", speed=speed, values=value, deviation=20.0, unit="N"
    )
    asked = {REAR + "spring.preload": Unknown("560 N", "650 N", name="P")}
    found = identify(plain, asked, [load], predict=[Predicted("preload: sum")], workers=1)
    (one,) = found.predictions
    assert one.bound == ("P",)
    assert np.isnan([one.low, one.high]).all()
    assert "–, P on a bound" in found.summary
    found.save(tmp_path, draw=False)
    head, row = (tmp_path / "predictions.csv").read_text(encoding="utf-8-sig").splitlines()
    assert head == "name,unit,value,low,high,measured,on a bound"
    assert row.endswith(",,,,P")
    pytest.importorskip("plotly", reason="the extra report is not installed")
    page = rotordyn.write_report(tmp_path, tmp_path / "page.html").read_text(encoding="utf-8")
    assert "–, P on a bound" in page
