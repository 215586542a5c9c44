"""A spindle with friction under a cycle of axial force, against networks that another code solved,
the state without memory, and the energy that friction takes."""

from __future__ import annotations

import json
import math
import re
from dataclasses import replace
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rotordyn
from bearings.ball.law import Law
from bearings.geometry import geometry
from bearings.materials import Material
from rotordyn.analyses import AxialCycleSpec
from rotordyn.analyses.axial_cycle.figures import figures, headline_curves
from rotordyn.analyses.axial_cycle.result import AxialCycleResult
from rotordyn.analyses.axial_cycle.solve import solve
from rotordyn.analyses.axial_cycle.summary import numbers, summary, warnings
from rotordyn.errors import InvalidInput
from rotordyn.machine.spindle import Spindle
from rotordyn.preload.history import history
from rotordyn.preload.together import dynamic_preload
from rotordyn.results.described import Shown
from rotordyn.scene.loads import PointLoad
from rotordyn.scene.spec import Setting
from tests.oracles.idealised import times
from tests.oracles.spindles import CASES, RPM, conditions, mfw2310, scene, with_sleeve

LAW = Law("outer", "equal")
FRICTION = 80.9  # N, Noël 2013, Tab. 3.7
FILE = Path(__file__).parents[1] / "rotordyn" / "state" / "network_cases.json"
KNOWN = {case["name"]: case for case in json.loads(FILE.read_text(encoding="utf-8"))["cases"]}
POSITION, LOAD = 0.02e-6, 1e-3  # m, relative


def rubbing(limit: float = FRICTION) -> Spindle:
    return with_sleeve(mfw2310(), "front", friction=limit)


@cache
def cycle(limit: float = FRICTION, steps: int = 35) -> AxialCycleResult:
    """At rest and 16 000 rpm, over the forces of the published measurements."""
    spec = AxialCycleSpec(lowest=-1900.0, highest=1600.0, steps=steps)
    return solve(scene(rubbing(limit), [0.0, 16000.0]), spec)


def met(state: Any, known: dict[str, Any]) -> None:
    assert state.x == pytest.approx(list(known["x"].values()), abs=POSITION, rel=0.0)
    assert state.at.load == pytest.approx(known["load"], rel=LOAD)
    assert state.friction == pytest.approx(known["friction"], rel=LOAD)
    assert np.sum(state.press) == pytest.approx(sum(known["stop"]), rel=LOAD)


def test_friction_at_rest_with_real_bearings() -> None:
    case = KNOWN["mfw2310_rest_friction"]
    path = history(dynamic_preload(rubbing(), np.zeros(1), LAW), 1900.0)
    (start,) = path.run_up()
    force = [step["force"]["shaft"] for step in case["path"]]
    for state, known in zip(path.loaded(0, start, force), case["answers"], strict=True):
        met(state, known)


def test_speeds_and_loads_with_real_bearings() -> None:
    case = KNOWN["mfw2310_speeds_no_friction"]
    preload = dynamic_preload(mfw2310(), np.array([16000.0, 24000.0]) * RPM, LAW)
    path = history(preload, 1900.0)
    states = list(path.run_up())
    force = [step["force"]["shaft"] for step in case["path"][2:]]
    states += path.loaded(1, states[-1], force)
    for state, known in zip(states, case["answers"], strict=True):
        met(state, known)


@pytest.mark.parametrize("force", [-1500.0, 0.0, 1200.0])
def test_without_friction_the_path_ends_where_no_memory_is_needed(force: float) -> None:
    found = cycle(0.0)
    (at,) = np.flatnonzero(np.isclose(found.force, force))
    plain = dynamic_preload(mfw2310(), found.speed, LAW, force)
    for branch in range(2):
        assert found.position[:, branch, at] == pytest.approx(plain.shift, abs=1e-10)
        loads = found.axial_load[:, branch, at]
        assert loads == pytest.approx(plain.seat_load(), rel=1e-5, abs=1e-3)
    assert found.loss == pytest.approx(0.0, abs=1e-12)


@pytest.mark.long
def test_the_energy_lost_is_the_area_between_the_branches() -> None:
    """∮ F du by the trapezoidal rule, whatever the steps of the analysis itself."""
    fine = cycle(steps=140)
    rising, falling = (np.trapezoid(fine.force, fine.position[:, k, :, 0]) for k in (1, 0))
    assert cycle().loss == pytest.approx(rising - falling, rel=2e-3)
    assert cycle(steps=1).loss == pytest.approx(fine.loss, rel=1e-9)
    front = fine.position[..., 1]
    way = front.max(axis=(1, 2)) - front.min(axis=(1, 2))
    assert fine.loss == pytest.approx(2.0 * FRICTION * way, rel=2e-3), (
        "of one sleeve, there and back"
    )


def test_the_stiffness_at_no_load_does_not_hang_on_the_steps() -> None:
    none = cycle(steps=35).no_load_stiffness
    assert cycle(steps=1).no_load_stiffness == pytest.approx(none, rel=1e-9)
    assert cycle(steps=1).force.tolist() == [-1900.0, 1600.0]


def test_the_stiffness_is_the_slope_of_each_branch() -> None:
    fine = cycle(steps=140)
    slope = np.diff(fine.force) / np.diff(fine.position[..., 0], axis=-1)
    between = 0.5 * (fine.stiffness[..., 1:] + fine.stiffness[..., :-1])
    same = np.all(  # within one part of a branch, where nothing sticks, stops or unloads
        np.abs(np.diff(fine.stiffness, axis=-1)) < 0.02 * between[..., :], axis=(0, 1)
    )
    assert same.sum() > 60
    assert slope[..., same] == pytest.approx(between[..., same], rel=2e-3)


def test_the_falling_branch_is_stiffer_at_no_load() -> None:
    """As measured: 153 N/µm while unloading, 139 while loading at 4000 rpm (Noël, Fig. 3.23)."""
    found = cycle()
    assert (found.no_load_stiffness[:, 0] > 1.02 * found.no_load_stiffness[:, 1]).all()
    smooth = cycle(0.0).no_load_stiffness
    assert smooth[:, 0] == pytest.approx(smooth[:, 1], rel=1e-9)


def test_past_the_unloading_of_the_front_the_slope_is_that_of_both_springs() -> None:
    """11.69 N/µm of springs, each in series with the bearings behind it (Noël, point A, who leaves
    the bearings out)."""
    found = cycle(0.0, steps=35)
    unloaded = (found.axial_load[0, 0, :, 0] == 0.0) & (found.stop_force[0, 0, :, 0] == 0.0)
    places = np.flatnonzero(unloaded)
    assert places.size >= 2
    springs = np.array([6.2e6, 5.49e6])
    for place in places:
        state = dynamic_preload(mfw2310(), np.zeros(1), LAW, float(found.force[place]))
        behind = (state.network.tandem * state.net.response.slope[0])[1:]
        series = (springs * behind / (springs + behind)).sum()
        assert found.stiffness[0, 0, place] == pytest.approx(series, rel=1e-6)
        assert series == pytest.approx(springs.sum(), rel=0.07)


def test_stiff_bearings_leave_the_springs_alone() -> None:
    """Kp1 + Kp2 = 12.0 N/µm past point A is the limit of bearings with a large modulus s E. What is
    missing is the springs' share of the way of d = (F/k)^(2/3): it falls as s^(-2/3), from
    Σ Kp²/K / Σ Kp with 1/K = 2/3 F^(-1/3) (Z k)^(-2/3) sin(α)^(-5/3)."""
    case = rotordyn.load(CASES / "mfw2310_rigid_or_sprung.yaml").variants["sprung"]
    assert case.spindle is not None
    force, factors, missing = np.array([-2501.0, -2499.0]), np.array([1.0, 8.0, 64.0]), []
    for factor in factors:
        machine = _stiffened(case.spindle, float(factor))
        moved = [
            dynamic_preload(machine, np.zeros(1), case.conditions.law, each).net.position[0, 0]
            for each in force
        ]
        missing.append(1.0 - 2.0 / float(moved[1] - moved[0]) / 12.0e6)
    soft = 0.0
    for seat, tandem in ((case.spindle.seats[2], 1.0), (case.spindle.seats[3], 2.0)):
        each = seat.bearing
        k = each.balls * geometry(each.grooves).series_stiffness
        held = (
            1.5 * (1250.0 / tandem) ** (1 / 3) * k ** (2 / 3) * math.sin(each.free_angle) ** (5 / 3)
        )
        soft += 1.0 / (tandem * held)
    limit = 6.0e6**2 * soft / 12.0e6
    errors = 1.0 - np.array(missing) * factors ** (2.0 / 3.0) / limit
    assert errors[1] / errors[2] == pytest.approx(4.0, rel=0.05)
    assert errors[2] < 0.01
    assert 12.0 * (1.0 - missing[-1]) == pytest.approx(12.0, rel=0.01)


def _stiffened(machine: Spindle, factor: float) -> Spindle:
    """Balls and rings with a modulus larger by ``factor``."""

    def stiff(material: Material) -> Material:
        return times(material, young_modulus=factor)

    return replace(
        machine,
        seats=tuple(
            replace(
                seat,
                bearing=replace(
                    seat.bearing,
                    ball_material=stiff(seat.bearing.ball_material),
                    ring_material=stiff(seat.bearing.ring_material),
                ),
            )
            for seat in machine.seats
        ),
    )


def test_lines_numbers_and_warnings() -> None:
    found = cycle()
    first, second = summary(found)
    assert re.match(r"axial +stiffness at no load \[N/µm\] force falling", first)
    assert re.match(r"hysteresis energy lost per cycle \[mJ\] 9\.\d+ →", second)
    assert len([*numbers(found, None)]) == 4  # type: ignore[arg-type]
    assert len(summary(cycle(0.0))) == 1
    said = warnings(found)
    assert [sentence.split(" is ")[0] for sentence in said] == ["bearing a", "bearing b"]
    assert "at 0 rpm" in said[0]


@pytest.mark.parametrize(
    ("steps", "words"), [(1, "0 and -1900"), (2, "-150 and -1900"), (5, "-500 and -1200")]
)
def test_the_force_that_unloads_lies_between_two_of_the_cycle(steps: int, words: str) -> None:
    """Steps of 100 N find it between -1100 and -1200 N, whatever coarser ones do."""
    assert "force between -1100 and -1200 N at 0 rpm" in warnings(cycle())[0]
    assert f"force between {words} N at 0 rpm" in warnings(cycle(steps=steps))[0]


def test_its_figures_show_both_branches() -> None:
    drawn = {name: draw() for name, draw in figures(None, cycle(), {})}  # type: ignore[arg-type]
    assert set(drawn) == {"axial_cycle", "axial_stiffness", "held_force"}
    upper = drawn["axial_cycle"].axes[0]
    loops = [line.get_ydata() for line in upper.lines]
    assert [np.asarray(loop)[0] for loop in loops] == pytest.approx([-57.95, -57.95], abs=0.01)
    for panel in drawn["axial_cycle"].axes:
        assert re.search(r"\[.+\]$", panel.get_xlabel())
    assert not any(panel.get_legend() for panel in drawn["axial_cycle"].axes[1::2])
    (bearings,) = drawn["axial_cycle"].legends
    boxes = [panel.get_window_extent() for panel in drawn["axial_cycle"].axes]
    assert bearings.get_window_extent().y0 > max(box.y1 for box in boxes)


def test_its_headline_curves_are_the_loops_and_the_stiffness_of_both_branches() -> None:
    variant = Shown(title="rubbing", result=cycle(), spindle=None, known=())
    curves = [*headline_curves(None, variant)]
    assert [curve.figure for curve in curves] == 4 * ["axial_cycle"] + 2 * ["axial_stiffness"]


def test_every_branch_moves_one_way() -> None:
    for branch in cycle().position[..., 0].reshape(4, -1):
        assert all(after > before for before, after in pairwise(branch))


def test_a_cycle_without_a_range_is_refused() -> None:
    with pytest.raises(InvalidInput, match="highest: no cycle: given"):
        AxialCycleSpec(lowest=100.0, highest=-100.0)


def test_a_cycle_under_loads_across_the_axis_is_refused() -> None:
    loads = (PointLoad(at="nose_face", Fy=10.0),)
    setting = Setting(mfw2310(), conditions(loads=loads), (0.0,))
    ((_, sentence),) = AxialCycleSpec().faults_on(setting)
    assert sentence.startswith("a cycle of axial force needs bearings under axial load alone")


def test_cyclic_force_that_friction_holds() -> None:
    """Noël 2013, section III.2.4.4 and Fig. 3.29: ± 185 N about −815 N at rest, with the parameters
    of his last identification."""
    result = cycle()
    known = np.isfinite(result.held_force[0])
    order = np.argsort(result.held_mean[0, known])
    mean, held = result.held_mean[0, known][order], result.held_force[0, known][order]
    assert np.interp(-815.0, mean, held) == pytest.approx(185.0, rel=0.03)
    assert held.min() > 0.0
    assert np.isnan(cycle(0.0).held_force).all()


def test_within_the_held_force_the_sleeve_stays() -> None:
    """From the falling branch up by 1.99 of the held force, and by 2.01: it stays, it moves."""
    path = history(dynamic_preload(rubbing(), np.zeros(1), LAW), 1900.0)
    (start,) = path.run_up()
    fallen = path.loaded(0, start, [1600.0, -1000.0])[-1]
    most = path.force_to_slide(0, fallen, -1000.0, 2000.0)
    for share, moves in ((0.995, False), (1.005, True)):
        there = path.loaded(0, fallen, [-1000.0 + share * most], path.under(0, -1000.0))[-1]
        assert bool(abs(there.x[1] - fallen.x[1]) > 1e-12) is moves
