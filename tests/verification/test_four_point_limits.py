"""Four-point bearings: the limit of two contacts, and symmetries."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from tests.oracles.four_point import Drawing
from tests.oracles.known_bearings import HYPOTHESES, RPM, SHARINGS
from tests.oracles.known_grooves import (
    QJ218,
    R24_14,
    angular_contact,
    four_point,
    lever,
    mixed_loads,
)

Array = NDArray[np.float64]
SHALLOW = replace(R24_14, inner_shim=0.05e-3, outer_shim=0.06e-3)
BOTH = pytest.mark.parametrize("dynamics", ["frozen", "resultant"])
DRAWN = pytest.mark.parametrize("drawing", [QJ218, R24_14], ids=["QJ218", "R24_14"])


def moved(drawing: Drawing) -> Array:
    """T: displacement of the point gi/2 off the middle plane, of that of the middle plane."""
    t = np.eye(5)
    t[1, 4], t[2, 3] = 0.5 * drawing.inner_shim, -0.5 * drawing.inner_shim
    return t


TWO = [
    ([20e3, 0.0, 0.0, 0.0, 0.0], 0.0),
    ([20e3, 2e3, -1e3, -20.0, -60.0], 0.0),
    ([20e3, 0.0, 0.0, 0.0, 0.0], 9000.0),
    ([20e3, 2e3, -1e3, -20.0, -60.0], 6000.0),
]


@pytest.mark.few(5)
@pytest.mark.parametrize("sharing", SHARINGS)
@pytest.mark.parametrize("kinematics", HYPOTHESES)
def test_two_contacts_make_an_angular_contact_bearing(kinematics: str, sharing: str) -> None:
    """Of which zero is Ep/2 further, and the point of the moments gi/2 off the middle."""
    t, unit = moved(SHALLOW), lever(SHALLOW)
    how = dict(kinematics=kinematics, moment_sharing=sharing)
    for load, rpm in TWO:
        ours = four_point(SHALLOW).equilibrium(load=load, speed=rpm * RPM, **how)
        there = np.linalg.solve(t.T, np.array(load))
        theirs = angular_contact(SHALLOW).equilibrium(load=there, speed=rpm * RPM, **how)
        assert (ours.contact_load[:, [1, 2]] == 0.0).all()
        travel = t @ ours.displacement - 0.5 * SHALLOW.axial_play * np.eye(5)[0]
        apart = (travel - theirs.displacement) * unit
        assert np.abs(apart).max() < 1e-10 * np.abs(ours.displacement * unit).max()
        top = theirs.outer_load.max()
        for name in ("inner_load", "outer_load", "centrifugal_force"):
            assert getattr(ours, name) == pytest.approx(getattr(theirs, name), abs=1e-10 * top)
        assert ours.contact_load[:, 0] == pytest.approx(theirs.inner_load, abs=1e-10 * top)
        assert ours.contact_load[:, 3] == pytest.approx(theirs.outer_load, abs=1e-10 * top)
        assert ours.contact_angle[:, 0] == pytest.approx(theirs.inner_angle, abs=1e-9)
        assert ours.contact_angle[:, 3] == pytest.approx(theirs.outer_angle, abs=1e-9)
        moment = np.abs(theirs.gyroscopic_moment).max()
        want = pytest.approx(theirs.gyroscopic_moment, abs=1e-10 * moment)
        assert ours.gyroscopic_moment == want
        k = t.T @ theirs.stiffness("complete") @ t / unit / unit[:, None]
        found = ours.stiffness("complete") / unit / unit[:, None]
        assert found == pytest.approx(k, abs=1e-8 * np.abs(k).max())


@DRAWN
@pytest.mark.parametrize(("compiled", "within"), [(True, 1e-10), (False, 1e-8)])
def test_frozen_forces_make_a_symmetric_stiffness(
    drawing: Drawing, compiled: bool, within: float
) -> None:
    """As far as balls are in balance. The solver that is not compiled stops at 1e-11 of the largest
    load: contacts pressed by a hundredth of that know their stiffness less well."""
    load, speed = mixed_loads(20, 1)
    how = dict(dynamics="frozen", compiled=compiled)
    s = four_point(drawing).equilibrium(load=load, speed=speed, **how)
    assert (s.outcome == "").all()
    k = s.stiffness("complete") / lever(drawing) / lever(drawing)[:, None]
    size = np.abs(k).max((1, 2), keepdims=True)
    assert np.abs((k - k.swapaxes(1, 2)) / size).max() < within
    assert np.linalg.eigvalsh(0.5 * (k + k.swapaxes(1, 2)) / size).min() > -1e-12


MIRRORS = [
    (np.array([-1.0, 1.0, 1.0, -1.0, -1.0]), [1, 0, 3, 2], False),  # x → −x
    (np.array([1.0, 1.0, -1.0, -1.0, 1.0]), [0, 1, 2, 3], True),  # z → −z
]


@BOTH
@DRAWN
@pytest.mark.parametrize(("signs", "swap", "backwards"), MIRRORS, ids=["x", "z"])
def test_mirrors(
    drawing: Drawing, dynamics: str, signs: Array, swap: list[int], backwards: bool
) -> None:
    load, speed = mixed_loads(8, 2)
    one = four_point(drawing).equilibrium(load=load, speed=speed, dynamics=dynamics)
    two = four_point(drawing).equilibrium(load=load * signs, speed=speed, dynamics=dynamics)
    unit = lever(drawing)
    size = np.abs(one.displacement * unit).max()
    assert np.abs((one.displacement * signs - two.displacement) * unit).max() < 1e-8 * size
    order = (-np.arange(drawing.balls)) % drawing.balls if backwards else np.arange(drawing.balls)
    want = one.contact_load[:, order][..., swap]
    assert two.contact_load == pytest.approx(want, abs=1e-8 * want.max())
    held = want > 1e-6 * want.max()
    angle = one.contact_angle[:, order][..., swap]
    assert two.contact_angle[held] == pytest.approx(angle[held], abs=1e-6)


@BOTH
@DRAWN
@pytest.mark.parametrize("pitches", [1, 4])
def test_turning_the_load_by_whole_pitches_turns_everything(
    drawing: Drawing, dynamics: str, pitches: int
) -> None:
    load, speed = mixed_loads(8, 3)
    angle = 2.0 * math.pi * pitches / drawing.balls
    turn = np.eye(5)
    pair = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    turn[1:3, 1:3] = turn[3:5, 3:5] = pair
    one = four_point(drawing).equilibrium(load=load, speed=speed, dynamics=dynamics)
    two = four_point(drawing).equilibrium(load=load @ turn.T, speed=speed, dynamics=dynamics)
    unit = lever(drawing)
    apart = (one.displacement @ turn.T - two.displacement) * unit
    assert np.abs(apart).max() < 1e-8 * np.abs(one.displacement * unit).max()
    want = np.roll(one.contact_load, pitches, axis=1)
    assert two.contact_load == pytest.approx(want, abs=1e-8 * want.max())
    k = one.stiffness("complete") / unit / unit[:, None]
    want = turn @ k @ turn.T
    found = two.stiffness("complete") / unit / unit[:, None]
    assert found == pytest.approx(want, abs=1e-6 * np.abs(k).max())
