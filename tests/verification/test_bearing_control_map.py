"""Boundaries of race control: the criterion flips there, and they scale as mechanics says."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.special import ellipe

from bearings import AngularContactBallBearing, InvalidBearing
from bearings.ball.law import Law
from rotordyn.analyses.control.control_map import (
    LEVELS,
    ControlMap,
    control_map,
    quadratic,
    resting_weight,
)
from tests.oracles.ball_bearing import BallBearingOracle
from tests.oracles.idealised import times
from tests.oracles.known_bearings import HARRIS_218, HYPOTHESES, RPM, VEX70, VEX70_IDENTIFIED
from tests.oracles.known_grooves import QJ218, four_point

CLOSE = replace(VEX70, inner_conformity=0.52)
CLOSER = replace(VEX70, inner_conformity=0.51)
SPEED = np.array([5000.0, 15000.0, 30000.0]) * RPM


def mapped(bearing: AngularContactBallBearing, **how: Any) -> ControlMap:
    return control_map(bearing, **({"speed": SPEED, "lowest": 10.0, "highest": 20000.0} | how))


@pytest.mark.parametrize(
    ("kinematics", "radial"), [*((k, 0.0) for k in HYPOTHESES), ("inner", 0.2), ("outer", 0.2)]
)
def test_control_changes_at_the_boundary(kinematics: str, radial: float) -> None:
    """A part in ten million above and below: the race controls every loaded ball on one side."""
    found = mapped(CLOSE, law=Law(kinematics), radial=radial)
    assert (found.absence == "").all()
    for race, above, loads in zip(("inner", "outer"), (True, False), found.boundary, strict=True):
        for speed, load in zip(SPEED, loads, strict=True):
            for side in (-1e-7, 1e-7):
                force = np.array([1.0, radial, 0.0]) * load * (1.0 + side)
                state = CLOSE.equilibrium(
                    load=[*force, None, None],
                    displacement=[None, None, None, 0, 0],
                    speed=speed,
                    kinematics=kinematics,
                )
                words = set(state.control[state.inner_load > 0.0])
                assert (words == {race}) == ((side > 0.0) == above)
    assert (found.boundary[0] > found.boundary[1]).all()


@pytest.mark.parametrize("kinematics", ["inner", "outer"])
def test_an_independent_model_finds_control_change_there(kinematics: str) -> None:
    found = mapped(CLOSE, law=Law(kinematics))
    oracle = BallBearingOracle(CLOSE, kinematics=kinematics)
    stiffer = oracle.inner.a1 * oracle.inner.e / (oracle.outer.a1 * oracle.outer.e)
    for race in (0, 1):
        s = oracle.from_load([found.boundary[race, 2], 0, 0, 0, 0], SPEED[2], free="x")
        weight = (s.inner_load / s.outer_load) ** (4 / 3) * stiffer
        turned = np.cos(s.inner_angle - s.outer_angle)
        margin = (weight * turned - 1.0, turned - weight)[race]
        assert np.abs(margin).max() < 1e-6


@pytest.mark.parametrize(
    ("bearing", "semi_axes", "ellipticities"),
    [  # of both contacts under 1000 N each: tabulated, after Hertz with exact integrals
        (VEX70, (0.84789, 0.97519), (4.59067, 5.12926)),
        (HARRIS_218, (1.74430, 1.70636), (8.15514, 6.89741)),
    ],
)
def test_at_rest_the_contacts_alone_decide(
    bearing: AngularContactBallBearing,
    semi_axes: tuple[float, float],
    ellipticities: tuple[float, float],
) -> None:
    """C = ai Ei/(ao Eo) under equal loads, E the integral of modulus 1 − κ⁻²."""
    inner, outer = (
        a * ellipe(1.0 - k**-2.0) for a, k in zip(semi_axes, ellipticities, strict=True)
    )
    assert resting_weight(bearing) == pytest.approx(inner / outer, rel=2e-5)
    expected = "inner" if inner > outer else "outer"
    state = bearing.equilibrium(load=[1000.0, 0, 0, 0, 0])
    assert set(state.control) == {expected}
    found = mapped(bearing, speed=[0.0])
    inner_at, outer_at = ("every", "no") if expected == "inner" else ("no", "every")
    assert found.absence[:, 0].tolist() == [
        f"inner race controls at {inner_at} load that has a solution",
        f"outer race controls at {outer_at} load that has a solution",
    ]
    assert np.isnan(found.boundary).all()
    assert (found.changes == 0).all()


def test_heavy_loads_tend_to_the_weight_at_rest() -> None:
    """Qi/Qo and the cosine of the angles tend to 1: the margins to those of rest, as 1/F."""
    found = mapped(VEX70_IDENTIFIED, speed=[5000.0 * RPM], lowest=1e4, highest=1e5)
    rest = resting_weight(VEX70_IDENTIFIED)
    gap = rest - 1.0 - found.inner_margin[0, [0, -1]]
    assert (gap > 0.0).all()
    assert 5.0 < gap[0] / gap[1] < 12.0


def test_no_boundary_where_the_outer_race_has_the_larger_contact() -> None:
    """C < 1 at rest, and centrifugal force lowers it: the inner race never controls."""
    for kinematics in HYPOTHESES:
        found = mapped(VEX70, law=Law(kinematics))
        assert set(found.absence[0]) == {"inner race controls at no load that has a solution"}
        assert set(found.absence[1]) == {"outer race controls at every load that has a solution"}
        assert np.isnan(found.boundary).all()
        assert np.isnan(found.pressure).all()


@pytest.mark.few(2)
@pytest.mark.parametrize("kinematics", HYPOTHESES)
def test_boundary_scales_with_the_square_of_speed_where_mechanics_does(kinematics: str) -> None:
    """ω and √(1/ρ) or √E together change nothing but the unit of force: exact."""
    reference = mapped(CLOSE, law=Law(kinematics)).boundary
    light = replace(CLOSE.ball_material, density=CLOSE.ball_material.density / 4.0)
    same = mapped(
        replace(CLOSE, ball_material=light), speed=2.0 * SPEED, law=Law(kinematics)
    ).boundary
    assert same == pytest.approx(reference, rel=1e-8)
    ball, ring = (times(m, young_modulus=4.0) for m in (CLOSE.ball_material, CLOSE.ring_material))
    stiff = mapped(
        replace(CLOSE, ball_material=ball, ring_material=ring),
        speed=2.0 * SPEED,
        lowest=40.0,
        highest=80000.0,
        law=Law(kinematics),
    ).boundary
    assert stiff == pytest.approx(4.0 * reference, rel=1e-8)


def test_slow_boundary_is_quadratic_up_to_the_power_of_hertz() -> None:
    """F/ω² tends to a limit, where contacts no longer give; its gap falls as δ ∝ ω^(4/3)."""
    speed = 400.0 * RPM * 2.0 ** np.arange(4)
    found = mapped(CLOSE, speed=speed, lowest=0.1, highest=1000.0)
    ratio = found.boundary / speed**2
    gaps = np.diff(ratio, axis=1)
    assert gaps[:, 1:] / gaps[:, :-1] == pytest.approx(np.full((2, 2), 2 ** (4 / 3)), rel=0.02)


def test_quadratic_fit_leaves_what_is_orthogonal_to_it() -> None:
    """(−1, 3, −3, 1) over four even speeds is orthogonal to every quadratic."""
    speed = np.array([1000.0, 2000.0, 3000.0, 4000.0])
    load = 3e-4 * speed**2 - 0.02 * speed + 5.0
    fit, misfit = quadratic(speed, load + 0.1 * np.array([-1.0, 3.0, -3.0, 1.0]))
    assert fit == pytest.approx([3e-4, -0.02, 5.0], rel=1e-9)
    assert misfit == pytest.approx(0.3, rel=1e-9)


def test_the_highest_of_several_changes_is_the_boundary() -> None:
    """Steep inner angles of light loads take control from the outer race as well."""
    found = mapped(replace(CLOSER, outer_conformity=0.56), law=Law("inner"), speed=[2094.0])
    assert found.changes[:, 0].tolist() == [3, 2]
    assert (found.absence == "").all()
    margins = np.array([found.inner_margin, -found.outer_margin])
    assert ((margins[..., :-1] < 0.0) & (margins[..., 1:] > 0.0)).sum(axis=-1).max() == 2
    for margin, boundary in zip(margins[:, 0], found.boundary[:, 0], strict=True):
        heavier = found.load > boundary
        assert (margin[heavier] > 0.0).all()
        assert margin[~heavier][-1] < 0.0


def test_a_boundary_lies_between_its_levels_and_light_loads_may_have_no_state() -> None:
    found = mapped(CLOSE, law=Law("inner"))
    lost = found.outcome != ""
    assert lost[2, 0]
    assert not lost[:, -1].any()
    assert np.isnan(found.inner_margin[lost]).all()
    assert np.isfinite(found.outer_margin[~lost]).all()
    nothing = mapped(CLOSE, law=Law("inner"), lowest=1.0, highest=2.0, speed=[SPEED[2]])
    assert nothing.absence.tolist() == [["no equilibrium"], ["no equilibrium"]]
    assert np.isnan(nothing.boundary).all()


def test_work_does_not_grow_with_speeds(monkeypatch: pytest.MonkeyPatch) -> None:
    """One solve for the levels, one for the pressures, one per step of the root: at most ten."""
    solves: list[int] = []
    original = AngularContactBallBearing.equilibrium

    def counted(self: AngularContactBallBearing, **question: Any) -> Any:
        state = original(self, **question)
        solves.append(state.speed.size)
        return state

    monkeypatch.setattr(AngularContactBallBearing, "equilibrium", counted)
    for count in (2, 20):
        solves.clear()
        mapped(CLOSE, speed=np.linspace(5000.0, 30000.0, count) * RPM)
        assert len(solves) <= 14
        assert solves[0] == LEVELS * count
        assert sum(solves[1:]) <= 26 * count


def test_growth_at_speed_belongs_to_its_speed() -> None:
    growth = np.array([0.0, 2e-6, 8e-6])
    found = mapped(CLOSE, growth=growth).boundary
    for row, own in enumerate(growth):
        alone = mapped(CLOSE, speed=SPEED[row : row + 1], growth=own).boundary[:, 0]
        assert found[:, row] == pytest.approx(alone, rel=1e-8)
    assert np.abs(found[:, 2] / mapped(CLOSE).boundary[:, 2] - 1.0).min() > 1e-3


@pytest.mark.parametrize(
    ("wrong", "sentence"),
    [
        ({"speed": []}, "one speed or more"),
        ({"speed": [[1.0]]}, "one speed or more"),
        ({"lowest": 0.0}, "0 < lowest < highest"),
        ({"lowest": -5.0}, "0 < lowest < highest"),
        ({"lowest": 5.0, "highest": 5.0}, "0 < lowest < highest"),
        ({"highest": np.inf}, "finite"),
        ({"lowest": np.nan}, "0 < lowest < highest"),
        ({"radial": -0.1}, "radial over axial load"),
        ({"speed": [np.nan]}, "speed must be finite"),
    ],
)
def test_what_cannot_be_asked(wrong: dict[str, Any], sentence: str) -> None:
    with pytest.raises(InvalidBearing, match=sentence):
        mapped(CLOSE, **wrong)


def test_no_race_controls_balls_of_three_contacts() -> None:
    """A QJ 218 has its third contact up to far above the boundaries that its margins would have."""
    bearing = four_point(QJ218)
    speed = np.array([1000.0, 3000.0, 6000.0]) * RPM
    found = mapped(bearing, speed=speed, highest=50e3)
    loads = np.zeros((*found.inner_margin.shape, 5))
    loads[..., 0] = found.load
    state = bearing.equilibrium(load=loads, speed=speed[:, None])
    three = (state.contacts > 2).any(axis=-1)
    assert (three.any(axis=1) & ~three.all(axis=1)).all()
    assert (found.outcome[three] == "third contact").all()
    assert (np.isnan(found.inner_margin) == (found.outcome != "")).all()
    control = np.where(found.inner_margin > 0.0, "inner", "")
    control = np.where(found.outer_margin > 0.0, "outer", control)
    assert (
        control == np.where(state.control[..., 0] == "neither", "", state.control[..., 0])
    ).all()
    assert np.isnan(found.boundary).all()
    assert set(found.absence[0]) == {"inner race controls at every load with two contacts per ball"}
    third = mapped(bearing, speed=speed[2:], highest=2e3)
    assert (third.absence == "third contact").all()
