"""What must not change: mirrors, a turn by one ball pitch, batches, round trips."""

from __future__ import annotations

import numpy as np
import pytest

from tests.oracles.known_bearings import HARRIS_209_DEEP, HYPOTHESES, RPM, VEX70

LOAD = np.array([1300.0, 260.0, -170.0, 2.5, -3.0])
SPEED = 21000.0 * RPM


def turned(angle: float) -> np.ndarray:
    """Rotation of (x, y, z, θy, θz) about the axis."""
    c, s = np.cos(angle), np.sin(angle)
    r = np.eye(5)
    r[1:3, 1:3] = r[3:5, 3:5] = [[c, -s], [s, c]]
    return r


@pytest.mark.parametrize("kinematics", HYPOTHESES)
@pytest.mark.parametrize("speed", [0.0, SPEED])
def test_turn_by_one_pitch_changes_nothing(kinematics: str, speed: float) -> None:
    r = turned(2.0 * np.pi / VEX70.balls)
    a, b = (VEX70.equilibrium(load=f, speed=speed, kinematics=kinematics) for f in (LOAD, r @ LOAD))
    assert b.displacement == pytest.approx(r @ a.displacement, rel=1e-8, abs=1e-15)
    assert np.roll(a.inner_load, 1) == pytest.approx(b.inner_load, rel=1e-8)
    assert np.roll(a.gyroscopic_moment, 1) == pytest.approx(b.gyroscopic_moment, rel=1e-8)
    k = r @ a.stiffness() @ r.T
    assert np.abs(b.stiffness() - k).max() < 1e-8 * np.abs(k).max()


def test_turn_by_any_angle_changes_little_with_many_balls() -> None:
    r = turned(0.4 * 2.0 * np.pi / VEX70.balls)
    a, b = (VEX70.equilibrium(load=f, speed=SPEED) for f in (LOAD, r @ LOAD))
    assert b.displacement == pytest.approx(r @ a.displacement, rel=1e-3, abs=1e-9)


@pytest.mark.parametrize("speed", [0.0, SPEED])
def test_mirror_in_the_plane_of_x_and_z(speed: float) -> None:
    """y and θz change sign; the sense of rotation does not matter to the balls."""
    mirror = np.array([1.0, -1.0, 1.0, 1.0, -1.0])
    a = VEX70.equilibrium(load=LOAD, speed=speed)
    b = VEX70.equilibrium(load=mirror * LOAD, speed=-speed)
    assert b.displacement == pytest.approx(mirror * a.displacement, rel=1e-8, abs=1e-15)
    # ball at ψ goes to π − ψ: only its own mirror image for an even count, so compare by stiffness
    k = np.outer(mirror, mirror) * a.stiffness()
    assert np.abs(b.stiffness() - k).max() < 2e-2 * np.abs(k).max()


@pytest.mark.parametrize("speed", [0.0, 8000.0 * RPM])
def test_mirror_in_the_plane_of_the_balls(speed: float) -> None:
    """Reversing x and the thrust flips x, the tilts, and every coupling between them and y, z."""
    mirror = np.array([-1.0, 1.0, 1.0, -1.0, -1.0])
    load = np.array([900.0, 300.0, 120.0, 1.0, 2.0])
    a = HARRIS_209_DEEP.equilibrium(load=load, speed=speed)
    b = HARRIS_209_DEEP.equilibrium(load=mirror * load, speed=speed)
    assert b.displacement == pytest.approx(mirror * a.displacement, rel=1e-8, abs=1e-15)
    assert b.inner_load == pytest.approx(a.inner_load, rel=1e-8, abs=1e-9)
    k = np.outer(mirror, mirror) * a.stiffness()
    assert np.abs(b.stiffness() - k).max() < 1e-8 * np.abs(k).max()


def test_ball_in_the_plane_of_a_radial_load_decides_the_mirror() -> None:
    """About y (through ball 0) the mirror in z is exact for any count of balls."""
    mirror = np.array([1.0, 1.0, -1.0, -1.0, 1.0])
    a = VEX70.equilibrium(load=LOAD, speed=SPEED)
    b = VEX70.equilibrium(load=mirror * LOAD, speed=SPEED)
    assert b.displacement == pytest.approx(mirror * a.displacement, rel=1e-8, abs=1e-15)
    image = (-np.arange(VEX70.balls)) % VEX70.balls
    assert a.inner_load[image] == pytest.approx(b.inner_load, rel=1e-8)
    k = np.outer(mirror, mirror) * a.stiffness()
    assert np.abs(b.stiffness() - k).max() < 1e-8 * np.abs(k).max()


@pytest.mark.parametrize("kinematics", HYPOTHESES)
@pytest.mark.parametrize("load", [[1000.0, 0, 0, 0, 0], list(LOAD), [600.0, 500.0, 0, 0, 0]])
def test_load_to_displacement_and_back(kinematics: str, load: list[float]) -> None:
    how = dict(speed=SPEED, kinematics=kinematics, static_growth=5e-6, growth=9e-6)
    there = VEX70.equilibrium(load=load, **how)
    back = VEX70.equilibrium(displacement=there.displacement, **how)
    assert there.load == pytest.approx(load, rel=1e-9, abs=1e-7)
    assert back.load == pytest.approx(load, rel=1e-9, abs=1e-6)
    assert back.inner_load == pytest.approx(there.inner_load, rel=1e-7, abs=1e-7)


def test_axial_load_gives_balls_alike_and_isotropy() -> None:
    s = VEX70.equilibrium(load=[1000.0, 0, 0, 0, 0], speed=SPEED)
    k = s.stiffness()
    assert np.ptp(s.inner_load) == pytest.approx(0.0, abs=1e-8)
    assert k[1, 1] == pytest.approx(k[2, 2], rel=1e-10)
    assert k[3, 3] == pytest.approx(k[4, 4], rel=1e-10)
    assert np.abs(k[0, 1:]).max() < 1e-9 * np.abs(k).max()


def test_pure_thrust_is_the_limit_of_nearly_pure_thrust() -> None:
    """The shortcut for one ball and the full ring agree."""
    a, b = (
        VEX70.equilibrium(load=[1000.0, f, 0, 0, 0], speed=SPEED, kinematics="outer")
        for f in (0.0, 1e-7)
    )
    assert b.displacement == pytest.approx(a.displacement, rel=1e-8, abs=1e-11)
    assert np.abs(a.stiffness() - b.stiffness()).max() < 1e-7 * np.abs(a.stiffness()).max()


@pytest.mark.parametrize("given", ["load", "displacement"])
def test_batch_equals_single(given: str) -> None:
    rng = np.random.default_rng(2310)
    loads = np.array([800.0, 0, 0, 0, 0]) + rng.uniform(-1, 1, (2, 3, 5)) * [400, 150, 150, 2, 2]
    loads[0, 0] = [900.0, 0, 0, 0, 0]
    speeds = np.array([0.0, 12000.0, 24000.0]) * RPM
    values = loads
    if given == "displacement":
        values = VEX70.equilibrium(load=loads, speed=speeds).displacement
    batch = VEX70.equilibrium(**{given: values}, speed=speeds)
    assert batch.load.shape == batch.displacement.shape == (2, 3, 5)
    assert batch.stiffness().shape == (2, 3, 5, 5)
    assert batch.inner_load.shape == batch.status.shape == (2, 3, VEX70.balls)
    for index in np.ndindex(2, 3):
        one = VEX70.equilibrium(**{given: values[index]}, speed=speeds[index[1]])
        assert one.displacement == pytest.approx(batch.displacement[index], rel=1e-8, abs=1e-15)
        assert one.load == pytest.approx(batch.load[index], rel=1e-8, abs=1e-6)
        assert one.outer_load == pytest.approx(batch.outer_load[index], rel=1e-8, abs=1e-8)
        assert one.inner_pressure == pytest.approx(batch.inner_pressure[index], rel=1e-7)


def test_speed_broadcasts_against_load() -> None:
    s = VEX70.equilibrium(load=[[500.0, 0, 0, 0, 0]], speed=np.array([[0.0], [1000.0], [2000.0]]))
    assert s.load.shape == (3, 1, 5)
    assert s.centrifugal_force.shape == (3, 1, 25)
    assert np.all(np.diff(s.centrifugal_force, axis=0) > 0.0)
