"""Section forces, elastic line and stress against closed forms, equilibrium and symmetry."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import rotordyn
from bearings import Material
from rotordyn.analyses import (
    Conditions,
    FrfSpec,
    LineLoad,
    PointLoad,
    Port,
    PreloadSpec,
    SectionForcesSpec,
    StiffnessSpec,
    TwistLimit,
    Unbalance,
)
from rotordyn.analyses.section_forces.result import SectionForcesResult
from rotordyn.analyses.section_forces.summary import warnings
from rotordyn.analyses.solving import solve_spindle
from rotordyn.errors import InvalidInput
from rotordyn.machine import Disc, Drawbar, Joint, LinearSupport, PointMass, Section, Shaft, Spindle
from rotordyn.machine.inertia import rotor_inertia
from tests.oracles.idealised import idealised
from tests.oracles.spindles import RPM, answers, case, mfw2310, undamped, with_sleeve

STEEL = Material("steel", 210e9, 0.3, 7850.0)
L, D, B, F = 1.2, 0.05, 0.02, 1500.0
E, G = 210e9, 210e9 / 2.6
AREA, INERTIA = math.pi / 4 * (D**2 - B**2), math.pi / 64 * (D**4 - B**4)
KAPPA = 0.75
EXACT = {"rel": 1e-11, "abs": 1e-12}
PINNED, SLIDING = ("x", "y", "z"), ("y", "z")


def held(name: str, x: float, *rigid: str) -> LinearSupport:
    return LinearSupport(name, x, rigid=rigid)


def beam(*supports: LinearSupport, **changes: Any) -> Spindle:
    shaft = Shaft(0.0, (Section(L, D, B, STEEL),), KAPPA)
    return Spindle("beam", shaft, supports=supports, **changes)


def solved(
    spindle: Spindle,
    *loads: PointLoad,
    rpm: Sequence[float] = (0.0,),
    conditions: Conditions | None = None,
    **asked: Any,
) -> SectionForcesResult:
    own = conditions or Conditions()
    speeds = tuple(n * RPM for n in rpm)
    spec = SectionForcesSpec(loads=loads, **asked)
    found = solve_spindle(spindle, own, speeds, {"section_forces": spec}, lambda name: None)
    result = found.results["section_forces"]
    assert isinstance(result, SectionForcesResult)
    return result


def at(result: SectionForcesResult, name: str, x: float, side: str = "front") -> float:
    """A quantity at ``x``, just in front of a jump there or just behind."""
    places = np.flatnonzero(np.abs(result.cut - x) < 1e-12)
    return float(getattr(result, name)[0, places[0 if side == "front" else -1]])


def test_beam_on_two_supports_with_a_force_off_the_middle() -> None:
    """Shear, moment and deflection of the textbook, shear deformation included."""
    a, b = 0.45, L - 0.45
    result = solved(beam(held("l", 0.0, *PINNED), held("r", L, *SLIDING)), PointLoad(a, Fy=-F))
    assert result.reaction[0, :, 1] == pytest.approx([F * b / L, F * a / L], **EXACT)
    assert at(result, "shear_force_y", a) == pytest.approx(-F * b / L, **EXACT)
    assert at(result, "shear_force_y", a, "rear") == pytest.approx(F * a / L, **EXACT)
    assert at(result, "bending_moment_z", a) == pytest.approx(F * a * b / L, **EXACT)
    sag = F * a**2 * b**2 / (3 * E * INERTIA * L) + F * a * b / (L * KAPPA * G * AREA)
    assert at(result, "deflection_y", a) == pytest.approx(-sag, rel=1e-11)
    end = F * a * b * (L + b) / (6 * L * E * INERTIA)
    assert at(result, "slope_z", 0.0) == pytest.approx(-end, rel=1e-11)


@pytest.mark.parametrize("plane", ["y", "z"])
def test_cantilever(plane: str) -> None:
    """Clamped at the front, force and moment at the end; the planes differ by the sign of tilt."""
    clamped = held("wall", 0.0, "x", "y", "z", "thx", "thy", "thz")
    own = {"y": {"Fy": F, "Mz": 40.0}, "z": {"Fz": F, "My": -40.0}}[plane]
    result = solved(beam(clamped), PointLoad(L, **own))
    x = result.cut
    moment = F * (L - x) + 40.0
    bent = (F * (L * x**2 / 2 - x**3 / 6) + 20.0 * x**2) / (E * INERTIA) + F * x / (
        KAPPA * G * AREA
    )
    turned = (F * (L * x - x**2 / 2) + 40.0 * x) / (E * INERTIA)
    sign = 1.0 if plane == "y" else -1.0
    other = {"y": "z", "z": "y"}[plane]
    values = {
        f"shear_force_{plane}": F + 0 * x,
        f"bending_moment_{other}": sign * moment,
        f"deflection_{plane}": bent,
        f"slope_{other}": sign * turned,
    }
    for name, wanted in values.items():
        found = getattr(result, name)[0]
        np.testing.assert_allclose(found, wanted, rtol=1e-11, atol=1e-12 * abs(wanted).max())
    assert not result.torque.any()
    assert not getattr(result, f"deflection_{other}").any()


@pytest.mark.parametrize("plane", ["y", "z"])
def test_a_cantilever_with_a_joint(plane: str) -> None:
    """Behind the joint the shaft is shifted by F/k and tilted by M/k; in front nothing changes."""
    clamped, x = held("wall", 0.0, "x", "y", "z", "thx", "thy", "thz"), 0.5
    joint = Joint("holder", x, radial=3e7, tilt=2e5, axial=1e7, torsion=5e4)
    load = PointLoad(L, **{f"F{plane}": F}, Fx=100.0, Mx=20.0)
    limits = TwistLimit(0.0, x, 0.1, name="front"), TwistLimit(x, L, 0.1, name="rear")
    whole, jointed = (
        solved(beam(clamped, joints=joints), load, twist_limits=limits) for joints in ((), (joint,))
    )
    behind = np.arange(jointed.cut.size) > np.flatnonzero(jointed.cut == x)[0]
    arm, moment = (jointed.cut - x) * behind, F * (L - x) * behind
    sign, other = {"y": (1.0, "z"), "z": (-1.0, "y")}[plane]
    wanted = {
        f"deflection_{plane}": F / 3e7 * behind + moment / 2e5 * arm,
        f"slope_{other}": sign * moment / 2e5,
        "axial_displacement": 100.0 / 1e7 * behind,
        "twist": 20.0 / 5e4 * behind,
        f"bending_moment_{other}": 0.0 * arm,
        "von_mises_stress": 0.0 * arm,
    }
    assert np.array_equal(whole.cut, jointed.cut)
    for name, change in wanted.items():
        without, found = getattr(whole, name)[0], getattr(jointed, name)[0]
        np.testing.assert_allclose(found - without, change, atol=1e-11 * np.abs(found).max())
    np.testing.assert_allclose(jointed.twist_between, whole.twist_between, rtol=1e-11)


def test_a_twist_limit_across_a_joint_is_refused() -> None:
    clamped = held("wall", 0.0, "x", "y", "z", "thx", "thy", "thz")
    spindle = beam(clamped, joints=(Joint("holder", 0.5, torsion=5e4),))
    across = TwistLimit(0.2, 0.8, 0.1)
    asked = {"section_forces": SectionForcesSpec((PointLoad(L, Mx=20.0),), twist_limits=(across,))}
    with pytest.raises(InvalidInput, match=r"twist_limits\.1: joint 'holder' twists between both"):
        rotordyn.Case("c", "", (0.0,), asked, spindle=spindle)
    stiff = beam(clamped, joints=(Joint("holder", 0.5, tilt=5e4),))
    assert solved(stiff, PointLoad(L, Mx=20.0), twist_limits=(across,)).twist_between.all()


def test_overhang_with_a_line_load() -> None:
    """q on the overhang c: R₂ = q c (1 + c/2l), hogging q c²/2, end deflection of the textbook."""
    span, c, q = 0.8, 0.4, 2000.0
    result = solved(
        beam(held("l", 0.0, *PINNED), held("r", span, *SLIDING)),
        line_loads=(LineLoad(span, L, qy=-q),),
    )
    assert result.reaction[0, 1, 1] == pytest.approx(q * c * (1 + c / (2 * span)), **EXACT)
    assert at(result, "bending_moment_z", span) == pytest.approx(-q * c**2 / 2, **EXACT)
    assert at(result, "shear_force_y", span, "rear") == pytest.approx(-q * c, **EXACT)
    bending = q * c**4 / 8 / (E * INERTIA) + q * c**2 / 2 * span / (3 * E * INERTIA) * c
    shear = q * c**2 / 2 * (1 + c / span) / (KAPPA * G * AREA)
    assert at(result, "deflection_y", L) == pytest.approx(-(bending + shear), rel=1e-11)


def test_three_supports_against_the_three_moment_equation() -> None:
    """Uniform load on two equal spans: M = −q l²/8 and 10/8 q l in the middle (no shear)."""
    stiff = Shaft(0.0, (Section(L, D, B, STEEL),), 1.0)
    slender = idealised("no shear", 210e9, -0.999999, 7850.0)
    stiff = replace(stiff, sections=(Section(L, D, B, slender),))
    supports = (held("a", 0.0, *PINNED), held("b", L / 2, *SLIDING), held("c", L, *SLIDING))
    q = 3000.0
    result = solved(Spindle("s", stiff, supports=supports), line_loads=(LineLoad(0.0, L, qy=-q),))
    span = L / 2
    assert result.reaction[0, :, 1] == pytest.approx(
        [0.375 * q * span, 1.25 * q * span, 0.375 * q * span], rel=1e-6
    )
    assert at(result, "bending_moment_z", span) == pytest.approx(-q * span**2 / 8, rel=1e-6)


def test_three_supports_with_shear_against_the_flexibility_of_the_middle() -> None:
    """The middle support takes back the deflection q would have without it."""
    supports = (held("a", 0.0, *PINNED), held("b", L / 2, *SLIDING), held("c", L, *SLIDING))
    q = 3000.0
    result = solved(beam(*supports), line_loads=(LineLoad(0.0, L, qz=-q),))
    shear = KAPPA * G * AREA
    free = 5 * q * L**4 / (384 * E * INERTIA) + q * L**2 / (8 * shear)
    unit = L**3 / (48 * E * INERTIA) + L / (4 * shear)
    assert result.reaction[0, 1, 2] == pytest.approx(free / unit, rel=1e-10)
    assert at(result, "deflection_z", L / 2) == pytest.approx(0.0, abs=1e-15)


def test_elastic_support_and_rod() -> None:
    """A push along the axis on a spring; a propped cantilever on a spring k: R = δ/(1/k + f)."""
    k = 2e7
    wall = held("wall", 0.0, "x", "y", "z", "thx", "thy", "thz")
    spring = LinearSupport("spring", L, {("y", "y"): k, ("x", "x"): k})
    result = solved(beam(wall, spring), PointLoad(L, Fy=-F, Fx=F))
    f = L**3 / (3 * E * INERTIA) + L / (KAPPA * G * AREA)
    assert result.reaction[0, 1, 1] == pytest.approx(F * f / (1 / k + f), rel=1e-10)
    rod = L / (E * AREA)
    assert at(result, "axial_displacement", L) == pytest.approx(F / (k + 1 / rod), rel=1e-10)
    assert at(result, "normal_force", 0.5 * L) == pytest.approx(F / (1 + k * rod), rel=1e-10)


def test_coupled_support_is_not_made_symmetric() -> None:
    """A push along y on an unsymmetric matrix: K u = F, with two such ends by symmetry."""
    matrix = {("y", "y"): 4e7, ("y", "z"): 1e7, ("z", "y"): -3e7, ("z", "z"): 5e7}
    ends = [LinearSupport(n, x, {**matrix, ("x", "x"): 1e7}) for n, x in (("l", 0.0), ("r", L))]
    result = solved(beam(*ends), PointLoad(0.0, Fy=F / 2), PointLoad(L, Fy=F / 2))
    u = np.linalg.solve([[4e7, 1e7], [-3e7, 5e7]], [F / 2, 0.0])
    assert at(result, "deflection_y", 0.0) == pytest.approx(u[0], rel=1e-10)
    assert at(result, "deflection_z", L / 2) == pytest.approx(u[1], rel=1e-10)


def test_torsion_of_a_stepped_shaft() -> None:
    """Torque in at one end, out at the other, free to spin: Σ Mt l / G Ip, stress at each step."""
    sections = (Section(0.3, 0.04, 0.0, STEEL), Section(0.5, 0.06, 0.03, STEEL))
    ends = held("l", 0.0, *PINNED), held("r", 0.8, *SLIDING)
    spindle = Spindle("s", Shaft(0.0, sections), supports=ends)
    t = 250.0
    result = solved(
        spindle,
        PointLoad(0.1, Mx=-t),
        PointLoad(0.8, Mx=t),
        twist_limits=(TwistLimit(0.1, 0.8, 1e-3, 0.01),),
    )
    polar = [math.pi / 32 * 0.04**4, math.pi / 32 * (0.06**4 - 0.03**4)]
    twist = t / G * (0.2 / polar[0] + 0.5 / polar[1])
    assert result.twist_between[0, 0] == pytest.approx(twist, rel=1e-12)
    assert at(result, "twist", 0.1) == 0.0
    assert at(result, "twist", 0.8) == pytest.approx(twist, rel=1e-12)
    assert at(result, "torque", 0.1) == pytest.approx(0.0, abs=1e-11)
    assert at(result, "torque", 0.1, "rear") == pytest.approx(t, **EXACT)
    for side, outer, ip in (("front", 0.04, polar[0]), ("rear", 0.06, polar[1])):
        tau = t * outer / 2 / ip
        assert at(result, "torsion_stress", 0.3, side) == pytest.approx(tau, rel=1e-12)
        assert at(result, "von_mises_stress", 0.3, side) == pytest.approx(
            math.sqrt(3) * tau, rel=1e-12
        )
    wide = result.required_diameter[0, 0]
    uniform = t * 0.7 / (G * math.pi / 32 * (wide**4 - 0.01**4))
    assert uniform == pytest.approx(1e-3, rel=1e-12)


def test_stress_of_a_known_section() -> None:
    """30 mm, 12 kN pull, My 90, Mz 120, Mt 100 N·m: the 150 N·m of both planes bend it."""
    d = 0.03
    wall = held("wall", 0.0, "x", "y", "z", "thx", "thy", "thz")
    spindle = Spindle("s", Shaft(0.0, (Section(0.2, d, 0.0, STEEL),)), supports=(wall,))
    result = solved(spindle, PointLoad(0.2, Fx=12e3, Mx=100.0, My=90.0, Mz=-120.0))
    normal = 12e3 * 4 / (math.pi * d**2) + 32 * 150.0 / (math.pi * d**3)
    shear = 16 * 100.0 / (math.pi * d**3)
    assert at(result, "normal_stress", 0.1) == pytest.approx(normal, rel=1e-12)
    assert at(result, "torsion_stress", 0.1) == pytest.approx(shear, rel=1e-12)
    wanted = math.sqrt(normal**2 + 3 * shear**2)
    assert at(result, "von_mises_stress", 0.1) == pytest.approx(wanted, rel=1e-12)
    pressed = solved(spindle, PointLoad(0.2, Fx=-12e3, My=150.0))
    assert at(pressed, "normal_stress", 0.1) == pytest.approx(-normal, rel=1e-12)


def test_weight_reaches_the_supports_and_bends() -> None:
    """Own weight of shaft, disc and mass, in every direction across the axis."""
    mass, disc = PointMass("m", 0.3, 4.0), Disc("d", 0.9, 0.2, D, 0.03, STEEL)
    spindle = beam(held("l", 0.0, *PINNED), held("r", L, *SLIDING), masses=(mass,), discs=(disc,))
    line, body = 7850.0 * AREA, disc.as_point_mass().mass
    total = 9.80665 * (line * L + 4.0 + body)
    rear = 9.80665 * (line * L / 2 + 4.0 * 0.25 + body * 0.75)
    for word, place, sign in (("-y", 1, 1), ("+y", 1, -1), ("-z", 2, 1), ("+z", 2, -1)):
        reaction = solved(spindle, gravity=word).reaction[0]
        assert reaction[:, place].sum() == pytest.approx(sign * total, rel=1e-12)
        assert reaction[1, place] == pytest.approx(sign * rear, rel=1e-12)
    hanging = solved(spindle, gravity="+x")
    assert hanging.reaction[0, 0, 0] == pytest.approx(-total, rel=1e-12)
    assert at(hanging, "normal_force", 0.0) == pytest.approx(total, rel=1e-12)


def test_weight_of_the_conditions_is_the_same() -> None:
    spring = LinearSupport("l", 0.0, {("x", "x"): 1e8}, rigid=("y", "z"))
    spindle = beam(spring, held("r", L, *SLIDING))
    own = solved(spindle, conditions=Conditions(gravity="+x", axial_force=300.0))
    asked = solved(spindle, PointLoad(0.0, Fx=300.0), gravity="+x")
    np.testing.assert_allclose(own.normal_force, asked.normal_force, rtol=1e-12, atol=1e-9)


def test_unbalance_grows_with_speed_squared_and_points_where_it_is() -> None:
    spindle = beam(held("l", 0.0, *PINNED), held("r", L, *SLIDING))
    unbalance = Unbalance(L / 2, 1e-4, math.radians(30.0))
    result = solved(spindle, unbalances=(unbalance,), rpm=(0.0, 3000.0, 6000.0))
    force = -2.0 * result.reaction[:, 0, 1:3]
    size = 1e-4 * (np.array([0.0, 3000.0, 6000.0]) * RPM) ** 2
    np.testing.assert_allclose(force[:, 0], size * math.cos(math.pi / 6), rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(force[:, 1], size * math.sin(math.pi / 6), rtol=1e-12, atol=1e-12)


def test_a_force_off_the_axis_is_a_force_and_its_moment() -> None:
    wall = held("wall", 0.0, "x", "y", "z", "thx", "thy", "thz")
    y, z, fx, fy, fz = 0.05, -0.03, 700.0, -200.0, 400.0
    off = solved(beam(wall), PointLoad(L, Fx=fx, Fy=fy, Fz=fz, y=y, z=z))
    moment = np.cross([0.0, y, z], [fx, fy, fz])
    on = PointLoad(L, "", fx, fy, fz, *moment)
    np.testing.assert_allclose(off.reaction, solved(beam(wall), on).reaction, rtol=1e-12)
    assert off.reaction[0, 0, 3] == pytest.approx(-moment[0])


NAMES = (
    "normal_force",
    "shear_force_y",
    "shear_force_z",
    "torque",
    "bending_moment_y",
    "bending_moment_z",
    "axial_displacement",
    "deflection_y",
    "deflection_z",
    "twist",
    "slope_y",
    "slope_z",
)
LOADS = st.lists(
    st.tuples(st.floats(0.0, L), *(st.floats(-1e3, 1e3) for _ in range(6))), min_size=1, max_size=5
)
REDUNDANT = (
    held("l", 0.1, "x", "y", "z", "thx"),
    LinearSupport("m", 0.5, {("y", "y"): 1e7, ("y", "thz"): 2e5, ("z", "z"): 3e7, ("x", "x"): 1e6}),
    held("r", L, "y", "z", "thz"),
)


@pytest.mark.long
@given(LOADS)
def test_any_loads_are_in_equilibrium(drawn: list[tuple[float, ...]]) -> None:
    """Forces and moments about the front end vanish, and so do section forces at both ends."""
    loads = [PointLoad(x, "", *load) for x, *load in drawn]
    result = solved(beam(*REDUNDANT), *loads)
    everything = [(x, np.array(load)) for x, *load in drawn]
    places = zip(result.support_station, result.reaction[0], strict=True)
    everything += [(float(x), load) for x, load in places]
    size = sum(np.abs(load).max() for _, load in everything)
    force = sum(load[:3] for _, load in everything)
    moment = sum(load[3:] + np.cross([x, 0.0, 0.0], load[:3]) for x, load in everything)
    assert np.abs(force).max() <= 1e-11 * size
    assert np.abs(moment).max() <= 1e-11 * size


@pytest.mark.long
@settings(max_examples=30)
@given(LOADS, LOADS)
def test_loads_superpose(one: list[tuple[float, ...]], other: list[tuple[float, ...]]) -> None:
    """Both sets at once give the sum; all are looked at at the same stations."""
    sets = [[PointLoad(x, "", *load) for x, *load in drawn] for drawn in (one, other)]
    silent = [[replace(load, Fx=0, Fy=0, Fz=0, Mx=0, My=0, Mz=0) for load in s] for s in sets]
    spindle = beam(*REDUNDANT)
    together = solved(spindle, *sets[0], *sets[1])
    alone = [solved(spindle, *sets[0], *silent[1]), solved(spindle, *silent[0], *sets[1])]
    for name in NAMES:
        parts = [getattr(part, name) for part in alone]
        size = max(float(np.abs(part).max()) for part in parts)
        scale = 1e-9 * max(size, 1e-9 if "deflection" in name else 1e-12)
        np.testing.assert_allclose(getattr(together, name), sum(parts), rtol=0, atol=scale)


def test_splitting_sections_and_elements_changes_nothing() -> None:
    loads = (PointLoad(0.37, Fy=-F, Fz=400.0, Mx=20.0), PointLoad(0.9, My=30.0))
    whole = beam(*REDUNDANT)
    parts = tuple(Section(n, D, B, STEEL) for n in (0.11, 0.2, 0.49, 0.4))
    split = replace(whole, shaft=replace(whole.shaft, sections=parts))
    results = [
        solved(whole, *loads, gravity="-y", conditions=Conditions(element_length=10.0)),
        solved(split, *loads, gravity="-y"),
        solved(split, *loads, gravity="-y", conditions=Conditions(element_length=0.005)),
    ]
    for name in NAMES:
        for x in (0.0, 0.1, 0.37, 0.5, 0.9, L):
            for side in ("front", "rear"):
                first, *others = (at(result, name, x, side) for result in results)
                size = float(np.abs(getattr(results[0], name)).max())
                assert others == pytest.approx([first, first], abs=1e-10 * size), name


def test_a_rigid_rotor_moves_as_a_body() -> None:
    ends = [LinearSupport(n, x, {("y", "y"): k}) for n, x, k in (("l", 0.0, 1e7), ("r", L, 3e7))]
    spindle = beam(*ends, held("z", 0.0, "x", "z", "thx", "thy"))
    result = solved(spindle, PointLoad(L / 4, Fy=F), conditions=Conditions(rotor="rigid"))
    left, right = 0.75 * F / 1e7, 0.25 * F / 3e7
    np.testing.assert_allclose(
        result.deflection_y[0], left + (right - left) * result.cut / L, rtol=1e-11
    )
    both = beam(*(held(n, x, *SLIDING) for n, x in (("a", 0.0), ("b", 0.5), ("c", L))))
    with pytest.raises(InvalidInput, match="the reactions are not determined"):
        solved(both, PointLoad(0.3, Fy=F), conditions=Conditions(rotor="rigid"))


def test_a_table_without_stiffness_at_a_speed_is_named() -> None:
    soft = {("y", "y"): (0.0, 1e8), ("z", "z"): (0.0, 1e8)}
    film = LinearSupport("film", 0.0, soft, speeds=(0.0, 300.0))
    spindle = beam(film, held("axis", 0.0, "x", "thx"), held("r", L, *SLIDING))
    with pytest.raises(InvalidInput, match=r"free body .* at 0 rpm: y, z, thy, thz .* no stiff"):
        solved(spindle, PointLoad(0.3, Fy=F))
    assert np.isfinite(solved(spindle, PointLoad(0.3, Fy=F), rpm=(500.0,)).reaction).all()


@pytest.mark.parametrize("tension", [0.0, 1e3])
def test_redundant_supports_are_named_whatever_the_axial_force(tension: float) -> None:
    places = enumerate((0.0, 1e-7, L))
    spindle = beam(*(held(f"s{k}", x, *SLIDING) for k, x in places), held("axis", 0.0, "x", "thx"))
    with pytest.raises(InvalidInput, match="the reactions are not determined"):
        solved(spindle, PointLoad(0.3, Fy=F), conditions=Conditions(tension=tension))


def test_bearings_as_supports_give_the_radial_stiffness_of_the_linear_model() -> None:
    """An independent solution in plane y with the same tangents, axial stiffening off."""
    own = {"axial_stiffening": False}
    asked = {
        "stiffness": StiffnessSpec("Oc2", 100.0, 1, ("full",)),
        "section_forces": SectionForcesSpec(loads=(PointLoad("Oc2", Fy=100.0),)),
    }
    found = answers(undamped(mfw2310()), (0.0, 24000.0), asked, **own)
    result = found["section_forces"]
    assert case().spindle is not None
    place = np.flatnonzero(np.abs(result.cut - case().spindle.points["Oc2"]) < 1e-9)[0]
    np.testing.assert_allclose(
        result.deflection_y[:, place], found["stiffness"].deflection[:, 0, -1], rtol=1e-6
    )
    assert np.abs(result.reaction[:, :, 1].sum(axis=1) + 100.0).max() < 1e-8


def test_preload_and_drawbar_are_part_of_the_normal_force() -> None:
    """Bearings push the shaft as the preload state says; the drawbar presses its wall."""
    bar = Drawbar(20e3, 0.0, 0.35, "everywhere")
    asked = {"section_forces": SectionForcesSpec(loads=(PointLoad("Oc2", Fy=100.0),))}
    plain, pulled = (
        answers(mfw2310(drawbar=own), (0.0, 24000.0), asked)["section_forces"]
        for own in (None, bar)
    )
    inside = (plain.cut > 0.0) & (plain.cut < 0.35)
    np.testing.assert_allclose(
        np.interp(0.2, pulled.cut, pulled.normal_force[0]),
        np.interp(0.2, plain.cut, plain.normal_force[0]) - 20e3,
        rtol=1e-9,
    )
    assert np.abs(plain.normal_force[:, inside]).max() > 500.0
    jump = np.diff(plain.normal_force[1])[np.diff(plain.cut) == 0.0]
    pushes = -plain.reaction[1, :, 0]
    real = np.sort(jump[np.abs(jump) > 1e-6])
    np.testing.assert_allclose(real, np.sort(pushes), rtol=1e-9)


def test_sleeves_give_along_and_across() -> None:
    """Rigid rotor under a push along x: bearings side by side, each in series with its sleeve.

    At 24 000 rpm the front sleeve is at its stop. Across, the linear model of the radial
    stiffness includes sprung sleeves too.
    """
    asked = {
        "preload": PreloadSpec(),
        "section_forces": SectionForcesSpec(loads=(PointLoad("Oc2", Fx=10.0),)),
    }
    found = answers(mfw2310(), (0.0, 24000.0), asked, rotor="rigid")
    k, result = found["preload"].stiffness[:, :, 0, 0], found["section_forces"]
    assert found["preload"].stop_reached[:, 0].tolist() == [False, True]
    front, rear = (sleeve.spring.stiffness for sleeve in mfw2310().sleeves)
    held = [1 / (1 / k[0, 2] + 1 / front), k[1, 2]]
    whole = k[:, 0] + k[:, 1] + held + 1 / (1 / (k[:, 3] + k[:, 4]) + 1 / rear)
    np.testing.assert_allclose(result.axial_displacement[0, 0], 10.0 / whole[0], rtol=1e-9)
    # a stop is a thousand times as stiff as the bearings of its sleeve
    np.testing.assert_allclose(result.axial_displacement[1, 0], 10.0 / whole[1], rtol=1e-3)

    soft = with_sleeve(mfw2310(), "rear", radial_stiffness=3e7)
    across = {
        "stiffness": StiffnessSpec("Oc2", 100.0, 1, ("full",)),
        "section_forces": SectionForcesSpec(loads=(PointLoad("Oc2", Fy=100.0),)),
    }
    found = answers(soft, (0.0,), across, axial_stiffening=False)
    assert at(found["section_forces"], "deflection_y", soft.points["Oc2"]) == pytest.approx(
        found["stiffness"].deflection[0, 0, -1], rel=1e-6
    )


def test_weight_of_a_vertical_spindle_hangs_in_its_bearings() -> None:
    """N vanishes at both free ends and changes by the weight of what lies between two cuts."""
    spec = {"section_forces": SectionForcesSpec(loads=(PointLoad("Oc2", Fy=1.0),))}
    still, hanging = (
        answers(mfw2310(), (0.0,), spec, gravity=word)["section_forces"] for word in ("none", "+x")
    )
    assert hanging.normal_force[0, [0, -1]] == pytest.approx([0.0, 0.0], abs=1e-9)
    inner, outer = hanging.inner_diameter[0], hanging.outer_diameter[0]
    shaft = mfw2310().shaft.sections[0].material.density * math.pi / 4 * (outer**2 - inner**2)
    change = np.diff(hanging.normal_force[0])[0]
    assert change == pytest.approx(-9.80665 * shaft * np.diff(hanging.cut)[0], rel=1e-9)
    total = hanging.reaction[0, :, 0].sum() - still.reaction[0, :, 0].sum()
    mass = rotor_inertia(mfw2310()).mass
    assert total == pytest.approx(-9.80665 * mass, rel=1e-9)


def test_a_load_merged_with_a_station_keeps_its_moment() -> None:
    """A ten-millionth beside a support there is no node of its own, but the moment is there."""
    off = 1e-7
    result = solved(
        beam(held("l", 0.0, *PINNED), held("r", L, *SLIDING)), PointLoad(off, Fy=1e6, Fz=1e6)
    )
    assert result.reaction[0, 1, 1:3] == pytest.approx([-1e6 * off / L] * 2, rel=1e-6)


def test_moments_and_tilts_of_both_planes_share_one_sense() -> None:
    """My and Mz on a beam with two supports: the rear one answers My/L along z, −Mz/L along y."""
    result = solved(
        beam(held("l", 0.0, *PINNED), held("r", L, *SLIDING)), PointLoad(0.4, My=50.0, Mz=80.0)
    )
    assert result.reaction[0, 1] == pytest.approx([0, -80.0 / L, 50.0 / L, 0, 0, 0], abs=1e-9)
    turned = solved(
        beam(
            held("l", 0.0, *PINNED),
            held("r", L, *SLIDING),
            LinearSupport("t", 0.5, {("thy", "thy"): 2e4}),
        ),
        PointLoad(0.5, My=50.0),
    )
    free = solved(beam(held("l", 0.0, *PINNED), held("r", L, *SLIDING)), PointLoad(0.5, My=50.0))
    give = at(free, "slope_y", 0.5) / 50.0
    assert turned.reaction[0, 2, 4] == pytest.approx(-50.0 * give / (give + 1 / 2e4), rel=1e-9)


def beam_column(share: float, load: float) -> tuple[float, float]:
    """Deflection and moment at mid-span of a pinned column without shear, under an axial force of
    ``share`` times its buckling load, compression positive (Timoshenko, Theory of Elastic
    Stability)."""
    force = share * math.pi**2 * E * INERTIA / L**2
    u = 0.5 * L * cmath.sqrt(force / (E * INERTIA))
    tangent = cmath.tan(u)
    deflection = load * L / (4.0 * force) * (tangent / u - 1.0)
    return deflection.real, (0.25 * load * L * tangent / u).real


@pytest.mark.parametrize("below", [0.998, 1.002])
def test_deflections_that_are_not_small_are_said(below: float) -> None:
    """Slope at the ends of the column near buckling, in closed form (Timoshenko)."""
    column = beam(held("a", 0.0, *PINNED), held("b", L, *SLIDING))
    column = replace(column, shaft=replace(column.shaft, shear_coefficient="none"))
    force = 0.99 * math.pi**2 * E * INERTIA / L**2
    u = 0.5 * L * math.sqrt(force / (E * INERTIA))
    load = below * 0.1 / ((1.0 / math.cos(u) - 1.0) / (2.0 * force))
    found = solved(
        column,
        PointLoad(L / 2, Fy=0.6 * load, Fz=0.8 * load),
        conditions=Conditions(tension=-force),
    )
    told = [each for each in warnings(found) if "inclined by up to 5.7" in each]
    assert len(told) == (below > 1.0), told


@pytest.mark.parametrize(
    ("share", "modulus"), [(0.6, E), (0.99, E), (-0.5, E), (-20.0, E), (-300.0, E / 20.0)]
)
def test_an_axial_force_bends_a_column_on_or_holds_it_straight(
    share: float, modulus: float
) -> None:
    column = beam(held("a", 0.0, *PINNED), held("b", L, *SLIDING))
    (section,) = column.shaft.sections
    section = replace(section, material=replace(STEEL, young_modulus=modulus))
    shaft = replace(column.shaft, shear_coefficient="none", sections=(section,))
    column = replace(column, shaft=shaft)
    tension = -share * math.pi**2 * modulus * INERTIA / L**2
    load = PointLoad(L / 2, Fy=60.0, Fz=80.0)
    found = solved(column, load, conditions=Conditions(tension=tension))
    deflection, moment = beam_column(share, 100.0)
    deflection *= E / modulus
    near = {"rel": 1e-10}
    assert at(found, "deflection_y", L / 2) == pytest.approx(0.6 * deflection, **near)
    assert at(found, "deflection_z", L / 2) == pytest.approx(0.8 * deflection, **near)
    assert at(found, "bending_moment_z", L / 2) == pytest.approx(-0.6 * moment, **near)
    assert at(found, "bending_moment_y", L / 2) == pytest.approx(0.8 * moment, **near)
    # forces are along the axes: the supports carry halves of the load, whatever the axial force
    assert found.reaction[0, :, 1] == pytest.approx([-30.0, -30.0], rel=1e-9)
    assert at(found, "shear_force_y", L / 2) == pytest.approx(30.0, rel=1e-9)
    first = solved(column, load, conditions=Conditions(tension=tension, axial_stiffening=False))
    straight = solved(column, load)
    for name in ("deflection_y", "bending_moment_y", "shear_force_z"):
        assert getattr(first, name) == pytest.approx(getattr(straight, name), rel=1e-12)


@pytest.mark.parametrize("tension", [-1.4e5, 3e5])
def test_a_shaft_under_axial_force_has_the_stiffness_of_the_equation_of_motion(
    tension: float,
) -> None:
    """A stepped hollow shaft with a cone, shear and a joint on soft supports that couple, by the
    receptance of a fine mesh at next to no frequency."""
    sections = (
        Section(0.1, 0.02, 0.0, STEEL),
        Section(0.15, 0.03, 0.01, STEEL, rear_outer_diameter=0.04),
        Section(0.1, 0.025, 0.0, STEEL),
    )
    tilt = {("thy", "thy"): 2e3, ("thz", "thz"): 2e3, ("x", "x"): 3e7, ("thx", "thx"): 1e3}
    across = {("y", "y"): 4e7, ("z", "z"): 3e7}
    spindle = Spindle(
        "stepped",
        Shaft(0.0, sections, KAPPA),
        supports=(
            LinearSupport("f", 0.1, stiffness={**across, ("y", "z"): 5e6, **tilt}),
            LinearSupport("r", 0.3, stiffness=across),
        ),
        joints=(Joint("j", 0.25, radial=1e8, tilt=3e4, axial=2e8, torsion=2e4),),
        points={"nose": 0.0},
    )
    conditions = Conditions(tension=tension, element_length=0.001)
    load = PointLoad(0.0, Fy=100.0)
    static, moved = solved(spindle, load, conditions=conditions), receptance(spindle, conditions)
    first = solved(spindle, load, conditions=replace(conditions, axial_stiffening=False))
    assert abs(at(first, "deflection_y", 0.0) / moved[0].real - 1.0) > 0.2
    own = [at(static, name, 0.0) for name in ("deflection_y", "deflection_z")]
    assert own == pytest.approx(moved.real, rel=1e-5)


def receptance(spindle: Spindle, conditions: Conditions) -> Any:
    """Motion of the nose in y and z by 100 N in y."""
    pairs = tuple((Port("nose", way), Port("nose", "y")) for way in "yz")
    spec = FrfSpec(frequencies=(0.01, 0.02), pairs=pairs)
    found = solve_spindle(spindle, conditions, (0.0,), {"frf": spec}, lambda name: None)
    return 100.0 * found.results["frf"].receptance[0, :, 0]


@pytest.mark.parametrize("guides", [(), (0.15, 0.35), "everywhere"])
def test_a_drawbar_pulls_straight_between_its_guides(guides: Any) -> None:
    """What it presses together its tension holds straight, where it is guided."""
    across = {("y", "y"): 1e8, ("z", "z"): 1e8}
    spindle = Spindle(
        "bar",
        Shaft(0.0, (Section(0.5, 0.03, 0.012, STEEL),), KAPPA),
        supports=(
            LinearSupport("a", 0.05, stiffness={**across, ("x", "x"): 5e7}),
            LinearSupport("b", 0.35, stiffness=across),
        ),
        drawbar=Drawbar(force=3e4, start=0.02, end=0.48, guides=guides),
        points={"nose": 0.25},
    )
    conditions = Conditions(element_length=0.002)
    moved = receptance(spindle, conditions)[0].real
    found = solved(spindle, PointLoad(0.25, Fy=100.0), conditions=conditions)
    assert at(found, "deflection_y", 0.25) == pytest.approx(moved, rel=1e-8)
    # the moments are those that curve the shaft: between the ends of every element h M / EI
    slope, moment, x = (
        v.reshape(-1, 2) for v in (found.slope_z, found.bending_moment_z, found.cut)
    )
    rigidity = E * math.pi / 64.0 * (0.03**4 - 0.012**4)
    turned = np.diff(x)[:, 0] * moment.mean(axis=1) / rigidity
    np.testing.assert_allclose(np.diff(slope)[:, 0], turned, atol=5e-6 * np.abs(turned).max())
