"""Contacts of a four-point bearing: four columns, also where a ring has one arc."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import bearings
from bearings import ElasticRing, FlexibleRings, FourPointBallBearing, Lubricant, life
from bearings.heat import sliding
from tests.oracles.known_bearings import RPM
from tests.oracles.known_grooves import QJ218, deep_groove, four_point

NAMES = ("ir", "il", "or", "ol")
SHIMS = [(0.0, 0.0), (0.2e-3, 0.0), (0.0, 0.2e-3), (0.2e-3, 0.3e-3)]
PUSHED = np.array([20e3, 2e3, -1e3, -20.0, -60.0])
BY_CONTACT = ("contact_load", "contact_angle", "contact_pressure")


def shimmed(inner: float, outer: float) -> FourPointBallBearing:
    return replace(four_point(QJ218), inner_shim=inner, outer_shim=outer)


@pytest.mark.parametrize("dynamics", ["frozen", "resultant"])
@pytest.mark.parametrize("shims", SHIMS)
def test_four_columns(shims: tuple[float, float], dynamics: str) -> None:
    bearing = shimmed(*shims)
    assert bearing.contact_names == NAMES
    state = bearing.equilibrium(load=[PUSHED, -PUSHED], speed=3000.0 * RPM, dynamics=dynamics)
    for name in BY_CONTACT:
        assert getattr(state, name).shape == (2, bearing.balls, 4)
    assert state.contacts.shape == (2, bearing.balls)
    loaded = state.contact_load > 0.0
    assert (loaded == np.isfinite(state.contact_angle)).all()
    assert (state.contact_angle[loaded] > 0.0).all()
    assert (loaded.sum(axis=-1) == state.contacts).all()
    if not any(shims):
        assert loaded[0].all(axis=0).tolist() == [True, False, False, True]
        assert loaded[1].all(axis=0).tolist() == [False, True, True, False]
        assert (loaded.sum(axis=(1, 2)) == 2 * bearing.balls).all()
    assert state.contact_load[..., :2].max(axis=-1) == pytest.approx(state.inner_load, rel=1e-3)


@pytest.mark.parametrize("rings", [(1.0, 0.0), (0.0, 1.0), (1.0, 1.0)])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_shim_that_vanishes(sign: float, rings: tuple[float, float]) -> None:
    """Loads, angles, pressures and what follows from them, all continuous at a shim of 0.

    Lightly loaded, since the second arc stays free only above a shim of about δ/sin α.
    """
    push = sign * np.array([0.3, 1e-3, 5e-4, 1e-5, 2e-5])
    none = shimmed(0.0, 0.0).equilibrium(load=push)
    apart = []
    for shim in (2e-6, 1e-6):
        thin = shimmed(shim * rings[0], shim * rings[1]).equilibrium(load=push)
        assert (thin.contacts == 2).all()
        for name in BY_CONTACT:
            found, near = getattr(none, name), getattr(thin, name)
            assert found == pytest.approx(near, rel=2e-2, nan_ok=True)
        ends, near_ends = (bearings.truncation(state).upper_end for state in (none, thin))
        assert ends == pytest.approx(near_ends, rel=2e-2, nan_ok=True)
        heat = [sliding(state, 0.06).spin_moment for state in (none, thin)]
        assert heat[0] == pytest.approx(heat[1], rel=2e-2)
        apart.append(np.abs(none.contact_load - thin.contact_load).max())
    assert apart[0] == pytest.approx(2.0 * apart[1], rel=0.05)


@pytest.mark.parametrize("load", [[0.0, 5e3, 0.0, 0.0, 0.0], PUSHED, [500.0, 5e3, 0, 0, 50.0]])
def test_a_ring_of_one_arc_has_one_raceway(load: Any) -> None:
    """Its life is that of a deep-groove bearing of the same grooves, on whichever side it bears."""
    bearing = four_point(replace(QJ218, inner_shim=0.0, outer_shim=0.0), contact_angle=0.3)
    deep = deep_groove(replace(QJ218, contact_angle=0.3))
    found, same = (life.life_of(b.equilibrium(load=load)) for b in (bearing, deep))
    assert found.revolutions == pytest.approx(float(same.revolutions), rel=1e-9)
    assert found.race_load == pytest.approx(same.race_load, rel=1e-9)
    assert found.limiting == same.limiting


def test_a_ball_in_the_middle_of_one_arc_has_one_definite_column() -> None:
    """Pressed radially, angles are rounding of either sign: all balls are in ir and ol."""
    bearing = four_point(replace(QJ218, inner_shim=0.0, outer_shim=0.0), radial_play=20e-6)
    for speed in (0.0, 300.0):
        state = bearing.equilibrium(load=[0.0, 5e3, 3e3, 0.0, 0.0], speed=speed)
        assert (state.contact_load[:, [1, 2]] == 0.0).all()


def test_films_and_flexible_rings_of_one_arc() -> None:
    """Those of a deep-groove bearing of the same grooves, in the columns that bear."""
    rings = FlexibleRings(outer=ElasticRing(30e-3, 160e-3, 200e-3))
    drawing = replace(QJ218, inner_shim=0.0, outer_shim=0.0)
    pair = (four_point(drawing), deep_groove(drawing))
    four, deep = (replace(b, rings=rings).equilibrium(load=PUSHED) for b in pair)
    found, same = bearings.ring_deflection(four), bearings.ring_deflection(deep)
    assert found.normal.shape == (15, 4)
    assert found.normal[:, [0, 3]] == pytest.approx(same.normal, rel=1e-6, abs=1e-12)
    assert found.outer == pytest.approx(same.outer, rel=1e-6)
    oil: dict[str, Any] = dict(
        lubricant=Lubricant(32e-6, 5.4e-6), temperature=40.0, load=PUSHED, speed=300.0
    )
    wet, other = (bearings.on_film.on_film(b, **oil) for b in pair)
    assert wet.stiffness == pytest.approx(other.stiffness, rel=1e-9)
    assert wet.growth == pytest.approx(other.growth, rel=1e-9)
