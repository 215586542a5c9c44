"""Axial force and drawbar: closed forms, the full model, and buckling."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import eigh

from bearings.materials import Material
from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.frf import solve as frf
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.preload.spec import PreloadSpec
from rotordyn.analyses.stiffness import solve as stiffness
from rotordyn.analyses.stiffness.spec import StiffnessSpec
from rotordyn.errors import NoSolution
from rotordyn.machine.drawbar import Drawbar
from rotordyn.machine.lumped import Disc
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.full_rotor import FullRotor
from tests.oracles.rotors import support, uniform
from tests.oracles.spindles import answers, mfw2310, pairs, scene, standard

HZ = 2.0 * math.pi
STEEL = Material("steel", 211e9, 211e9 / (2 * 81.2e9) - 1, 7810.0)
LENGTH, DIAMETER = 1.0, 0.012
MOMENT, AREA = math.pi * DIAMETER**4 / 64, math.pi * DIAMETER**2 / 4
EULER = math.pi**2 * STEEL.young_modulus * MOMENT / LENGTH**2
SHEAR = 0.886 * 81.2e9 * AREA
CRITICAL = EULER / (1.0 + EULER / SHEAR)
PINNED = math.pi / (2 * LENGTH**2) * math.sqrt(STEEL.young_modulus * MOMENT / (7810.0 * AREA))


def beam(bar: Drawbar | None = None, radial: float = 1e9) -> Spindle:
    """Slender, on two pins; the rear one holds it along its axis."""
    front = support("front", 0.0, (radial, radial))
    rear = LinearSupport("rear", LENGTH, {("x", "x"): 1e8, ("y", "y"): radial, ("z", "z"): radial})
    return replace(uniform(LENGTH, DIAMETER, STEEL, supports=(front, rear)), drawbar=bar)


def first(spindle: Spindle, highest: float = 400.0, count: int = 1, **changes: Any) -> np.ndarray:
    """Lowest bending frequencies at rest [Hz], double ones once."""
    found = Scene(spindle, Conditions(**changes), np.zeros(1), highest)
    result = campbell.solve(found, CampbellSpec(highest))
    bending = [k == "bending" for k in result.kind]
    return np.sort(result.frequency[0, bending])[::2][:count]


@cache
def unstrung() -> float:
    """Lowest frequency of the beam without a bar."""
    return float(first(beam())[0])


# --- a published rotor, and the slender beam in closed form ------------------------------------


@pytest.mark.parametrize(
    ("tension", "expected"),
    [
        (0.0, [13.792067, 43.658247, 114.080085]),
        (1e4, [13.935788, 43.913150, 114.759565]),
        (1e5, [15.020440, 46.132265, 120.620287]),
        (-1e4, [13.642635, 43.401542, 113.394556]),
    ],
)
def test_two_discs_under_axial_force(tension: float, expected: list[float]) -> None:
    """Friswell and others (2010), example 5.9.7, as an established open code prints it.

    That code has Cowper's shear coefficient; the rear support holds the shaft along its axis, and a
    pull at the front end is a negative force.
    """
    ends = (
        support("left", 0.0, (1e6, 1e6)),
        LinearSupport("right", 1.5, {("x", "x"): 1e8, ("y", "y"): 1e6, ("z", "z"): 1e6}),
    )
    discs = (
        Disc("left", 0.5, 0.28, 0.05, 0.07, STEEL),
        Disc("right", 1.0, 0.35, 0.05, 0.07, STEEL),
    )
    rotor = replace(uniform(1.5, 0.05, STEEL, supports=ends), discs=discs)
    found = first(rotor, 300.0, 3, element_length=0.25, axial_force=-tension)
    assert found == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize("share", [-0.9, -0.5, -0.1, 0.5, 3.0])
def test_pinned_beam(share: float) -> None:
    """f = f0 √(1 + N L²/(π² E I)), shear (2.6e-4 of E I) taken off the buckling force."""
    found = first(beam(), axial_force=-share * CRITICAL)[0]
    assert found / first(beam())[0] == pytest.approx(math.sqrt(1.0 + share), rel=5e-5)
    assert found == pytest.approx(PINNED * math.sqrt(1.0 + share), rel=5e-4)


@pytest.mark.parametrize("share", [-0.5, 0.5, 3.0])
def test_pinned_beam_in_one_element(share: float) -> None:
    """Bent to a parabola: f = f0 √(1 + N L²/(12 E I)). No DOF is truncated."""
    one, pinned = 2.0 * LENGTH, beam(radial=1e12)
    plain = first(pinned, element_length=one)[0]
    found = first(pinned, element_length=one, axial_force=-share * EULER)[0]
    expected = math.sqrt(1.0 + share * math.pi**2 / 12.0)
    assert found / plain == pytest.approx(expected, rel=1e-7)


def test_switched_off() -> None:
    bar = Drawbar(0.5 * EULER, 0.0, LENGTH)
    plain = first(beam())
    found = first(beam(bar), axial_force=30.0, axial_stiffening=False)
    assert found == pytest.approx(plain, rel=1e-7)
    assert first(beam(bar), axial_force=30.0)[0] < 0.9 * plain[0]


# --- the drawbar -------------------------------------------------------------------------------


@pytest.mark.parametrize("share", [0.2, 0.5, 0.9])
def test_bar_between_the_pins_without_guides(share: float) -> None:
    """Its ends do not move: only the compression of the shaft acts, f = f0 √(1 − P/Pcr)."""
    found = first(beam(Drawbar(share * CRITICAL, 0.0, LENGTH)))[0]
    assert found / first(beam())[0] == pytest.approx(math.sqrt(1.0 - share), rel=5e-5)


def test_guided_everywhere_the_bar_does_nothing() -> None:
    bar = Drawbar(50.0 * EULER, 0.0, LENGTH, "everywhere")
    with_bar, plain = (first(beam(b), count=3, accuracy=1e-8) for b in (bar, None))
    assert with_bar == pytest.approx(plain, rel=1e-9)


def test_more_guides_hold_the_shaft_better() -> None:
    """With one guide, a straight string instead of the sine leaves 1 − 8/π² of the softening.

    With more, what is left falls with the square of the distance between guides.
    """
    plain, bar = first(beam())[0], Drawbar(0.6 * EULER, 0.0, LENGTH)
    held = [
        first(beam(replace(bar, guides=tuple(np.linspace(0.0, LENGTH, n + 2)[1:-1].tolist()))))[0]
        for n in (0, 1, 3, 7)
    ]
    assert held == sorted(held)
    assert held[-1] < plain
    light = replace(bar, force=0.02 * EULER, guides=(0.5 * LENGTH,))
    left = 1.0 - (first(beam(light))[0] / plain) ** 2
    assert left == pytest.approx(0.02 * (1.0 - 8.0 / math.pi**2), rel=0.005)
    assert plain - held[2] == pytest.approx(4.0 * (plain - held[3]), rel=0.05)


def test_a_bar_in_a_free_part_of_the_shaft_acts_with_its_ends() -> None:
    """Turning the shaft as a rigid body costs nothing: the bar turns with it."""
    bar = Drawbar(2e4, 0.3, 0.8, (0.5,))
    spindle = replace(uniform(1.0, 0.05), drawbar=bar)
    found = Scene(spindle, Conditions(), np.zeros(1))
    (bending,) = found.with_motions(("bending",))
    own = found.linear(bending)
    work = own.stiffness[0][np.ix_(own.rigid, own.rigid)]
    moved = np.abs(own.motion[:, 1:3, own.rigid]).max()
    assert own.rigid.sum() == 4
    assert np.abs(work).max() < 1e-9 * 2e4 * moved**2


# --- against all DOF ----------------------------------------------------------------------


@pytest.mark.parametrize("share", [0.0, 0.9])
def test_reduced_wire_between_pins(share: float) -> None:
    """Pins a hundred thousand times as stiff as the wire, close to buckling."""
    asked = Conditions(axial_force=share * EULER, **standard(beam()))
    found = Scene(beam(), asked, np.zeros(1), 400.0)
    tangents = np.zeros((0, 5, 5))
    exact = FullRotor(
        found.spindle, found.mesh, tangents, 0.0, axial_force=found.bending_force()[0]
    )
    lowest = math.sqrt(eigh(exact.stiffness, exact.mass, eigvals_only=True)[0]) / HZ
    assert first(beam(), axial_force=share * EULER)[0] == pytest.approx(lowest, rel=1e-6)


STRONG = Drawbar(3e5, -0.0524, 0.38, (0.15, 0.3))  # 430 MPa in the neck behind the tool


def strong(rpm: Sequence[float], **changes: Any) -> Scene:
    spindle = replace(mfw2310(rotor_damping=()), drawbar=STRONG)
    return scene(spindle, rpm, ports=(-0.0524, -0.0721), **changes)


def full(found: Scene, row: int) -> FullRotor:
    return FullRotor(
        found.spindle,
        found.mesh,
        found.seat_stiffness[row],
        found.speed[row],
        axial_force=found.bending_force()[row],
    )


def swinging(found: Scene, row: int) -> np.ndarray:
    """Angular frequencies of bending, ascending."""
    (bending,) = found.with_motions(("bending",))
    imag = found.system(bending).pole[row].imag
    return np.sort(imag[imag > 1.0])


@pytest.mark.parametrize("row", [0, 1], ids=["rest", "24000 rpm"])
def test_reduced_rotor_under_a_strong_bar(row: int) -> None:
    """The bar moves modes; the reduction, whose vectors do not know of it, follows within 1e-5."""
    found = strong((0, 24000))
    ours = swinging(found, row)
    ours = ours[ours < HZ * 4000]
    exact = np.sort(full(found, row).poles(4000.0).imag)
    assert ours == pytest.approx(exact, rel=1e-5)
    plain = Scene(found.spindle, replace(found.conditions, axial_stiffening=False), found.speed)
    before = swinging(plain, row)[: len(ours)]
    assert (ours / before).min() < 1.0 - 1e-4
    frequency = np.linspace(5.0, 4000.0, 60)
    spec = FrfSpec(tuple(frequency), pairs("Oc2.y/Oc2.y", "Oc2.z/Oc2.y"))
    rotor = full(found, row)
    ends = [(rotor.row(-0.0524, f), rotor.row(-0.0524, "y")) for f in ("y", "z")]
    ours_h, exact_h = frf.solve(found, spec).receptance[row], rotor.receptance(ends, frequency)
    assert np.abs(ours_h - exact_h).max() < 5e-4 * np.abs(exact_h).max()


def slender(points: dict[str, float] | None = None) -> Spindle:
    """The flagship's bearings on a bar of 30 mm, which a drawbar within its range can buckle; steps
    and necks of the true shaft yield long before."""
    spindle = mfw2310(points=points) if points else mfw2310()
    sections = tuple(
        replace(s, outer_diameter=0.03, inner_diameter=0.0) for s in spindle.shaft.sections
    )
    return replace(spindle, shaft=replace(spindle.shaft, sections=sections))


@pytest.mark.parametrize("share", [0.5, 0.95])
def test_condensed_rotor_near_buckling(share: float) -> None:
    """Half way to buckling, and close to it, against all DOF: 1e-4 of the axial force, whose
    error the tangent there has over (1 − share)."""
    critical = critical_bar()
    spindle = replace(slender(), drawbar=replace(STRONG, force=share * critical))
    found = scene(spindle, (0, 12000))
    asked = StiffnessSpec("Oc2", 50.0, 1, ("nonlinear", "full"))
    result = stiffness.solve(found, asked)
    for row in (0, 1):
        rotor = full(found, row)
        tip = rotor.row(-0.0524, "y")
        expected = 1.0 / np.linalg.inv(rotor.stiffness)[tip, tip]
        assert result.tangent[row] == pytest.approx([expected] * 2, rel=1e-4 / (1.0 - share))
    plain = stiffness.solve(scene(slender(), (0, 12000)), asked)
    assert (result.tangent < (1.0 - 0.3 * share) * plain.tangent).all()


def critical_bar(rpm: float = 12000.0) -> float:
    """Force of the strong bar at which a direction of the full model loses its stiffness."""
    bar = replace(STRONG, force=1e6)
    found = scene(replace(slender(), drawbar=bar), (rpm,))
    same_mesh = {**mfw2310().points, "guide": 0.15, "other": 0.3, "end": 0.38}
    unloaded = full(scene(slender(same_mesh), (rpm,)), 0).stiffness
    change = unloaded - full(found, 0).stiffness
    sym = [0.5 * (m + m.T) for m in (change, unloaded)]
    largest = eigh(*sym, eigvals_only=True)[-1]
    return bar.force / float(largest)


# --- buckling ----------------------------------------------------------------------------------


def test_bar_that_buckles_the_shaft_is_refused_with_what_it_may_pull() -> None:
    with pytest.raises(NoSolution, match="the drawbar force buckles the shaft at 0 rpm") as caught:
        scene(beam(Drawbar(1.5 * EULER, 0.0, LENGTH)), (0,)).require_solution()
    most = float(str(caught.value).split("at most ")[1].split()[0]) * 1e3
    assert most == pytest.approx(EULER, rel=1e-3)


def test_axial_force_that_buckles_the_shaft_is_refused() -> None:
    with pytest.raises(
        NoSolution, match=r"axial force buckles the shaft at 0 rpm, 0\.5 times that force"
    ):
        first(beam(), axial_force=2.0 * EULER)


def test_spindle_buckles_where_the_full_model_says() -> None:
    critical = critical_bar()
    for share, stands in ((0.999, True), (1.001, False)):
        spindle = replace(slender(), drawbar=replace(STRONG, force=share * critical))
        found = scene(spindle, (0, 12000))
        assert (found.outcome[1] == "") == stands
    most = float(found.outcome[1].split("at most ")[1].split()[0]) * 1e3
    assert most == pytest.approx(critical, rel=1e-3)


def test_buckled_speeds_are_named_and_the_others_delivered() -> None:
    """The bearings soften with speed: a shaft stable at rest buckles at 20 000 rpm."""
    force = 0.5 * (critical_bar(0.0) + critical_bar(20000.0))
    spindle = replace(slender(), drawbar=replace(STRONG, force=force))
    asked = {
        "preload": PreloadSpec(),
        "campbell": CampbellSpec(2000.0),
        "stiffness": StiffnessSpec("Oc2", 50.0, 1, ("full",)),
    }
    found = answers(spindle, (0, 20000), asked)
    for result in found.values():
        assert result.outcome[0] == ""
        assert "the drawbar force buckles the shaft at 20000 rpm" in result.outcome[1]
    assert np.isnan(found["campbell"].frequency[1]).all()
    assert np.isfinite(found["stiffness"].tangent[0]).all()


def test_buckling_between_two_supports() -> None:
    """Even a clamped span that nothing sees from outside."""
    pins = tuple(
        LinearSupport(f"s{k}", x, {(f, f): v for f, v in (("x", 1e9), ("y", 1e9), ("z", 1e9))})
        for k, x in enumerate((0.0, 0.02, 0.98, 1.0))
    )
    clamped = 4.0 * EULER / 0.96**2
    spindle = uniform(LENGTH, DIAMETER, STEEL, supports=pins)
    for share, stands in ((0.9, True), (1.1, False), (9.5, False)):
        bar = Drawbar(share * clamped, 0.02, 0.98)
        found = Scene(replace(spindle, drawbar=bar), Conditions(), np.zeros(1))
        assert (found.outcome[0] == "") == stands, share


# --- rules that hold for any bar ---------------------------------------------------------------


@pytest.mark.long
@settings(max_examples=40)
@given(
    st.floats(0.0, 0.45),
    st.floats(0.55, 1.0),
    st.lists(st.floats(0.46, 0.54), max_size=3, unique_by=lambda x: round(x, 3)),
    st.floats(0.01, 0.9),
)
def test_any_bar_softens_and_none_does_more_than_its_force(
    start: float, end: float, guides: list[float], share: float
) -> None:
    bar = Drawbar(share * EULER, start, end, tuple(sorted(guides)))
    plain, found = unstrung(), first(beam(bar))[0]
    assert plain * math.sqrt(1.0 - share) * (1.0 - 1e-3) <= found <= plain * (1.0 + 1e-9)


@pytest.mark.parametrize("gap", [1e-6, 1e-7, 1e-8, 2e-9])
def test_bar_that_begins_a_hair_beside_the_end_acts_as_at_the_end(gap: float) -> None:
    """Stations that nobody can tell apart make no element that arithmetic cannot hold."""
    guides = (0.46, 0.46875, 0.53125)
    at, beside = (first(beam(Drawbar(0.5 * EULER, x, 0.97, guides)))[0] for x in (0.0, gap))
    assert beside == pytest.approx(at, rel=1e-6)


def test_rigid_rotor_in_tension_resists_tilting() -> None:
    """Two springs k a distance L apart in tension N: the tilting mode gains N/L on k L²/2."""
    tension, k = 2e5, 1e6
    front = support("front", 0.0, (k, k))
    rear = LinearSupport("rear", LENGTH, {("x", "x"): 1e8, ("y", "y"): k, ("z", "z"): k})
    rotor = uniform(LENGTH, 0.05, STEEL, supports=(front, rear))
    plain, pulled = (
        first(rotor, 2000.0, 2, rotor="rigid", axial_force=-n)[1] for n in (0.0, tension)
    )
    expected = math.sqrt(1.0 + tension * LENGTH / (k * LENGTH**2 / 2.0))
    assert pulled / plain == pytest.approx(expected, rel=1e-9)


def test_flagship_moves_by_less_than_a_ten_thousandth() -> None:
    asked = {"campbell": CampbellSpec(4000.0)}
    on, off = (
        answers(mfw2310(), (0, 24000), asked, axial_stiffening=flag)["campbell"].frequency
        for flag in (True, False)
    )
    moved = np.abs(on / off - 1.0)
    assert 1e-6 < moved.max() < 1e-4


@pytest.mark.parametrize("guides", [(), (0.4,)])
def test_a_strong_drawbar_is_no_error_of_the_rotor(guides: tuple[float, ...]) -> None:
    """A string under the load on truncated modes of the pressed shaft: almost no reported error."""
    strung = beam(Drawbar(1.5 * EULER, 0.1, 0.8, guides))
    found = [
        campbell.solve(
            Scene(strung, Conditions(accuracy=accuracy), np.zeros(1), 4.0 * PINNED),
            CampbellSpec(4.0 * PINNED, shapes=False),
        )
        for accuracy in (1e-4, 1e-7)
    ]
    rough, fine = (each.frequency[0, [kind == "bending" for kind in each.kind]] for each in found)
    error = np.abs(rough / fine - 1.0).max()
    assert error < 1e-4
    assert found[0].frequency_error[0].max() < 1e-4
