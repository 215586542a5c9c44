"""Limits and fits as catalogues print them."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bearings import STEEL, InvalidBearing, fits
from bearings.fit.compound import Cylinder, compound


@pytest.mark.parametrize(
    ("tolerance", "size", "known"),
    [
        ("k5", 70, (2, 15)),
        ("js5", 70, (-6.5, 6.5)),
        ("h5", 70, (-13, 0)),
        ("H6", 110, (0, 22)),
        ("JS6", 110, (-11, 11)),
        ("JS5", 110, (-7.5, 7.5)),
        ("k5", 50, (2, 13)),
        ("K6", 110, (-18, 4)),
        ("j5", 75, (-7, 6)),
        ("h4", 80, (-8, 0)),
        ("h4", 80.001, (-10, 0)),
    ],
)
def test_limits_of_a_catalogue(tolerance: str, size: float, known: tuple[float, float]) -> None:
    """SKF's tables of shafts and housings, ISO 286; sizes over … up to and including."""
    found = fits.limits(tolerance, size * 1e-3)
    assert found == pytest.approx([1e-6 * value for value in known], abs=1e-12)


@pytest.mark.parametrize(
    ("tolerance", "known"),
    [
        ("M6", [(-17, -4), (-20, -4), (-24, -5), (-28, -6), (-33, -8), (-37, -8)]),
        ("M7", [(-21, 0), (-25, 0), (-30, 0), (-35, 0), (-40, 0), (-46, 0)]),
        ("N6", [(-24, -11), (-28, -12), (-33, -14), (-38, -16), (-45, -20), (-51, -22)]),
        ("N7", [(-28, -7), (-33, -8), (-39, -9), (-45, -10), (-52, -12), (-60, -14)]),
        ("P6", [(-31, -18), (-37, -21), (-45, -26), (-52, -30), (-61, -36), (-70, -41)]),
        ("P7", [(-35, -14), (-42, -17), (-51, -21), (-59, -24), (-68, -28), (-79, -33)]),
    ],
)
def test_holes_that_hold_outer_rings_tightly(
    tolerance: str, known: list[tuple[float, float]]
) -> None:
    """ISO 286-2, as in tables of housings: 18 to 30 mm, to 50, 80, 120, 180 and 250 mm."""
    for size, limits in zip((25, 40, 70, 110, 150, 200), known, strict=True):
        found = fits.limits(tolerance, size * 1e-3)
        assert found == pytest.approx([1e-6 * value for value in limits], abs=1e-12)


def test_fit_of_a_catalogue() -> None:
    """SKF, 70 k5 in a bore 0/−15: +30/+2, probable +26/+6 µm."""
    found = fits.interference(fits.limits("k5", 0.070), fits.bearing_bore(0.070))
    assert (found.most, found.least) == pytest.approx((30e-6, 2e-6))
    assert found.probable == pytest.approx((6e-6, 26e-6), abs=1e-6)
    assert found.reduced(3e-6).mean == pytest.approx(13e-6)


def test_probable_fits_lie_within_half_the_root_of_squared_tolerances() -> None:
    """Of 6 and 8 µm: 5 µm on either side of the mean."""
    found = fits.interference((11e-6, 17e-6), (-8e-6, 0.0))
    assert found.mean == pytest.approx(18e-6)
    assert found.probable == pytest.approx((13e-6, 23e-6))
    assert (found.least, found.most) == pytest.approx((11e-6, 25e-6))


def test_fit_of_another_catalogue() -> None:
    """NKE, 75 j5 in a bore 0/−15: 21 to −7, probable 12 µm."""
    shaft, bore = fits.limits("j5", 0.075), fits.bearing_bore(0.075)
    found = fits.interference(shaft, bore)
    assert (found.most, found.least) == pytest.approx((21e-6, -7e-6))
    assert fits.one_third(shaft, bore) == pytest.approx(12e-6, abs=0.5e-6)


def test_hollow_shafts_need_more_interference() -> None:
    """SKF: a 6208 on a shaft of bore ratio 0.8 needs 1.7 times the interference of a solid one;
    the ring's ratio of diameters, 0.77, is the one of SKF's chart."""
    bore, ring, step = 20e-3, 20e-3 / 0.77, 10e-6
    pressure = [
        float(
            compound(
                [Cylinder(hole * bore, bore, STEEL), Cylinder(bore, ring, STEEL)], [step]
            ).pressure[0]
        )
        for hole in (0.0, 0.8)
    ]
    assert pressure[0] / pressure[1] == pytest.approx(1.724, rel=2e-3)


def test_smoothing() -> None:
    assert fits.smoothing(2e-6, 3e-6) == pytest.approx(4e-6)
    assert fits.smoothing(0.8e-6, 0.4e-6, "NKE") == pytest.approx(0.48e-6)


def test_smoothing_takes_as_much_of_every_interference() -> None:
    whole = fits.Interference(-2e-6, 16e-6, 7e-6, (1e-6, 13e-6))
    less = whole.reduced(4e-6)
    assert less[:3] == pytest.approx((-6e-6, 12e-6, 3e-6))
    assert less.probable == pytest.approx((-3e-6, 9e-6))


def test_bearing_rings_of_the_normal_class() -> None:
    """A maker's table of deep-groove bearings, over … up to and including [mm], lower limits."""
    bores = {18: 8, 30: 10, 50: 12, 80: 15, 120: 20, 180: 25, 250: 30}
    outsides = {30: 9, 50: 11, 80: 13, 120: 15, 150: 18, 180: 25, 250: 30}
    for found, known in ((fits.bearing_bore, bores), (fits.bearing_outside, outsides)):
        for size, lower in known.items():
            at = found(size * 1e-3, "normal")
            assert at == found(size * 1e-3 - 1e-6, "normal") == pytest.approx((-lower * 1e-6, 0.0))


def test_bearing_rings() -> None:
    """Without a class both rings are normal ones."""
    assert fits.bearing_bore(0.07) == fits.bearing_bore(0.07, "normal")
    assert fits.bearing_outside(0.110) == fits.bearing_outside(0.110, "normal")
    assert fits.bearing_bore(0.07, "P4") == pytest.approx((-7e-6, 0.0))
    assert fits.bearing_outside(0.110, "P4") == pytest.approx((-8e-6, 0.0))
    assert fits.bearing_outside(0.140, "P4") == pytest.approx((-9e-6, 0.0))


def test_every_class_holds_its_grade() -> None:
    """Upper less lower deviation is the grade, in every size; grades and sizes widen it."""
    sizes = np.array([15, 25, 40, 60, 100, 150, 200]) * 1e-3
    for letter in (
        "f",
        "g",
        "h",
        "js",
        "k",
        "m",
        "n",
        "p",
        "F",
        "G",
        "H",
        "JS",
        "K",
        "M",
        "N",
        "P",
    ):
        width = [
            [high - low for low, high in (fits.limits(f"{letter}{it}", d) for d in sizes)]
            for it in (4, 5, 6, 7)
        ]
        assert (np.diff(width, axis=0) > 0.0).all()
        assert (np.diff(width, axis=1) > -1e-12).all()
        assert width == pytest.approx(
            np.array([[np.ptp(fits.limits(f"h{it}", d)) for d in sizes] for it in (4, 5, 6, 7)])
        )


@pytest.mark.parametrize(
    ("tolerance", "size", "word"),
    [
        ("q5", 0.07, "unknown tolerance class"),
        ("k9", 0.07, "unknown tolerance class"),
        ("5k", 0.07, "unknown tolerance class"),
        ("k3", 0.07, "grade 4"),
        ("N3", 0.07, "N is from grade 4"),
        ("j7", 0.07, "j5 and j6"),
        ("k5", 70.0, "tabulated above 10 mm"),
        ("k5", math.nan, "diameter must be a number, got nan"),
    ],
)
def test_unknown_classes_are_refused(tolerance: str, size: float, word: str) -> None:
    with pytest.raises(InvalidBearing, match=word):
        fits.limits(tolerance, size)
