"""Rigid supports: no motion at all there, in every analysis."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from bearings.materials import Material
from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.frf import solve as frf
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.measured_response import Port
from rotordyn.analyses.preload.spec import PreloadSpec
from rotordyn.analyses.section_forces import solve as section_forces
from rotordyn.analyses.section_forces.spec import SectionForcesSpec
from rotordyn.analyses.stiffness.spec import StiffnessSpec
from rotordyn.analyses.time_response import solve as time_response
from rotordyn.analyses.time_response.spec import ForceOverTime, TimeResponseSpec
from rotordyn.analyses.unbalance import solve as unbalance
from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.analyses.unbalance.summary import summary
from rotordyn.equation.constraint import allowed_motions
from rotordyn.machine.rotor import Rotor
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.loads import PointLoad, Unbalance
from rotordyn.scene.scene import Scene
from tests.oracles.spindles import answers, mfw2310
from tests.oracles.spinning_beam import PinnedBeam

STEEL = Material("steel", 2.1e11, 0.3, 7800.0)
LENGTH, DIAMETER = 0.5, 0.05
SPEEDS = np.array([0.0, 500.0, 2000.0])
FINE = Conditions(accuracy=1e-8)


def beam(*supports: LinearSupport, **more: Any) -> Spindle:
    shaft = Shaft(0.0, (Section(LENGTH, DIAMETER, 0.0, STEEL),))
    return Spindle("beam", shaft, supports=supports, points={"mid": 0.2, "end": LENGTH}, **more)


def pin(name: str, x: float, *ways: str, **more: Any) -> LinearSupport:
    return LinearSupport(name, x, rigid=ways or ("y", "z"), **more)


def spring(name: str, x: float, stiffness: float, *ways: str, damping: float = 0.0) -> Any:
    return LinearSupport(
        name,
        x,
        {(way, way): stiffness for way in ways or ("y", "z")},
        {(way, way): damping for way in ways or ("y", "z")} if damping else {},
    )


def bending(spindle: Spindle, highest: float = 6000.0, conditions: Conditions = FINE) -> Any:
    """Frequencies of bending (speeds, modes) [Hz], ascending."""
    found = campbell.solve(Scene(spindle, conditions, SPEEDS, highest), CampbellSpec(highest))
    return np.sort(found.frequency[:, [kind == "bending" for kind in found.kind]], axis=1)


def response(spindle: Spindle, *pair: str, conditions: Conditions = FINE) -> Any:
    ports = tuple(Port(*end.split(".")) for end in pair)
    spec = FrfSpec(tuple(np.linspace(20.0, 1500.0, 60)), ((ports[0], ports[1]),))
    scene = Scene(spindle, conditions, SPEEDS, 1500.0, (0.2, LENGTH))
    return frf.solve(scene, spec).receptance[:, 0]  # type: ignore[attr-defined]


def whirling(spindle: Spindle, point: str = "mid") -> Any:
    spec = UnbalanceSpec((point,), (Unbalance(point, 1e-5),))
    return unbalance.solve(Scene(spindle, FINE, SPEEDS, 500.0, (0.2, LENGTH)), spec)


def test_pinned_beam_in_closed_form() -> None:
    own = PinnedBeam(LENGTH, DIAMETER)
    exact = [
        np.sort(np.abs(np.concatenate([own.frequencies(k, s) for k in (1, 2, 3, 4)])))[:8]
        for s in SPEEDS
    ]
    found = bending(beam(pin("a", 0.0), pin("b", LENGTH)))
    assert found == pytest.approx(np.array(exact) / (2.0 * math.pi), rel=1e-8)


def test_each_plane_alone() -> None:
    """Held in y and z at different places, the planes are those of two machines."""
    mixed = beam(pin("a", 0.0), pin("b", LENGTH, "y"), pin("c", 0.3, "z"))
    ends = [beam(pin("a", 0.0), pin("b", LENGTH)), beam(pin("a", 0.0), pin("c", 0.3))]
    rest = np.sort(np.concatenate([bending(each)[0, ::2] for each in ends]))
    assert bending(mixed)[0] == pytest.approx(rest, rel=1e-9)


@pytest.mark.few(1)
@pytest.mark.parametrize("ways", [("y", "z"), ("y", "z", "thy", "thz"), ("y", "thy")])
def test_limit_of_ever_stiffer_springs(ways: tuple[str, ...]) -> None:
    """The distance to springs falls as their stiffness grows."""
    others = spring("a", 0.0, 2e7, damping=500.0), spring("b", 0.35, 5e7, damping=500.0)
    held = beam(pin("c", LENGTH, *ways), *others)
    apart: dict[str, list[float]] = {"modes": [], "frf": [], "orbit": [], "force": []}
    modes, receptance, orbit = bending(held), response(held, "mid.y", "mid.z"), whirling(held)
    for stiffness in (1e10, 1e11):
        like = beam(spring("c", LENGTH, stiffness, *ways), *others)
        near = response(like, "mid.y", "mid.z")
        other = whirling(like)
        apart["modes"].append(np.abs(bending(like) / modes - 1.0).max())
        apart["frf"].append(np.abs(near - receptance).max() / np.abs(receptance).max())
        for key, name in (("orbit", "displacement"), ("force", "force")):
            own = getattr(orbit, name)
            apart[key].append(np.abs(getattr(other, name) - own).max() / np.abs(own).max())
    for key, (soft, stiff) in apart.items():
        assert stiff < 0.02, key
        assert stiff == pytest.approx(soft / 10.0, rel=0.1, abs=1e-9), key


def test_reactions_of_unbalance_balance_the_inertia() -> None:
    """Rigid rotor between pins: Ω² U is shared by the lever arms."""
    rigid = replace(FINE, rotor="rigid")
    spindle = beam(pin("a", 0.0), pin("b", LENGTH))
    spec = UnbalanceSpec(("mid",), (Unbalance("mid", 1e-5),))
    found = unbalance.solve(Scene(spindle, rigid, SPEEDS, 500.0, (0.2,)), spec)
    share = np.array([1.0 - 0.2 / LENGTH, 0.2 / LENGTH])
    assert np.abs(found.displacement).max() < 1e-20
    assert found.force[..., 0] == pytest.approx(-1e-5 * np.outer(SPEEDS**2, share), rel=1e-9)


def test_statics_are_those_of_section_forces() -> None:
    """A slow force bends the shaft as a static one, on three pins, one more than needed."""
    held = beam(pin("a", 0.0), pin("b", 0.3), pin("c", LENGTH))
    spec = SectionForcesSpec(loads=(PointLoad("mid", Fy=1000.0),))
    line = section_forces.solve(Scene(held, FINE, np.zeros(1)), spec)
    ports = (Port("mid", "y"), Port("mid", "y"))
    slow = frf.solve(Scene(held, FINE, np.zeros(1), 1000.0, (0.2,)), FrfSpec((0.01,), (ports,)))
    at = np.abs(line.cut - 0.2).argmin()
    static = line.deflection_y[0, at] / 1000.0
    assert slow.receptance[0, 0, 0].real == pytest.approx(static, rel=1e-7)  # type: ignore[attr-defined]


def test_two_rotors_without_give_between_them_are_one() -> None:
    """A quill pinned to the shaft at both ends, beside a spring so stiff that it might be a pin."""
    quill = Rotor("quill", 1.0, Shaft(0.1, (Section(0.3, 0.02, 0.0, STEEL),)))
    frame = spring("a", 0.0, 5e7), spring("b", LENGTH, 5e7)

    def joined(*ties: LinearSupport) -> Any:
        return bending(beam(*frame, *ties, rotors=(quill,)), 2500.0)

    own = {"holds": "quill", "against": "spindle"}
    exact = joined(pin("i", 0.1, **own), pin("k", 0.4, **own))
    near = [
        joined(*(replace(spring(n, x, k), **own) for n, x in (("i", 0.1), ("k", 0.4))))
        for k in (1e11, 1e12)
    ]
    soft, stiff = (np.abs(each / exact - 1.0).max() for each in near)
    assert stiff < 1e-4
    assert stiff == pytest.approx(soft / 10.0, rel=0.1)


def test_hysteretic_shaft_between_pins() -> None:
    held = beam(pin("a", 0.0), pin("b", LENGTH), loss_factor=0.02)
    like = beam(spring("a", 0.0, 1e13), spring("b", LENGTH, 1e13), loss_factor=0.02)
    found, near = (response(each, "mid.y", "mid.y") for each in (held, like))
    assert np.abs(found - near).max() < 1e-3 * np.abs(found).max()


def test_a_rotor_that_cannot_move() -> None:
    """A rigid rotor held in everything has no modes, and answers no force."""
    every = pin("a", 0.0, "x", "y", "z", "thx", "thy", "thz")
    conditions = replace(FINE, rotor="rigid")
    scene = Scene(beam(every), conditions, SPEEDS, 1000.0)
    assert campbell.solve(scene, CampbellSpec(1000.0)).mode == ()
    assert not response(beam(every), "mid.y", "mid.y", conditions=conditions).any()


def test_what_acts_on_a_rigid_support_moves_nothing() -> None:
    """Nor does the place held there move; the support alone carries the unbalance force Ω² U."""
    spindle = beam(pin("a", 0.0), spring("b", LENGTH, 5e7, damping=1e3))
    spindle = replace(spindle, points={**spindle.points, "held": 0.0})
    spec: Any = UnbalanceSpec(("mid", "end"), (Unbalance("held", 1e-5),), run_up=(1.0,))
    found = unbalance.solve(Scene(spindle, Conditions(), SPEEDS, 500.0, (0.0, 0.2, LENGTH)), spec)
    assert not found.displacement.any()
    assert not found.run_amplitude.any()
    assert not found.error.any()
    assert found.force_amplitude[:, 0] == pytest.approx(1e-5 * SPEEDS**2, rel=1e-9)
    assert not found.force_amplitude[:, 1].any()
    pairs = ("mid.y", "held.y"), ("held.z", "mid.z")
    assert not any(response(spindle, *pair, conditions=Conditions()).any() for pair in pairs)
    blow = ForceOverTime("held", "y", force=100.0, pulse=5e-3)
    spec = TimeResponseSpec(duration=0.02, points=("mid",), forces=(blow,), max_frequency=500.0)
    scene = Scene(spindle, Conditions(), np.array([100.0]), 500.0, (0.0, 0.2))
    after: Any = time_response.solve(scene, spec)
    assert not after.displacement.any()
    assert not after.error.any()


def test_a_constraint_that_follows_from_others_holds_nothing_more() -> None:
    rng = np.random.default_rng(3)
    stiffness = np.concatenate([[0.0, 0.0], 10.0 ** rng.uniform(3, 14, 10)])
    rows = rng.standard_normal((3, 12))
    found = allowed_motions(np.vstack([rows, rows[0] - rows[2]]), stiffness)
    assert found.shape == (12, 9)
    assert found.T @ found == pytest.approx(np.eye(9), abs=1e-13)
    assert np.abs(rows @ found).max() < 1e-12


def test_beside_bearings_the_limit_of_ever_stiffer_springs() -> None:
    """A spindle on its bearings and a steady rest: radial stiffness under load and in its
    linear variants tends to that of the rigid one with 1/k, and preload does not feel it."""
    base = mfw2310()

    def solved(*rest: LinearSupport) -> Any:
        asked = {
            "preload": PreloadSpec(),
            "stiffness": StiffnessSpec("Oc2", 500.0, 2, ("nonlinear", "full", "diagonal")),
        }
        return answers(replace(base, supports=rest), (0, 24000), asked)

    without, held = solved(), solved(pin("rest", 0.25))
    names = ("axial_load", "inner_pressure")
    for name in names:
        assert getattr(held["preload"], name) == pytest.approx(
            getattr(without["preload"], name), rel=1e-12
        )
    gain = held["stiffness"].tangent / without["stiffness"].tangent
    assert (gain > 1.02).all()
    apart = []
    for stiffness in (1e10, 1e11, 1e12):
        found = solved(spring("rest", 0.25, stiffness))
        for name in names:
            assert (getattr(found["preload"], name) == getattr(without["preload"], name)).all()
        both = [
            np.abs(getattr(found["stiffness"], name) / getattr(held["stiffness"], name) - 1.0).max()
            for name in ("tangent", "secant")
        ]
        apart.append(max(both))
    assert apart[0] / apart[1] == pytest.approx(10.0, rel=0.1)
    assert apart[1] / apart[2] == pytest.approx(10.0, rel=0.02)
    assert apart[2] < 3e-5


def test_forces_that_more_supports_than_needed_share_are_said_not_to_be_determined() -> None:
    """A rigid rotor on three: no balance of forces tells what each takes."""
    pins = pin("one", 0.0), pin("two", 0.2), pin("three", LENGTH)
    scene = Scene(beam(*pins), Conditions(rotor="rigid"), np.array([0.0, 300.0]), 500.0)
    asked = UnbalanceSpec(points=("mid",), unbalances=(Unbalance(0.2, 1e-6),), run_up=(1.0,))
    found = unbalance.solve(scene, asked)
    assert np.isnan(found.fine_force_amplitude).all()
    assert np.isnan(found.run_force_peak).all()
    (line,) = (each for each in summary(found) if "largest force" in each)
    assert line.count("not determined") == 3
