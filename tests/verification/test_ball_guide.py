"""Linear ball guides: force law against a plain sum, the published stiffness, sleeves in them."""

from __future__ import annotations

import math
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import rotordyn
from bearings import SILICON_NITRIDE, STEEL, InvalidBearing, LinearBallGuide
from rotordyn.analyses import BearingLoadsSpec
from rotordyn.analyses.bearing_loads import solve as bearing_loads
from rotordyn.errors import InvalidInput
from rotordyn.machine import BallGuide
from rotordyn.scene.loads import PointLoad
from rotordyn.scene.scene import Scene
from rotordyn.scene.warnings import _guides
from tests.oracles.spindles import RPM, conditions, mfw2310

GUIDE = LinearBallGuide(250, 4e-3, 0.1, 4e-6)


def point_stiffness(guide: LinearBallGuide, side: float) -> float:
    """k of a ball on a cylinder from the integrals of Hertz, solved for the ellipse by bisection.

    Johnson, *Contact Mechanics*, 4.26–4.28: (A, B) of the undeformed gap, e² = 1 − (b/a)².
    """
    from scipy.integrate import quad
    from scipy.optimize import brentq

    ball, d = guide.ball_diameter / 2.0, guide.column_diameter / 2.0
    curvature = 1.0 / d if side > 0.0 else -1.0 / (d + 2.0 * ball)
    small, large = sorted((0.5 / ball, 0.5 * (1.0 / ball + curvature)))
    modulus = 1.0 / (
        guide.ball_material.contact_compliance + guide.column_material.contact_compliance
    )

    def integrals(b: float) -> tuple[float, float, float]:
        """With a = 1: of the approach, and of both curvatures."""

        def over(f: Any) -> float:
            return float(quad(f, 0.0, math.pi / 2.0)[0])

        e2 = 1.0 - b**2
        k = over(lambda t: 1.0 / math.sqrt(1.0 - e2 * math.sin(t) ** 2))
        along = over(lambda t: math.sin(t) ** 2 / math.sqrt(1.0 - e2 * math.sin(t) ** 2))
        across = over(lambda t: math.cos(t) ** 2 / (1.0 - e2 * math.cos(t) ** 2) ** 1.5)
        return k, along, across

    def ratio(b: float) -> float:
        _, along, across = integrals(b)
        return across / along - large / small

    b = brentq(ratio, 0.3, 1.0 - 1e-9)
    k, along, _ = integrals(b)
    # p0 (1 − x² − y²/b²)^½ moves the surface by p0 b (k − along x² − …)/E*; load 2 π p0 b a²/3
    a = 1.0
    p0 = small / along * modulus / b * a
    load, approach = 2.0 * math.pi * p0 * b / 3.0, p0 * b * k / modulus
    return float(load / approach**1.5)


def test_contacts_are_those_of_hertz() -> None:
    for ball in (STEEL, SILICON_NITRIDE):
        guide = LinearBallGuide(60, 5e-3, 0.06, 3e-6, ball)
        sides = [point_stiffness(guide, side) ** (-2.0 / 3.0) for side in (1.0, -1.0)]
        assert guide.contact_stiffness == pytest.approx(sum(sides) ** -1.5, rel=1e-6)


def test_published_stiffness_with_plausible_dimensions() -> None:
    """896 N/µm at 4 µm (Noël 2013, chapter IV); 250 balls of 4 mm on 100 mm are ours."""
    assert GUIDE.stiffness == pytest.approx(896e6, rel=2e-3)


def test_stiffness_at_the_centre() -> None:
    slope = (GUIDE.force(1e-9) - GUIDE.force(-1e-9)) / 2e-9
    assert slope == pytest.approx(GUIDE.stiffness, rel=1e-6)
    assert GUIDE.tangent(0.0) == pytest.approx(GUIDE.stiffness, rel=1e-12)


@pytest.mark.parametrize("interference", [4e-6, 0.0, -3e-6])
def test_force_is_the_sum_over_balls(interference: float) -> None:
    guide = LinearBallGuide(9, 4e-3, 0.1, interference)
    moved = np.array([-9e-6, -2e-6, 1e-8, 1e-6, 2.5e-6, 12e-6])
    for place, found in zip(moved, guide.force(moved), strict=True):
        total = 0.0
        for ball in range(9):
            cosine = math.cos(2.0 * math.pi * ball / 9)
            pressed = place * cosine + interference
            if pressed > 0.0:
                total += guide.contact_stiffness * pressed**1.5 * cosine
        assert found == pytest.approx(total, rel=1e-12, abs=1e-9)
    steps = (guide.force(moved + 1e-10) - guide.force(moved - 1e-10)) / 2e-10
    assert np.allclose(guide.tangent(moved), steps, rtol=1e-5, atol=10.0)


def test_linear_range() -> None:
    s = GUIDE.interference
    secant = GUIDE.force(np.array([0.5, 1.0]) * s) / (np.array([0.5, 1.0]) * s) / GUIDE.stiffness
    assert secant == pytest.approx([1.0 - 0.008, 1.0 - 0.04], abs=0.001)
    assert GUIDE.linear_range() == pytest.approx(0.55 * s, rel=0.01)
    assert GUIDE.linear_range(0.04) == pytest.approx(1.0 * s, rel=0.02)
    assert GUIDE.linear_range(0.9) == 2.0 * s  # as far as it is looked for


def test_clearance_is_free_until_it_is_taken_up() -> None:
    guide = LinearBallGuide(250, 4e-3, 0.1, -3e-6)
    assert guide.stiffness == guide.linear_range() == 0.0
    assert (guide.force(np.array([-2.9e-6, 0.0, 2.9e-6])) == 0.0).all()
    assert guide.force(5e-6) > 0.0 > guide.force(-5e-6)


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ((2, 4e-3, 0.1, 4e-6), "from 3 up"),
        ((9, 0.0, 0.1, 4e-6), "above 0"),
        ((9, 4e-3, 0.1, 4e-3), "4000 µm must be far below the balls' diameter, 4 mm"),
    ],
)
def test_impossible_guides(values: Any, sentence: str) -> None:
    with pytest.raises(InvalidBearing, match=sentence):
        LinearBallGuide(*values)


def test_sleeve_in_a_guide_is_one_on_its_stiffness() -> None:
    """Same modes as with the stiffness written by hand; softer than a rigid bore."""
    case = rotordyn.load("mfw2310_ball_guide").variants["rigid_bore"]
    case = case.vary({"speeds": ["0 rpm", "12000 rpm"]})
    size = BallGuide(250, 4e-3, 0.1, 4e-6)
    guide = case.vary({"spindle.sleeves.rear.ball_guide": size})
    spring = case.vary({"spindle.sleeves.rear.radial_stiffness": GUIDE.stiffness})
    rigid, first, second = (
        rotordyn.run(each)["campbell"].frequency.values for each in (case, guide, spring)
    )
    assert np.allclose(first, second, rtol=1e-12, equal_nan=True)
    assert first[0, 0] < 0.95 * rigid[0, 0]
    assert "ball guide 894.7 N/µm, within 1 % up to 2.2 µm" in rotordyn.run(guide).summary


@pytest.mark.parametrize(("interference", "said"), [(1e-6, True), (10e-6, False)])
def test_a_guide_far_from_its_centre_is_reported(interference: float, said: bool) -> None:
    """Where the plain sum over its balls is the force of its bearings, and the slope there."""
    rear = BallGuide(250, 4e-3, 0.1, interference)
    machine = mfw2310()
    sleeves = tuple(replace(s, ball_guide=rear) if s.name == "rear" else s for s in machine.sleeves)
    (behind,) = [sleeve for sleeve in sleeves if sleeve.ball_guide]
    machine = replace(machine, sleeves=sleeves)
    at = [seat.x for seat in machine.seats if seat.name in behind.bearings]
    pushed = [PointLoad(x, Fy=350.0, Fz=100.0) for x in at]
    scene = Scene(machine, conditions(loads=tuple(pushed)), np.array([0.0]))
    scene.preload  # noqa: B018 - warnings speak of what was solved
    told = [each for each in scene.warnings if "ball guide carries" in each]
    assert bool(told) == said
    if not said:
        return
    found = bearing_loads.solve(scene, BearingLoadsSpec())
    of_guide = np.isin(found.bearing, behind.bearings)
    across = found.radial_load[0] * np.exp(1j * found.load_angle[0])
    force = abs(across[of_guide].sum())
    way = np.linspace(0.0, 10.0, 20001)[:, None] * interference
    cosine = np.cos(2.0 * np.pi * np.arange(250) / 250)
    pressed = np.maximum(way * cosine + interference, 0.0)
    sums = rear.law.contact_stiffness * (pressed**1.5 * cosine).sum(axis=1)
    row = int(np.searchsorted(sums, force))
    slope = (sums[row] - sums[row - 1]) / (way[row, 0] - way[row - 1, 0])
    assert f"carries {force:.0f} N across at 0 rpm" in told[0]
    mean = sums[row] / way[row, 0]
    assert f"deflects by {way[row, 0] * 1e6:.3g} µm ({mean / 1e6:.3g}"[:-1] in told[0]
    assert f"and has {slope / 1e6:.3g}"[:-1] in told[0]


def test_the_speed_at_which_a_guide_is_farthest_off_is_reported() -> None:
    """Under 1.7 kN it is not off at all, in between that of the centre; loads of bearings that
    face one another are summed up in one frame."""
    guide, half = BallGuide(250, 4e-3, 0.1, 1e-6), np.array([300.0, 850.0, 450.0]) / math.sqrt(2.0)
    load = np.zeros((3, 1, 5))
    load[..., 1] = load[..., 2] = half[:, None]
    seats = [SimpleNamespace(name=name, thrust=thrust) for name, thrust in (("d", 1), ("e", -1))]
    turned = load * np.array([-1.0, 1.0, -1.0, 1.0, -1.0])  # about y, as a seat of thrust −1 counts

    def told(rows: list[int]) -> list[str]:
        preload = SimpleNamespace(
            lateral=True,
            speed=np.arange(3.0)[rows] * RPM * 1e3,
            usable=np.ones(len(rows), dtype=bool),
            seat_states=lambda: [(SimpleNamespace(load=x[rows]), 0) for x in (load, turned)],
        )
        (rear,) = (sleeve for sleeve in mfw2310().sleeves if sleeve.name == "rear")
        sleeve = replace(rear, ball_guide=guide)
        spindle = SimpleNamespace(sleeves=(sleeve,), seats=seats)
        return [*_guides(SimpleNamespace(preload=preload, spindle=spindle))]  # type: ignore[arg-type]

    assert not told([1])
    (said,) = told([0, 1, 2])
    assert "carries 600 N across at 0 rpm" in said
    assert "carries 900 N across at 2000 rpm" in told([1, 2])[0]


def test_guides_that_hold_nothing_or_too_much() -> None:
    with pytest.raises(InvalidInput, match="without interference has no stiffness"):
        BallGuide(250, 4e-3, 0.1, 0.0)
    with pytest.raises(InvalidInput, match="below a tenth of"):
        BallGuide(250, 1e-3, 0.1, 5e-4)
    rear = {"spindle.sleeves.rear.ball_guide": BallGuide(250, 4e-3, 0.1, 4e-6)}
    case = rotordyn.load("mfw2310").vary(rear)
    with pytest.raises(InvalidInput, match="given beside ball_guide"):
        case.vary({"spindle.sleeves.rear.radial_stiffness": 1e8})
    assert mfw2310().sleeves[1].radially == math.inf
