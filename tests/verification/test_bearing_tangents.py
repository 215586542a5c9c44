"""Complete, frozen and difference tangent of the same state."""

from __future__ import annotations

import numpy as np
import pytest

from bearings import DeepGrooveBallBearing, InvalidBearing, stiffness
from tests.oracles.known_bearings import RPM, VEX70

SCALE = np.array([1.0, 1.0, 1.0, 0.045, 0.045])


def apart(a: np.ndarray, b: np.ndarray) -> float:
    """Largest difference over the largest entry, moments and tilts scaled by dm/2."""
    weight = SCALE * SCALE[:, None]
    return float((np.abs(a - b) / weight).max() / (np.abs(b) / weight).max())


def test_at_rest_nothing_is_left_to_freeze() -> None:
    state = VEX70.equilibrium(load=[1000.0, 200.0, 0.0, 1.0, 0.0])
    assert apart(state.stiffness("frozen"), state.stiffness("complete")) == 0.0


@pytest.mark.parametrize("rpm", [0.0, 10000.0, 30000.0])
def test_differences_confirm_the_complete_tangent(rpm: float) -> None:
    state = VEX70.equilibrium(load=[1000.0, 200.0, 50.0, 1.0, -2.0], speed=rpm * RPM)
    assert apart(stiffness(state, "difference"), state.stiffness("complete")) < 1e-6


def test_frozen_error_grows_with_speed_to_a_sixth_when_lightly_loaded() -> None:
    """Noël (2013), ch. II: up to about 16 % at 30 000 rpm; there of Kxx, lightly loaded."""
    speed = np.array([10000.0, 20000.0, 30000.0]) * RPM
    for load, low, high in ((250.0, 0.14, 0.19), (2000.0, 0.005, 0.03)):
        state = VEX70.equilibrium(load=[load, 0.0, 0.0, 0.0, 0.0], speed=speed)
        complete = state.stiffness("complete")[:, 0, 0]
        error = np.abs(state.stiffness("frozen")[:, 0, 0] / complete - 1.0)
        assert (np.diff(error) > 0.0).all()
        assert low < error[-1] < high


def test_shapes_follow_the_batch() -> None:
    load = np.ones((3, 2, 5)) * [1000.0, 1.0, 0.0, 0.0, 0.0]
    state = VEX70.equilibrium(load=load, speed=np.array([0.0, 1500.0]))
    for method in ("complete", "frozen", "difference"):
        assert stiffness(state, method).shape == (3, 2, 5, 5)


@pytest.mark.parametrize("method", ["complete", "frozen", "difference"])
def test_planes_of_an_axial_state_answer_alike(method: str) -> None:
    """Nothing couples them, not even rounding: the rotor on top may then fold both into one."""
    turned = np.array([0, 2, 1, 4, 3])
    sign = np.array([1.0, 1.0, 1.0, -1.0, -1.0])
    k = stiffness(VEX70.equilibrium(load=[1220.0, 0, 0, 0, 0], speed=25000 * RPM), method)
    assert k == pytest.approx((k * sign * sign[:, None])[np.ix_(turned, turned)], rel=1e-13)
    assert set(zip(*np.nonzero(k), strict=True)) == {
        (0, 0), (1, 1), (2, 2), (3, 3), (4, 4), (1, 4), (4, 1), (2, 3), (3, 2),
    }  # fmt: skip


def test_states_that_do_not_exist_do_not_disturb_their_neighbours() -> None:
    load = np.array([[1000.0, 0, 0, 0, 0], [0.0, 0, 0, 0, 0], [1000.0, 50.0, 0, 0, 0]])
    state = VEX70.equilibrium(load=load, speed=2000.0)
    for method in ("complete", "frozen", "difference"):
        k = stiffness(state, method)
        assert np.isnan(k[1]).all()
        for place in (0, 2):
            alone = stiffness(VEX70.equilibrium(load=load[place], speed=2000.0), method)
            assert apart(k[place], alone) < 1e-7


def test_unknown_method() -> None:
    with pytest.raises(InvalidBearing, match="did you mean 'frozen'"):
        VEX70.equilibrium(load=[1000.0, 0, 0, 0, 0]).stiffness("frosen")


def test_frozen_is_not_complete_where_the_moment_is_zero_and_its_slope_is_not() -> None:
    """Under a radial load alone angles and Mg are zero, but not what a tilt makes of them."""
    bearing = DeepGrooveBallBearing(8e-3, 40e-3, 9, radial_clearance=10e-6)
    s = bearing.equilibrium(load=[0.0, 500.0, 0.0, 0.0, 0.0], speed=2000.0)
    assert not s.gyroscopic_moment.any()
    complete, frozen = s.stiffness(), s.stiffness("frozen")
    assert apart(stiffness(s, "difference"), complete) < 1e-6
    assert apart(frozen, complete) > 1e-6
