"""Random hard states: every answer balances, every refusal is named."""

from __future__ import annotations

from dataclasses import fields
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from bearings.ring.state import BearingState
from tests.oracles.balance import ball_faults, ring_fault
from tests.oracles.ball_bearing import BallBearingOracle
from tests.oracles.known_bearings import HARRIS_218, HYPOTHESES, RPM, SHARINGS, VEX70
from tests.oracles.random_states import draw_bearing

OUTCOMES = {"", "unloaded", "no equilibrium", "no contact angle", "overloaded"}
STATUS = {"loaded", "open side", "lost contact", "unloaded"}
COUNT = 150


def hard_displacements(seed: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    thrown = rng.uniform(-1.0, 1.0, (COUNT, 5))
    middle = np.array([25e-6, 0.0, 0.0, 0.0, 0.0])
    speed = rng.uniform(0.0, 34000.0, COUNT) * RPM
    speed[::15] = 0.0
    return middle + thrown * [50e-6, 40e-6, 40e-6, 1e-3, 1e-3], speed


def hard_loads(seed: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    thrust = 10 ** rng.uniform(1.5, 4.0, COUNT)
    side = rng.uniform(-1.0, 1.0, (COUNT, 2)) * thrust[:, None]
    moment = rng.uniform(-0.02, 0.02, (COUNT, 2)) * thrust[:, None]
    speed = rng.uniform(0.0, 34000.0, COUNT) * RPM
    speed[::15] = 0.0
    return np.column_stack([thrust, side, moment]), speed


def one(batch: BearingState, index: int) -> Any:
    names = [f.name for f in fields(batch) if f.name not in ("ball_centre", "operation")]
    return SimpleNamespace(**{name: getattr(batch, name)[index] for name in names})


def numbers(state: Any) -> np.ndarray:
    names = (
        "load",
        "displacement",
        "complete_stiffness",
        "inner_load",
        "outer_load",
        "inner_angle",
        "outer_angle",
        "inner_pressure",
        "outer_pressure",
        "centrifugal_force",
        "gyroscopic_moment",
    )
    return np.concatenate([np.ravel(getattr(state, name)) for name in names])


def check(batch: BearingState, oracle: BallBearingOracle) -> float:
    """Share of the states solved, every one of them checked."""
    assert set(np.unique(batch.outcome)) <= OUTCOMES
    solved = 0
    for index in range(COUNT):
        state = one(batch, index)
        if state.outcome:
            assert np.isnan(numbers(state)).all()
            continue
        solved += 1
        assert np.isfinite(numbers(state)).all()
        assert set(np.unique(state.status)) <= STATUS
        assert (state.inner_load >= 0.0).all()
        closure, forces = ball_faults(oracle, state)
        assert np.abs(closure).max(initial=0.0) < 1e-12
        assert np.abs(forces).max(initial=0.0) < 1e-8
        assert np.abs(ring_fault(oracle, state)).max() < 1e-8 * max(state.outer_load.sum(), 1.0)
    return solved / COUNT


@pytest.mark.parametrize(
    ("kinematics", "sharing", "least"),
    [
        ("hybrid", "equal", 0.99),
        ("hybrid", "hybrid", 0.99),
        ("outer", "equal", 0.99),
        ("outer", "outer", 0.99),
        ("inner", "equal", 0.0),
        ("geometric", "equal", 0.0),
        ("geometric", "inner", 0.0),
    ],
)
def test_hard_displacements(kinematics: str, sharing: str, least: float) -> None:
    """Nearly all have a state where Mg fades with αo; the other hypotheses may end in a jump."""
    how = dict(kinematics=kinematics, moment_sharing=sharing, static_growth=4e-6, growth=8e-6)
    given, speed = hard_displacements(1)
    batch = VEX70.equilibrium(displacement=given, speed=speed, **how)
    assert np.array_equal(np.isfinite(batch.load).all(axis=-1), batch.outcome == "")
    solved = check(batch, BallBearingOracle(VEX70, **how))
    assert solved >= max(least, 0.3)


@pytest.mark.few(2)
@pytest.mark.parametrize("kinematics", HYPOTHESES)
def test_hard_loads(kinematics: str) -> None:
    given, speed = hard_loads(7)
    batch = VEX70.equilibrium(load=given, speed=speed, kinematics=kinematics)
    solved = check(batch, BallBearingOracle(VEX70, kinematics=kinematics))
    good = batch.outcome == ""
    fault = np.abs(batch.load - given)[good].max(axis=1)
    assert (fault < 1e-8 * np.abs(given[good]).max(axis=1)).all()
    assert solved > 0.3


@pytest.mark.parametrize("sharing", SHARINGS)
@pytest.mark.parametrize("kinematics", HYPOTHESES)
def test_axial_balance(kinematics: str, sharing: str) -> None:
    """Z (Qi sin αi + λi Mg/D cos αi) = Fa to 1e-10, and the outer ring carries the same."""
    thrusts = np.array([800.0, 2500.0, 9000.0])
    load = thrusts[:, None] * np.array([1.0, 0, 0, 0, 0])
    speed = np.array([9000.0, 20000.0, 24000.0]) * RPM
    s = VEX70.equilibrium(load=load, speed=speed, kinematics=kinematics, moment_sharing=sharing)
    assert (s.outcome == "").all()
    oracle = BallBearingOracle(VEX70, kinematics=kinematics, moment_sharing=sharing)
    weight = (
        (s.inner_load / s.outer_load) ** (4 / 3)
        * (oracle.inner.a1 * oracle.inner.e)
        / (oracle.outer.a1 * oracle.outer.e)
    )
    hybrid = 2.0 * weight / (1.0 + weight)
    inner = {"equal": 1.0, "outer": 0.0, "inner": 2.0, "hybrid": hybrid}[sharing]
    moment = s.gyroscopic_moment / VEX70.ball_diameter
    carried = s.inner_load * np.sin(s.inner_angle) + inner * moment * np.cos(s.inner_angle)
    outside = s.outer_load * np.sin(s.outer_angle) + (2 - inner) * moment * np.cos(s.outer_angle)
    assert carried.sum(-1) == pytest.approx(thrusts, rel=1e-10)
    assert outside.sum(-1) == pytest.approx(thrusts, rel=1e-10)
    assert (s.gyroscopic_moment > 0.0).all()


def test_forces_of_the_rings_differ_by_the_centrifugal_force() -> None:
    load, speed = [1500.0, 400.0, -300.0, 3.0, 1.0], 20000.0 * RPM
    s = HARRIS_218.equilibrium(load=load, speed=6000.0 * RPM)
    v = VEX70.equilibrium(load=load, speed=speed)
    for bearing, state in ((HARRIS_218, s), (VEX70, v)):
        psi = BallBearingOracle(bearing).azimuths()
        moment = state.gyroscopic_moment / bearing.ball_diameter
        radial = state.outer_load * np.cos(state.outer_angle) - moment * np.sin(state.outer_angle)
        axial = state.outer_load * np.sin(state.outer_angle) + moment * np.cos(state.outer_angle)
        spare = radial - state.centrifugal_force
        assert axial.sum() == pytest.approx(state.load[0], rel=1e-10)
        assert spare @ np.cos(psi) == pytest.approx(state.load[1], rel=1e-8)
        assert spare @ np.sin(psi) == pytest.approx(state.load[2], rel=1e-8)


@pytest.mark.parametrize("number", [5, 8, 12])
@pytest.mark.parametrize("speed", [50.0, 1500.0])
@pytest.mark.parametrize("dynamics", ["frozen", "resultant"])
def test_light_thrust_at_speed(number: int, speed: float, dynamics: str) -> None:
    """Balls thrown outward by up to ten thousand times the thrust still share it among them."""
    bearing = draw_bearing(np.random.default_rng(number), number).bearing
    thrust = 10.0 ** np.arange(-7.0, 1.0)
    load = np.zeros((len(thrust), 5))
    load[:, 0] = thrust
    s = bearing.equilibrium(load=load, speed=speed, dynamics=dynamics)
    assert (s.outcome == "").all()
    assert (np.diff(s.displacement[:, 0]) > 0.0).all()
    carried = (s.inner_load * np.sin(s.inner_angle)).sum(axis=-1)
    if dynamics == "frozen":
        rounding = 1e-11 * s.outer_load.sum(axis=-1).max()
        np.testing.assert_allclose(carried, thrust, rtol=1e-9, atol=rounding)
