"""Responses along engine orders: those of the whole grid, and the motion by unbalance."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rotordyn.analyses.frf.figures.orders import orders_figure
from rotordyn.analyses.frf.solve import solve
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.frf.summary import summary
from rotordyn.analyses.unbalance.solve import solve as unbalanced
from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.errors import InvalidInput
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.loads import Unbalance
from rotordyn.scene.scene import Scene
from tests.oracles.coaxial import COAXIAL
from tests.oracles.spindles import RPM, pairs
from tests.rotordyn.analyses.frf.test_receptance_errors import machine

SPEEDS = np.linspace(1500.0, 30000.0, 4) * RPM
ASKED = pairs("p0.y/p0.y", "p1.z/p0.y", "p0.y/p0.z")


def scene(kind: str, **conditions: object) -> Scene:
    spindle = machine(kind)
    own = Conditions(accuracy=1e-3, **conditions)  # type: ignore[arg-type]
    return Scene(spindle, own, SPEEDS, 1500.0, tuple(spindle.points.values()))


@pytest.mark.parametrize("kind", ["isotropic", "uneven", "lossy"])
def test_values_are_those_of_the_grid(kind: str) -> None:
    found = solve(scene(kind), FrfSpec((), ASKED, engine_orders=(1.0, 2.5)))
    hertz = SPEEDS[:, None] * np.array([1.0, 2.5]) / (2.0 * math.pi)
    np.testing.assert_allclose(found.line_frequency, hertz, rtol=1e-14)
    grid = solve(scene(kind), FrfSpec(tuple(np.unique(hertz)), ASKED))
    for row in range(len(SPEEDS)):
        for line in range(2):
            at = np.searchsorted(grid.frequency, hertz[row, line] * (1.0 - 1e-12))
            own, same = found.line_value[row, line], grid.response[row, :, at]
            np.testing.assert_allclose(own, same, rtol=1e-10, atol=1e-10 * np.abs(same).max())
    assert found.frequency.size == found.slice_speed.size == 0


@pytest.mark.parametrize("kind", ["isotropic", "uneven", "lossy", "coupled"])
def test_unbalance_is_the_first_order(kind: str) -> None:
    """y = u Ω² (H_yy − i H_yz) of a force that turns forward."""
    size = 1e-5
    spec = UnbalanceSpec(("p0",), (Unbalance("p0", size),))
    moved = unbalanced(scene(kind), spec).displacement[:, 0, 0]
    found = solve(scene(kind), FrfSpec((), ASKED, engine_orders=(1.0,))).line_value[:, 0]
    forward = size * SPEEDS**2 * (found[:, 0] - 1j * found[:, 2])
    np.testing.assert_allclose(forward, moved, rtol=1e-10)


@pytest.mark.few(1)
@pytest.mark.parametrize("count", [2, 7])
def test_peaks_are_those_of_many_speeds(count: int) -> None:
    spindle = machine("uneven")
    few, many = (
        solve(
            Scene(
                spindle,
                Conditions(accuracy=1e-3),
                np.linspace(12000.0, 30000.0, n) * RPM,
                1500.0,
                tuple(spindle.points.values()),
            ),
            FrfSpec((), ASKED[:1], engine_orders=(1.0,)),
        )
        for n in (count, 151)
    )
    size = np.abs(many.line_value[:, 0, 0])
    assert np.nanmax(np.abs(few.line_curve[0, :, 0])) >= (1.0 - 1e-3) * size.max()
    tops = 1 + np.flatnonzero((size[1:-1] > size[:-2]) & (size[1:-1] >= size[2:]))
    assert len(tops)
    for top in tops:
        near = np.nanargmin(np.abs(few.line_peak_speed[0, 0] - many.speed[top]))
        assert abs(few.line_peak_value[0, 0, near]) == pytest.approx(size[top], rel=0.02)
    assert "along 1× at" in summary(few)[0].replace("\N{NO-BREAK SPACE}", " ")
    axes = orders_figure(few, [0]).axes[0]
    assert np.nanmax(axes.lines[0].get_ydata()) == pytest.approx(
        np.nanmax(np.abs(few.line_curve)) * 1e6
    )


def test_no_speed_is_sampled_twice() -> None:
    """Of two samples apart by rounding alone one is higher: a peak that is none."""
    speeds = np.linspace(0.0, 30000.0, 14) * RPM  # evenly spread samples meet them but for rounding
    spindle = machine("uneven")
    own = Scene(spindle, Conditions(accuracy=1e-3), speeds, 1500.0, tuple(spindle.points.values()))
    found = solve(own, FrfSpec((), ASKED, engine_orders=(1.0, 2.0)))
    steps = np.diff(found.line_speed, axis=1)
    assert np.nanmin(steps) > 1e-8 * speeds[-1]
    assert set(speeds) <= set(found.line_speed[0])


def test_a_further_rotor_has_lines_of_its_own() -> None:
    one = Scene(COAXIAL, Conditions(accuracy=1e-3), 0.02 * SPEEDS, 60.0, (0.076,))
    found = solve(one, FrfSpec((), pairs("d1.y/d1.y"), engine_orders=(1.0, 2.0)))
    assert found.line == ("1×", "2×", "1× outer", "2× outer")
    np.testing.assert_allclose(found.line_frequency[:, 2], 0.03 * SPEEDS / (2.0 * math.pi))


def test_the_rotating_frame_has_no_engine_orders() -> None:
    with pytest.raises(InvalidInput, match="engine_orders: a multiple of the speed"):
        solve(scene("isotropic", formulation="rotating"), FrfSpec((), ASKED, engine_orders=(1.0,)))
