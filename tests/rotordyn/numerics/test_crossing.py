"""Zeros of sampled curves."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotordyn.numerics.crossing import above_zero, zero_crossings


@given(st.floats(-2.2, 2.2))
def test_cubic_is_met_exactly_away_from_the_ends(zero: float) -> None:
    x = np.linspace(-3.0, 3.0, 9)
    y = (x - zero) * (1.0 + 0.2 * (x + 1.0) ** 2)
    assert zero_crossings(x, y) == pytest.approx([zero], abs=1e-9)


def test_fourth_order_in_the_step() -> None:
    errors = []
    for count in (9, 17, 33):
        x = np.linspace(0.0, 3.0, count) + 0.01
        found = zero_crossings(x, np.cos(x))
        errors.append(abs(found[0] - np.pi / 2))
    assert errors[0] / errors[1] > 8
    assert errors[1] / errors[2] > 8


def test_several_zeros_ascend() -> None:
    x = np.linspace(0.1, 10.0, 200)
    expected = np.pi * np.array([1, 2, 3])
    assert zero_crossings(x, np.sin(x)) == pytest.approx(expected, abs=1e-6)


def test_no_zero() -> None:
    assert zero_crossings(np.arange(5.0), np.ones(5)) == []


@pytest.mark.parametrize("zero", [0.0, 2.0, 4.0])
def test_zero_on_a_sample_counts_once(zero: float) -> None:
    x = np.arange(5.0)
    assert zero_crossings(x, x - zero) == pytest.approx([zero])


@pytest.mark.parametrize("gap", [np.nan, np.inf, -np.inf])
def test_gap_interrupts_the_curve(gap: float) -> None:
    x = np.arange(6.0)
    y = np.array([1.0, 0.5, gap, -0.5, -1.0, 1.0])
    assert zero_crossings(x, y) == pytest.approx([4.5], abs=0.2)


def test_two_samples_are_a_line() -> None:
    assert zero_crossings(np.array([0.0, 1.0]), np.array([1.0, -3.0])) == pytest.approx([0.25])


@pytest.mark.parametrize("twice", range(2, 6))
@pytest.mark.filterwarnings("error")
def test_samples_that_differ_in_the_last_digit_are_one(twice: int) -> None:
    """Beside the interval, at either of its ends, or the zero between them."""
    x = np.arange(1.0, 8.0)
    y = (x - 4.4) * (1.0 + 0.2 * (x + 1.0) ** 2)
    x = np.insert(x, twice + 1, np.nextafter(x[twice], np.inf))
    y = np.insert(y, twice + 1, y[twice])
    assert zero_crossings(x, y) == pytest.approx([4.4], abs=1e-9)
    assert above_zero(x, y)[0] == pytest.approx([4.4, 7.0], abs=1e-9)
    met = np.array([1.0, 2.0, np.nextafter(2.0, 3.0), 3.0])
    assert zero_crossings(met, np.array([-3.0, -1.0, 1.0, 3.0])) == pytest.approx([2.0])
