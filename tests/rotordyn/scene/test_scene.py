"""Shared stages: solved once, only when asked, and outcomes that travel into every result."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from rotordyn.analyses.campbell.solve import solve as campbell_answer
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.preload.spec import PreloadSpec
from rotordyn.analyses.solving import solve_spindle
from rotordyn.analyses.stiffness.spec import StiffnessSpec
from rotordyn.errors import NoSolution
from rotordyn.machine.growth import PrescribedShortening
from rotordyn.machine.support import LinearSupport
from rotordyn.scene.scene import Scene
from rotordyn.scene.stage import Memo
from tests.oracles.rotors import support, uniform
from tests.oracles.spindles import (
    ROOT,
    RPM,
    answers,
    case,
    conditions,
    mfw2310,
    pairs,
    scene,
    system_of,
    with_sleeve,
)

ASKED = {
    "preload": PreloadSpec(),
    "campbell": CampbellSpec(3000.0),
    "frf": FrfSpec((100.0, 1000.0), pairs("Oc2.y/Oc2.y", "Oc2.z/Oc2.y")),
    "stiffness": StiffnessSpec("Oc2", 500.0, 2, second_stop={"front": 45e-6}),
}
STAGES = {"mesh", "preload", "shaft_force", "buckling", "tangents", "rotor", "subsystems"}


def skipped(analyses: dict[str, Any]) -> set[str]:
    speeds = (0.0, 12000 * RPM)
    found = solve_spindle(mfw2310(), conditions(), speeds, analyses, lambda name: None)
    return set(found.skipped)


@pytest.mark.parametrize(
    ("names", "unused"),
    [
        (["preload"], STAGES - {"preload", "buckling"}),
        (["stiffness"], {"subsystems"}),
        (["frf"], set()),
        (["campbell"], set()),
        (["preload", "frf", "stiffness"], set()),
    ],
)
def test_stages_nobody_asks_for_never_run(names: list[str], unused: set[str]) -> None:
    assert skipped({n: ASKED[n] for n in names}) == unused


@pytest.mark.parametrize("name", sorted(ASKED))
def test_each_analysis_alone_equals_itself_in_company(name: str) -> None:
    together = answers(mfw2310(), (0, 24000), ASKED)[name]
    alone = answers(mfw2310(), (0, 24000), {name: ASKED[name]})[name]
    for field in ("frequency", "receptance", "deflection", "axial_load"):
        if hasattr(alone, field):
            a, b = getattr(alone, field), getattr(together, field)
            assert a.shape == b.shape
            assert a == pytest.approx(b, rel=1e-5)


def test_preload_is_solved_once_for_all_questions(monkeypatch: pytest.MonkeyPatch) -> None:
    import rotordyn.scene.statics as module

    calls = []
    original = module.operating_state
    monkeypatch.setattr(
        module, "operating_state", lambda *given: calls.append(1) or original(*given)
    )
    answers(mfw2310(), (0, 12000), ASKED)
    assert len(calls) == 1


def test_static_bearings_are_solved_at_rest_only() -> None:
    found = scene(mfw2310(), (0, 6000, 24000), bearings="static")
    assert found.preload.speed.tolist() == [0.0]
    assert found.bearing_row.tolist() == [0, 0, 0]
    assert (found.seat_stiffness[0] == found.seat_stiffness[2]).all()


@pytest.mark.parametrize("tangent", ["complete", "frozen", "difference"])
def test_the_tangent_in_force_is_that_of_the_conditions(tangent: str) -> None:
    """Modes, receptances and linear stiffness all stand on it; the planes stay alike."""
    found = scene(mfw2310(), (0, 24000), tangent=tangent)
    expected = found.preload.seat_stiffness(tangent)
    assert (found.seat_stiffness == expected).all()
    assert system_of(found).whirling
    complete = found.preload.seat_stiffness()
    apart = np.abs(expected[..., 1, 1] / complete[..., 1, 1] - 1.0)
    assert apart[0].max() < 1e-7
    assert (apart[1].max() > 0.01) == (tangent == "frozen")


def test_tangent_reaches_every_linear_answer() -> None:
    """At rest all tangents are one; at top speed the frozen one is too stiff in every variant."""
    linear = StiffnessSpec("Oc2", 500.0, 2, ("full", "diagonal", "constant_preload"))
    asked = {"campbell": CampbellSpec(2000.0, (), False), "stiffness": linear}
    found, frozen = (
        answers(mfw2310(), (0, 24000), asked, tangent=name) for name in ("complete", "frozen")
    )
    pairs = (found["stiffness"].tangent, frozen["stiffness"].tangent)
    assert pairs[1][0] == pytest.approx(pairs[0][0], rel=1e-9)
    assert (pairs[1][1] > 1.01 * pairs[0][1]).all()
    modes, stiffer = (f["campbell"].frequency[:, 0] for f in (found, frozen))
    assert stiffer[0] == pytest.approx(modes[0], rel=1e-9)
    assert abs(stiffer[1] / modes[1] - 1.0) > 1e-3


def test_weight_of_a_vertical_spindle() -> None:
    """21.35 kg hang on position 1 or pull at it."""
    assert scene(mfw2310(), (0,), gravity="+x").axial_force == pytest.approx(209.4, abs=0.3)
    assert scene(mfw2310(), (0,), gravity="-x").axial_force == pytest.approx(-209.4, abs=0.3)
    both = scene(mfw2310(), (0,), gravity="-x", axial_force=300.0).axial_force
    assert both == pytest.approx(90.6, abs=0.3)
    found = answers(mfw2310(), (6000,), {"preload": PreloadSpec()}, gravity="+x")["preload"]
    a, b, c, d, e = found.axial_load[0]
    assert a + b - c - d - e == pytest.approx(209.4, abs=0.3)


def test_speeds_without_solution_are_named_in_every_result() -> None:
    """The rear seats shift away: the first speeds are delivered, the last is not."""
    far = PrescribedShortening(6000 * RPM, {"d": 300e-6, "e": 300e-6})
    found = answers(mfw2310(shortening=far), (0, 3000, 6000), ASKED)
    for name, result in found.items():
        assert [word == "" for word in result.outcome] == [True, True, False], name
        assert "d, e is unloaded at 6000 rpm" in result.outcome[2]
    lost = {
        "preload": ("axial_load", "stiffness", "inner_pressure", "position", "growth"),
        "campbell": ("frequency", "damping_ratio", "whirl"),
        "frf": ("receptance",),
        "stiffness": ("deflection", "tangent", "secant"),
    }
    for name, fields in lost.items():
        for field in fields:
            values = getattr(found[name], field)
            assert np.isfinite(values[:2]).all(), field
            assert np.isnan(values[2]).all(), field
    assert np.isnan(found["frf"].receptance[2].imag).all()
    assert found["campbell"].shape_speed == pytest.approx(np.array([0, 3000]) * RPM)


@pytest.mark.parametrize("name", ["campbell", "frf", "stiffness"])
def test_no_speed_with_a_solution(name: str) -> None:
    far = PrescribedShortening(3000 * RPM, {"d": 300e-6, "e": 300e-6})
    with pytest.raises(NoSolution, match="unloaded at 3000 rpm"):
        answers(mfw2310(shortening=far), (3000, 6000), {name: ASKED[name]})


def test_preload_alone_has_no_solution_either() -> None:
    far = PrescribedShortening(3000 * RPM, {"d": 300e-6, "e": 300e-6})
    with pytest.raises(NoSolution, match="unloaded at 3000 rpm"):
        answers(mfw2310(shortening=far), (3000, 6000), {"preload": PreloadSpec()})


def test_coarsest_mesh_is_a_mesh() -> None:
    """One element between supports: as many reduced coordinates as DOF, no more."""
    held = tuple(support(n, x, (1e7, 1e7)) for n, x in (("a", 0.0), ("b", 1.0)))
    rotor = uniform(1.0, 0.05, supports=held)
    asked = {"campbell": CampbellSpec(2000.0)}
    for element in (1.0, 0.5, 0.2):
        found = answers(rotor, (0, 3000), asked, element_length=element)["campbell"]
        assert found.frequency[0].min() == pytest.approx(90.0, rel=0.1)


def test_linear_supports_need_no_bearing_solver() -> None:
    code = (
        "import sys, rotordyn\n"
        "case = rotordyn.load('cases/lalanne_ferraris.yaml')\n"
        "from rotordyn.job import solve\n"
        "solve(case)\n"
        "print(*sorted(m for m in sys.modules if m.startswith('bearings')))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert "bearings.materials" in done.stdout.split()
    assert not {
        "bearings.ring.equilibrium",
        "bearings.ball.balance",
        "bearings.fit.compound",
    } & set(done.stdout.split())


def test_a_state_that_only_one_of_both_models_has_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    """As near to buckling, or where loads are hardly balanced: no error can be reported there."""
    found = scene(mfw2310(), (0.0, 12000.0, 24000.0))
    exact = Scene.outcome
    monkeypatch.setattr(
        Scene,
        "outcome",
        property(lambda each: ("", "the shaft buckles", "") if each.finer else exact.func(each)),
    )
    with pytest.raises(
        NoSolution, match=r"at 12000 rpm depends on the refinement of its model \(the shaft"
    ):
        campbell_answer(found, CampbellSpec(3000.0))


def test_tolerances_reached() -> None:
    speeds = tuple(n * RPM for n in (0, 12000, 24000))
    found = solve_spindle(mfw2310(), conditions(), speeds, ASKED, lambda name: None)
    assert len(found.tolerances) >= 2
    assert max(found.tolerances.values()) < 1e-8
    assert set(found.seconds) >= {"preload", "rotor", *(f"solve {name}" for name in ASKED)}


def test_only_questions_asked_report_progress() -> None:
    seen: list[str] = []
    speeds = (0.0,)
    solve_spindle(mfw2310(), conditions(), speeds, {"frf": ASKED["frf"]}, seen.append)
    assert seen == ["frf"]


def test_case_of_linear_supports_has_no_preload_question() -> None:
    rotor = case("lalanne_ferraris")
    assert rotor.spindle is not None
    found = answers(
        replace(rotor.spindle), (0, 3000), {"campbell": CampbellSpec(600.0)}, element_length=0.1
    )
    assert found["campbell"].outcome == ("", "")


def test_variants_of_a_spring_have_their_own_vibrations() -> None:
    """What one machine leaves in the memo does not serve another that moves otherwise."""
    memo, speed = Memo(), np.array([0.0, 12000.0]) * RPM
    ours = mfw2310().sleeves[0].spring
    for stiffness in (2e6, 40e6):
        machine = with_sleeve(mfw2310(), "front", spring=replace(ours, stiffness=stiffness))
        shared, alone = (
            system_of(Scene(machine, conditions(), speed, memo=kept), "axial")
            for kept in (memo, Memo())
        )
        assert shared.pole == pytest.approx(alone.pole, rel=1e-12)


def test_bearings_at_rest_beside_supports_that_follow_the_speed_bend_with_it() -> None:
    """Under weight the shaft hangs between bearings that do not change and a film that does."""
    ours = mfw2310()
    film = LinearSupport(
        name="film",
        x=ours.shaft.end - 0.05,
        stiffness={(way, way): (1e6, 5e8) for way in "yz"},
        speeds=(0.0, 2600.0),
    )
    machine = replace(ours, supports=(*ours.supports, film))
    how = conditions(bearings="static", gravity="-z")
    found = Scene(machine, how, np.array([0.0, 24000.0]) * RPM)
    assert found.preload.usable.all()
    other = found.at(np.array([0.0, 3000.0]) * RPM)
    alone = Scene(machine, how, np.array([0.0, 3000.0]) * RPM)
    assert other.preload.lateral == pytest.approx(alone.preload.lateral, rel=1e-4)
