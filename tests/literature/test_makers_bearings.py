"""Bearings whose balls a maker prints: what he prints of them beside what their models give."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest

import rotordyn
from bearings import STEEL, estimate
from bearings.catalogue.races import static_rating
from bearings.life.rating import Insides, rating
from rotordyn.case.library import known, models_root

SOURCES = {
    name: " ".join((models_root() / "bearings" / f"{name}.yaml").read_text("utf-8").split())
    for name in known("bearings")
}
PRINTED = [name for name, text in SOURCES.items() if "balls" in text and "as printed" in text]
RATED = [name for name in PRINTED if "Conformities: bearings.estimate" in SOURCES[name]]
PAIRS = [name for name in PRINTED if "axial rigidities of a pair" in SOURCES[name]]


def _numbers(text: str) -> list[float]:
    return [float(number) for number in text.split(", ")]


def test_library_has_makers_bearings_of_several_series() -> None:
    assert len(PRINTED) >= 40
    series = {re.sub(r"\d\d?e?$", "", name.replace("vex100", "vex00")) for name in PRINTED}
    assert {"kh60", "kh619", "s60", "s619", "vex"} <= series


@pytest.mark.parametrize("name", PAIRS)
def test_rigidity_of_a_pair_is_as_printed(name: str) -> None:
    """GMN, catalogue 4000 0813 EN; twice the stiffness of one bearing at the preload."""
    found = re.search(r"of a pair ([\d., ]+) N/um at ([\d., ]+) N;", SOURCES[name])
    assert found
    bearing = rotordyn.model("bearings", name)
    preloads = _numbers(found[2])
    load = np.zeros((len(preloads), 5))
    load[:, 0] = preloads
    stiffness = bearing.equilibrium(load=load).complete_stiffness[:, 0, 0]
    assert 2.0 * stiffness * 1e-6 == pytest.approx(_numbers(found[1]), rel=0.035)


@pytest.mark.parametrize("name", RATED)
def test_ratings_are_as_printed(name: str) -> None:
    """C by ISO 281 and C0 by ISO 76 from the grooves, steel balls."""
    found = re.search(r"C ([\d ]+) N,? (?:and )?C0 ([\d ]+) N", SOURCES[name])
    assert found
    bearing = rotordyn.model("bearings", name)
    x = Insides(
        np.array(bearing.ball_diameter),
        np.array(bearing.balls),
        np.array(bearing.pitch_diameter),
        np.array(bearing.inner_conformity),
        np.array(bearing.outer_conformity),
        bearing.contact_angle,
    )
    dynamic, static = (float(number.replace(" ", "")) for number in found.groups())
    assert float(rating(x)) == pytest.approx(dynamic, rel=0.08)
    assert float(static_rating(x, STEEL, STEEL)) == pytest.approx(static, rel=0.04)


@pytest.mark.long
def test_estimates_predict_what_is_printed_at_other_preloads() -> None:
    """Rings, C0 and the medium class given, as if balls were not printed: the rigidity at the
    other two, and the ball diameter."""
    errors, balls = [], []
    for name in PAIRS:
        text, bearing = SOURCES[name], rotordyn.model("bearings", name)
        rigidity, preload = re.search(r"of a pair ([\d., ]+) N/um at ([\d., ]+) N;", text).groups()  # type: ignore[union-attr]
        static = re.search(r"C0 ([\d ]+) N", text)
        assert static
        printed, at = np.array(_numbers(rigidity)) * 1e6, _numbers(preload)
        bore, outside = (
            float(re.search(rf"{key}: ([\d.]+) mm", text)[1]) * 1e-3  # type: ignore[index]
            for key in ("bore_diameter", "outside_diameter")
        )
        found = estimate(
            bore=bore,
            outside_diameter=outside,
            contact_angle=bearing.contact_angle,
            hybrid=False,
            preloads=at[1:2],
            rigidities=list(printed[1:2]),
            static_rating=float(static[1].replace(" ", "")),
        )
        errors += [abs(found.pair(at[k])[0] / printed[k] - 1.0) for k in (0, 2)]
        balls.append(abs(found.ball_diameter / bearing.ball_diameter - 1.0))
    assert len(errors) >= 70
    assert np.median(errors) < 0.01
    assert np.percentile(errors, 95) < 0.03
    assert max(errors) < 0.06
    assert np.median(balls) < 0.001
    assert max(balls) < 0.15


@pytest.mark.parametrize("name", [name for name in PAIRS if name.startswith("s6")])
def test_shoulders_hold_the_contact(name: str) -> None:
    """The printed shoulders lie beyond the contact angle, as the grooves are estimated."""
    inner, outer = rotordyn.model("bearings", name).grooves.shoulder_angles
    assert math.radians(30.0) < inner < math.radians(60.0)
    assert math.radians(30.0) < outer < math.radians(60.0)
