"""Values that stand where their quantity ends, or where the study does."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

import rotordyn
from rotordyn import Unknown, identify
from rotordyn.case.case import Case
from rotordyn.study.identification.identification import Identification
from rotordyn.study.identification.trial import Trial
from tests.rotordyn.study.axial_twin import FRONT, Array
from tests.rotordyn.study.made_up import MadeUp

FRICTION = FRONT + "friction"


@dataclass(frozen=True, eq=False)
class Friction(MadeUp):
    """Friction of the front sleeve [N], read several times."""

    def predicted(self, trial: Trial) -> Array:
        assert trial.case.spindle is not None
        return np.full(len(self.observed), trial.case.spindle.sleeves[0].friction)


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


def test_a_limit_excuses_no_difference(case: Case) -> None:
    found = _found(case, "0 N", mean=-9.0)
    assert not found.sufficient
    assert "Ff stands on a bound" in found.verdict[0]
