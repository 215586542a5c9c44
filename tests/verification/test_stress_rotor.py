"""What breaks codes of rotors: each with its right answer, or one sentence (docs/stress.md)."""

from __future__ import annotations

import math
import tracemalloc
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from bearings.errors import InvalidBearing
from bearings.materials import Material
from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.frf import solve as frf
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.section_forces.solve import solve as section_forces
from rotordyn.analyses.section_forces.spec import SectionForcesSpec
from rotordyn.analyses.unbalance import solve as unbalance
from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.equation import mesh
from rotordyn.errors import InvalidInput
from rotordyn.machine.housing import RigidHousing
from rotordyn.machine.lumped import PointMass
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.loads import PointLoad, Unbalance
from rotordyn.scene.scene import Scene
from tests.oracles.dense_rotor.unreduced import dense_poles
from tests.oracles.exact_shaft.count import whirl_frequencies
from tests.oracles.exact_shaft.rotor import exact_rotor
from tests.oracles.idealised import idealised
from tests.oracles.rotors import STEEL, support, uniform
from tests.oracles.spindles import RPM, pairs
from tests.verification.test_soft_springs import encloses

HZ = 2.0 * math.pi
HELD = 1e8  # N/m
NO_SEATS = np.zeros((0, 5, 5))


def on_two(
    stiffness: float = HELD, damping: float = 0.0, material: Material = STEEL, **more: Any
) -> Spindle:
    """A bar of 0.5 m and 50 mm on two equal supports, a named point at its front."""
    places = {"left": 0.05, "right": 0.45}
    held = [support(n, x, (stiffness, stiffness), damping) for n, x in places.items()]
    bar = uniform(0.5, 0.05, material, supports=held)
    return replace(bar, points={"tip": 0.0}, **more)


def row(*sections: Section, places: tuple[float, float] = (0.1, 0.9)) -> Spindle:
    """Sections on two supports at shares of the length."""
    shaft = Shaft(0.0, sections)
    held = tuple(
        support(f"s{k}", share * shaft.end, (HELD, HELD)) for k, share in enumerate(places)
    )
    return Spindle("row", shaft, supports=held)


def seen(
    spindle: Spindle,
    speed: tuple[float, ...] = (0.0, 500.0),
    top: float = 2000.0,
    **conditions: Any,
) -> Scene:
    return Scene(spindle, Conditions(**conditions), np.array(speed), top, (0.0,))


def modes(spindle: Spindle, *arguments: Any, **conditions: Any) -> Any:
    own = seen(spindle, *arguments, **conditions)
    return campbell.solve(own, CampbellSpec(own.max_frequency, shapes=False))


def bending(result: Any) -> np.ndarray:
    """Frequencies of bending [Hz] (speeds, modes)."""
    return result.frequency[:, [kind == "bending" for kind in result.kind]]


def receptance(scene: Scene, *frequency: float) -> np.ndarray:
    """At the front, y by y and x by x (speeds, 2, frequencies)."""
    spec = FrfSpec(frequency, pairs("tip.y/tip.y", "tip.x/tip.x"))
    return frf.solve(scene, spec).receptance


# --- stiffness and length ------------------------------------------------------------------------


@pytest.mark.parametrize("thick", [0, 1, 2])
def test_sections_of_a_millionfold_stiffness(thick: int) -> None:
    """EI 10⁶:1 in any order: elements keep to what they tell, sixty digits enclose the exact."""
    sections = [Section(0.2, 0.006, 0.0, STEEL) for _ in range(3)]
    sections[thick] = Section(0.2, 0.006 * 1e6**0.25, 0.0, STEEL)
    spindle = row(*sections)
    exact = exact_rotor(spindle, 300.0, NO_SEATS)
    truth = np.sort(np.concatenate([whirl_frequencies(exact, 4, side) for side in (-1, 1)]))
    result = modes(spindle, (300.0,), 1.2 * float(truth[-1]) / HZ, accuracy=1e-6)
    found = np.sort(bending(result)[0])[:8] * HZ
    assert found == pytest.approx(truth, rel=1e-7)
    assert np.nanmax(result.frequency_error) < 1e-5
    for side in (-1, 1):
        lowest = side * float(whirl_frequencies(exact, 1, side)[0])
        assert encloses(exact, lowest, 1e-10)


@pytest.mark.parametrize("share", [1e-300, 1.4e-7, 1.6e-7, 1e-6])
def test_a_piece_of_a_millionth_of_the_length(share: float) -> None:
    """Cut where nothing changes, at any length: no frequency moves."""
    whole = modes(row(Section(0.5, 0.05, 0.0, STEEL)), accuracy=1e-6)
    cut = [Section(h, 0.05, 0.0, STEEL) for h in (0.2, 0.5 * share, 0.3 - 0.5 * share)]
    found = modes(row(*cut), accuracy=1e-6)
    assert bending(found) == pytest.approx(bending(whole), rel=3e-7)
    assert found.frequency.shape == whole.frequency.shape


def test_stations_a_nanometre_apart_are_one() -> None:
    """Two supports, masses and points there: one of the sum."""
    twice = on_two(
        supports=tuple(
            support(f"{n}{k}", x + 1e-9 * k, (HELD / 2.0,) * 2)
            for n, x in (("left", 0.05), ("right", 0.45))
            for k in (0, 1)
        ),
        masses=tuple(PointMass(f"m{k}", 0.2 + 1e-9 * k, 1.5) for k in (0, 1)),
    )
    once = on_two(masses=(PointMass("m", 0.2, 3.0),))
    both = [modes(spindle) for spindle in (twice, once)]
    assert bending(both[0]) == pytest.approx(bending(both[1]), rel=1e-9)
    near = [receptance(seen(s), 10.0, 400.0) for s in (twice, once)]
    assert near[0] == pytest.approx(near[1], rel=1e-6)


@pytest.mark.parametrize(
    ("length", "young", "density"), [(-7, 0, 0), (6, 26, -2), (0, -30, -36), (0, -30, 26)]
)
def test_units_do_not_matter(length: int, young: int, density: int) -> None:
    """Lengths × 2ᵃ, E × 2ᵇ, ρ × 2ᶜ: frequencies go by 2^(b/2 − c/2 − a)."""
    scale = 2.0**length
    material = idealised("m", 2.1e11 * 2.0**young, 0.3, 7800.0 * 2.0**density)
    stiffness = HELD * 2.0 ** (length + young)
    held = [support(n, x * scale, (stiffness,) * 2) for n, x in (("a", 0.05), ("b", 0.45))]
    bar = uniform(0.5 * scale, 0.05 * scale, material, supports=held)
    faster = 2.0 ** (young / 2.0 - density / 2.0 - length)
    top = 2000.0 * faster
    plain, scaled = (
        modes(on_two()),
        modes(bar, (0.0, 500.0 * faster), top),
    )
    assert scaled.mode == plain.mode
    assert scaled.frequency == pytest.approx(plain.frequency * faster, rel=1e-8)


@pytest.mark.parametrize(
    ("young", "density"), [(1e-300, 7800.0), (1e300, 7800.0), (2e11, 1e-300), (2e11, 1e300)]
)
def test_materials_beyond_sense_are_refused(young: float, density: float) -> None:
    with pytest.raises(InvalidBearing, match="must lie from") as refused:
        Material("m", young, 0.3, density)
    assert "\n" not in str(refused.value)


# --- size ----------------------------------------------------------------------------------------


def test_more_sections_than_fit_are_refused_before_any_matrix(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(mesh, "MOST_NODES", 3000)
    thin = Section(5e-5, 0.05, 0.0, STEEL)
    tracemalloc.start()
    try:
        with pytest.raises(InvalidInput, match=r"given 100\d\d by 10000 sections.* up to 3000"):
            modes(row(*[thin] * 10_000))
        assert tracemalloc.get_traced_memory()[1] < 20e6
    finally:
        tracemalloc.stop()


def test_waves_shorter_than_matrices_hold_are_refused() -> None:
    long = uniform(50.0, 0.02, supports=[support("a", 1.0, (HELD, HELD))])
    tracemalloc.start()
    try:
        with pytest.raises(InvalidInput, match=r"bending up to 1e\+06 Hz takes .* up to 200000"):
            modes(long, (0.0,), 1e6)
        with pytest.raises(InvalidInput, match=r"too many nodes.* up to 100000"):
            modes(long, (0.0,), 100.0, element_length=1e-9)
        assert tracemalloc.get_traced_memory()[1] < 100e6
    finally:
        tracemalloc.stop()


# --- almost nothing -----------------------------------------------------------------------------


@pytest.mark.few(2)
@pytest.mark.parametrize("stiffness", [0.0, 5e-324, 1e-26, 1e-15])
def test_next_to_no_support_is_none(stiffness: float) -> None:
    """As many free motions, the same modes and receptances as those of the free bar, no growth."""
    spindle = on_two(stiffness)
    free = replace(spindle, supports=())
    (own, found), (other, expected) = ((s, modes(s)) for s in (spindle, free))
    assert found.mode == expected.mode
    assert found.free == pytest.approx(expected.free)
    np.testing.assert_allclose(found.frequency, expected.frequency, rtol=1e-6)
    assert math.isinf(found.stability_threshold)
    both = [seen(s) for s in (own, other)]
    near = [receptance(one, 1.0, 400.0) for one in both]
    assert near[0] == pytest.approx(near[1], rel=1e-5)
    assert both[0].warnings == ()


@pytest.mark.parametrize("stiffness", [1e-11, 1e-8, 1e-3])
def test_a_soft_support_lets_nothing_grow(stiffness: float) -> None:
    """Bounce √(2k/m) and pitch √(2k a²/J) of a rigid body; no growth is read into rounding."""
    spindle = on_two(stiffness)
    result = modes(spindle)
    mass = STEEL.density * math.pi / 4.0 * 0.05**2 * 0.5
    inertia = mass * (0.5**2 / 12.0 + 0.05**2 / 16.0)
    expected = np.sqrt([2.0 * stiffness / mass, 2.0 * stiffness * 0.2**2 / inertia]) / HZ
    assert np.sort(bending(result)[0])[[0, 2]] == pytest.approx(expected, rel=1e-6)
    assert math.isinf(result.stability_threshold)
    spec = UnbalanceSpec(("tip",), (Unbalance("tip", 1e-6),))
    own = seen(spindle)
    assert not any(unbalance.solve(own, spec).outcome)
    assert own.warnings == ()


@pytest.mark.parametrize("mass", [5e-324, 1e-12])
def test_almost_no_mass_changes_nothing(mass: float) -> None:
    with_mass = on_two(masses=(PointMass("m", 0.2, mass, mass, mass),))
    assert bending(modes(with_mass)) == pytest.approx(bending(modes(on_two())), rel=1e-6)


def test_a_hundred_tons_swing_on_the_shaft_at_rest() -> None:
    """M ω² = 1/(1/2k + L³/48EI + L/4κGA) of the static deflection in the middle."""
    tons = on_two(masses=(PointMass("m", 0.25, 1e5),))
    span, moment, area = 0.4, math.pi * 0.05**4 / 64.0, math.pi * 0.05**2 / 4.0
    shear = 6.0 * 1.3 / (7.0 + 6.0 * 0.3) * STEEL.shear_modulus * area
    give = 0.5 / HELD + span**3 / (48.0 * STEEL.young_modulus * moment) + span / (4.0 * shear)
    lowest = float(bending(modes(tons)).min(axis=1)[0])
    assert lowest == pytest.approx(math.sqrt(1.0 / (1e5 * give)) / HZ, rel=1e-4)


def test_a_housing_of_no_mass_is_refused() -> None:
    with pytest.raises(InvalidInput, match="needs mass: given 1e-300; allowed: at least 1e-12"):
        RigidHousing("h", ("left",), 0.05, 1e-300, {("y", "y"): 1e8, ("z", "z"): 1e8})


# --- next to rigid -------------------------------------------------------------------------------


@pytest.mark.parametrize("stiffness", [1e13, 1e16, 1e20])
def test_a_rigid_support_is_a_pin(stiffness: float) -> None:
    """Against the exact shaft; motions that do not strain so stiff a spring keep their digits."""
    expected = whirl_frequencies(exact_rotor(on_two(stiffness), 0.0, NO_SEATS), 1)[0] / HZ
    pinned = whirl_frequencies(exact_rotor(on_two(1e19), 0.0, NO_SEATS), 1)[0] / HZ
    assert expected == pytest.approx(pinned, rel=2e-5)
    result = modes(on_two(stiffness))
    off = np.abs(bending(result)[0] / expected - 1.0)
    assert (off < 1e-7).all()
    assert np.nanmax(result.frequency_error) < 3e-7


@pytest.mark.parametrize("damping", [1e9, 1e13])
def test_a_damper_that_holds_is_a_pin(damping: float) -> None:
    """What is_overdamped through it is slower than rounding tells: no growth."""
    own = on_two(HELD, damping)
    expected = whirl_frequencies(exact_rotor(on_two(1e13), 0.0, NO_SEATS), 1)[0] / HZ
    result = modes(own)
    swinging = bending(result)[0][np.abs(result.damping_ratio[0, : len(bending(result)[0])]) < 0.1]
    assert swinging == pytest.approx(expected, rel=1e-5)
    scene = seen(own)
    assert np.isfinite(receptance(scene, 10.0)).all()
    assert scene.warnings == ()


@pytest.mark.parametrize(("stiffness", "damping"), [(1e300, 0.0), (-1e300, 0.0), (1e8, 1e300)])
def test_supports_beyond_sense_are_refused(stiffness: float, damping: float) -> None:
    with pytest.raises(InvalidInput, match=r"out of range: given -?1e\+300 .*; allowed: from"):
        on_two(stiffness, damping)


# --- eigenvalues ---------------------------------------------------------------------------------


@pytest.mark.parametrize("uneven", [1e-16, 1e-13, 1e-11, 1e-8])
def test_nearly_repeated_frequencies_are_two(uneven: float) -> None:
    """At rest either plane is a machine of its own; all are found, none twice."""
    other = HELD * (1.0 + uneven)
    held = tuple(support(n, x, (HELD, other)) for n, x in (("left", 0.05), ("right", 0.45)))
    result = modes(on_two(supports=held))
    each = [np.sort(bending(modes(on_two(k)))[0])[::2] for k in (HELD, other)]
    assert np.sort(bending(result)[0]) == pytest.approx(np.sort(np.concatenate(each)), rel=1e-11)


@pytest.mark.parametrize("uneven", [1e-15, 1e-9])
@pytest.mark.parametrize("spin", [1e-6, 500.0])
def test_planes_nearly_alike_whirl_as_all_dof_do(uneven: float, spin: float) -> None:
    """One dense solve of the elements without reduction, planes side by side."""
    held = tuple(
        support(n, x, (HELD, HELD * (1.0 + uneven))) for n, x in (("left", 0.05), ("right", 0.45))
    )
    spindle = on_two(supports=held)
    poles = np.sort(dense_poles(spindle, spin, 2000.0, 1e-6).imag[:6])
    result = modes(spindle, (spin,), accuracy=1e-6)
    assert np.sort(bending(result)[0]) * HZ == pytest.approx(poles, rel=1e-7)
    assert np.abs(result.damping_ratio).max() < 1e-7


# --- speed and sign ------------------------------------------------------------------------------


@pytest.mark.parametrize("speeds", [(0.0,), (500.0,), (0.0, 5e-324), (500.0, 500.0 * (1 + 3e-16))])
def test_one_speed_or_two_that_hardly_differ(speeds: tuple[float, ...]) -> None:
    """Every question is answered as at that speed among others."""
    result, usual = modes(on_two(), speeds), modes(on_two(), (0.0, 500.0))
    expected = bending(usual)[0 if speeds[0] == 0.0 else 1]
    assert np.sort(bending(result)) == pytest.approx(np.tile(np.sort(expected), (len(speeds), 1)))
    spec = UnbalanceSpec(("tip",), (Unbalance("tip", 1e-6),))
    found = unbalance.solve(seen(on_two(), speeds), spec)
    assert np.isfinite(found.amplitude).all()
    assert not any(found.outcome)


def test_a_million_rpm_by_the_exact_shaft() -> None:
    spin = 1e6 * RPM
    exact = exact_rotor(on_two(), spin, NO_SEATS)
    truth = [whirl_frequencies(exact, 4, side) / HZ for side in (-1, 1)]
    result = modes(on_two(), (0.0, spin), 3000.0)
    for side, expected in zip((-1, 1), truth, strict=True):
        own = np.sort(result.frequency[1, result.whirl[1] == side])
        inside = expected[expected < 3000.0]
        assert len(inside)
        assert own[: len(inside)] == pytest.approx(inside, rel=1e-4)


@pytest.mark.parametrize("damping", [-1e-3, -30.0, -3e3])
def test_negative_damping_grows_in_closed_form(damping: float) -> None:
    """A rigid rotor bounces by m λ² + 2c λ + 2k = 0; it has no steady response to unbalance."""
    own = seen(on_two(HELD, damping), rotor="rigid")
    result = campbell.solve(own, CampbellSpec(2000.0, shapes=False))
    mass = STEEL.density * math.pi / 4.0 * 0.05**2 * 0.5
    pole = np.roots([mass, 2.0 * damping, 2.0 * HELD])[0]
    at = np.abs(result.frequency[0] - abs(pole.imag) / HZ).argmin()
    assert result.frequency[0, at] == pytest.approx(abs(pole.imag) / HZ, rel=1e-9)
    assert result.damping_ratio[0, at] == pytest.approx(-pole.real / abs(pole), rel=1e-6)
    if damping < -1.0:
        assert result.stability_threshold == 0.0
        (sentence,) = own.warnings
        assert "unstable at 2 of 2 speeds" in sentence


# --- loads ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("size", [0.0, 5e-324, 1e-310, 1e-300, 1e-30, 1e3])
def test_unbalance_of_any_size_is_a_multiple(size: float) -> None:
    def amplitude(amount: float) -> Any:
        spec = UnbalanceSpec(("tip",), (Unbalance("tip", amount),))
        return unbalance.solve(seen(on_two()), spec).amplitude

    assert amplitude(size) == pytest.approx(amplitude(1.0) * size, rel=1e-9, abs=1e-320)


@pytest.mark.parametrize("size", [5e-324, 1e-310, 1e-300, 1e-30, 1e7])
def test_static_loads_of_any_size_are_a_multiple(size: float) -> None:
    def answered(force: float) -> Any:
        spec = SectionForcesSpec(loads=(PointLoad("tip", Fy=force),))
        return section_forces(seen(on_two(), (0.0,)), spec)

    found, unit = answered(size), answered(1.0)
    for name in ("shear_force_y", "bending_moment_z", "deflection_y", "reaction"):
        value, expected = getattr(found, name), getattr(unit, name) * size
        assert value == pytest.approx(expected, rel=1e-9, abs=1e-9 * size + 2e-322), name
    assert np.isfinite(found.von_mises_stress).all()
