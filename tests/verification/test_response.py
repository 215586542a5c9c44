"""Responses of the reduced model: against dense solves, the exact shaft and closed forms."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from rotordyn.analyses.frf.solve import solve
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.measured_response import Port
from rotordyn.equation.mesh import build_mesh
from rotordyn.machine.drawbar import Drawbar
from rotordyn.machine.joint import Joint
from rotordyn.machine.rotor import RayleighDamping
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.coaxial import COAXIAL, STEEL
from tests.oracles.dense_rotor.selection import LATERAL
from tests.oracles.exact_shaft.bending import exact_receptance
from tests.oracles.full_rotor import FullRotor
from tests.oracles.rotors import STEPPED, support
from tests.oracles.spindles import RPM, mfw2310, pairs, with_sleeve

BAND = tuple(np.linspace(3.0, 3000.0, 120))
ASKED = pairs("tip.y/tip.y", "mid.z/tip.y", "tip.thy/mid.z", "end.thz/mid.y")
POINTS = {"tip": -0.05, "mid": 0.11, "end": 0.27}
EVEN = (support("front", 0.0, (8e7, 8e7), 300.0), support("rear", 0.2, (6e7, 6e7), 200.0))
UNEVEN = (
    support("front", 0.0, (8e7, 5e7, 6e6), 300.0),
    replace(
        support("rear", 0.2, (6e7, 6e7), 200.0),
        stiffness={("y", "y"): 6e7, ("z", "z"): 4e7, ("y", "z"): 9e6, ("z", "y"): -4e6},
    ),
)
SKEW = tuple(replace(s, stiffness={**s.stiffness, ("y", "z"): 5e6, ("z", "y"): -5e6}) for s in EVEN)
ROTOR = replace(STEPPED, points=POINTS, supports=EVEN)


def seen(spindle: Spindle, rpm: float, asked: Any = ASKED, **more: Any) -> Scene:
    ports = tuple({spindle.place(port.point) for pair in asked for port in pair})
    return Scene(spindle, Conditions(**more), np.array([rpm * RPM]), BAND[-1], ports)


def response(spindle: Spindle, rpm: float, asked: Any = ASKED, **more: Any) -> Any:
    return solve(seen(spindle, rpm, asked, **more), FrfSpec(BAND, asked))


def values(result: Any) -> np.ndarray:
    """(pairs, frequencies)"""
    kind = "receptance" if hasattr(result, "receptance") else "turning_receptance"
    return getattr(result, kind)[0]


def apart(one: Any, other: Any) -> float:
    """Largest difference over the peak of each pair."""
    a, b = (x if isinstance(x, np.ndarray) else values(x) for x in (one, other))
    return float((np.abs(a - b).max(axis=1) / np.abs(b).max(axis=1)).max())


@pytest.mark.parametrize("ratios", [(), (0.02, 0.05)], ids=["plain", "modal"])
@pytest.mark.parametrize("supports", [EVEN, SKEW, UNEVEN], ids=["even", "skew", "uneven"])
def test_a_dense_solve_of_four_dof_per_node(supports: tuple, ratios: tuple) -> None:
    """Assembled otherwise: both planes node by node, no circular coordinates."""
    spindle = replace(ROTOR, supports=supports, rotor_damping=ratios)
    length = 0.011
    found = response(spindle, 20000.0, element_length=length)
    mesh = build_mesh(spindle, length)
    full = FullRotor(spindle, mesh, np.zeros((0, 6, 6)), 20000.0 * RPM, LATERAL)
    ends = [
        tuple(full.row(spindle.points[port.point], port.direction) for port in pair)
        for pair in ASKED
    ]
    assert apart(found, full.receptance(ends, np.array(BAND))) < 5e-6


def test_a_spindle_under_axial_force_and_on_bearings() -> None:
    """Of the flagship, tension in the shaft by its drawbar included."""
    spindle = mfw2310(rotor_damping=(), drawbar=Drawbar(2e4, 0.02, 0.3, (0.15,)))
    asked = pairs("Oc2.y/Oc2.y", "Oc1.z/Oc2.y")
    ports = tuple({spindle.place(port.point) for pair in asked for port in pair})
    conditions = Conditions(element_length=0.02)
    scene = Scene(spindle, conditions, np.array([18000.0 * RPM]), BAND[-1], ports)
    found = solve(scene, FrfSpec(BAND, asked))
    force = scene.bending_force()
    full = FullRotor(
        spindle, scene.mesh, scene.seat_stiffness[0], scene.speed[0], LATERAL, force[0]
    )
    ends = [
        tuple(full.row(spindle.points[port.point], port.direction) for port in pair)
        for pair in asked
    ]
    assert apart(found, full.receptance(ends, np.array(BAND))) < 1e-7


def machines() -> dict[str, tuple[Spindle, dict[str, Any]]]:
    """Everything that bending may have, with its conditions."""
    hinge = Joint("hinge", 0.05, radial=3e8, tilt=4e5, radial_damping=200.0, tilt_damping=1.0)
    tilting = Joint("flange", 0.15, tilt=6e5)
    lossy = (replace(UNEVEN[0], loss_factor=0.03), UNEVEN[1])
    fixed = (replace(EVEN[0], stiffness={**EVEN[0].stiffness, ("x", "x"): 1e8}), EVEN[1])
    grown = RayleighDamping(20.0, 2e-6)
    coaxial = replace(COAXIAL, points={"tip": 0.0, "mid": 0.254, "end": 0.508}, rayleigh=grown)
    sprung = with_sleeve(mfw2310(rotor_damping=()), "front", radial_stiffness=2e8, mass=0.7)
    light = with_sleeve(mfw2310(rotor_damping=()), "front", radial_stiffness=2e8)
    places = {"tip": 0.0, "mid": 0.15, "end": 0.3}
    return {
        "rayleigh": (replace(ROTOR, rayleigh=grown, internal_damping=0.4), {}),
        "rayleigh, uneven": (replace(ROTOR, supports=UNEVEN, rayleigh=grown), {}),
        "modal": (replace(ROTOR, rotor_damping=(0.01, 0.03), internal_damping=0.3), {}),
        "joints": (replace(ROTOR, joints=(hinge, tilting)), {}),
        "joints, uneven": (replace(ROTOR, joints=(hinge,), supports=UNEVEN), {}),
        "loss factors": (replace(ROTOR, loss_factor=0.02), {}),
        "loss factors, uneven": (replace(ROTOR, loss_factor=0.02, supports=lossy), {}),
        "softened": (replace(ROTOR, supports=UNEVEN), {"formulation": "fixed-frame softening"}),
        "turning": (replace(ROTOR, supports=SKEW), {"formulation": "rotating"}),
        "turning, lossy": (replace(ROTOR, loss_factor=0.02), {"formulation": "rotating"}),
        "two rotors": (coaxial, {}),
        "sleeve": (replace(sprung, points=places), {}),
        "sleeve without mass": (replace(light, points=places), {}),
        "pulled": (replace(ROTOR, supports=fixed), {"axial_force": -3e4}),
    }


MACHINES = machines()
SEEN = 2e-7  # of the peak: errors below a thousandth of the accuracy requested are not judged


@pytest.mark.few(4)
@pytest.mark.parametrize("kind", MACHINES)
def test_reported_errors_are_those_of_a_coarser_model(kind: str) -> None:
    """Against the same ten thousand times finer: damping of the rotor, of joints and by loss
    factors reaches what is truncated."""
    spindle, more = MACHINES[kind]
    rough, fine = (response(spindle, 15000.0, accuracy=a, **more) for a in (1e-4, 1e-8))
    true = np.abs(values(rough) - values(fine)).max(axis=1) / np.abs(values(fine)).max(axis=1)
    # in rotating axes modes up to Ω beyond the band of the model are seen within it
    apart = np.abs(np.log(rough.error / true))[true > SEEN]
    assert apart.max(initial=0.0) < math.log(6.0 if kind == "turning" else 3.0)
    assert (rough.error[true <= SEEN] < 10.0 * SEEN).all()
    assert fine.error.max() < 5e-7  # of peaks of some per cent damping


@pytest.mark.parametrize("supports", [EVEN, UNEVEN], ids=["even", "uneven"])
def test_reported_errors_are_those_of_the_elements(supports: tuple) -> None:
    """Against the exact shaft."""
    spindle = replace(ROTOR, supports=supports)
    exact = exact_receptance(seen(spindle, 20000.0), ASKED, np.array(BAND))[0]
    for more in ({"accuracy": 1e-3}, {"accuracy": 1e-5}, {"element_length": 0.04}):
        found = response(spindle, 20000.0, **more)
        true = np.abs(values(found) - exact).max(axis=1) / np.abs(exact).max(axis=1)
        assert true.max() > 1e-9  # well above rounding
        assert np.abs(np.log(found.error / true)).max() < math.log(3.0)


def test_growth_is_reported_with_a_response() -> None:
    """Supports that drive forward whirl."""
    driving = {("y", "z"): 3e7, ("z", "y"): -3e7}
    supports = tuple(replace(s, stiffness={**s.stiffness, **driving}, damping={}) for s in EVEN)
    spindle = replace(ROTOR, supports=supports)
    ports = (spindle.place("tip"),)
    scene = Scene(spindle, Conditions(), np.array([1000.0 * RPM]), BAND[-1], ports)
    solve(scene, FrfSpec(BAND, pairs("tip.y/tip.y")))
    assert "unstable at 1 of 1 speeds" in "".join(scene.warnings)


@pytest.mark.parametrize("speed", [0.0, 20_000.0])
def test_rounding_of_short_elements_is_small(speed: float) -> None:
    """A free bar in 600 pieces, far below its bending, moves as a rigid body."""
    length, outer, count = 0.5, 0.05, 600
    bar = Spindle(
        "bar",
        Shaft(0.0, (Section(length / count, outer, 0.0, STEEL),) * count),
        points={"tip": 0.0},
    )
    asked, band = pairs("tip.y/tip.y", "tip.z/tip.y"), np.array([0.1, 0.3, 1.0])
    scene = Scene(bar, Conditions(), np.array([speed * RPM]), 1.0, (0.0,))
    found = solve(scene, FrfSpec(tuple(band), asked))
    mass = STEEL.density * math.pi / 4.0 * outer**2 * length
    across, along = mass * (length**2 / 12.0 + outer**2 / 16.0), mass * outer**2 / 8.0
    omega = 2.0 * math.pi * band
    plus, minus = (
        -1.0 / (mass * w**2) + (length / 2.0) ** 2 / (along * speed * RPM * w - across * w**2)
        for w in (omega, -omega)
    )
    exact = np.array([0.5 * (plus + minus), -0.5j * (plus - minus)])
    off = np.abs(found.receptance[0] - exact).max(axis=1)
    off = off / np.maximum(np.abs(exact).max(axis=1), 1e-30)
    assert off.max() < 2e-7


def test_a_rotor_that_nothing_moves_stays() -> None:
    """Two rotors, each on its own even supports: a force on one is none on the other."""
    on = (
        ("a", 0.02, "spindle"),
        ("b", 0.48, "spindle"),
        ("c", 0.17, "outer"),
        ("d", 0.39, "outer"),
    )
    supports = tuple(replace(support(n, x, (5e7, 5e7)), holds=rotor) for n, x, rotor in on)
    outer = replace(COAXIAL.rotors[0], points={"p": 0.28})
    two = replace(COAXIAL, supports=supports, rotors=(outer,), points={"tip": 0.0})
    drive, across = (Port("tip", "y"),) * 2, (Port("outer.p", "y"), Port("tip", "y"))
    found = response(two, 6000.0, (across, drive))
    size = np.abs(values(found))
    assert size[0].max() < 1e-12 * size[1].max()
