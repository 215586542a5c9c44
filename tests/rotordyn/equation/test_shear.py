"""Shear coefficients at their published limits."""

from __future__ import annotations

import numpy as np
import pytest

from rotordyn.equation.elements.shear import cowper, hutchinson, shear_coefficient
from rotordyn.errors import InvalidInput


def test_solid_circle() -> None:
    assert cowper(0.3, 0.0) == pytest.approx(0.886364, abs=5e-7)
    assert hutchinson(0.3, 0.0) == pytest.approx(0.925182, abs=5e-7)


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.49])
def test_thin_tube(nu: float) -> None:
    assert cowper(nu, 1.0) == pytest.approx(2 * (1 + nu) / (4 + 3 * nu))
    assert hutchinson(nu, 1.0) == pytest.approx((1 + nu) / (2 + nu))


@pytest.mark.parametrize("formula", [cowper, hutchinson])
def test_falls_with_the_bore(formula) -> None:
    values = formula(0.3, np.linspace(0.0, 1.0, 21))
    assert (np.diff(values) < 0).all()


def test_choice() -> None:
    ratio = np.array([0.0, 0.5])
    assert shear_coefficient("cowper", 0.3, ratio) == pytest.approx(cowper(0.3, ratio))
    assert shear_coefficient("hutchinson", 0.3, ratio) == pytest.approx(hutchinson(0.3, ratio))
    assert shear_coefficient(0.9, 0.3, ratio).tolist() == [0.9, 0.9]


@pytest.mark.parametrize("choice", ["timoshenko", 0.0, -1.0, float("nan"), float("inf")])
def test_refused(choice: str | float) -> None:
    with pytest.raises(InvalidInput, match="shear coefficient"):
        shear_coefficient(choice, 0.3, 0.0)
