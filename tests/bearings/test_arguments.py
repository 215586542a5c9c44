"""Arguments of public functions are held against their annotations."""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction

import numpy as np
import pytest

from bearings import AngularContactBallBearing, InvalidBearing, Lubricant, Material, condition
from bearings.arguments import MOST, checked
from bearings.errors import shown
from bearings.fits import bearing_bore, interference
from bearings.life import basic_life, mean_life


@checked
def power(base: float, values: object, name: str = "", often: int = 1) -> float:
    return float(base) ** 8 * often


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: power("2", 0.0), "power: base must be a number, got '2'"),
        (lambda: power(True, 0.0), "base must be a number"),
        (lambda: power(Fraction(1, 2), 0.0), "base must be a number"),
        (lambda: power(10**400, 0.0), "base must be a number, got 1000"),
        (lambda: power(2.0, 0.0, name=b"x"), "name must be text"),
        (lambda: power(2.0, 0.0, often=1.5), "often must be a whole number"),
        (lambda: power(MOST, 0.0), "power: .* see the arguments"),
        (lambda: condition(3), "condition: state must be a BearingState, got 3"),
        (lambda: basic_life([1.0, "x"], 2.0), "rating must be numbers"),
        (lambda: basic_life(1.0, [1e60]), "load must be numbers"),
        (lambda: mean_life([1.0, 1.0], [1.0, 2.0, 3.0]), "mean_life: .* see the arguments"),
        (lambda: interference((0.0, 1e-6), (0.0,)), "bore must be two numbers"),
        (lambda: bearing_bore(0.06, 4), "grade must be text"),
        (lambda: Lubricant("x", 5e-6), "viscosity_40 must be a number"),
        (lambda: Lubricant(5e-6, 0.4e-6), "above 0.5 mm²/s, got 0.4 mm²/s: is the unit right"),
        (
            lambda: Lubricant(5e-6, 8e-6),
            "viscosity_100 8 mm²/s must be below viscosity_40, 5 mm²/s",
        ),
        (lambda: Material("m", 10**400, 0.3, 1.0), "young_modulus must be a finite number"),
        (
            lambda: Material("m", 2e11, -1.001, 7800.0),
            "poisson_ratio must lie above -1 and below 0.5",
        ),
        (lambda: Material("m", 210.0, 0.3, 7800.0), r"got 210 Pa \(did you mean 210 GPa\?\)"),
        (lambda: Material("m", 2.1e5, 0.3, 7800.0), r"210000 Pa \(did you mean 210 GPa\?\)"),
        (lambda: Material("m", 2e11, 0.3, 7.85), r"7.85 kg/m³ \(did you mean 7850 kg/m³\?\)"),
        (lambda: Material("m", 2e11, 0.3, 7.85e-9), r"did you mean 7850 kg/m³\?"),
        (lambda: Material("m", 2e11, 0.3, 0.284), r"did you mean 7861 kg/m³\?"),  # lb/in³
        (lambda: Material("m", 2e11, 0.3, 7800.0, 11.5), r"did you mean 1.15e-05 1/K\?"),
        (lambda: Material(3, 2e11, 0.3, 7800.0), "name must be text, got 3"),
        (lambda: AngularContactBallBearing(8.0, 0.07, 20, contact_angle=0.3), "mean 8 mm"),
        (lambda: AngularContactBallBearing(0.008, 0.07, 20, contact_angle=15.0), "mean 15°"),
    ],
)
def test_an_argument_that_makes_no_sense(call: Callable[[], object], words: str) -> None:
    with pytest.raises(InvalidBearing, match=words):
        call()


def test_arguments_that_do() -> None:
    assert power(np.float32(2.0), None, often=np.int64(2)) == 512.0
    assert np.isnan(basic_life([math.nan, 1e3], 1e2)[0])


def test_a_value_is_shown_on_one_short_line() -> None:
    assert shown("y" * 1000) == "'" + "y" * 56 + "..."
    assert shown(np.ones((3, 2, 2))).count("\n") == 0
    assert shown(10**5000) == "a very large int"
