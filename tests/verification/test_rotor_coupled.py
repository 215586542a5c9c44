"""Supports that couple bending, axial motion and torsion, against all DOF of every node."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.frf import solve as frf
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.equation.dofs import DIRECTIONS
from rotordyn.machine.inertia import rotor_inertia
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import coupled_motions
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.dense_rotor.selection import ALL
from tests.oracles.full_rotor import FullRotor
from tests.oracles.matrices import definite, definites, held, turn_about_axis
from tests.oracles.rotors import STEPPED, support
from tests.oracles.spindles import (
    RPM,
    case,
    joined_motions,
    mfw2310,
    pairs,
    poles,
    scene,
    standard,
    with_springs,
)

HIGHEST = 2000.0
REDUCED = 1e-5  # relative error by a cut-off of four times the band, where the length is given
EVERY = tuple(f"nose.{a}/tip.{b}" for a, b in product(DIRECTIONS, DIRECTIONS))
DRIVEN = tuple(f"{point}.{a}/{point}.{a}" for point in ("nose", "tip") for a in DIRECTIONS)
FREQUENCY = np.linspace(5.0, HIGHEST, 80)
RANDOM = np.random.default_rng(7).uniform(-1.0, 1.0, (4, 6, 6))


def on(*supports: object) -> Spindle:
    return replace(STEPPED, supports=supports)


def solved(spindle: Spindle, rpm: tuple[float, ...], element: float | None = 0.05) -> Scene:
    ports = tuple(spindle.points.values())
    conditions = Conditions(element_length=element or standard(spindle)["element_length"])
    return Scene(spindle, conditions, np.array(rpm) * RPM, HIGHEST, ports)


def above(found: np.ndarray, highest: float = HIGHEST) -> np.ndarray:
    """Those that oscillate up to ``highest`` [Hz], by imaginary part."""
    found = found[(found.imag > 1.0) & (found.imag < 2.0 * np.pi * highest)]
    return found[np.argsort(found.imag)]


def receptance(found: Scene, names: tuple[str, ...]) -> np.ndarray:
    return frf.solve(found, FrfSpec(tuple(FREQUENCY), pairs(*names))).receptance


def dense(found: Scene, row: int, names: tuple[str, ...]) -> np.ndarray:
    full, points = whole(found, row), found.spindle.points
    ends = [tuple(full.row(points[p.point], p.direction) for p in pair) for pair in pairs(*names)]
    return full.receptance(ends, FREQUENCY)  # type: ignore[arg-type]


def whole(found: Scene, row: int) -> FullRotor:
    tangents = found.seat_stiffness[row]
    force = found.bending_force()
    pressed = None if force is None else force[found.bearing_row[row]]
    return FullRotor(
        found.spindle, found.mesh, tangents, found.speed[row], ALL, axial_force=pressed
    )


def gap(ours: np.ndarray, exact: np.ndarray, driven: np.ndarray) -> float:
    """Largest error of EVERY over the mean peak of its two ends, each driven at itself."""
    peaks = np.abs(driven).max(axis=-1)
    scale = np.sqrt(np.outer(peaks[:6], peaks[6:])).ravel()
    return float((np.abs(ours - exact).max(axis=-1) / scale).max())


def compare(found: Scene, row: int) -> None:
    ours, exact = above(poles(found, row)), whole(found, row).poles(HIGHEST)
    assert len(ours) == len(exact) >= 1  # strong dampers leave few that oscillate
    assert np.abs(ours / exact - 1.0).max() < REDUCED
    curves = receptance(found, EVERY)[row]
    assert gap(curves, dense(found, row, EVERY), dense(found, row, DRIVEN)) < 1e-5


@pytest.mark.long
@settings(max_examples=15)
@given(
    springs=st.tuples(definites(1e6, 1e9), definites(1e6, 1e9)),
    dampers=st.tuples(definites(1e2, 1e4), definites(1e2, 1e4)),
    rpm=st.floats(0.0, 30000.0),
)
def test_random_supports(springs: tuple, dampers: tuple, rpm: float) -> None:
    rotor = on(held("a", 0.03, springs[0], dampers[0]), held("b", 0.2, springs[1], dampers[1]))
    assume(len(coupled_motions(rotor.supports)) == 3)
    compare(solved(rotor, (rpm,)), 0)


def full_supports(*, skew: float = 0.0) -> tuple[object, object]:
    """Two supports with all 36 entries; ``skew``: share of an antisymmetric part."""
    other = skew * (RANDOM[0] - RANDOM[0].T)
    size = np.sqrt(np.diag(definite(RANDOM[0], 1e8)))
    unsymmetric = definite(RANDOM[0], 1e8) + other * np.outer(size, size)
    return (
        held("a", 0.03, unsymmetric, definite(RANDOM[1], 3e3)),
        held("b", 0.2, definite(RANDOM[2], 3e7), definite(RANDOM[3], 1e3)),
    )


@pytest.mark.long
@pytest.mark.parametrize("skew", [0.0, 0.1], ids=["symmetric", "unsymmetric"])
def test_reduced_basis_of_a_fine_mesh(skew: float) -> None:
    found = solved(on(*full_supports(skew=skew)), (0, 20000), None)
    assert len(found.mesh.x) > 50
    (k,) = found.with_motions(("bending",))
    assert found.linear(k).size < 100
    for row in (0, 1):
        compare(found, row)


def test_bearings_beside_a_coupling_support() -> None:
    """The flagship with locked sleeves, bearings as at rest."""
    extra = held("extra", 0.1, definite(RANDOM[0], 3e7), definite(RANDOM[1], 1e3))
    spindle = with_springs(mfw2310(rotor_damping=(), supports=(extra,)), np.inf)
    found = scene(spindle, (0, 24000), 2000.0, bearings="static")
    assert found.outcome == ("", "")
    for row in (0, 1):
        ours, exact = above(poles(found, row)), whole(found, row).poles(HIGHEST)
        assert len(ours) == len(exact) >= 5
        assert np.abs(ours / exact - 1.0).max() < REDUCED


@pytest.mark.parametrize("degrees", [90.0, 180.0, 37.0])
def test_turned_about_the_axis(degrees: float) -> None:
    """The rotor has no preferred direction: poles stay, receptances turn with the supports."""
    turn = turn_about_axis(np.radians(degrees))
    k, c = definite(RANDOM[0], 1e8), definite(RANDOM[1], 3e3)
    first, turned = (
        solved(
            on(
                held("a", 0.03, r @ k @ r.T, r @ c @ r.T),
                held("b", 0.2, 0.3 * r @ k @ r.T, 0.3 * r @ c @ r.T),
            ),
            (0, 20000),
        )
        for r in (np.eye(6), turn)
    )
    for row in (0, 1):
        a, b = above(poles(first, row)), above(poles(turned, row))
        assert b == pytest.approx(a, rel=1e-8)
    h, g = (receptance(s, EVERY).reshape(2, 6, 6, -1) for s in (first, turned))
    expected = np.einsum("ia,sabf,jb->sijf", turn, h, turn)
    assert g == pytest.approx(expected, rel=1e-6, abs=1e-8 * np.abs(expected).max())


def test_couplings_that_cancel_leave_the_motions_apart() -> None:
    """Two supports at one place with opposite coupling: as none, in bending as in both rods."""
    k = definite(RANDOM[0], 1e8)
    between = np.diag([1, -1, -1, -1, -1, -1])
    opposite = between @ k @ between  # axial motion coupled the other way
    spin = np.diag([1, 1, 1, -1, 1, 1])
    rest = [spin @ k @ spin, spin @ opposite @ spin]
    sum_of_all = 0.25 * (k + opposite + rest[0] + rest[1])
    plain = solved(on(held("a", 0.03, sum_of_all), held("b", 0.2, sum_of_all)), (20000,))
    every = [
        held(f"{name}{n}", x, 0.25 * part)
        for name, x in (("a", 0.03), ("b", 0.2))
        for n, part in enumerate((k, opposite, *rest))
    ]
    joined = solved(on(*every), (20000,))
    assert not joined_motions(plain)
    assert len(joined_motions(joined)) == 3
    assert above(poles(joined, 0)) == pytest.approx(above(poles(plain, 0)), rel=1e-9)
    names = ("nose.x/tip.y", "nose.thx/tip.x", "nose.thz/tip.thx")
    across, straight = receptance(joined, names), receptance(joined, ("nose.y/tip.y",))
    assert np.abs(across).max() < 1e-9 * np.abs(straight).max() / 0.1
    assert (receptance(plain, names) == 0.0).all()
    assert receptance(plain, ("nose.y/tip.z",)) == pytest.approx(
        receptance(joined, ("nose.y/tip.z",)), rel=1e-6, abs=1e-15
    )


def test_plane_that_a_turned_coupling_leaves_alone() -> None:
    """x coupled to one radial direction only: the other one bends as if nothing were coupled."""
    even = np.diag([1e8, 1e8, 1e8, 1e6, 1e6, 1e6])
    coupling = np.zeros((6, 6))
    coupling[0, 1] = coupling[1, 0] = 5e7
    turn = turn_about_axis(np.radians(37.0))
    k = turn @ (even + coupling) @ turn.T
    joined = solved(on(held("a", 0.03, k), held("b", 0.2, even)), (0,))
    plain = solved(on(held("a", 0.03, even), held("b", 0.2, even)), (0,))
    assert joined_motions(joined) == {"axial", "bending"}
    (bending,) = plain.with_motions(("bending",))
    alone = above(plain.system(bending).pole[0])[::2]
    ours = above(poles(joined, 0))
    distance = np.abs(ours[:, None] / alone - 1.0).min(axis=0)
    assert distance.max() < 1e-8
    assert np.abs(ours[:, None] / alone - 1.0).min(axis=1).max() > 1e-3


def test_weak_coupling_moves_frequencies_with_its_square() -> None:
    """Perturbation: no first-order effect between motions of different frequencies."""
    k = definite(RANDOM[0], 1e8)
    own = np.zeros((6, 6), dtype=bool)
    own[0, 0] = own[3, 3] = True
    lateral = [1, 2, 4, 5]
    own[np.ix_(lateral, lateral)] = True
    plain = solved(on(*(held(n, x, k * own) for n, x in (("a", 0.03), ("b", 0.2)))), (0,))
    rest = above(poles(plain, 0))
    moved = []
    for share in (0.02, 0.01, 0.005):
        weak = np.where(own, k, share * k)
        found = solved(on(*(held(n, x, weak) for n, x in (("a", 0.03), ("b", 0.2)))), (0,))
        moved.append(np.abs(above(poles(found, 0)) / rest - 1.0))
    assert moved[0].max() < 2e-3
    for coarse, fine in ((moved[0], moved[1]), (moved[1], moved[2])):
        seen = fine > 1e-8
        assert seen.sum() >= 3
        assert (coarse / fine)[seen] == pytest.approx(4.0, rel=0.02)


def test_screw_leaves_bending_in_its_complex_form() -> None:
    """x coupled to spin alone, on a rigid rotor: m ẍ, J θ̈ with a 2×2 matrix, in closed form."""
    ends = [support(n, x, (5e7, 5e7)) for n, x in (("a", 0.03), ("b", 0.2))]
    screw = {("x", "x"): 4e7, ("thx", "thx"): 3e4, ("x", "thx"): 5e5, ("thx", "x"): 5e5}
    ends[0] = replace(ends[0], stiffness={**ends[0].stiffness, **screw})
    found = Scene(on(*ends), Conditions(rotor="rigid"), np.array([0, 20000]) * RPM, HIGHEST)
    answer = campbell.solve(found, CampbellSpec(HIGHEST))
    (bending,), (screw_motion,) = (found.with_motions((m,)) for m in ("bending", "axial"))
    assert found.linear(bending).axisymmetric
    assert found.name_of(screw_motion) == "axial and torsion"
    body = rotor_inertia(found.spindle)
    scale = np.diag([body.mass, body.polar]) ** 0.5
    inverse = np.linalg.inv(scale)
    k = inverse @ np.array([[4e7, 5e5], [5e5, 3e4]]) @ inverse
    expected = np.sqrt(np.linalg.eigvalsh(k)) / (2.0 * np.pi)
    rods = [n for n, kind in enumerate(answer.kind) if kind != "bending"]
    assert np.sort(answer.frequency[1, rods]) == pytest.approx(
        expected[expected < HIGHEST], rel=1e-9
    )
    names = {"bending 1 forward", "bending 1 backward", "bending 2 forward", "bending 2 backward"}
    assert names <= set(answer.mode)


def test_rigid_rotation_along_a_screw_is_no_vibration() -> None:
    """K of rank one between x and spin: one motion is free, the other vibrates."""
    ends = [support(n, x, (5e7, 5e7)) for n, x in (("a", 0.03), ("b", 0.2))]
    lead = 0.01
    row = {"x": 1.0, "thx": lead, "y": 0.3}
    screw = {(a, b): 4e7 * row[a] * row[b] for a, b in product(row, row)}
    ends[0] = replace(ends[0], stiffness={**ends[0].stiffness, **screw, ("y", "y"): 9e7})
    found = Scene(on(*ends), Conditions(rotor="rigid"), np.array([0, 20000]) * RPM, HIGHEST)
    answer = campbell.solve(found, CampbellSpec(HIGHEST))
    assert sorted(answer.kind).count("bending") == 4
    assert len(answer.mode) == 5
    assert found.warnings == ()


def test_veering_modes_are_named_after_what_they_mostly_are() -> None:
    """Friswell's rotor, its torsion held near a bending pair: torsion does not depend on speed."""
    first, second = case("friswell_cross_coupled").spindle.supports
    even = {("y", "y"): 1e6, ("z", "z"): 1e6}
    twist = {("y", "thx"): 3e4, ("thx", "y"): 3e4, ("thx", "thx"): 5e4}
    supports = (
        replace(first, stiffness={**even, **twist}),
        replace(second, stiffness=even),
    )
    rotor = replace(case("friswell_cross_coupled").spindle, supports=supports)
    for step in (100, 400):
        speed = np.arange(0, 4001, step) * RPM
        found = campbell.solve(Scene(rotor, Conditions(), speed, 150.0), CampbellSpec(150.0))
        line = dict(zip(found.mode, found.frequency.T, strict=True))
        assert np.ptp(line["torsion 2"]) < 2.5
        assert np.ptp(line["bending 5"]) > 15.0
        assert found.whirl[-1, found.mode.index("bending 5")] == -1.0
        assert (found.whirl[:, found.mode.index("torsion 2")] == 0.0).all()
