"""Profiles against closed forms, and predictions over all models that survive."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

import rotordyn
from rotordyn import Predicted, Unknown, identify
from rotordyn.case.case import Case
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.job import solve
from rotordyn.study.identification.along_axis import RPM
from rotordyn.study.identification.identification import Identification
from rotordyn.study.identification.measurement import Data
from rotordyn.study.identification.profile import AT_BOUND, NO_MACHINE
from rotordyn.study.identification.trial import Trial
from rotordyn.study.optimum.criterion import Criterion
from tests.rotordyn.page.conftest import held

FRONT, REAR = "spindle.sleeves.front.", "spindle.sleeves.rear."
P1, P2 = FRONT + "spring.preload", REAR + "spring.preload"
ENDS = {P1: Unknown("100 N", "1000 N", name="P1"), P2: Unknown("100 N", "1000 N", name="P2")}
REPEATED = 10


@dataclass(frozen=True, eq=False)
class Preloads:
    """Closed form of both preloads, `a` and `b` [kN], each number read so many times.

    No machine lies in the ``gap``: above its first a, below its second, below its b.
    """

    form: str
    values: tuple[float, ...]
    noise: tuple[float, ...]
    scatter: float = 0.0
    gap: tuple[float, float, float] = (0.0, 0.0, 0.0)

    @property
    def data(self) -> Data:
        values = np.repeat(self.values, REPEATED)
        noise = np.repeat(self.noise, REPEATED)
        values = values + self.scatter * noise * np.tile([-1.0, 1.0], len(values) // 2)
        n = len(values)
        return Data("made up", values, noise, "N", 1.0, np.arange(n) * 1.0, "", ("",) * n)

    def faults(self, case: Case) -> Iterator[str]:
        yield from ()

    def speeds(self, case: Case) -> Iterator[float]:
        yield from ()

    def analyses(self, case: Case) -> dict[str, Any]:
        return {}

    def predicted(self, trial: Trial) -> np.ndarray[Any, np.dtype[np.float64]]:
        assert trial.case.spindle is not None
        a, b = (1e-3 * each.spring.preload for each in trial.case.spindle.sleeves)
        low, high, least = self.gap
        if low < a < high and b < least:
            raise NoSolution("no machine there")
        forms = {
            "linear": (a + b, a - 2.0 * b, 0.3 * a + b),
            "ratio": (a * b, b),
            "rear": (b, 2.0 * b),
            "square": (a * a, 0.0 * b),
        }
        return np.repeat(forms[self.form], REPEATED)


@pytest.fixture(scope="module")
def case() -> Case:
    return rotordyn.load("mfw2310_identification")


def solved(case: Case, measured: Preloads, unknowns: Any = ENDS, **given: Any) -> Identification:
    return identify(case, unknowns, [measured], workers=1, **{"profiles": "all"} | given)


@pytest.mark.parametrize("scatter", [0.0, 2.5])
def test_profile_of_a_linear_model_is_the_parabola(case: Case, scatter: float) -> None:
    """With the Birge factor of scattered points, and with a prior, too."""
    measured = Preloads("linear", (1.0, -0.5, 0.65), (0.05, 0.03, 0.02), scatter)
    unknowns = {P1: ENDS[P1], P2: replace(ENDS[P2], prior="480 N", deviation="15 N")}
    found = solved(case, measured, unknowns)
    sure = found.explained.sure
    assert (sure.birge > 2.0) == (scatter > 1.0)
    for k, profile in enumerate(found.profiles.values()):
        assert 7 <= len(profile.values) <= 11
        parabola = ((profile.values - sure.values[k]) / sure.deviation[k]) ** 2
        assert profile.excess == pytest.approx(parabola, rel=1e-4, abs=1e-4)
        assert profile.interval == pytest.approx(sure.interval[k], rel=1e-5)
        assert profile.why == ("", "")
    assert not any("profile" in line for line in found.verdict)


def test_profile_of_a_ratio_is_that_of_fieller(case: Case) -> None:
    """χ² of a where a·b and b are measured: (x − a y)²/(s² + a² t²) (E. Fieller, 1954)."""
    x, y, s, t = 0.08, 0.2, 0.005, 0.07
    found = solved(case, Preloads("ratio", (x, y), (s, t)))
    sure, profile = found.explained.sure, found.profiles[P1]
    s, t = s / REPEATED**0.5, t / REPEATED**0.5
    a = 1e-3 * profile.values
    assert profile.excess == pytest.approx((x - a * y) ** 2 / (s**2 + (a * t) ** 2), rel=1e-3)
    q = sure.quantile**2
    ends = np.roots([y * y - q * t * t, -2.0 * x * y, x * x - q * s * s])
    assert 1e-3 * np.array(profile.interval) == pytest.approx(np.sort(ends), rel=5e-3)
    off = np.abs(1e3 * np.sort(ends) - sure.interval[0]).max() / (0.5 * np.ptp(sure.interval[0]))
    assert off > 0.25
    line = next(line for line in found.verdict if "by profile departs" in line)
    assert "P1 by " in line
    assert "P2" not in line
    assert float(line.partition("P1 by ")[2].split(" %")[0]) == pytest.approx(100 * off, abs=2.0)


def test_profile_ends_at_a_bound(case: Case) -> None:
    """One unknown by its square: ends are √(x ± q s), or the bound."""
    unknowns = {P1: Unknown("300 N", "1000 N", name="P1")}
    found = solved(case, Preloads("square", (0.16, 0.0), (0.2, 0.1)), unknowns, profiles=["P1"])
    sure, profile = found.explained.sure, found.profiles[P1]
    half = sure.quantile * 0.2 / REPEATED**0.5
    assert profile.interval == pytest.approx((300.0, 1e3 * (0.16 + half) ** 0.5), rel=5e-3)
    assert profile.why == (AT_BOUND, "")
    assert "bound 300 to " in found.summary


def test_a_profile_goes_on_where_its_first_start_has_no_machine(case: Case) -> None:
    """The covariance leads b of a first step onto its lower end, where there is no machine."""
    s, t = 0.0174, 0.63
    unknowns = {P1: ENDS[P1], P2: Unknown("140 N", "1000 N", name="P2")}
    measured = Preloads("ratio", (0.08, 0.2), (s, t), gap=(0.0, 0.56, 0.141))
    found = solved(case, measured, unknowns, profiles=["P1"])
    profile, q = found.profiles[P1], found.explained.sure.quantile
    s, t = s / REPEATED**0.5, t / REPEATED**0.5
    a, b = np.linspace(0.5, 0.8, 1501), np.linspace(0.14, 0.2, 1501)[:, None]
    least = np.min(((0.08 - a * b) / s) ** 2 + ((0.2 - b) / t) ** 2, axis=0)
    assert 1e-3 * profile.interval[1] == pytest.approx(a[least < q * q].max(), rel=5e-3)
    assert profile.why[1] == ""


def test_a_profile_ends_near_the_last_machine(case: Case) -> None:
    """A first step of 60 N goes beyond 420 N, the last machine; its halves end near it."""
    unknowns = {P1: replace(ENDS[P1], start="380 N")}
    measured = Preloads("square", (0.16, 0.0), (0.25, 0.1), gap=(0.42, 1.0, 1.0))
    found = solved(case, measured, unknowns)
    profile = found.profiles[P1]
    assert profile.why[1] == NO_MACHINE
    assert profile.interval[1] == pytest.approx(420.0, abs=3.0)
    assert any(line.endswith("N: no machine found beyond") for line in found.verdict)


def test_profiles_are_written_and_drawn(case: Case, tmp_path: Path) -> None:
    found = solved(case, Preloads("ratio", (0.08, 0.2), (0.005, 0.06)), profiles=[P1])
    found.save(tmp_path, draw=False)
    assert [*found.profiles] == [P1]
    assert "profiles" in found.figures
    assert len(found.plot("profiles").axes) == 1
    profile = found.profiles[P1]
    with xr.open_dataset(tmp_path / "identification.nc", engine="h5netcdf") as data:
        assert data.profile_interval[0].values == pytest.approx(profile.interval)
        assert np.isnan(data.profile_interval[1]).all()
        assert data.profile_excess.values == pytest.approx(profile.excess)
        assert {*data.profile_unknown.values.tolist()} == {P1}
    lines = (tmp_path / "profiles.csv").read_text(encoding="utf-8").splitlines()
    assert len(lines) - 1 == len(profile.values)
    head, first, second = (tmp_path / "values.csv").read_text(encoding="utf-8").splitlines()
    place = head.split(",").index("upper end by profile")
    assert float(first.split(",")[place]) == pytest.approx(profile.interval[1], rel=1e-6)
    assert second.split(",")[place] == ""
    pytest.importorskip("plotly", reason="the extra report is not installed")
    page = rotordyn.write_report(tmp_path, tmp_path / "page.html").read_text(encoding="utf-8")
    assert "Models by evidence" not in page
    chart = next(c for c in held(page)[0].values() if c["controls"])
    assert [trace["name"] for trace in chart["traces"]] == ["profile", "linear", "95 %"]
    assert chart["traces"][0]["moving"]["y"][0] == pytest.approx(profile.excess, abs=1e-5)


def test_profiles_that_cannot_be(case: Case) -> None:
    measured = Preloads("ratio", (0.08, 0.2), (0.005, 0.06))
    with pytest.raises(InvalidInput, match="profiles: no unknown 'P3'; allowed: all, P1, P2"):
        solved(case, measured, profiles=["P3"])
    with pytest.raises(InvalidInput, match="need minimise: squares; given minimise: absolute"):
        solved(case, measured, minimise="absolute")


def test_predictions_range_over_all_models_that_survive(case: Case) -> None:
    """Loads of machines with either front preload, which the measurement does not determine."""
    plain = replace(case, analyses={"preload": case.analyses["preload"]}, speeds=(24000.0 * RPM,))
    plain = rotordyn.vary(plain, {FRONT + "stop_travel": np.inf})
    measured = Preloads("rear", (0.528, 1.056), (0.1, 0.1))
    asked = {P2: ENDS[P2]}
    wanted = [Predicted("preload: sum", name="load"), Predicted("preload: stop front")]
    given: dict[str, Any] = dict(predict=wanted, workers=1)
    both = identify(plain, asked, [measured], hypotheses={P1: ["574 N", "620 N"]}, **given)
    assert len(both.surviving) == 2
    alone = [
        Criterion("preload: sum").read(each.case, solve(each.case).results).values[0]
        for each in both.models
    ]
    values = sorted(alone)
    assert values[1] > values[0] * 1.0001
    one, none = both.predictions
    assert np.isnan([none.value, none.least, none.most]).all()
    assert "no preload: stop front" not in both.summary
    assert (one.least, one.most) == pytest.approx(values, rel=1e-6)
    assert f"{values[0]:.4g} to {values[1]:.4g}" in both.summary
    assert both.dataset().predicted_most.values[0] == pytest.approx(values[1], rel=1e-6)
