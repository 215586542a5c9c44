"""Sag and runout of the nose against closed forms, symmetry and another formulation."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rotordyn
from bearings import Material
from rotordyn.analyses import Conditions, FrfSpec, PointLoad, Port, SectionForcesSpec
from rotordyn.analyses.registry import analysis
from rotordyn.analyses.solving import solve_spindle
from rotordyn.analyses.static_sag.figures.line import line_figure
from rotordyn.analyses.static_sag.result import StaticSagResult
from rotordyn.analyses.static_sag.spec import RingRunout, StaticSagSpec
from rotordyn.analyses.static_sag.summary import numbers, summary, warnings
from rotordyn.errors import InvalidInput
from rotordyn.machine import Joint, LinearSupport, PointMass, Section, Shaft, Spindle
from rotordyn.results.described import Shown
from rotordyn.units import STANDARD_GRAVITY

STEEL = Material("steel", 210e9, 0.3, 7850.0)
L, D, KAPPA = 1.2, 0.05, 0.9
EI = 210e9 * math.pi / 64 * D**4
GA = KAPPA * 210e9 / 2.6 * math.pi / 4 * D**2
W = 7850.0 * math.pi / 4 * D**2 * STANDARD_GRAVITY  # weight per length
PINNED = ("x", "y", "z")
CASES = Path(__file__).parents[2] / "cases"


def beam(*supports: LinearSupport, shear: float | str = KAPPA, **changes: Any) -> Spindle:
    shaft = Shaft(0.0, (Section(L, D, 0.0, STEEL),), shear)
    points = {"nose": 0.0, "middle": L / 2}
    return Spindle("beam", shaft, supports=supports, points=points, **changes)


def held(name: str, x: float) -> LinearSupport:
    return LinearSupport(name, x, rigid=PINNED)


def sprung(name: str, x: float, y: float = 2e7, z: float = 2e7, tilt: float = 0.0) -> LinearSupport:
    stiffness = {("y", "y"): y, ("z", "z"): z, ("thy", "thy"): tilt, ("thz", "thz"): tilt}
    return LinearSupport(name, x, stiffness={k: v for k, v in stiffness.items() if v})


def solved(
    spindle: Spindle, point: str = "nose", conditions: Conditions | None = None, **asked: Any
) -> StaticSagResult:
    spec = {"static_sag": StaticSagSpec(point, **asked)}
    found = solve_spindle(spindle, conditions or Conditions(), (0.0,), spec, lambda name: None)
    result = found.results["static_sag"]
    assert isinstance(result, StaticSagResult)
    return result


def test_beam_on_two_supports() -> None:
    """5 w L⁴/384 EI + w L²/8 κGA in the middle, w L³/24 EI at the ends."""
    spindle = beam(held("a", 0.0), held("b", L))
    middle = 5 * W * L**4 / (384 * EI) + W * L**2 / (8 * GA)
    assert solved(spindle, "middle").sag[0, 0] == pytest.approx([-middle, 0.0], rel=1e-11)
    end = solved(spindle)
    assert end.sag[0, 0] == pytest.approx([0.0, 0.0], abs=1e-18)
    assert end.slope[0] == pytest.approx([-W * L**3 / (24 * EI), 0.0], rel=1e-11)
    x = end.station
    line = W * x * (L**3 - 2 * L * x**2 + x**3) / (24 * EI) + W * x * (L - x) / (2 * GA)
    np.testing.assert_allclose(end.deflection[0, :, 0], -line, rtol=1e-10, atol=1e-18)


@pytest.mark.parametrize("overhang", [0.2, 0.5])
def test_overhung_nose(overhang: float) -> None:
    """w c (3 c³ + 4 c² l − l³)/24 EI at the end: a short nose rises.

    A test bar goes on straight.
    """
    c, span = overhang, L - overhang
    found = solved(beam(held("a", c), held("b", L), shear="none"), gauges=(0.0, 0.3, -0.1))
    sag = W * c * (3 * c**3 + 4 * c**2 * span - span**3) / (24 * EI)
    turn = W * (c**2 * span / 6 - span**3 / 24 + c**3 / 6) / EI
    assert found.slope[0, 0] == pytest.approx(turn, rel=1e-10)
    wanted = [-sag, -sag - 0.3 * turn, -sag + 0.1 * turn]
    assert found.sag[0, :, 0] == pytest.approx(wanted, rel=1e-10)
    assert not found.sag[0, :, 1].any()


@pytest.mark.parametrize(("way", "stiffness"), [("tilt", 2e5), ("radial", 3e7), ("axial", 1e6)])
def test_a_joint_adds_what_it_gives(way: str, stiffness: float) -> None:
    """Under a weight m g on the nose, l in front of a joint: m g l²/k of one that tilts, m g/k of
    one that gives across the axis, and what the weight w l of the shaft there adds, at l/2."""
    arm, mass = 0.2, 4.0
    joint = Joint("holder", arm, **{way: stiffness})
    spindle = beam(*SUPPORTS["soft"], masses=(PointMass("m", 0.0, mass),))
    whole, jointed = (
        solved(each, gauges=(0.0, 0.1)) for each in (spindle, replace(spindle, joints=(joint,)))
    )
    force, shaft = mass * STANDARD_GRAVITY, W * arm
    turn = (force * arm + shaft * arm / 2) / stiffness if way == "tilt" else 0.0
    shift = (force + shaft) / stiffness if way == "radial" else 0.0
    more = jointed.sag - whole.sag
    wanted = [-shift - turn * arm, -shift - turn * (arm + 0.1)]
    assert more[0, :, 0] == pytest.approx(wanted, rel=1e-9, abs=1e-15)
    assert (jointed.slope - whole.slope)[0] == pytest.approx([turn, 0.0], rel=1e-9, abs=1e-15)


@pytest.mark.parametrize("rotor", ["flexible", "rigid"])
def test_joints_between_supports_are_those_of_the_equation_of_motion(rotor: str) -> None:
    """A weight sags by the receptance at frequencies near zero, unlike in y and z."""
    joints = (
        Joint("front", 0.5, radial=4e7, tilt=3e5, axial=1e8),
        Joint("rear", 0.8, radial=9e6, torsion=1e4),
    )
    supports = (sprung("a", 0.3, 3e7, 1e7, 4e4), sprung("b", 0.7, 1e8, 2e7), sprung("c", 1.1))
    spindle, conditions = beam(*supports, joints=joints), Conditions(rotor=rotor)
    ports = [(Port(at, way), Port("nose", way)) for at in ("nose", "middle") for way in "yz"]
    asked = {"frf": FrfSpec((0.01,), tuple(ports))}
    receptance: Any = solve_spindle(spindle, conditions, (0.0,), asked, lambda name: None)
    wanted = receptance.results["frf"].receptance.real.reshape(2, 2)
    heavy = replace(spindle, masses=(PointMass("m", 0.0, 10.0),))
    for column, gravity in enumerate(("-y", "-z")):
        for row, at in enumerate(("nose", "middle")):
            sag = [
                solved(each, at, conditions, gravity=gravity).sag[0, 0, column]
                for each in (heavy, spindle)
            ]
            more = (sag[1] - sag[0]) / (10.0 * STANDARD_GRAVITY)
            assert more == pytest.approx(wanted[row, column], rel=1e-6)


def test_weight_turns_and_grows_with_mass() -> None:
    """The same sag in every direction of gravity, twice as much of twice the density, none lying
    along the axis; a mass on the nose adds its own."""
    spindle = beam(sprung("a", 0.3), sprung("b", 1.0))
    down = solved(spindle, gauges=(0.1,))
    for gravity, column, sign in (("+y", 0, -1), ("-z", 1, 1), ("+z", 1, -1)):
        other = solved(spindle, gauges=(0.1,), gravity=gravity)
        assert sign * other.sag[..., column] == pytest.approx(down.sag[..., 0], rel=1e-12)
        assert sign * other.slope[:, column] == pytest.approx(down.slope[:, 0], rel=1e-12)
    assert not solved(spindle, gravity="none").deflection.any()
    (section,) = spindle.shaft.sections
    heavy = replace(spindle.shaft, sections=(replace(section, mean_density=2 * 7850.0),))
    twice = solved(replace(spindle, shaft=heavy), gauges=(0.1,))
    assert twice.sag == pytest.approx(2 * down.sag, rel=1e-12)
    masses = {m: (PointMass("m", 0.0, m),) for m in (1.0, 3.0)}
    light, more = (
        solved(replace(spindle, masses=m), gauges=(0.1,)).sag - down.sag for m in masses.values()
    )
    assert more == pytest.approx(3 * light, rel=1e-10)
    assert light[0, 0, 0] < 0.0


SUPPORTS = {
    "rigid": (held("a", 0.3), held("b", 1.0)),
    "soft": (sprung("a", 0.3, 1e5, 3e8), sprung("b", 1.0, 2e7, 4e4)),
}


@pytest.mark.parametrize("kind", SUPPORTS)
def test_runout_of_two_rings_by_their_levers(kind: str) -> None:
    """Whatever the stiffness: in phase the axis shifts, in opposite phase it tilts; at a right
    angle both levers add as squares."""
    spindle, gauges, r = beam(*SUPPORTS[kind]), (0.0, 0.3), 4e-6

    def runout(angle: float) -> StaticSagResult:
        rings = (RingRunout("a", r, 0.2), RingRunout("b", r, 0.2 + angle))
        return solved(spindle, gauges=gauges, ring_runouts=rings)

    near = 1.0 + (0.3 + np.array(gauges)) / 0.7  # of ring a: the nose lies at x = −gauge
    far = (0.3 + np.array(gauges)) / 0.7
    for angle, wanted in (
        (0.0, near - far),
        (math.pi, near + far),
        (math.pi / 2, np.hypot(near, far)),
    ):
        found = runout(angle)
        for column in (0, 1):
            assert found.runout[0, :, column] == pytest.approx(r * wanted, rel=1e-9)
            assert found.highest_runout[0, :, column] == pytest.approx(r * (near + far), rel=1e-9)
            shares = found.ring_share[0, :, :, column].T
            assert shares == pytest.approx(r * np.array([near, far]), rel=1e-9)


def test_three_supports_that_tilt_against_loads_by_their_stiffness() -> None:
    """An eccentricity e at a stiffness K is a force −K e there, one plane not like the other."""
    supports = [
        sprung("a", 0.25, 3e7, 1e7, 4e4),
        sprung("b", 0.7, 1e8, 2e7),
        sprung("c", 1.1, 2e7, 5e7, 1e5),
    ]
    crossed = {("y", "z"): 2e7, ("z", "y"): 2e7}
    supports[1] = replace(supports[1], stiffness={**supports[1].stiffness, **crossed})
    spindle, e = beam(*supports), 2e-6
    rings = (RingRunout("b", 2 * e, 0.0), RingRunout("c", 2 * e, math.pi / 2))
    found = solved(spindle, ring_runouts=rings)
    swing = np.zeros((2, 2))
    for turn, (b, c) in enumerate((((1, 0), (0, 1)), ((0, 1), (-1, 0)))):  # ψ of 0 and a quarter
        loads = []
        for support, way in ((supports[1], b), (supports[2], c)):
            stiff = [[support.stiffness.get((i, j), 0.0) for j in "yz"] for i in "yz"]
            y, z = -np.array(stiff) @ way * e
            loads.append(PointLoad(support.x, Fy=y, Fz=z))
        spec = {"section_forces": SectionForcesSpec(tuple(loads))}
        moved: Any = solve_spindle(spindle, Conditions(), (0.0,), spec, lambda name: None)
        line = moved.results["section_forces"]
        swing[turn] = line.deflection_y[0, 0], line.deflection_z[0, 0]
    assert found.runout[0, 0] == pytest.approx(2 * np.hypot(*swing), rel=1e-9)
    assert abs(found.runout[0, 0, 0] / found.runout[0, 0, 1] - 1.0) > 0.05


def test_a_spindle_on_ball_bearings() -> None:
    """Its line is that of its section forces; rings all alike shift it by their runout."""
    case = rotordyn.load(CASES / "grinding_spindle_sag.yaml")
    (spec,) = case.analyses.values()
    assert isinstance(spec, StaticSagSpec)
    alike = tuple(RingRunout(name, 3e-6, 0.7) for name in "abcd")
    asked = {
        "static_sag": replace(spec, ring_runouts=alike),
        "section_forces": SectionForcesSpec(gravity="-y"),
    }
    results = rotordyn.run(replace(case, analyses=asked))
    sag, forces = results["static_sag"], results["section_forces"]
    line = np.interp(sag.station, forces.cut, forces.deflection_y[1])
    np.testing.assert_allclose(sag.deflection[1, :, 0], line, rtol=1e-9)
    np.testing.assert_allclose(sag.runout.values, 3e-6, rtol=1e-9)
    assert (sag.sag[:, :, 0].values < 0.0).all()


def test_numbers_and_curves_say_at_which_speed_they_are() -> None:
    case = rotordyn.load(CASES / "grinding_spindle_sag.yaml")
    assert case.spindle is not None
    asked = {"static_sag": StaticSagSpec("nose"), "section_forces": SectionForcesSpec(gravity="-y")}
    speeds = (0.0, 500.0, 1200.0)
    answered = solve_spindle(case.spindle, Conditions(), speeds, asked, lambda name: None).results
    rpm = [0.0, 1200.0 * 30.0 / math.pi]
    for name, curve_at in (("section_forces", rpm[1]), ("static_sag", rpm[0])):
        shown = Shown("", answered[name], (), case.spindle)
        found = [n for n in analysis(name).numbers(answered[name], case) if not n.inner]
        assert [each.speed for each in found[:2]] == pytest.approx(rpm)
        for curve in analysis(name).curves(None, shown):
            assert curve.along == f"station [mm] at {curve_at:.0f} rpm"
    sag: Any = answered["static_sag"]
    down = [each for each in numbers(sag, case) if each.name.startswith("sag")]
    slow, fast = (each.value for each in down if not each.inner)
    assert slow == pytest.approx(-1e6 * sag.sag[0, 0, 0])
    assert fast == pytest.approx(-1e6 * sag.sag[-1, 0, 0])
    assert "by weight at 0 rpm [µm]" in summary(sag)[0]


@pytest.mark.parametrize(("down", "column", "sign"), [("-y", 0, -1), ("+z", 1, 1)])
def test_numbers_count_along_the_weight(down: str, column: int, sign: int) -> None:
    """A short nose in front of long spans rises, a long one sags; the slope turns its sign, too."""
    for overhang, rises in ((0.2, True), (0.5, False)):
        found = solved(beam(held("a", overhang), held("b", L)), gravity=down)
        sag, slope = (each.value for each in numbers(found, None))  # type: ignore[arg-type]
        assert sag == pytest.approx(sign * 1e6 * found.sag[0, 0, column])
        assert slope == pytest.approx(sign * 1e6 * found.slope[0, column])
        assert (sag < 0.0, slope > 0.0) == (rises, rises)
    along = solved(beam(held("a", 0.0), LinearSupport("b", L, rigid=("y", "z"))), gravity="none")
    assert [each.value for each in numbers(along, None)] == [0.0, 0.0]  # type: ignore[arg-type]


def test_that_a_shaft_turns_is_said_where_what_holds_it_follows_the_speed() -> None:
    """Constant supports hold it as at rest at any speed; tables and bearings do not."""
    table = LinearSupport(
        "t", 1.0, stiffness={("y", "y"): (2e7, 1e7), ("z", "z"): 2e7}, speeds=(0.0, 200.0)
    )
    damped = LinearSupport(
        "d",
        1.0,
        stiffness={("y", "y"): 2e7, ("z", "z"): 2e7},
        damping={("y", "y"): (1e3, 0.0)},
        speeds=(0.0, 200.0),
    )
    for rear, told in ((sprung("b", 1.0), ()), (damped, ()), (table, ("t",))):
        spec = {"static_sag": StaticSagSpec("nose")}
        found = solve_spindle(
            beam(sprung("a", 0.3), rear), Conditions(), (100.0,), spec, lambda name: None
        )
        result: Any = found.results["static_sag"]
        assert result.follows_speed == told
        assert [*map(bool, warnings(result))] == [True] * len(told)
    case = rotordyn.load(CASES / "grinding_spindle_sag.yaml")
    bearings = rotordyn.run(replace(case, speeds=(100.0,)))
    assert bearings["static_sag"].follows_speed.values.tolist() == list("abcd")
    assert any("add 0 rpm" in said for said in bearings.warnings)


def test_words_and_figure() -> None:
    spindle, rings = beam(*SUPPORTS["rigid"]), (RingRunout("a", 4e-6),)
    bare, turned = solved(spindle), solved(spindle, gauges=(0.0, 0.3), ring_runouts=rings)
    assert not any("runout" in line for line in summary(bare))
    said = " ".join(summary(turned)).replace("\u00a0", " ")
    assert "y 5.71 z 5.71, y 7.43 z 7.43 300 mm in front" in said
    assert "the sag does not rotate" in said
    heads = ["sag along the weight at 0 rpm [µm]", "slope along the weight at 0 rpm [µrad]"]
    heads.append("runout at 0 rpm [µm]")
    assert [n.heading for n in numbers(turned, None)] == heads  # type: ignore[arg-type]
    assert [n.heading for n in numbers(bare, None)] == heads[:2]  # type: ignore[arg-type]
    assert warnings(turned) == []
    late = replace(turned, speed=np.array([100.0]), true_ring=("c", "d"), follows_speed=("c", "d"))
    given, slow = warnings(late)
    assert "bearings c, d, which are assumed to run true" in given
    assert "slowest speed solved is 955 rpm" in slow
    (axes,) = line_figure([Shown("", turned, (), spindle)]).axes
    assert axes.get_ylabel() == "deflection y [µm]"
    words = [text.get_text() for text in axes.texts]
    assert any("runout 7.43 µm" in each for each in words)
    marks = next(line for line in axes.get_lines() if line.get_marker() == "v")
    assert list(marks.get_xdata()) == pytest.approx([0.0, -300.0])


@pytest.mark.parametrize("gauges", [(-0.02, 0.0, 0.05), (0.3, 0.31, 0.32, 0.33)])
def test_what_gauges_near_to_each_other_read_is_beside_each_other(
    gauges: tuple[float, ...],
) -> None:
    """Within the panel, too."""
    spindle, rings = beam(*SUPPORTS["rigid"]), (RingRunout("a", 4e-6),)
    found = solved(spindle, gauges=gauges, ring_runouts=rings)
    figure = line_figure([Shown("", found, (), spindle)])
    figure.draw_without_rendering()
    (axes,) = figure.axes
    said = [text for text in axes.texts if "runout" in text.get_text()]
    boxes = [text.get_window_extent() for text in said]
    assert len(boxes) == len(gauges)
    assert not any(one.overlaps(other) for one, other in combinations(boxes, 2))
    panel = axes.get_window_extent()
    assert all(panel.x0 <= box.x0 and box.x1 <= panel.x1 for box in boxes)
    both = line_figure([Shown(title, found, (), spindle) for title in ("one", "other")])
    said = [text for text in both.axes[0].texts if "runout" in text.get_text()]
    assert len(said) == len(gauges), "of the first machine alone"


def test_what_a_gauge_reads_is_clear_of_the_shaft() -> None:
    """At the lower end of an overhang the shaft lies above the gauge."""
    spindle = beam(*SUPPORTS["rigid"])
    found = solved(spindle, gauges=(0.0,))
    low = replace(found, deflection=-np.abs(found.deflection), sag=-np.abs(found.sag))
    for each in (found, low):
        figure = line_figure([Shown("", each, (), spindle)])
        figure.draw_without_rendering()
        (axes,) = figure.axes
        (said,) = (text for text in axes.texts if "µm" in text.get_text())
        shaft = next(line for line in axes.get_lines() if line.get_label().startswith("shaft"))
        fine = np.linspace(*shaft.get_xdata()[[0, -1]], 2000)
        drawn = np.interp(fine, shaft.get_xdata(), shaft.get_ydata())
        points = axes.transData.transform(np.column_stack([fine, drawn]))
        box = said.get_window_extent()
        assert not box.count_contains(points)


FAULTS: Sequence[tuple[str, dict[str, Any], str]] = (
    ("nose", {"ring_runouts": (RingRunout("d", 1e-6),)}, "unknown bearing or support: given 'd'"),
    ("nos", {}, "unknown point: given 'nos'.*did you mean nose"),
    ("nose", {"gravity": "-x"}, "gravity.*not one of its choices"),
    ("nose", {"gauges": ()}, "gauges.*too few items"),
    ("nose", {"gauges": (0.1, 0.1)}, "100 mm"),
    ("nose", {"ring_runouts": (RingRunout("a", 1e-6), RingRunout("a", 2e-6))}, "'a'"),
)


@pytest.mark.parametrize(("point", "asked", "why"), FAULTS)
def test_faults(point: str, asked: dict[str, Any], why: str) -> None:
    with pytest.raises(InvalidInput, match=why):
        _case(beam(*SUPPORTS["rigid"]), StaticSagSpec(point, **asked))


@pytest.mark.parametrize(("down", "sag"), [("-y", (-1, 0)), ("+z", (0, 1)), ("+x", (0, 0))])
def test_by_default_the_weight_is_that_of_the_conditions(down: str, sag: tuple[int, int]) -> None:
    ends = held("a", 0.0), LinearSupport("b", L, rigid=("y", "z"))
    own = solved(beam(*ends), "middle")
    found = solved(beam(*ends), "middle", Conditions(gravity=down))
    size = -own.sag[0, 0, 0]
    assert found.sag[0, 0] == pytest.approx(np.multiply(size, sag), abs=1e-9 * size)


def test_a_weight_that_contradicts_the_conditions_or_is_held_by_nothing() -> None:
    for own, acting in (("-y", "+x"), ("none", "-y"), ("-z", "-y")):
        spec, words = (
            StaticSagSpec("nose", gravity=own),
            f"given '{own}', in the conditions '.{acting[1]}'",
        )
        with pytest.raises(InvalidInput, match=words):
            _case(beam(*SUPPORTS["rigid"]), spec, Conditions(gravity=acting))
    with pytest.raises(InvalidInput, match=r"gravity: free body .*: .*thz unrestrained"):
        _case(beam(sprung("a", 0.3)), StaticSagSpec("nose"))


def _case(spindle: Spindle, spec: StaticSagSpec, conditions: Conditions | None = None) -> Any:
    return rotordyn.Case(
        name="sag",
        title="sag",
        spindle=spindle,
        conditions=conditions or Conditions(),
        speeds=(0.0,),
        analyses={"static_sag": spec},
    )


@pytest.mark.parametrize("share", [0.5, -3.0])
def test_sag_under_an_axial_force(share: float) -> None:
    """A pinned column without shear that carries its weight, at mid-span, under a share of its
    buckling load, compression positive (Timoshenko, Theory of Elastic Stability)."""
    column = beam(held("l", 0.0), LinearSupport("r", L, rigid=("y", "z")), shear="none")
    force = share * math.pi**2 * EI / L**2
    k = cmath.sqrt(force / EI)
    sag = W / force * ((1.0 / cmath.cos(k * L / 2.0) - 1.0) / k**2 - L**2 / 8.0)
    found = solved(column, "middle", Conditions(tension=-force))
    assert found.sag[0, 0, 0] == pytest.approx(-sag.real, rel=1e-10)


def test_a_sag_that_is_not_small_is_said() -> None:
    column = beam(held("l", 0.0), LinearSupport("r", L, rigid=("y", "z")), shear="none")
    for share, told in ((0.5, 0), (0.99995, 1)):
        force = share * math.pi**2 * EI / L**2
        found = solved(column, "middle", Conditions(tension=-force))
        assert sum("beyond small deflections" in each for each in warnings(found)) == told, share
