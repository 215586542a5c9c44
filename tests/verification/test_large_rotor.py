"""Rotors of many sections: by Lanczos as good as by all eigenvectors, and against closed forms."""

from __future__ import annotations

import math
import tracemalloc
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.frf import solve as frf
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.equation import reduce
from rotordyn.machine.drawbar import Drawbar
from rotordyn.machine.joint import Joint
from rotordyn.machine.lumped import PointMass
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.rotors import STEEL, support
from tests.oracles.spindles import pairs
from tests.oracles.spinning_beam import PinnedBeam

HZ = 2.0 * math.pi
PIN = 1e15  # N/m, by whose give frequencies fall by 1e-8


def wavy(sections: int, **more: Any) -> Spindle:
    """A metre of sections of many diameters on two uneven damped supports."""
    shape = [0.06 + 0.01 * math.sin(7.0 * k / sections) for k in range(sections)]
    shaft = Shaft(0.0, tuple(Section(1.0 / sections, d, 0.02, STEEL) for d in shape))
    held = (support("a", 0.1, (1e8, 2e8), 1e3), support("b", 0.9, (2e8, 1e8), 2e3))
    return Spindle("wavy", shaft, **({"supports": held, "points": {"tip": 0.0}} | more))


def equal(sections: int, beam: PinnedBeam, stiffness: float = PIN) -> Spindle:
    """A uniform bar in equal pieces, held at both ends."""
    piece = Section(beam.length / sections, beam.diameter, 0.0, STEEL)
    held = [support(n, x, (stiffness, stiffness)) for n, x in (("a", 0.0), ("b", beam.length))]
    return Spindle("equal", Shaft(0.0, (piece,) * sections), supports=tuple(held))


def scene(spindle: Spindle, spins: tuple[float, ...], highest: float, **given: Any) -> Scene:
    ports = tuple(spindle.points.values())
    return Scene(spindle, Conditions(**given), np.array(spins), highest, ports)


def modes(spindle: Spindle, spins: tuple[float, ...], highest: float, **given: Any) -> Any:
    own = scene(spindle, spins, highest, **given)
    return campbell.solve(own, CampbellSpec(highest, shapes=False))


def bending(result: Any, values: str = "frequency") -> np.ndarray:
    return getattr(result, values)[:, [kind == "bending" for kind in result.kind]]


@pytest.fixture
def both_ways(monkeypatch: pytest.MonkeyPatch) -> Callable[[Callable[[], Any]], tuple[Any, Any]]:
    """Answers of a question by all eigenvectors, and by Lanczos."""

    def answers(question: Callable[[], Any]) -> tuple[Any, Any]:
        found = []
        for least in (10**9, 0):
            monkeypatch.setattr(reduce, "LARGE", least)
            found.append(question())
        return found[0], found[1]

    monkeypatch.setattr(reduce, "MOST_DENSE", 0)
    return answers


MACHINES = {
    "plain": wavy(90),
    "free": wavy(90, supports=()),
    "with joint, mass and drawbar": wavy(
        90,
        joints=(
            Joint("cone", 0.35, radial=8e8, tilt=5e6, axial=9e8, torsion=6e5, tilt_damping=20.0),
        ),
        masses=(PointMass("wheel", 0.7, 5.0, 0.04, 0.02),),
        drawbar=Drawbar(20000.0, 0.02, 0.6, (0.3,)),
    ),
}


@pytest.mark.few(1)
@pytest.mark.parametrize("name", MACHINES)
def test_both_ways_agree(name: str, both_ways: Any) -> None:
    """Frequencies, damping and the estimates of their errors."""
    dense, few = both_ways(lambda: modes(MACHINES[name], (0.0, 2000.0), 3000.0))
    assert few.mode == dense.mode
    np.testing.assert_allclose(few.frequency, dense.frequency, rtol=3e-10, atol=1e-7)
    np.testing.assert_allclose(few.damping_ratio, dense.damping_ratio, rtol=1e-7, atol=1e-10)
    np.testing.assert_allclose(few.frequency_error, dense.frequency_error, rtol=0.02, atol=2e-10)


def test_receptances_agree_both_ways(both_ways: Any) -> None:
    grid = np.linspace(5.0, 3000.0, 200)

    def asked() -> np.ndarray:
        spec = FrfSpec(tuple(grid), pairs("tip.y/tip.y", "tip.z/tip.y", "tip.x/tip.x"))
        own = scene(wavy(90), (500.0,), 3000.0)
        return frf.solve(own, spec).response

    dense, few = both_ways(asked)
    np.testing.assert_allclose(few, dense, rtol=0.0, atol=1e-8 * np.abs(dense).max())


@pytest.mark.parametrize("spin", [0.0, 2000.0])
def test_ten_thousand_sections_of_a_pinned_beam(spin: float) -> None:
    """Closed form of the spinning Timoshenko beam within the estimated error, in little
    memory."""
    beam = PinnedBeam(1.0, 0.05)
    tracemalloc.start()
    try:
        result = modes(equal(10_000, beam), (spin,), 1700.0)
        assert tracemalloc.get_traced_memory()[1] < 200e6
    finally:
        tracemalloc.stop()
    exact = np.sort([w for n in range(1, 5) for w in beam.bending_whirl(n, spin)]) / HZ
    order = np.argsort(bending(result)[0])
    found, told = (bending(result, name)[0, order] for name in ("frequency", "frequency_error"))
    assert len(found) == 8
    assert not result.unconverged
    assert (np.abs(found / exact - 1.0) < 3.0 * told + 3e-8).all()
    assert told.max() < 2e-5


def test_receptances_of_ten_thousand_sections_take_little_memory() -> None:
    """Two refined models included."""
    held = tuple(support(name, x, (1e8, 1e8), 1e3) for name, x in (("a", 0.1), ("b", 0.9)))
    spec = FrfSpec(tuple(np.linspace(5.0, 1500.0, 300)), pairs("tip.y/tip.y"))
    tracemalloc.start()
    try:
        result = frf.solve(scene(wavy(10_000, supports=held), (1000.0,), 1500.0), spec)
        assert tracemalloc.get_traced_memory()[1] < 265e6
    finally:
        tracemalloc.stop()
    assert np.isfinite(result.response).all()


@pytest.mark.parametrize("rotor", ["flexible", "rigid"])
def test_ten_thousand_sections_bounce_and_pitch(rotor: str) -> None:
    """On soft supports a stiff bar is a rigid body: its two closed frequencies."""
    beam, k = PinnedBeam(0.5, 0.1), 1e3
    result = modes(equal(10_000, beam, k), (0.0,), 300.0, rotor=rotor)
    mass = 7800.0 * math.pi * 0.05**2 * 0.5
    pitch = mass * (0.5**2 / 12.0 + 0.05**2 / 4.0)
    exact = np.sqrt([2.0 * k / mass, 2.0 * k * 0.25**2 / pitch]) / HZ
    found = np.sort(bending(result)[0])[::2]
    np.testing.assert_allclose(found, np.sort(exact), rtol=2e-5 if rotor == "flexible" else 1e-10)


def test_ten_thousand_free_sections_have_their_rigid_motions() -> None:
    """Two a plane, at zero to the last digit, and what bends is that of one free bar."""
    beam = PinnedBeam(1.0, 0.05)
    many = replace(equal(10_000, beam), supports=())
    one = replace(equal(1, beam), supports=())
    own = scene(many, (0.0,), 3000.0)
    bent = [c for c in own.rotor.components if c.bends]
    assert [int((c.values == 0.0).sum()) for c in bent] == [2, 2]
    result, known = modes(many, (0.0,), 3000.0), modes(one, (0.0,), 3000.0, accuracy=1e-8)
    assert result.mode == known.mode
    np.testing.assert_allclose(result.frequency, known.frequency, rtol=3e-8)


def test_the_estimate_falls_with_the_elements_as_the_error(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Standard elements err with the square of their length: halving them changes frequencies by
    three quarters of the error."""
    beam = PinnedBeam(0.5, 0.1)
    exact = np.sort([w for n in range(1, 4) for w in beam.bending_whirl(n, 2000.0)]) / HZ
    errors, told = [], []
    monkeypatch.setattr(reduce, "LARGE", 0)
    for elements in (40, 80, 160):
        result = modes(equal(1, beam), (2000.0,), 6000.0, element_length=0.5 / elements)
        order = np.argsort(bending(result)[0])
        errors.append(bending(result)[0, order] / exact - 1.0)
        told.append(bending(result, "frequency_error")[0, order])
    fallen = -np.diff(errors, axis=0)  # the give of the pins stays
    np.testing.assert_allclose(-np.diff(told, axis=0), 0.75 * fallen, rtol=0.02)
    np.testing.assert_allclose(fallen[0] / fallen[1], 4.0, rtol=0.02)
