"""Whole cases under changes that leave the physics as it is: other units of length, time and mass,
a quarter turn, front for rear, other origin, order and names; and one number by two analyses."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import rotordyn
from bearings import AngularContactBallBearing, DeepGrooveBallBearing
from bearings.ball.law import Law
from bearings.materials import SILICON_NITRIDE, STEEL
from rotordyn.analyses import (
    AxialCycleSpec,
    BearingLoadsSpec,
    CampbellSpec,
    FrfSpec,
    PointLoad,
    Port,
    PreloadSpec,
    SectionForcesSpec,
    StabilityLobesSpec,
    StiffnessSpec,
    Unbalance,
    UnbalanceSpec,
)
from rotordyn.analyses.section_forces.outer_fibre import outer_fibre
from rotordyn.case.case import Case
from rotordyn.machine.seat import BearingSeat, Misalignment
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.sleeve import Sleeve, Spring
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.preload.play import axial_run_up
from rotordyn.scene.conditions import Conditions
from tests.oracles.transformed import MIRRORED, TURNED, Change, Scale, factor, moved, scaled

RPM = math.pi / 30.0
FLOOR = 1e-3  # of the largest value of a variable: less is compared with that
OF_MIXED_UNITS = {"shape", "stiffness", "reaction"}
SMALL, LARGE = (0.125, 0.125, 0.125**3), (8.0, 8.0, 512.0)  # modulus and density stay
WEIGHED = (4.0, 2.0, 16.0)  # so do gravity and the modulus
SLOWER = (2.0, 3.0, 5.0)  # nothing does

# --- other units of length, time and mass ---------------------------------------------------------


def asked(name: str, speeds: tuple[float, ...], variant: str = "", **analyses: Any) -> Case:
    """A case of the project at some speeds [rpm], with these analyses or its own."""
    case = rotordyn.load(name)
    case = case.variants[variant] if variant else case
    own = {key: given or case.analyses[key] for key, given in analyses.items()}
    own = own or {**case.analyses}
    if "frf" in own:
        own["frf"] = replace(own["frf"], measured=())
    return replace(case, speeds=tuple(s * RPM for s in speeds), analyses=own, references=())


FEW = {
    "campbell": CampbellSpec(2500.0, shapes=False),
    "frf": FrfSpec((200.0, 700.0, 1900.0), ((Port("nose", "y"), Port("nose", "y")),)),
    "preload": PreloadSpec(),
    "stiffness": None,
}


def soft_sleeve() -> Case:
    """A massless one, on a spring next to none against its bearings."""
    case = rotordyn.load("belt_driven_loads")
    loads = {"campbell": CampbellSpec(2000.0, shapes=False)}
    case = replace(case, speeds=(9000.0 * RPM,), analyses=loads, references=())
    return case.vary({"conditions.gravity": "none", "spindle.sleeves.*.spring.stiffness": 1e6})


CASES = {
    "four analyses": (lambda: asked("grinding_spindle", (0.0, 9000.0), **FEW), (SMALL, SLOWER)),
    "a cycle with stops": (lambda: asked("mfw1709", (4000.0, 24000.0)), (SMALL, LARGE)),
    "a cycle with friction": (
        lambda: asked("mfw2310_axial_cycle", (16000.0,), "rubbing", axial_cycle=SHORT),
        (SMALL,),
    ),
    "loads and weight": (
        lambda: asked("belt_driven_loads", (9000.0,), bearing_loads=None, preload=None),
        (WEIGHED,),
    ),
    "a soft sleeve under loads": (soft_sleeve, ((0.25, 0.25 * 200**0.5, 0.25**3),)),
    "tables of supports": (lambda: asked("friswell_oil_films", (500.0, 1500.0)), (SLOWER,)),
    "turning": (
        lambda: asked("deep_groove_turning", (2000.0,), stability_lobes=ONE_SPEED),
        (SLOWER,),
    ),
    "joints": (lambda: asked("tool_holder_joint", (0.0, 24000.0), "hsk"), (SLOWER,)),
    "a film damper": (lambda: asked("squeeze_film_damper", (1500.0, 3000.0), "full"), (SLOWER,)),
}
TURNING = rotordyn.load("deep_groove_turning").analyses["stability_lobes"]
ONE_SPEED = replace(TURNING, speeds=(2000.0 * RPM,))
SHORT = AxialCycleSpec(-1500.0, 1500.0, 6)


@pytest.mark.parametrize(
    ("name", "scale"), [(name, scale) for name, (_, scales) in CASES.items() for scale in scales]
)
def test_results_follow_their_dimensions(name: str, scale: Scale) -> None:
    case = CASES[name][0]()
    here, there = rotordyn.run(case), rotordyn.run(scaled(case, scale))
    count = 0
    for analysis in here:
        for key, held in here[analysis].data_vars.items():
            if key in OF_MIXED_UNITS or held.dtype.kind not in "fc" or str(key).endswith("error"):
                continue
            unit = re.sub(r"([a-zA-Z])(-?\d)", r"\1^\2", held.attrs.get("units", "1"))
            grown = held.values * (1.0 if unit == "1" else factor(unit, scale))
            agree(there[analysis][key].values, grown, 1e-6, f"{analysis}.{key}")
            count += grown.size
    assert count > 5


def agree(found: Any, wanted: Any, within: float, what: str) -> None:
    found, wanted = np.asarray(found), np.asarray(wanted)
    known = np.isfinite(wanted)
    assert (np.isfinite(found) == known).all(), what
    size = np.abs(wanted[known])
    most = size.max(initial=0.0)
    off = np.abs(found[known] - wanted[known]) / np.where(most > 0.0, size + FLOOR * most, 1.0)
    assert off.max(initial=0.0) <= within, what


def test_identification_follows_its_dimensions() -> None:
    """The quicker solver of cycles, against itself: friction, stops, two sleeves."""
    rubbing = {"spindle.sleeves.front.friction": 80.9}
    machine = replace(rotordyn.load("mfw2310").vary(rubbing).spindle, references=())
    force, speed, paths = np.linspace(-1800.0, 1500.0, 7), np.array([0.0, 20000.0]) * RPM, []
    for size in (1.0, 0.35, 8.0):
        found = axial_run_up(
            scaled(machine, (size, size, size**3)), Law("outer", "equal"), speed / size
        )
        forces = force * size**2
        paths += [np.array([found.cycle(k, forces[::-1], forces) for k in range(2)]) / size]
    for path in paths[1:]:
        assert path == pytest.approx(paths[0], abs=1e-6 * np.abs(paths[0]).max())


# --- a quarter turn, front for rear ---------------------------------------------------------------

BALLS = AngularContactBallBearing(
    8e-3,
    60e-3,
    16,
    contact_angle=math.radians(18),
    ball_material=SILICON_NITRIDE,
    inner_conformity=0.54,
)
STIFF = {("y", "y"): 2e8, ("z", "z"): 6e7, ("y", "z"): 1e7, ("z", "y"): -4e6}
TILTS = {("y", "thz"): 1.2e6, ("thz", "y"): 1.1e6, ("thz", "thz"): 4e4, ("z", "thy"): -3e5}
PAIRS = ("tip.y tip.y", "tip.z tip.y", "tail.y tip.z", "tail.thy tip.z", "tip.y tip.thy")


def whole(*, loads: bool, **changes: Any) -> Case:
    """Two bearings, one of them on a sleeve, and a support that couples the planes."""
    sections = (Section(0.06, 0.07, 0.02, STEEL), Section(0.25, 0.045, 0.02, STEEL))
    off = Misalignment(3e-6, -2e-6, 5e-5, 2e-5) if loads else Misalignment()
    spindle = Spindle(
        "whole",
        Shaft(0.0, (*sections, Section(0.04, 0.03, 0.01, STEEL, rear_outer_diameter=0.04))),
        seats=(
            BearingSeat("a", BALLS, 0.08, 1, radial_damping=500.0, misalignment=off),
            BearingSeat("b", BALLS, 0.27, -1, radial_damping=300.0),
        ),
        sleeves=(Sleeve("s", ("b",), Spring(600.0, 8e6), 3e-6),),
        supports=(LinearSupport("g", 0.17, STIFF | TILTS, {("y", "y"): 2e3, ("z", "z"): 6e2}),),
        points={"tip": 0.0, "tail": 0.35},
        rotor_damping=(0.01,),
        internal_damping=0.3,
    )
    acting = (PointLoad("tip", Fx=40.0, Fy=150.0, Fz=-60.0, Mx=3.6, Mz=3.0, y=0.01, z=0.02),)
    pairs = tuple(tuple(Port(*port.split(".")) for port in pair.split()) for pair in PAIRS)
    analyses = {
        "campbell": CampbellSpec(1800.0, shapes=False),
        "frf": FrfSpec((5.0, 400.0, 1300.0), pairs),
        "preload": PreloadSpec(),
        "unbalance": UnbalanceSpec(("tip",), (Unbalance("tail", 3e-6, 0.4),)),
        "stability_lobes": StabilityLobesSpec(
            "tip", 0.02, 4, 7e8, 3e8, immersion=0.3, milling="up", feed=0.2, method="zero-order"
        ),
    }
    if loads:
        analyses["bearing_loads"] = BearingLoadsSpec(4)
    else:
        analyses["section_forces"] = SectionForcesSpec(acting, gravity="-z")
        analyses["axial_cycle"] = AxialCycleSpec(-300.0, 500.0, 3)
    conditions = Conditions(gravity="+y" if loads else "none", loads=acting if loads else ())
    case = Case("whole", "", (0.0, 12000.0 * RPM), analyses, conditions, spindle)
    return replace(case, **changes)


ALIKE = {  # whatever the change: nothing of these has a direction, or it goes with the bearing
    "campbell": ("frequency", "damping_ratio", "whirl", "critical_speed"),
    "preload": ("axial_load", "deflection", "inner_angle", "inner_pressure", "spring_force"),
    "unbalance": ("major_axis", "minor_axis", "force_amplitude", "fine_major_axis"),
    "stability_lobes": ("depth", "chatter"),
    "bearing_loads": ("radial_load", "moment", "tilt", "loaded_balls", "loss_share"),
    "section_forces": ("von_mises_stress", "normal_stress"),
}


@pytest.mark.parametrize("change", [TURNED, MIRRORED], ids=["quarter turn", "front for rear"])
@pytest.mark.parametrize("loads", [False, True], ids=["preload alone", "loads and tilts"])
def test_a_machine_seen_from_another_side(change: Change, *, loads: bool) -> None:
    case, rear = whole(loads=loads), change is MIRRORED
    here, there = rotordyn.run(case), rotordyn.run(moved(case, change))
    for analysis, names in ALIKE.items():
        for name in names if analysis in here else ():
            wanted = here[analysis][name].values
            wanted = wanted[:, ::-1] if rear and analysis == "section_forces" else wanted
            agree(there[analysis][name].values, wanted, 1e-6, f"{analysis}.{name}")
    signs = [math.prod(change[p.direction][1] for p in pair) for pair in case.analyses["frf"].pairs]
    for k, sign in enumerate(signs):
        wanted = sign * here["frf"].receptance.values[:, k]
        agree(there["frf"].receptance.values[:, k], wanted, 1e-6, PAIRS[k])
    y, z = np.moveaxis(here["unbalance"].displacement.values, -1, 0)
    wanted = np.stack([y, z] if rear else [-z, y], axis=-1)
    agree(there["unbalance"].displacement.values, wanted, 1e-6, "unbalance")
    if not loads:
        names = ("position", "stiffness")
        position, stiffness = (here["axial_cycle"][name].values for name in names)
        wanted = (-position[:, ::-1, ::-1], stiffness[:, ::-1, ::-1]) if rear else (
            position, stiffness)  # fmt: skip
        for name, each in zip(names, wanted, strict=True):
            agree(there["axial_cycle"][name].values, each, 1e-6, name)
        push, pushed = (each["section_forces"].reaction.values for each in (here, there))
        wanted = [sign * push[..., k] for k, (_, sign) in enumerate(change.values())]
        found = [pushed[..., [*change].index(to)] for to, _ in change.values()]
        for each, other in zip(found, wanted, strict=True):
            agree(each, other, 1e-6, "reactions")


# --- the same machine described another way -------------------------------------------------------


def test_origin_order_names_and_sections_do_not_matter() -> None:
    case = whole(loads=False)
    spindle, specs = case.spindle, case.analyses
    assert spindle is not None
    halves = [replace(s, length=s.length / 2) for s in spindle.shaft.sections[:2] for _ in "12"]
    by = 0.137
    other = replace(
        spindle,
        shaft=Shaft(spindle.shaft.start + by, (*halves, spindle.shaft.sections[2])),
        seats=tuple(replace(s, x=s.x + by, name=f"q{s.name}") for s in spindle.seats[::-1]),
        sleeves=tuple(replace(s, bearings=("qb",)) for s in spindle.sleeves),
        supports=tuple(replace(s, x=s.x + by) for s in spindle.supports),
        points={name: x + by for name, x in [*spindle.points.items()][::-1]},
    )
    plain = {name: specs[name] for name in [*specs][::-1] if name != "section_forces"}
    sure = replace(case.conditions, accuracy=1e-8)
    here = rotordyn.run(replace(case, analyses=plain, conditions=sure))
    there = rotordyn.run(replace(case, spindle=other, analyses=plain, conditions=sure))
    load = here["preload"].axial_load.values
    agree(there["preload"].axial_load.values[:, ::-1], load, 1e-9, "preload")
    for analysis in ("campbell", "unbalance", "stability_lobes"):
        for name in ALIKE[analysis]:
            if name != "force_amplitude":
                found = there[analysis][name].values
                agree(found, here[analysis][name].values, 1e-7, f"{analysis}.{name}")
    agree(there["frf"].receptance.values, here["frf"].receptance.values, 1e-7, "frf")


# --- the same number by two analyses --------------------------------------------------------------


def pushed(force: float, size: float, angle: float = 15.0) -> tuple[Case, Case]:
    """A pair with close grooves behind a soft spring: the case of a cycle up to a force [N], and of
    the preload under it; lengths by ``size``, and forces by its square."""
    close = replace(BALLS, contact_angle=math.radians(angle), inner_conformity=0.52)
    case = whole(loads=False)
    spindle = replace(
        case.spindle,
        seats=tuple(replace(seat, bearing=close) for seat in case.spindle.seats),
        sleeves=(Sleeve("s", ("b",), Spring(300.0, 2e6)),),
        supports=(),
    )
    cycle = {"axial_cycle": AxialCycleSpec(min(force, -1.0), max(force, 1.0), 2)}
    scale = (size, size, size**3)
    one = replace(case, spindle=spindle, analyses=cycle)
    held = replace(case.conditions, axial_force=force)
    other = replace(one, analyses={"preload": PreloadSpec()}, conditions=held)
    return scaled(one, scale), scaled(other, scale)


@pytest.mark.parametrize("size", [1.0, 0.1])
@pytest.mark.parametrize("force", [-250.0, 800.0])
def test_a_cycle_passes_the_states_without_memory(force: float, size: float) -> None:
    cycle, plain = (rotordyn.run(case) for case in pushed(force, size))
    end = 0 if force < 0.0 else -1
    found = cycle["axial_cycle"].axial_load.values[:, 0, end]
    agree(found, plain["preload"].axial_load.values, 1e-5, "loads")
    agree(
        cycle["axial_cycle"].position.values[:, 0, end],
        plain["preload"].position.values,
        1e-5,
        "positions",
    )


@pytest.mark.parametrize("angle", [20.0, 35.0])
@pytest.mark.parametrize("force", [-250.0, 800.0])
def test_play_of_bearings_that_take_thrust_both_ways(force: float, angle: float) -> None:
    """They carry from where it ends, at sin(angle) of the free distance, either way."""
    cycle, plain = pushed(force, 1.0)
    model = DeepGrooveBallBearing(8e-3, 60e-3, 16, contact_angle=math.radians(angle))
    seats = tuple(replace(seat, bearing=model) for seat in cycle.spindle.seats)
    both = (replace(c, spindle=replace(c.spindle, seats=seats)) for c in (cycle, plain))
    found, wanted = (rotordyn.run(case) for case in both)
    end = 0 if force < 0.0 else -1
    load = found["axial_cycle"].axial_load.values[:, 0, end]
    agree(load, wanted["preload"].axial_load.values, 1e-5, "loads")


def test_bearings_pushed_far_apart_do_not_pull() -> None:
    """Twice as far as contact angles are free they would touch the side that takes no thrust."""
    force = -700.0
    case = pushed(force, 1.0)[0]
    far = rotordyn.run(case)["axial_cycle"]
    assert far.position.values[:, 0, 0, 0].max() < -180e-6
    assert far.axial_load.values[:, 0, 0, 0] == pytest.approx(0.0, abs=1e-6)
    quick = axial_run_up(case.spindle, case.conditions.law, np.array(case.speeds))
    shifts = [quick.under(row, [force])[0] for row in range(len(case.speeds))]
    assert np.array(shifts) == pytest.approx(far.position.values[:, 0, 0], abs=1e-8)


CLOSE_12 = DeepGrooveBallBearing(8e-3, 60e-3, 16, contact_angle=math.radians(12))


@pytest.mark.parametrize("model", [None, CLOSE_12], ids=["angular contact", "deep groove"])
@pytest.mark.parametrize("force", [-250.0, 3000.0])
def test_the_quick_solver_follows_close_grooves(
    model: DeepGrooveBallBearing | None, force: float
) -> None:
    """Pressed by a tenth of the free distance of their centres and more; with play."""
    case = pushed(force, 1.0)[0]
    seats = tuple(replace(seat, bearing=model or seat.bearing) for seat in case.spindle.seats)
    case = replace(case, spindle=replace(case.spindle, seats=seats))
    end = 0 if force < 0.0 else -1
    wanted = rotordyn.run(case)["axial_cycle"].position.values[:, 0, end]
    quick = axial_run_up(case.spindle, case.conditions.law, np.array(case.speeds))
    shifts = [quick.under(row, [force])[0] for row in range(len(case.speeds))]
    assert np.array(shifts) == pytest.approx(wanted, abs=5e-9)


def test_static_stiffness_by_three_analyses() -> None:
    """A small force at the tip: the tangent, a receptance that hardly moves, section forces."""
    case = whole(loads=False)
    analyses = {
        "stiffness": StiffnessSpec("tip", 0.1, 1, variants=("full", "nonlinear")),
        "frf": FrfSpec((1e-3,), ((Port("tip", "y"), Port("tip", "y")),)),
        "section_forces": SectionForcesSpec((PointLoad("tip", Fy=1.0),)),
    }
    spindle = replace(case.spindle, supports=(), internal_damping=0.0)
    sure = Conditions(accuracy=1e-7, axial_stiffening=False)
    results = rotordyn.run(replace(case, spindle=spindle, analyses=analyses, conditions=sure))
    soft = results["frf"].receptance.values[:, 0, 0].real
    for tangent in results["stiffness"].tangent.values.T:
        assert tangent * soft == pytest.approx(1.0, rel=1e-6)
    assert results["section_forces"].deflection_y.values[:, 0] == pytest.approx(
        soft, rel=1e-6, abs=0.0
    )


def test_an_unbalance_is_a_force_at_the_speed() -> None:
    case = whole(loads=True)
    speed = case.speeds[-1]
    ports = [Port("tip", way) for way in "yz"], [Port("tail", way) for way in "yz"]
    pairs = tuple((response, excitation) for response in ports[0] for excitation in ports[1])
    once = FrfSpec((speed / (2.0 * math.pi),), pairs, engine_orders=(1.0,))
    asked = {"frf": once, "unbalance": case.analyses["unbalance"]}
    results = rotordyn.run(replace(case, analyses=asked))
    receptance = results["frf"].receptance.values[-1, :, 0]
    assert results["frf"].line_value.values[-1, 0] == pytest.approx(receptance, rel=1e-12, abs=0.0)
    force = 3e-6 * speed**2 * np.exp(0.4j) * np.array([1.0, -1.0j])
    found = results["unbalance"].displacement.values[-1, 0]
    assert found == pytest.approx(receptance.reshape(2, 2) @ force, rel=1e-9, abs=0.0)


def test_pure_bending_pulls() -> None:
    """Rounding of the axial force does not choose the sign of the normal stress."""
    forces = np.array([[n, 0.0, 0.0, 0.0, 0.0, 50.0] for n in (1e-11, -1e-11, 20.0, -20.0)])
    stress = outer_fibre(forces, np.array(0.03), np.array(0.0))
    assert np.sign(stress.normal).tolist() == [1.0, 1.0, 1.0, -1.0]
