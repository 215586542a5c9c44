"""Rotors of many sections: found from static answers alone, as good as from all eigenvectors."""

from __future__ import annotations

import math
import tracemalloc
from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from rotordyn.numerics.reduction import RitzBasis
from rotordyn.system import flexibility, hierarchy, remainder
from rotordyn.system.hierarchic_rotor import bending_hierarchy

from rotordyn.analysis import campbell, frf
from rotordyn.analysis.scene import Scene
from rotordyn.analysis.specs import CampbellSpec, Conditions, FrfSpec
from rotordyn.errors import InvalidInput
from rotordyn.machine.drawbar import Drawbar
from rotordyn.machine.joint import Joint
from rotordyn.machine.lumped import PointMass
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.numerics import flexible
from tests.oracles.rotors import STEEL, support, uniform
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
    return campbell.answer(own, CampbellSpec(highest, shapes=False))


def bending(result: Any, values: str = "frequency") -> np.ndarray:
    return getattr(result, values)[:, [kind == "bending" for kind in result.kind]]


@pytest.fixture
def both_ways(monkeypatch: pytest.MonkeyPatch) -> Callable[[Callable[[], Any]], tuple[Any, Any]]:
    """Answers of a question by all eigenvectors, and by static answers."""

    def answers(question: Callable[[], Any]) -> tuple[Any, Any]:
        found = []
        for least in (10**9, 0):
            monkeypatch.setattr(hierarchy, "LARGE", least)
            found.append(question())
        return found[0], found[1]

    monkeypatch.setattr(flexibility, "MOST_DENSE", 0)
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


@pytest.mark.parametrize("name", MACHINES)
def test_both_ways_agree(name: str, both_ways: Any) -> None:
    """Frequencies, damping, counts and what is told of their errors."""
    dense, few = both_ways(lambda: modes(MACHINES[name], (0.0, 2000.0), 3000.0))
    assert few.mode == dense.mode
    np.testing.assert_allclose(few.frequency, dense.frequency, rtol=3e-10, atol=1e-7)
    np.testing.assert_allclose(few.damping_ratio, dense.damping_ratio, rtol=1e-7, atol=1e-10)
    np.testing.assert_allclose(few.frequency_error, dense.frequency_error, rtol=0.02, atol=2e-10)
    assert dense.certified.all()
    assert few.certified.all()
    np.testing.assert_array_equal(few.modes_below, dense.modes_below)


def test_receptances_agree_both_ways(both_ways: Any) -> None:
    grid = np.linspace(5.0, 3000.0, 200)

    def asked() -> np.ndarray:
        spec = FrfSpec(tuple(grid), pairs("tip.y/tip.y", "tip.z/tip.y", "tip.x/tip.x"))
        own = scene(wavy(90), (500.0,), 3000.0)
        return frf.answer(own, spec).response

    dense, few = both_ways(asked)
    np.testing.assert_allclose(few, dense, rtol=0.0, atol=1e-8 * np.abs(dense).max())


@pytest.mark.parametrize("name", MACHINES)
def test_norms_of_all_that_is_left_out(name: str, both_ways: Any) -> None:
    """What the count of modes is proven by, against singular values of all eigenvectors."""

    def norms() -> list[float]:
        own = scene(MACHINES[name], (0.0,), 2000.0).rotor.unreduced
        return [own.mass_norm, own.polar_norm, own.slope_norm]  # type: ignore[union-attr]

    dense, few = np.array(both_ways(norms))
    assert (few[1:] >= dense[1:] * (1.0 - 1e-9)).all()
    np.testing.assert_allclose(few[1:], dense[1:], rtol=0.02)
    assert dense[0] * (1.0 - 1e-9) <= few[0] < 1.0 / (HZ * 5000.0) ** 2


@pytest.mark.parametrize("name", MACHINES)
def test_forces_on_all_that_is_left_out(name: str, both_ways: Any) -> None:
    """Of inertia, gyroscopic moments and axial force of each vector, in the measure of stiffness:
    those on the few vectors of the rest are those on all eigenvectors."""

    def forces() -> np.ndarray:
        own = scene(MACHINES[name], (0.0,), 2000.0).rotor.unreduced
        assert own is not None
        basis, rest = own.basis, own.rest.vectors
        pressed = (own.slope @ rest).T @ (own.slope @ basis.vectors)
        both = (own.mass_coupling, own.polar_coupling, pressed)
        return np.array([np.linalg.norm(part, axis=0)[: len(basis.values)] for part in both])

    dense, few = both_ways(forces)
    for one, other in zip(dense, few, strict=True):
        np.testing.assert_allclose(other, one, rtol=1e-3, atol=1e-5 * one.max())


def test_finer_elements_are_gathered_without_loss() -> None:
    """What 2m vectors answer to forces is what all inner freedoms answer, inertia included."""
    spindle = wavy(40)
    elements = bending_hierarchy(spindle, HZ * 3000.0, 2000.0, 1e-3)
    vectors = np.random.default_rng(2).standard_normal((elements.size, 6))
    basis = SimpleNamespace(vectors=vectors)
    found = []
    for gather in (remainder._of_finer_elements, remainder._gathered):
        part = gather(elements, basis)  # type: ignore[arg-type]
        met = np.concatenate([part["mass"], part["polar"]], axis=1)
        soft = 1.0 / part["own_stiffness"][:, None]
        found.append([met.T @ (soft * met), met.T @ (soft**2 * part["own_mass"][:, None] * met)])
    assert len(part["own_mass"]) <= 12
    for every, few in zip(*found, strict=True):
        np.testing.assert_allclose(few, every, rtol=1e-7, atol=1e-9 * np.abs(every).max())


def test_vectors_and_the_rest_are_orthonormal() -> None:
    """In mass, and in stiffness with each other's values; the rest holds what was added."""
    own = scene(wavy(400), (0.0,), 2000.0).rotor.unreduced
    assert own is not None
    basis = own.basis
    assert len(basis.vectors) > 1000 > basis.rest.shape[1]
    stiff = basis.outside[0].flexible
    mass = basis.vectors.T @ stiff.pushed
    kept = np.flatnonzero(basis.values <= basis.outside[0].above)
    assert mass[kept] == pytest.approx(np.eye(len(kept)), abs=1e-10)
    assert np.abs(basis.rest.T @ stiff.pushed).max() < 1e-10
    assert (basis.rest_values > basis.outside[0].above).all()


@pytest.mark.parametrize("spin", [0.0, 2000.0])
def test_ten_thousand_sections_of_a_pinned_beam(spin: float) -> None:
    """Closed form of the spinning Timoshenko beam within what is told, in little memory."""
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
    assert result.certified.all()
    assert result.modes_below == pytest.approx(len(result.mode))
    assert (np.abs(found / exact - 1.0) < 1.05 * told + 3e-8).all()
    assert told.max() < 2e-5


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
    assert (own.rotor.stiffness == 0.0).sum() == 2
    result, known = modes(many, (0.0,), 3000.0), modes(one, (0.0,), 3000.0, accuracy=1e-8)
    assert result.mode == known.mode
    np.testing.assert_allclose(result.frequency, known.frequency, rtol=3e-8)


def test_what_is_told_falls_with_the_elements_and_is_the_error(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Standard elements err with the square of their length; so does what is told, to 2 %."""
    beam = PinnedBeam(0.5, 0.1)
    exact = np.sort([w for n in range(1, 4) for w in beam.bending_whirl(n, 2000.0)]) / HZ
    errors, told = [], []
    monkeypatch.setattr(hierarchy, "LARGE", 0)
    for elements in (40, 80, 160):
        result = modes(equal(1, beam), (2000.0,), 6000.0, element_length=0.5 / elements)
        order = np.argsort(bending(result)[0])
        errors.append(bending(result)[0, order] / exact - 1.0)
        told.append(bending(result, "frequency_error")[0, order])
    fallen = -np.diff(errors, axis=0)  # the give of the pins stays
    np.testing.assert_allclose(-np.diff(told, axis=0), fallen, rtol=0.02)
    np.testing.assert_allclose(fallen[0] / fallen[1], 4.0, rtol=0.02)


def test_a_vibration_that_lanczos_misses_is_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    """Dropped once it is found by a search for more, dropped always the rotor is refused."""
    rotor, whole, dropped = wavy(300), flexible._lanczos, []
    expected = modes(rotor, (0.0,), 4000.0)

    def poorer(problem: Any, answer: Any, count: int) -> tuple[np.ndarray, np.ndarray]:
        vectors, values = whole(problem, answer, count)
        if dropped and dropped[-1] == "once":
            return vectors, values
        dropped.append("once" if not always else "again")
        return np.delete(vectors, 2, axis=1), np.delete(values, 2)

    monkeypatch.setattr(flexible, "_lanczos", poorer)
    always = True
    with pytest.raises(InvalidInput, match="cannot be told from one another"):
        scene(rotor, (0.0,), 4000.0).rotor  # noqa: B018
    always = False
    dropped.clear()
    np.testing.assert_allclose(
        modes(rotor, (0.0,), 4000.0).frequency, expected.frequency, rtol=1e-9
    )


def test_a_mode_that_the_basis_lacks_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    """The second bending vector is put among those left out: the count is not proven."""
    whole = flexibility.ritz_basis_of_large

    def poorer(*arguments: Any) -> RitzBasis:
        basis = whole(*arguments)
        kept = np.delete(np.arange(basis.vectors.shape[1]), 3)
        return replace(
            basis,
            vectors=basis.vectors[:, kept],
            values=basis.values[kept],
            are_modes=basis.are_modes[kept],
            rest=np.concatenate([basis.vectors[:, 3:4], basis.rest], axis=1),
            rest_values=np.append(basis.values[3], basis.rest_values),
            rest_mass=np.concatenate([np.zeros((1, len(kept))), basis.rest_mass[:, kept]]),
            rounding=basis.rounding[kept],
        )

    assert modes(wavy(300), (100.0,), 2000.0).certified.all()
    monkeypatch.setattr(flexibility, "ritz_basis_of_large", poorer)
    assert not modes(wavy(300), (100.0,), 2000.0).certified.any()


def test_too_many_vibrations_are_refused_before_they_are_sought(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(flexibility, "MOST_ENTRIES", 100_000)
    monkeypatch.setattr(flexibility, "MOST_DENSE", 0)
    with pytest.raises(InvalidInput, match=r"vibrations and loads of a rotor of .* are too many"):
        modes(uniform(1.0, 0.02, supports=[support("a", 0.0, (1e7, 1e7))]), (0.0,), 9e4)
