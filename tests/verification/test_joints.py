"""Joints in the shaft: closed forms, two shafts tied by springs, limits."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import block_diag
from scipy.optimize import brentq, newton

import rotordyn
from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.frf import solve as frf
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.stiffness import solve as stiffness
from rotordyn.analyses.stiffness.spec import StiffnessSpec
from rotordyn.equation.mesh import build_mesh
from rotordyn.errors import InvalidInput
from rotordyn.machine.joint import Joint
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.numerics.modes import modes
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.dense_rotor.assemble import rotor_matrices
from tests.oracles.dense_rotor.selection import ALL
from tests.oracles.rotors import STEEL, STEPPED, support, uniform
from tests.oracles.spindles import RPM, all_poles, case, mfw2310, pairs, system_of

PARTED = Joint("cone", 0.05, radial=4e8, tilt=2e5, axial=9e8, torsion=6e4)
HELD = (support("a", 0.08, (6e7, 4e7), 1e3), support("b", 0.2, (4e7, 4e7), 1e3))


def scene(spindle: Spindle, rpm: tuple[float, ...], highest: float, **given: object) -> Scene:
    ports = tuple(spindle.points.values())
    return Scene(spindle, Conditions(**given), np.array(rpm) * RPM, highest, ports)  # type: ignore[arg-type]


def hinged(spring: float) -> Spindle:
    ends = tuple(support(name, x, (1e11, 1e11)) for name, x in (("left", 0.0), ("right", 2.0)))
    rotor = uniform(2.0, 0.01, supports=ends)
    return replace(rotor, joints=(Joint("hinge", 1.0, tilt=spring),))


@pytest.mark.parametrize("spring", [1.0, 50.0, 500.0])
def test_a_slender_beam_with_a_hinge(spring: float) -> None:
    """Pinned ends, spring k in the middle: EI β (tanh βl cos βl − sin βl) + 4 k cos βl = 0 of the
    symmetric modes, l half the length; the others, sin βl = 0, do not feel it."""
    rigidity, mass, half = 2.1e11 * math.pi * 0.01**4 / 64, 7800 * math.pi * 0.01**2 / 4, 1.0

    def closed(b: float) -> float:
        c, s, t = math.cos(b * half), math.sin(b * half), math.tanh(b * half)
        return rigidity * b * (t * c - s) + 2.0 * 2.0 * spring * c

    found = campbell.solve(scene(hinged(spring), (0.0,), 200.0), CampbellSpec(max_frequency=100.0))
    bent = found.frequency[0, [k for k, kind in enumerate(found.kind) if kind == "bending"]][::2]
    grid = np.linspace(0.05, 8.0, 400)
    crossed = [(a, b) for a, b in pairwise(grid) if closed(a) * closed(b) < 0.0]
    betas = [brentq(closed, a, b, xtol=1e-12) for a, b in crossed] + [math.pi, 2 * math.pi]
    exact = np.sort(np.array(betas)) ** 2 * math.sqrt(rigidity / mass) / (2 * math.pi)
    exact = exact[exact < 100.0]
    assert len(bent) == len(exact) >= 4
    assert bent == pytest.approx(exact, rel=1e-3)


def parts() -> tuple[Spindle, Spindle]:
    """STEPPED cut at its joint."""
    shaft = STEPPED.shaft
    x = PARTED.x
    front = Shaft(shaft.start, (shaft.sections[0], replace(shaft.sections[1], length=0.05)))
    rear = Shaft(x, (replace(shaft.sections[1], length=0.05), *shaft.sections[2:]))
    masses = [m for m in STEPPED.masses if m.x > x]
    return (
        replace(STEPPED, shaft=front, masses=(), points={}),
        replace(STEPPED, shaft=rear, masses=tuple(masses), points={}),
    )


def tied(rpm: float, length: float, dampers: tuple[float, ...] = (0.0,) * 6) -> np.ndarray:
    """Poles of both parts, all DOF of every node, tied by the springs and by ``dampers`` that
    turn with the shaft: c(ẏ + Ωz), c(ż − Ωy), and as much of the tilts."""
    halves = [(part, build_mesh(part, length)) for part in parts()]
    free = [rotor_matrices(part, mesh, ALL) for part, mesh in halves]
    mass, gyroscopic, stiff = (
        block_diag(*(getattr(f, name) for f in free))
        for name in ("mass", "gyroscopic", "stiffness")
    )
    behind = 6 * halves[0][1].nodes
    front = behind - 6 + np.arange(6)
    springs = np.diag([9e8, 4e8, 4e8, 6e4, 2e5, 2e5])
    both = np.concatenate([front, behind + np.arange(6)])
    stiff[np.ix_(both, both)] += np.block([[springs, -springs], [-springs, springs]])
    damping = rpm * RPM * gyroscopic
    turned = np.zeros((6, 6))
    for one, other in ((1, 2), (4, 5)):
        turned[one, other], turned[other, one] = (
            rpm * RPM * dampers[one],
            -rpm * RPM * dampers[one],
        )
    for matrix, block in ((damping, np.diag(dampers)), (stiff, turned)):
        matrix[np.ix_(both, both)] += np.block([[block, -block], [-block, block]])
    for held in HELD:
        at = behind + 6 * halves[1][1].node_of(held.x)
        for place, freedom in ((1, "y"), (2, "z")):
            stiff[at + place, at + place] += held.stiffness[freedom, freedom]
            damping[at + place, at + place] += held.damping[freedom, freedom]
    return _poles(mass, damping, stiff)


def _poles(mass: np.ndarray, damping: np.ndarray, stiff: np.ndarray) -> np.ndarray:
    n = len(mass)
    inverse = np.linalg.inv(mass)
    companion = np.block([[np.zeros((n, n)), np.eye(n)], [-inverse @ stiff, -inverse @ damping]])
    return np.linalg.eigvals(companion)


@pytest.mark.parametrize("rpm", [0.0, 20000.0])
def test_two_shafts_tied_by_springs(rpm: float) -> None:
    rotor = replace(STEPPED, joints=(PARTED,), supports=HELD)
    found = scene(rotor, (rpm,), 3000.0, element_length=0.01)
    exact = tied(rpm, 0.01)
    ours = all_poles(found)
    ours = ours[(ours.imag > 100.0) & (ours.imag < 2 * np.pi * 3000.0)]
    exact = exact[(exact.imag > 100.0) & (exact.imag < 2 * np.pi * 3000.0)]
    assert len(ours) == len(exact) >= 6
    for pole in exact:
        assert np.abs(ours / pole - 1.0).min() < 1e-5  # a tenth of the accuracy


@pytest.mark.parametrize("rpm", [0.0, 20000.0])
def test_dampers_of_joints_between_two_shafts(rpm: float) -> None:
    """Poles, and how many there are."""
    dampers = {"radial": 3e3, "tilt": 20.0, "axial": 1e3, "torsion": 1.0}
    joint = replace(PARTED, **{f"{way}_damping": value for way, value in dampers.items()})
    rotor = replace(STEPPED, joints=(joint,), supports=HELD)
    found = scene(rotor, (rpm,), 3000.0, element_length=0.01)
    poles = tied(rpm, 0.01, (1e3, 3e3, 3e3, 1.0, 20.0, 20.0))
    band = 2 * np.pi * 3000.0
    exact = poles[(poles.imag > 100.0) & (poles.imag < band) & (np.abs(poles) < 1.5 * band)]
    result = campbell.solve(found, CampbellSpec(max_frequency=3000.0))
    followed = (result.frequency[0] <= 3000.0) & (np.abs(result.pole[0]) < 1.5 * band)
    assert followed.sum() == len(exact) >= 6
    ours = all_poles(found)
    for pole in exact:  # strongly damped ones have a part in modes far above the band
        strongly = -pole.real > 0.1 * abs(pole)
        assert np.abs(ours / pole - 1.0).min() < (2e-4 if strongly else 1e-5)


def test_the_finer_elements_agree() -> None:
    rotor = replace(STEPPED, joints=(PARTED,), supports=HELD)
    spec = CampbellSpec(max_frequency=3000.0)
    fine, accurate = (
        campbell.solve(scene(rotor, (20000.0,), 3000.0, **given), spec)
        for given in ({"element_length": 0.002}, {"accuracy": 1e-6})
    )
    assert fine.frequency == pytest.approx(accurate.frequency, rel=2e-4)
    coarse = campbell.solve(scene(rotor, (20000.0,), 3000.0, element_length=0.05), spec)
    error = np.abs(coarse.frequency / accurate.frequency - 1.0)[0]
    worst = int(np.argmax(error))
    assert error[worst] > 1e-3
    assert coarse.frequency_error[0, worst] == pytest.approx(error[worst], rel=0.4)


def test_a_stiff_joint_is_none() -> None:
    spec = CampbellSpec(max_frequency=3000.0)
    plain = replace(STEPPED, supports=HELD, points={"cut": 0.05})
    whole, stiff, along = (
        campbell.solve(scene(replace(plain, joints=joints), (0.0, 20000.0), 3000.0), spec)
        for joints in (
            (),
            (Joint("j", 0.05, 1e12, 1e11, 1e12, 1e11),),
            (Joint("j", 0.05, axial=1e8),),
        )
    )
    assert stiff.mode == whole.mode
    assert stiff.frequency == pytest.approx(whole.frequency, rel=2e-4)
    bent = [k for k, kind in enumerate(along.kind) if kind != "axial"]
    same = [k for k, kind in enumerate(whole.kind) if kind != "axial"]
    assert along.frequency[:, bent] == pytest.approx(whole.frequency[:, same], rel=1e-9)


@pytest.mark.parametrize(("way", "motion"), [("axial", "axial"), ("torsion", "torsion")])
def test_two_bodies_on_a_spring(way: str, motion: str) -> None:
    """A soft joint between two stubs: ω² = k (1/m₁ + 1/m₂), to the give of the stubs."""
    sections = (Section(0.03, 0.05, 0.0, STEEL), Section(0.06, 0.08, 0.0, STEEL))
    mass = [7800 * math.pi / 4 * d**2 * h for d, h in ((0.05, 0.03), (0.08, 0.06))]
    inertia = [m * d**2 / 8 for m, d in zip(mass, (0.05, 0.08), strict=True)]
    spring, bodies = (1e5, mass) if way == "axial" else (1e2, inertia)
    damper = 1e-4 * spring
    joint = Joint("j", 0.03, **{way: spring, f"{way}_damping": damper})
    rotor = Spindle(
        "stubs", Shaft(0.0, sections), joints=(joint,), supports=(support("a", 0.0, (1e7, 1e7)),)
    )
    found = scene(rotor, (5000.0,), 500.0)
    pole = system_of(found, motion).pole[0]
    lowest = pole[pole.imag > 1.0][np.argmin(pole[pole.imag > 1.0].imag)]
    together = sum(1.0 / m for m in bodies)
    assert abs(lowest) == pytest.approx(math.sqrt(spring * together), rel=1e-4)
    assert lowest.real == pytest.approx(-damper * together / 2.0, rel=1e-3)


@pytest.mark.parametrize(
    ("way", "spring", "dampers"),
    [("axial", 3e8, (5e3, 5e4, 2e5)), ("torsion", 2e4, (0.5, 5.0, 20.0))],
)
def test_two_free_rods_on_a_damped_spring(
    way: str, spring: float, dampers: tuple[float, ...]
) -> None:
    """Rods of end stiffness K = S β tanh βl, S = E A or G J, β² = ρ s²/E or ρ s²/G, and a spring
    k + c s between them: (k + c s) (K₁ + K₂) + K₁ K₂ = 0; errors are about the reported ones."""
    lengths, diameters = (0.15, 0.35), (0.04, 0.06)
    modulus = STEEL.young_modulus / (1.0 if way == "axial" else 2.0 * (1.0 + STEEL.poisson_ratio))
    size = [math.pi * (d**2 / 4 if way == "axial" else d**4 / 32) for d in diameters]
    parted = Shaft(0.0, tuple(map(lambda h, d: Section(h, d, 0.0, STEEL), lengths, diameters)))

    def rods(s: complex, damper: float) -> complex:
        wave, between = s * math.sqrt(STEEL.density / modulus), spring + damper * s
        one, other = (
            modulus * section * wave * np.tanh(wave * length)
            for section, length in zip(size, lengths, strict=True)
        )
        return complex(between * (one + other) + one * other)

    for damper in dampers:
        joint = Joint("j", lengths[0], **{way: spring, f"{way}_damping": damper})
        spindle = Spindle("rods", parted, joints=(joint,), supports=HELD)
        found = campbell.solve(scene(spindle, (0.0,), 8000.0), CampbellSpec(max_frequency=8000.0))
        ours = [k for k, kind in enumerate(found.kind) if kind == way and found.pole[0, k].imag > 1]
        assert ours
        for k in ours:
            pole = complex(found.pole[0, k])
            exact = newton(partial(rods, damper=damper), pole, tol=1e-12 * abs(pole))
            assert found.frequency_error[0, k] < 1e-4
            told = 2.0 * found.frequency_error[0, k] + 1e-8
            assert abs(pole.imag / exact.imag - 1.0) < told
            told = 2.0 * found.damping_error[0, k] + 1e-8
            assert abs(pole.real / abs(pole) - exact.real / abs(exact)) < told


def test_a_damper_that_turns_drives_forward_whirl_above_its_speed() -> None:
    """A light damper in a joint moves the pole by −c (ω − Ω)/ω |θ|²/2: it changes sign at Ω = ω."""
    even = tuple(replace(s, stiffness={("y", "y"): 4e7, ("z", "z"): 4e7}, damping={}) for s in HELD)
    plain = replace(STEPPED, joints=(PARTED,), supports=even)
    damped = replace(plain, joints=(replace(PARTED, tilt_damping=0.5),))
    rpm = (0.0, 10000.0, 200000.0)
    ours, free = (system_of(scene(each, rpm, 3000.0)).modes.pole for each in (damped, plain))
    for row, one in enumerate(rpm):
        spin = one * RPM
        turning = free[row][np.abs(free[row].imag) < 2 * np.pi * 2000.0]
        for pole in turning[np.abs(turning.imag) > 100.0]:
            moved = ours[row][np.abs(ours[row] - pole).argmin()]
            expected = -np.sign(pole.imag) * np.sign(pole.imag - spin)
            assert np.sign(moved.real) == expected
    uneven = replace(
        damped,
        supports=(replace(even[0], stiffness={("y", "y"): 4e7, ("z", "z"): 4.0000004e7}), even[1]),
    )
    real = scene(uneven, rpm, 3000.0)
    assert not system_of(real).whirling
    for row in range(3):
        for pole in ours[row][np.abs(ours[row].imag) < 2 * np.pi * 1000.0]:
            assert np.abs(system_of(real).modes.pole[row] - pole).min() < 1e-5 * max(abs(pole), 1e3)


def test_radial_stiffness_is_the_receptance_at_rest() -> None:
    joint = Joint("HSK", 0.0, radial=8e8, tilt=4e6)
    spindle = mfw2310(joints=(joint,), rotor_damping=())
    conditions = replace(case().conditions, axial_stiffening=False)
    found = Scene(
        spindle, conditions, np.array([0.0, 24000.0]) * RPM, 500.0, tuple(spindle.points.values())
    )
    spec = StiffnessSpec("Oc1", 10.0, steps=1, variants=("full",))
    tangent = stiffness.solve(found, spec).tangent[:, 0]
    curve = frf.solve(found, FrfSpec((0.1, 1.0), pairs("Oc1.y/Oc1.y"))).receptance[:, 0, 0]
    assert 1.0 / np.abs(curve) == pytest.approx(tangent, rel=1e-4)
    stiff = Scene(mfw2310(rotor_damping=()), conditions, found.speed, 500.0)
    assert tangent[0] < 0.9 * stiffness.solve(stiff, spec).tangent[0, 0]


def test_a_point_at_a_joint_is_in_series_with_it_and_said_to_be() -> None:
    """The nose face of a spindle belongs to the tool where that is held by a joint there."""
    conditions = replace(case().conditions, axial_stiffening=False)
    spec = StiffnessSpec("nose", 10.0, steps=1, variants=("full",))
    joint = Joint("HSK", 0.0, radial=8e8)
    compliance, said = [], []
    for joints, x in (((), 0.0), ((joint,), 0.0), ((joint,), 1e-4)):
        spindle = mfw2310(joints=joints, rotor_damping=(), points={"nose": x})
        found = Scene(spindle, conditions, np.array([0.0]), 500.0, (x,))
        compliance.append(1.0 / stiffness.solve(found, spec).tangent[0, 0])
        said.append([each for each in found.notes if "joint HSK" in each])
    bare, series, behind = compliance
    assert series == pytest.approx(bare + 1.0 / 8e8, rel=1e-6)
    assert behind == pytest.approx(bare, rel=1e-2)
    assert [len(each) for each in said] == [0, 1, 0]
    assert said[1][0].startswith("point nose lies at joint HSK and moves with the part in front")


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({}, "joint without flexibility"),
        ({"radial": 1e8, "tilt_damping": 1.0}, "tilt is rigid and has a damper"),
        ({"radial": 0.0}, "stiffness out of range: given 0 N/m"),
    ],
)
def test_joints_that_are_none(given: dict[str, float], words: str) -> None:
    with pytest.raises(InvalidInput, match=words):
        Joint("j", 0.0, **given)


def test_joints_that_give_way_along_are_in_front_of_all_bearings() -> None:
    """Preload states take the shaft as rigid along its axis, unless it carries nothing there."""
    soft = {"radial": 8e8, "axial": 5e6}
    whole = case()
    front, *_, rear = sorted(seat.x for seat in whole.spindle.seats)
    for x, taken in ((0.0, True), (front, False), (rear, True), ((front + rear) / 2.0, False)):
        changes: dict[str, object] = {"spindle.joints": (Joint("j", x, **soft),)}
        if taken:
            rotordyn.vary(whole, changes)
            continue
        with pytest.raises(InvalidInput, match="joint j is flexible along x between bearings"):
            rotordyn.vary(whole, changes)
        rotordyn.vary(whole, changes | {"conditions.rotor": "rigid"})
        rotordyn.vary(whole, changes | {"spindle.joints": (Joint("j", x, radial=8e8),)})


def test_joints_lie_within_the_shaft() -> None:
    with pytest.raises(InvalidInput, match=r"joins no two parts: given 0.27 m"):
        replace(STEPPED, joints=(replace(PARTED, x=0.27),))
    with pytest.raises(InvalidInput, match="is at the same station"):
        replace(STEPPED, joints=(PARTED, replace(PARTED, name="other")))


@pytest.mark.few(2)
@pytest.mark.parametrize("length", [0.1, 0.5, 5.0])
@pytest.mark.parametrize("way", ["radial", "tilt"])
def test_joints_ever_nearer_to_one_another(length: float, way: str) -> None:
    """As if both were one of half the stiffness, by the distance; nearer ones are refused by
    name."""
    shaft = Shaft(0.0, (Section(length, 0.05, 0.0, STEEL),))
    ends = (support("a", 0.0, (1e7, 1e7)), support("b", 0.7 * length, (5e7, 5e7)))
    spindle = Spindle("near", shaft, supports=ends)

    def lowest(*joints: Joint) -> float:
        held = replace(spindle, joints=joints)
        found = Scene(held, Conditions(accuracy=1e-8), np.zeros(1), 4000.0)
        pole = found.system(found.with_motions(["bending"])[0]).pole[0].imag
        return float(pole[pole > 1.0].min())

    one = lowest(Joint("one", 0.6 * length, **{way: 5e6}))
    for apart in (1e-3, 1e-4, 1e-5, 1.1e-6):
        joints = (Joint(n, x * length, **{way: 1e7}) for n, x in (("a", 0.6), ("b", 0.6 + apart)))
        assert lowest(*joints) == pytest.approx(one, rel=30.0 * apart + 1e-6)
    for apart in (1.1e-9 / length, 1e-8, 9e-7):
        joints = (Joint(n, x * length, **{way: 1e7}) for n, x in (("a", 0.6), ("b", 0.6 + apart)))
        with pytest.raises(
            InvalidInput, match=r"joints\.b\.x: too short a part of the shaft to joint 'a'"
        ):
            lowest(*joints)
    with pytest.raises(InvalidInput, match=r"joints\.late\.x: joins no two parts"):
        lowest(Joint("late", (1.0 - 1e-8) * length, **{way: 1e7}))


CASE = """
title: stepped shaft with a joint
spindle:
  shaft:
    start: 0 mm
    material: steel_rotor
    sections: [{length: 0.4 m, outer_diameter: 50 mm}]
  supports:
    - {name: front, x: 50 mm, stiffness: {yy: 30 N/um, zz: 30 N/um}}
    - {name: rear, x: 350 mm, stiffness: {yy: 30 N/um, zz: 30 N/um}}
  joints:
    - {name: flange, x: 200 mm, tilt: 0.1 MN m/rad, damping: {tilt: 2 N m s/rad}}
tool:
  material: steel_rotor
  sections: [{length: 80 mm, outer_diameter: 20 mm}]
  joints: [{name: HSK, x: %s, radial: 800 N/um, tilt: 1 MN m/rad}]
speeds: [0 rpm, 6000 rpm]
analyses: {campbell: {max_frequency: 800 Hz}}
"""


def test_joints_of_spindle_and_tool(tmp_path: Path) -> None:
    (tmp_path / "case.yaml").write_text(CASE % "0 mm")
    made = rotordyn.load(tmp_path / "case.yaml")
    assert made.spindle is not None
    assert made.spindle.joints == (
        Joint("flange", 0.2, tilt=1e5, tilt_damping=2.0),
        Joint("HSK", 0.0, radial=8e8, tilt=1e6),
    )
    assert np.isfinite(rotordyn.run(made)["campbell"].frequency.values).all()


def test_a_joint_beside_the_tool_is_refused(tmp_path: Path) -> None:
    (tmp_path / "case.yaml").write_text(CASE % "-80 mm")
    with pytest.raises(
        InvalidInput, match=r"given '-80 mm'; allowed: between -80.00 mm and 400.0 mm"
    ):
        rotordyn.load(tmp_path / "case.yaml")


def test_what_turns_with_the_shaft_does_not_damp_synchronous_whirl() -> None:
    """Internal damping of the shaft and dampers of joints, each once: K + iΩD is Hermitian, so
    forward whirl at the speed of the shaft does no work; the real form has the same poles."""
    ends = tuple(support(s.name, s.x, (4e7, 4e7)) for s in HELD)
    joint = replace(PARTED, radial_damping=3e3, tilt_damping=20.0)
    rotor = replace(
        STEPPED, supports=ends, joints=(joint,), rotor_damping=(0.02,), internal_damping=1.0
    )
    one = system_of(scene(rotor, (9000.0,), 2000.0))
    assert one.whirling
    stiffness, damping = one.modes.stiffness[0], one.modes.damping[0]
    turning = stiffness + 1j * 9000.0 * RPM * damping
    lost = np.abs(turning - turning.conj().T).max()
    assert lost < 1e-9 * np.abs(9000.0 * RPM * damping.real).max()
    real = modes(one.linear.stiffness, one.linear.damping).pole[0]
    uneven = replace(ends[0], stiffness={**ends[0].stiffness, ("z", "z"): 4e7 * (1.0 + 1e-8)})
    other = scene(replace(rotor, supports=(uneven, ends[1])), (9000.0,), 2000.0)
    assert not system_of(other).whirling
    found = system_of(other).modes.pole[0]
    for pole in one.modes.pole[0]:
        for poles in (real, found):
            assert np.abs(poles - pole).min() < 1e-5 * abs(pole)


def test_a_rigid_rotor_notes_that_its_joints_are_rigid() -> None:
    rotor = replace(STEPPED, joints=(PARTED,), supports=HELD)
    own, speeds = Conditions(), np.array([0.0])
    flexible, rigid = (
        Scene(rotor, replace(own, rotor=word), speeds).notes for word in ("flexible", "rigid")
    )
    assert not flexible
    assert rigid == (f"with rotor: rigid the joints of the shaft are rigid as well: {PARTED.name}",)
