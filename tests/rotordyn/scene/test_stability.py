"""Motions that grow by themselves are results, and said to be."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.solving import MachineResults, solve_spindle
from rotordyn.machine.inertia import rotor_inertia
from rotordyn.machine.lumped import PointMass
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.report.warnings import result_warnings
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.stability import fastest_growth
from tests.oracles.rotors import STEEL, support, uniform
from tests.oracles.spindles import RPM, mfw2310, pairs, scene, undamped

STIFF, DAMPER = 1e6, 200.0


def swirled(cross: float, stiff: float = STIFF) -> Spindle:
    """A cylinder between two seals with k yz = −k zy."""
    swirl = {("y", "z"): cross, ("z", "y"): -cross}
    ends = [support(n, x, (stiff, stiff), DAMPER) for n, x in (("a", 0.0), ("b", 0.5))]
    held = tuple(replace(s, stiffness={**s.stiffness, **swirl}) for s in ends)
    return replace(uniform(0.5, 0.05, supports=held), points={"mid": 0.25})


def held(
    name: str, x: float, direct: tuple[float, float], cross: tuple[float, float], damping: float
) -> LinearSupport:
    """Radial stiffness yy and zz, yz and zy."""
    ways = [("y", "y"), ("z", "z"), ("y", "z"), ("z", "y")]
    stiffness = dict(zip(ways, (*direct, *cross), strict=True))
    return LinearSupport(name, x, stiffness, dict.fromkeys(ways[:2], damping))


def solved(spindle: Spindle, highest: float = 400.0) -> MachineResults:
    asked: dict[str, Any] = {"campbell": CampbellSpec(highest, shapes=False)}
    speeds = (0.0, 1000.0 * RPM)
    return solve_spindle(spindle, Conditions(rotor="rigid"), speeds, asked, lambda name: None)


@pytest.mark.parametrize("share", [0.9, 1.1], ids=["below", "above"])
def test_swirl_against_damping_in_closed_form(share: float) -> None:
    """Translation of a rigid rotor: m λ² + c λ + k ∓ iκ = 0, unstable from κ = c √(k/m) on."""
    mass = rotor_inertia(swirled(0.0)).mass
    cross = share * DAMPER * math.sqrt(2.0 * STIFF / mass)
    poles = np.roots([mass, 2.0 * DAMPER, 2.0 * STIFF - 2j * cross])
    pole = poles[np.abs(poles.imag).argmax()] if share < 1 else poles[poles.real.argmax()]
    answers = solved(swirled(cross))
    found = answers.results["campbell"]
    worst = found.damping_ratio[0].min()
    ratio = min(-p.real / abs(p) for p in poles if abs(p.imag) > 1.0)
    assert worst == pytest.approx(ratio, rel=1e-9)
    assert (pole.real > 0.0) == (share > 1.0)
    named = result_warnings(answers.results)
    if share < 1.0:
        assert not found.unstable.any()
        assert named == []
        assert answers.warnings == ()
        return
    name = found.mode[found.damping_ratio[0].argmin()]
    assert any(sentence.startswith(f"{name} is unstable at 0 rpm") for sentence in named)
    (sentence,) = answers.warnings
    assert "steady responses there are solutions of the linear equations" in sentence
    assert sentence.startswith("unstable at 2 of 2 speeds, first at 0 rpm: the machine vibrates at")
    assert np.isfinite(found.frequency).all()


def test_the_first_unstable_speed_is_reported_with_the_growth_there() -> None:
    """Translation of a rigid rotor as above, κ by the speed; at twice the speed it grows faster."""
    mass, first = rotor_inertia(swirled(0.0)).mass, 500.0 * RPM
    cross = 2.2 * DAMPER * math.sqrt(2.0 * STIFF / mass)  # at twice ``first``, half of it there
    swirl = {("y", "z"): (0.0, cross), ("z", "y"): (0.0, -cross)}
    held = tuple(
        replace(s, stiffness={**s.stiffness, **swirl}, speeds=(0.0, 2.0 * first))
        for s in swirled(0.0).supports
    )
    asked: dict[str, Any] = {"campbell": CampbellSpec(400.0, shapes=False)}
    answers = solve_spindle(
        replace(swirled(0.0), supports=held),
        Conditions(rotor="rigid"),
        (0.0, first, 2.0 * first),
        asked,
        lambda name: None,
    )
    poles = np.roots([mass, 2.0 * DAMPER, 2.0 * STIFF - 1j * cross])
    pole = poles[poles.real.argmax()]
    (sentence,) = answers.warnings
    assert sentence.startswith("unstable at 2 of 3 speeds, first at 500 rpm: the machine vibrates")
    said = re.search(
        r"vibrates at ([\d.]+) Hz, its amplitude grows by a factor e in ([\d.]+) s", sentence
    )
    assert said is not None
    assert [float(each) for each in said.groups()] == pytest.approx(
        [abs(pole.imag) / 2.0 / math.pi, 1.0 / pole.real], rel=6e-3
    )


def test_divergence_is_no_mode_but_a_warning() -> None:
    """Pushed away by its support: nothing vibrates, the warning still comes."""
    ends = (support("a", 0.0, (STIFF, STIFF)), support("b", 0.5, (STIFF, -3.0 * STIFF)))
    answers = solved(uniform(0.5, 0.05, supports=ends))
    (sentence,) = answers.warnings
    assert "moves away without vibrating (divergence, a static instability" in sentence
    found = answers.results["campbell"]
    assert not found.unstable.any()
    assert (found.stability_threshold, found.unstable_mode) == (0.0, "a divergence")


@pytest.mark.parametrize("rotor", ["rigid", "flexible"])
def test_divergence_of_a_whirl_is_no_vibration(rotor: str) -> None:
    """Isotropic: pushed away in a slow spiral at speed, straight on at rest."""
    ends = (support("a", 0.0, (STIFF, STIFF)), support("b", 0.5, (-3.0 * STIFF, -3.0 * STIFF)))
    asked: dict[str, Any] = {"campbell": CampbellSpec(400.0, shapes=False)}
    spindle = uniform(0.5, 0.05, supports=ends)
    speeds = (0.0, 1000.0 * RPM)
    answers = solve_spindle(spindle, Conditions(rotor=rotor), speeds, asked, lambda name: None)
    (sentence,) = answers.warnings
    assert "vibrates at" not in sentence
    assert "moves away without vibrating (divergence" in sentence
    found = answers.results["campbell"]
    assert (found.stability_threshold, found.unstable_mode) == (0.0, "a divergence")


def test_the_speed_at_which_a_divergence_begins() -> None:
    """The support's table goes through zero at 500 rad/s: k = 1 − Ω/500 of the other plane's."""
    table = tuple(STIFF * (1.0 - speed / 500.0) for speed in (0.0, 1000.0))
    ends = tuple(
        LinearSupport(
            name, x, {("y", "y"): STIFF, ("z", "z"): table}, {("z", "z"): 1e3}, speeds=(0.0, 1000.0)
        )
        for name, x in (("a", 0.0), ("b", 0.5))
    )
    asked: dict[str, Any] = {"campbell": CampbellSpec(400.0, shapes=False)}
    given, speeds = Conditions(rotor="rigid"), (0.0, 300.0, 1000.0)
    answers = solve_spindle(
        uniform(0.5, 0.05, supports=ends), given, speeds, asked, lambda name: None
    )
    found = answers.results["campbell"]
    assert found.stability_threshold == pytest.approx(500.0, rel=1e-6)
    assert found.unstable_mode == "a divergence"


def test_receptances_of_an_unstable_machine_are_warned_of() -> None:
    asked = {"frf": FrfSpec((10.0, 50.0), pairs("mid.y/mid.y"))}
    answers = solve_spindle(
        swirled(STIFF), Conditions(), (0.0, 1000.0 * RPM), asked, lambda name: None
    )
    assert answers.results["frf"].unstable.all()
    assert any("an unstable machine does not reach" in sentence for sentence in answers.warnings)


def test_what_a_slow_model_gives_mass_does_not_vibrate() -> None:
    """At 0.01 Hz no motion has the mass of the machine; a divergence needs none."""
    asked = {"frf": FrfSpec((0.001, 0.01), pairs("mid.y/mid.y"))}
    stiff = 10.0 * STIFF
    limit = DAMPER * math.sqrt(stiff * 2.0 / rotor_inertia(swirled(0.0)).mass)
    stable = swirled(0.6 * limit, stiff)
    ends = (support("a", 0.0, (STIFF, STIFF)), support("b", 0.5, (STIFF, -3.0 * STIFF)))
    pushed = replace(uniform(0.5, 0.05, supports=ends), points={"mid": 0.25})
    for spindle, said in ((stable, False), (pushed, True)):
        answers = solve_spindle(
            spindle, Conditions(accuracy=1e-6), (0.0,), asked, lambda name: None
        )
        assert answers.results["frf"].unstable.any() == said
        assert any("unstable" in sentence for sentence in answers.warnings) == said


@pytest.mark.parametrize(
    ("highest", "told"),
    [
        (400.0, "vibrates at about 580 Hz, above the 400 Hz that its model is made for (campbell"),
        (800.0, "vibrates at 583.2 Hz, its amplitude grows by a factor e in 0.109 s"),
    ],
    ids=["above the band", "in the band"],
)
def test_an_instability_above_the_band_is_no_fact(highest: float, told: str) -> None:
    """A model for 4000 Hz has 583.22 Hz and 0.1091 s; faster growth at 2000 to 5000 Hz differs with
    every model."""
    swirl = (8.42e7, 5.28e7), (2.10e7, -1.49e7)
    spindle = Spindle(
        "swirl in one support",
        Shaft(0.0, (Section(0.4, 0.0295, 0.0, STEEL), Section(0.22, 0.064, 0.0, STEEL))),
        masses=(PointMass("disc", 0.4, 22.8, 0.228, 0.137),),
        supports=(
            held("a", 0.0, *swirl, 100.0),
            held("b", 0.62, (1.24e7, 6.93e6), (0.0, 0.0), 800.0),
        ),
    )
    asked: dict[str, Any] = {"campbell": CampbellSpec(highest, shapes=False)}
    (sentence,) = solve_spindle(spindle, Conditions(), (300.0,), asked, lambda name: None).warnings
    assert told in sentence


def test_growth_is_reported_at_speeds_with_fewer_poles() -> None:
    """Damping so strong at rest that nothing oscillates; at speed the slowest pair grows."""
    mass = rotor_inertia(swirled(0.0)).mass
    cross = 2.0 * DAMPER * math.sqrt(2.0 * STIFF / mass)
    swirl = {("y", "z"): (0.0, cross), ("z", "y"): (0.0, -cross)}
    ends = tuple(
        LinearSupport(
            name,
            x,
            {("y", "y"): STIFF, ("z", "z"): 1.001 * STIFF, **swirl},
            {("y", "y"): (1e6, DAMPER), ("z", "z"): (1e6, DAMPER)},
            speeds=(0.0, 1000.0 * RPM),
        )
        for name, x in (("a", 0.0), ("b", 0.5))
    )
    (sentence,) = solved(uniform(0.5, 0.05, supports=ends)).warnings
    assert sentence.startswith("unstable at 1 of 2 speeds, first at 1000 rpm: the machine vibrates")


def test_growth_that_is_reported_is_the_fastest_of_all_subsystems() -> None:
    """In the band; of what grows beyond it alone the slowest."""

    def growing(*pole: complex) -> Any:
        fine = SimpleNamespace(frequency=400.0)
        linear = SimpleNamespace(structure=SimpleNamespace(fine=fine))
        row = np.array(pole)[:, None]
        return SimpleNamespace(pole=row, growing=row.real > 0.0, linear=linear)

    inside, outside = 2j * math.pi * 300.0, 2j * math.pi * 500.0
    one = growing(5.0 + inside, 9.0 + outside, 9.0 + outside, -1.0 + inside)
    other = growing(3.0 + inside, 3.0 + inside, 1.0 + 1.1 * outside, -2.0 + inside)
    told = [5.0 + inside, 3.0 + inside, 9.0 + outside, 0.0]
    for systems in ([one, other], [other, one]):
        assert fastest_growth(systems, 4).tolist() == told


@pytest.mark.parametrize("spindle", [mfw2310(), undamped(mfw2310())], ids=["damped", "undamped"])
def test_rounding_is_no_instability(spindle: Spindle) -> None:
    """The flagship with unsymmetric tangents, its spin free."""
    found = scene(spindle, (0, 12000, 24000))
    for k in found.with_motions(("bending", "axial", "torsion")):
        assert not found.system(k).growing.any(), found.name_of(k)
    assert found.warnings == ()


def test_the_threshold_of_a_swirl_that_does_not_depend_on_speed() -> None:
    """It grows from the first speed on; below the limit it never does."""
    mass = rotor_inertia(swirled(0.0)).mass
    limit = DAMPER * math.sqrt(STIFF * 2.0 / mass)
    for share, expected in ((0.9, math.inf), (1.1, 0.0)):
        found = solved(swirled(share * limit)).results["campbell"]
        assert found.stability_threshold == expected
        assert (found.unstable_mode != "") == (share > 1.0)
