"""Internal damping of a disc on a light shaft: where forward whirl begins to grow."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import rotordyn
from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.machine.lumped import PointMass
from rotordyn.machine.rotor import RayleighDamping
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.modes.overdamped import OVERDAMPED
from rotordyn.report.warnings import result_warnings
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.coaxial import INNER, OUTER, bearing
from tests.oracles.idealised import idealised
from tests.oracles.rotors import support, uniform
from tests.oracles.spindles import all_poles

LIGHT = idealised("light", 2.1e11, 0.3, 1.0)
LENGTH, MASS, BETA = 0.6, 20.0, 2e-8


def rotor(external: float, uneven: float = 0.0) -> Spindle:
    """All damping of the shaft is internal and β times its stiffness, c_i = β k."""
    disc = PointMass("disc", LENGTH / 2, MASS, 1e-6, 1e-6)
    damper = {("y", "y"): external, ("z", "z"): external}
    held = (
        support("a", 0.0, (1e12, 1e12)),
        support("b", LENGTH, (1e12, 1e12)),
        LinearSupport("damper", LENGTH / 2, {("y", "y"): uneven, ("z", "z"): 0.0}, damper),
    )
    bare = uniform(LENGTH, 0.03, LIGHT, masses=(disc,), supports=held)
    return replace(bare, rayleigh=RayleighDamping(stiffness=BETA), internal_damping=1.0)


def solved_scene(spindle: Spindle, speed: np.ndarray, **conditions: Any) -> Scene:
    return Scene(spindle, Conditions(**conditions), speed, 150.0)


def answered(spindle: Spindle, speed: list[float], **conditions: Any) -> Any:
    scene = solved_scene(spindle, np.array(speed), **conditions)
    return campbell.solve(scene, CampbellSpec(150.0, shapes=False))


def still(spindle: Spindle) -> tuple[float, float]:
    """ω and k of the disc on the shaft."""
    omega = 2.0 * math.pi * answered(spindle, [0.0]).frequency[0, 0]
    return omega, MASS * omega**2


@pytest.mark.few(3)
@pytest.mark.parametrize("ratio", [0.0, 0.3, 1.0, 2.5])
@pytest.mark.parametrize("formulation", ["inertial", "rotating"])
def test_threshold_in_closed_form(ratio: float, formulation: str) -> None:
    """Ω = ω (1 + c_e/c_i), from speeds far apart."""
    omega, stiff = still(rotor(0.0))
    found = answered(
        rotor(ratio * BETA * stiff), [0.0, 3.0 * omega, 6.0 * omega], formulation=formulation
    )
    assert found.stability_threshold == pytest.approx(omega * (1.0 + ratio), rel=1e-4)
    assert found.unstable_mode == "bending 1 forward"
    sentence = f"from {found.stability_threshold * 30 / math.pi:.0f} rpm on"
    assert any(sentence in warning for warning in result_warnings({"campbell": found}))


def test_growth_at_speed_in_closed_form() -> None:
    """m λ² + (c_e + c_i) λ + k − iΩ c_i = 0, both whirls."""
    omega, stiff = still(rotor(0.0))
    inner, outer, spin = BETA * stiff, 0.5 * BETA * stiff, 2.0 * omega
    found = answered(rotor(outer), [spin])
    for pole in np.roots([MASS, inner + outer, stiff - 1j * spin * inner]):
        name = "bending 1 forward" if pole.imag > 0.0 else "bending 1 backward"
        own = found.mode.index(name)
        assert found.damping_ratio[0, own] == pytest.approx(-pole.real / abs(pole), rel=1e-3)


def test_uneven_supports_raise_the_threshold() -> None:
    """In both planes: m λ² + c λ + k (± Δ) with ∓Ω c_i across; stable up to a higher speed."""
    omega, stiff = still(rotor(0.0))
    inner, extra = BETA * stiff, 4e-5 * stiff
    found = answered(rotor(0.0, uneven=extra), np.linspace(0.0, 8.0 * omega, 5).tolist())

    def growth(spin: float) -> float:
        k = np.array([[stiff + extra, spin * inner], [-spin * inner, stiff]]) / MASS
        d = np.eye(2) * inner / MASS
        return float(
            np.linalg.eigvals(np.block([[np.zeros((2, 2)), np.eye(2)], [-k, -d]])).real.max()
        )

    low, high = omega, 8.0 * omega
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if growth(middle) > 0.0 else (middle, high)
    assert 1.1 * omega < low < 7.0 * omega
    assert found.stability_threshold == pytest.approx(low, rel=1e-3)


def test_damping_in_the_fixed_frame_never_grows() -> None:
    omega, stiff = still(rotor(0.0))
    fixed = replace(rotor(0.1 * BETA * stiff), internal_damping=0.0)
    found = answered(fixed, [0.0, 3.0 * omega, 6.0 * omega])
    assert found.stability_threshold == math.inf
    assert found.unstable_mode == ""
    assert result_warnings({"campbell": found}) == []


def test_what_hardly_swings_is_numbered_last_and_not_listed() -> None:
    """β of the shaft overdamps its short waves, which in the fixed frame turn with it: they are
    modes by the letter, and counted, but stand behind those that oscillate."""
    damping = RayleighDamping(stiffness=2e-5)
    spindle = replace(rotor(1e3), rayleigh=damping)
    found = answered(spindle, [100.0, 600.0])
    overdamped = found.mostly_overdamped[[kind == "bending" for kind in found.kind]]
    assert overdamped.any()
    assert not overdamped[0]
    assert (np.diff(overdamped.astype(int)) >= 0).all()
    ratio = found.damping_ratio[:, found.mostly_overdamped]
    assert (ratio[np.isfinite(ratio)] > 0.99).all()
    assert len(found.critical_speed) > 0
    assert (found.critical_damping < 0.99).all()


def test_what_swings_at_one_end_only_by_a_hair_creeps() -> None:
    """Relaxations −1/β + iΩ in the fixed frame, damping ratio 1/√(1 + (βΩ)²): 0.983 at the last of
    five speeds. They turn at Ω at every speed, and resonate at none."""
    spindle = replace(rotor(1e3), rotor_damping=(), rayleigh=RayleighDamping(stiffness=2e-4))
    found = answered(spindle, [0.0, 200.0, 500.0, 700.0, 930.0])
    last, bending = found.damping_ratio[-1], np.array(found.kind) == "bending"
    hair = found.mostly_overdamped & (last < OVERDAMPED)
    assert hair.any()
    assert last[hair] == pytest.approx(1.0 / math.hypot(1.0, 2e-4 * 930.0), abs=2e-3)
    assert (np.diff(found.mostly_overdamped[bending].astype(int)) >= 0).all()
    assert not np.isin(found.critical, np.array(found.mode)[found.mostly_overdamped]).any()


@pytest.mark.parametrize(("slow", "is_overdamped"), [(0.995, True), (0.985, False)])
def test_what_creeps_at_most_speeds_has_no_critical_speed(slow: float, is_overdamped: bool) -> None:
    """A damper whose rate falls with speed: the disc, of ω √(1 − ζ²), meets the speed where it has
    ζ = 0.67, and that is reported of a mode that oscillates at most of the speeds only."""
    omega, stiff = still(rotor(0.0))
    rate = tuple(2.0 * zeta * stiff / omega for zeta in (slow, slow, 0.6))
    speeds = [0.0, 0.02 * omega, 0.04 * omega, 0.06 * omega, 0.9 * omega]
    bare = replace(rotor(0.0), rotor_damping=(), internal_damping=0.0)
    damper = LinearSupport(
        "damper",
        LENGTH / 2,
        {},
        {("y", "y"): rate, ("z", "z"): rate},
        speeds=(0.0, 0.06 * omega, 0.9 * omega),
    )
    found = answered(replace(bare, supports=(*bare.supports[:2], damper)), speeds)
    assert found.mostly_overdamped.any() == is_overdamped
    assert found.critical_excited.any() == (not is_overdamped)
    assert found.critical_damping[found.critical_excited] == pytest.approx(0.67, abs=0.01)


def test_what_has_no_peak_has_no_critical_speed() -> None:
    """A disc of ζ = 0.96 meets the speed at ω √(1 − ζ²), but no speed is worse than others."""
    omega, stiff = still(rotor(0.0))
    bare = replace(rotor(0.0), rotor_damping=(), internal_damping=0.0)
    for zeta, told in ((0.96, False), (0.75, False), (0.65, True)):
        rate = {(way, way): 2.0 * zeta * stiff / omega for way in ("y", "z")}
        damper = LinearSupport("damper", LENGTH / 2, {}, rate)
        spindle = replace(bare, supports=(*bare.supports[:2], damper))
        found = answered(spindle, [0.0, 0.1 * omega, 0.5 * omega, 0.9 * omega])
        assert found.critical_excited.any() == told


def test_tapered_shaft_grows_from_where_its_ratios_say() -> None:
    """Ω_t = ω (1 + ζ_e/ζ_i) of the first mode, ζ at rest from the bearings alone and from both;
    ζ_i is βω/2 of what the shaft bends. Softer bearings let the dampers win."""
    whole = rotordyn.load("friswell_tapered_shaft").vary({"speeds": ["0 rpm", "2000 rpm"]})
    found = rotordyn.run(whole)
    outer, both = (
        found[f"{name}/campbell"].sel(mode="bending 1 forward").damping_ratio.values[0]
        for name in ("published", "material")
    )
    modes = found["material/campbell"]
    omega = 2.0 * math.pi * float(modes.frequency.sel(mode="bending 1 forward")[0])
    assert both - outer == pytest.approx(0.5 * 2e-5 * omega, rel=0.03)
    predicted = omega * (1.0 + outer / (both - outer))
    assert float(modes.stability_threshold) == pytest.approx(predicted, rel=5e-3)
    assert found["soft/campbell"].stability_threshold == math.inf
    assert found["published/campbell"].stability_threshold == math.inf


@pytest.mark.parametrize("ratio", [1.5, -0.7])
def test_damping_of_a_further_rotor_turns_at_its_own_speed(ratio: float) -> None:
    """Joined to nothing, it has the poles that it has alone at that speed, either way it turns."""
    spin = np.array([500.0])
    ends = (bearing("c", 0.16, 2e7, 3e7, "outer"), bearing("d", 0.4, 1e7, 1e7, "outer"))
    held = (bearing("a", 0.0, 26e6, 26e6), bearing("b", 0.5, 9e6, 9e6))
    outer = replace(
        OUTER, speed_ratio=ratio, rayleigh=RayleighDamping(stiffness=1e-4), internal_damping=0.8
    )
    both = replace(INNER, rotors=(outer,), supports=(*held, *ends))
    found = all_poles(Scene(both, Conditions(), spin, 400.0))
    alone = all_poles(Scene(both.part("outer"), Conditions(), abs(ratio) * spin, 400.0))
    alone = alone[(alone.imag > 1.0) & (alone.imag < 2.0 * np.pi * 400.0)]
    assert len(alone) >= 2
    for pole in alone:
        assert np.abs(found / pole - 1.0).min() < 1e-6


@pytest.mark.parametrize("share", [0.5, 0.8])
def test_a_share_of_the_damping_turns(share: float) -> None:
    """Of damping β k the whole damps and the share drives: ζ = β (ω − s Ω)/2, forwards."""
    part = replace(rotor(0.0), internal_damping=share)
    omega, _ = still(part)
    for factor in (0.5, 2.0):
        ratio = answered(part, [factor * omega]).damping_ratio[0, :2]
        expected = 0.5 * BETA * omega * (1.0 + share * factor * np.array([1.0, -1.0]))
        assert np.sort(ratio)[::-1] == pytest.approx(expected, rel=1e-3)
