"""The exact shaft and the shaft of elements: these converge to it, every mode is there once."""

from __future__ import annotations

import math
from dataclasses import fields, replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.optimize import linear_sum_assignment

from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.frf import solve as frf
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.equation.mesh import Mesh, station_mesh
from rotordyn.errors import InvalidInput
from rotordyn.machine.drawbar import Drawbar
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.exact_shaft.bending import (
    exact_modes,
    exact_poles,
    exact_receptance,
    exact_rotors,
    signed_poles,
)
from tests.oracles.exact_shaft.box import Box, poles_inside
from tests.oracles.exact_shaft.count import modes_below
from tests.oracles.exact_shaft.rotor import exact_rotor
from tests.oracles.exact_shaft.shooting import Shooting
from tests.oracles.exact_shaft.spectrum import modes_inside
from tests.oracles.full_rotor import FullRotor
from tests.oracles.rotors import STEPPED, support, uniform
from tests.oracles.spindles import mfw2310, pairs, scene, undamped, with_sleeve
from tests.oracles.spinning_beam import PinnedBeam
from tests.oracles.stepped_rotors import stepped_rotor

HZ = 2.0 * math.pi
NO_SEATS = np.zeros((0, 5, 5))
SPEEDS = (0.0, 24000.0)
FREQUENCY = np.linspace(50.0, 4000.0, 30)
PAIRS = ("Oc2.y/Oc2.y", "Oc2.z/Oc2.y", "Oc1.thy/Oc2.thz", "O3.thz/Oc1.y")
UNEVEN = LinearSupport(
    "uneven",
    0.2,
    {("y", "y"): 2e8, ("z", "z"): 5e7, ("y", "z"): 3e7, ("z", "y"): -3e7, ("thz", "thz"): 1e4},
    {("y", "y"): 500.0},
)
HELD = replace(STEPPED, supports=(support("a", 0.05, (2e8, 2e8)), support("b", 0.25, (1e8, 1e8))))
# Beyond 1 MN, where no shaft holds, axial force reaches modes far above the cutoff.
STRONG = Drawbar(3e5, -0.0524, 0.38, (0.15, 0.3))


def flagship(**changes: Any) -> Spindle:
    """Without modal damping of the rotor."""
    return mfw2310(rotor_damping=(), **changes)


def sprung(spindle: Spindle) -> Spindle:
    """Both sleeves on radial springs, with masses."""
    soft = with_sleeve(spindle, "front", radial_stiffness=3e8, mass=0.8)
    return with_sleeve(soft, "rear", radial_stiffness=2e8, mass=1.2)


MACHINES = {
    "plain": flagship(),
    "uneven": flagship(supports=(UNEVEN,)),
    "sprung sleeves": sprung(flagship()),
    "drawbar": flagship(drawbar=STRONG),
    "all of it": sprung(flagship(supports=(UNEVEN,), drawbar=STRONG)),
}
*PARTLY, WHOLE = MACHINES


# --- elements converge to it -------------------------------------------------------------------


def divided(mesh: Mesh, parts: int) -> Mesh:
    """Every element cut into equal ones."""
    share = np.arange(parts) / parts
    x = np.append((mesh.x[:-1, None] + mesh.length[:, None] * share).ravel(), mesh.x[-1])
    rest = {f.name: np.repeat(getattr(mesh, f.name), parts, axis=-1) for f in fields(Mesh)[1:-1]}
    return Mesh(x, **rest)


@cache
def in_elements(parts: int) -> list[tuple[np.ndarray, np.ndarray]]:
    """Poles and receptances of the flagship at every speed, all DOF."""
    found = scene(MACHINES["plain"], SPEEDS)
    mesh, answers = divided(station_mesh(found.spindle), parts), []
    for row in range(len(SPEEDS)):
        force = found.shaft_force.bending(mesh.middle)[row]
        tangents = found.seat_stiffness[row]
        rotor = FullRotor(found.spindle, mesh, tangents, found.speed[row], axial_force=force)
        points = found.spindle.points
        ends = []
        for response, excitation in pairs(*PAIRS):
            ports = (response, excitation)
            ends.append(tuple(rotor.row(points[p.point], p.direction) for p in ports))
        answers.append((rotor.poles(3500.0), rotor.receptance(ends, FREQUENCY)))
    return answers


@pytest.mark.long
def test_elements_converge_to_it_with_order_two() -> None:
    """Halving every element leaves a quarter of the error, in every pole and receptance."""
    found = scene(MACHINES["plain"], SPEEDS)
    receptance = exact_receptance(found, pairs(*PAIRS), FREQUENCY)
    for row, pole in enumerate(exact_poles(found, 3600.0)):
        check_order_two(row, receptance[row], pole)


def check_order_two(row: int, exact_h: np.ndarray, pole: np.ndarray) -> None:
    exact = pole[np.isfinite(pole)]
    exact = np.where(exact.imag < 0.0, exact.conj(), exact)
    errors, errors_h = [], []
    for parts in (2, 4, 8):
        poles, receptance = in_elements(parts)[row]
        nearest = np.abs(poles[:, None] - exact).argmin(axis=1)
        assert len(poles) >= 8
        errors.append(np.abs(poles - exact[nearest]) / np.abs(poles))
        size = np.abs(exact_h).max(axis=1)
        errors_h.append(np.abs(receptance - exact_h).max(axis=1)[size > 0] / size[size > 0])
    for coarse, fine, much in ((*errors[:2], 1e-3), (*errors[1:], 2.5e-4)):
        assert coarse.max() < much
        assert coarse / fine == pytest.approx(4.0, rel=0.08)
    assert errors_h[1] / errors_h[2] == pytest.approx(4.0, rel=0.1)


@pytest.mark.parametrize("name", [*PARTLY, pytest.param(WHOLE, marks=pytest.mark.long)])
def test_fine_elements_agree(name: str) -> None:
    """Poles, how many there are, and receptances, whatever couples planes, sleeves and bar."""
    ports = tuple(MACHINES[name].points.values())
    own = scene(MACHINES[name], SPEEDS, 3500.0, ports, element_length=0.003)
    result = campbell.solve(own, CampbellSpec(3500.0, shapes=False))
    bends = [kind == "bending" for kind in result.kind]
    for row, exact in enumerate(exact_poles(own, 3600.0)):
        ratio, turning = result.damping_ratio[row, bends], HZ * result.frequency[row, bends]
        found = turning * (1j - ratio / np.sqrt(1.0 - ratio**2))
        found = found[turning < HZ * 3500.0]
        truth = exact[np.isfinite(exact)].real + 1j * np.abs(exact[np.isfinite(exact)].imag)
        gap = np.abs(truth[:, None] - found) / np.abs(found)
        assert len(found) == (truth.imag < HZ * 3500.0).sum() >= 7
        assert gap[linear_sum_assignment(gap)].max() < 1e-4
    plain_h = frf.solve(own, FrfSpec(tuple(FREQUENCY), pairs(*PAIRS))).receptance
    exact_h = exact_receptance(own, pairs(*PAIRS), FREQUENCY)
    size = np.abs(exact_h).max(axis=(0, 2))
    assert (np.abs(plain_h - exact_h).max(axis=(0, 2)) <= 0.01 * size).all()


def test_shapes_are_those_of_the_elements() -> None:
    """Parallel to those of the poles nearest, in both planes."""
    own = scene(MACHINES["uneven"], SPEEDS, 3500.0, element_length=0.003)
    result = campbell.solve(own, CampbellSpec(3500.0))
    poles, shapes = exact_modes(own, 3500.0, result.node)
    for row, (pole, shape) in enumerate(zip(poles, shapes, strict=True)):
        forward, backward = shape[..., 0], shape[..., 2]
        planes = (forward + backward) / 2.0, (forward - backward) / 2.0j
        for k in (k for k, kind in enumerate(result.kind) if kind == "bending"):
            frequency = HZ * result.frequency[row, k]
            if not frequency < HZ * 3500.0:
                continue
            nearest = int(np.nanargmin(np.abs(pole.imag - frequency)))
            truth = np.concatenate([plane[nearest] for plane in planes])
            seen = np.concatenate([result.shape[row, k, :, way] for way in (1, 2)])
            share = abs(np.vdot(truth, seen)) ** 2
            assert share > (1.0 - 1e-6) * (np.linalg.norm(truth) * np.linalg.norm(seen)) ** 2


# --- closed forms under axial force ------------------------------------------------------------


@pytest.mark.parametrize("spin", [0.0, 1500.0])
@pytest.mark.parametrize("share", [-0.9, -0.3, 0.0, 2.0])
@pytest.mark.parametrize(("length", "diameter"), [(20.0, 0.05), (1.0, 0.05), (0.5, 0.1)])
def test_pinned_beam_under_axial_force(
    length: float, diameter: float, share: float, spin: float
) -> None:
    """Timoshenko's with spin; slender ones at rest f = f0 √(1 + N L²/(π² EI))."""
    plain = PinnedBeam(length, diameter)
    tension = share * math.pi**2 * plain.bending / length**2
    if share < 0.0:  # shear lowers the force that buckles
        tension /= 1.0 + math.pi**2 * plain.bending / (length**2 * plain.shear)
    beam = replace(plain, tension=tension)
    ends = [support("a", 0.0, (1e19, 1e19)), support("b", length, (1e19, 1e19))]
    spindle = uniform(length, diameter, supports=ends)
    rotor = exact_rotor(spindle, spin, NO_SEATS, axial_force=np.array([tension]))
    for direction, side in ((1, 1), (-1, 0)):
        for mode in range(1, 5):
            omega = direction * beam.bending_whirl(mode, spin)[side]
            around = [modes_below(rotor, omega * (1.0 + s * 1e-8)) for s in (-1, 1)]
            assert around == [mode - 1, mode]
    if length == 20.0 and spin == 0.0:
        slender = plain.bending_whirl(1, 0.0)[1] * math.sqrt(1.0 + share)
        assert beam.bending_whirl(1, 0.0)[1] == pytest.approx(slender, rel=1e-4)


def test_without_axial_force_nothing_changes() -> None:
    mesh = station_mesh(HELD)
    bare = exact_rotor(HELD, 800.0, NO_SEATS, mesh)
    nought = exact_rotor(HELD, 800.0, NO_SEATS, mesh, np.zeros(mesh.nodes - 1))
    omega = np.array([3000.0, -900.0 + 20.0j])
    first, second = (Shooting.of(r).matrix(omega) for r in (bare, nought))
    np.testing.assert_array_equal(first, second)


def test_more_compression_than_shear_stiffness_is_refused() -> None:
    spindle = uniform(1.0, 0.05, supports=[support("a", 0.0, (1e8, 1e8))])
    with pytest.raises(InvalidInput, match="overcomes the shear stiffness"):
        exact_rotor(spindle, 0.0, NO_SEATS, axial_force=np.array([-1e12]))


# --- every pole and no other -------------------------------------------------------------------


def rough_elements(spindle: Spindle) -> Conditions:
    return Conditions(element_length=spindle.shaft.end / 100.0)


def random_scene(seed: int, isotropic: bool, damped: bool) -> tuple[Scene, float]:
    """In elements of high degree, and the highest frequency of interest [Hz]."""
    rng = np.random.default_rng(seed)
    spindle = stepped_rotor(rng, isotropic=isotropic, damped=damped)
    rough = signed_poles(Scene(spindle, rough_elements(spindle), np.zeros(1), 1e6), 0).imag
    lowest = np.sort(np.abs(rough[np.abs(rough) > 1e-3]))[::2] / HZ
    highest = 1.6 * float(lowest[min(7, len(lowest) - 1)])
    speed = np.array([rng.uniform(0.0, 5.0) * HZ * lowest[0]])
    return Scene(spindle, Conditions(accuracy=1e-6), speed, highest), highest


def vibrations(pole: np.ndarray, isotropic: bool, highest: float) -> np.ndarray:
    """Poles of the band, one of each pair."""
    turning = np.abs(pole.imag) if isotropic else pole.imag
    band = (turning > 2e-4 * HZ * highest) & (turning < HZ * highest)
    return pole[band & (np.abs(pole.real) < HZ * highest)]


@pytest.mark.few(4)
@pytest.mark.parametrize("damped", [False, True], ids=["undamped", "damped"])
@pytest.mark.parametrize("isotropic", [True, False], ids=["isotropic", "anisotropic"])
@pytest.mark.parametrize("seed", range(3))
def test_random_rotors(seed: int, isotropic: bool, damped: bool) -> None:
    """Every pole of fine elements is found, and every pole found is one of theirs."""
    fine, highest = random_scene(seed, isotropic, damped)
    theirs, ours = signed_poles(fine, 0), exact_poles(fine, highest)[0]
    for one, other in ((ours, theirs), (theirs, ours)):
        sought = vibrations(one, isotropic, highest * 0.99)
        assert len(sought) >= 3
        for pole in sought:
            assert np.abs(other - pole).min() < 2e-5 * abs(pole)
    distinct = np.sort_complex(ours)
    assert (np.abs(np.diff(distinct)) > 0.0).all()


@pytest.mark.few(1)
@pytest.mark.parametrize(("seed", "damped"), [(0, True), (1, False), (1, True)])
def test_starts_only_save_time(seed: int, damped: bool) -> None:
    """Without any, and with all of them at one place, the same modes are found."""
    rng = np.random.default_rng(100 + seed)
    spindle = stepped_rotor(rng, isotropic=bool(seed % 2), damped=damped)
    rough = signed_poles(Scene(spindle, rough_elements(spindle), np.zeros(1), 1e6), 0)
    omega = np.sort(np.abs(rough.imag))
    band = float(omega[omega > 1e-3][min(9, len(omega) // 2)])
    rotor = exact_rotor(spindle, 0.3 * band, NO_SEATS).up_to(2.0 * band)
    equations = Shooting.of(rotor)
    box = Box(complex(1e-4 * band, -band), complex(1.3 * band, band))
    starts = (-1j * rough, np.zeros(0), np.full(5, 0.7 * band))
    found = [modes_inside(equations, box, np.asarray(s, dtype=complex)) for s in starts]
    values = [np.sort_complex(np.array([m.omega for m in modes])) for modes in found]
    assert len(values[0]) == poles_inside(equations, box)
    assert values[1] == pytest.approx(values[0], rel=1e-9)
    assert values[2] == pytest.approx(values[0], rel=1e-9)


def test_both_counts_agree() -> None:
    """Signs of the dynamic stiffness and turns of the determinant, sleeves and bar included."""
    for name in ("plain", "sprung sleeves", "drawbar"):
        own = exact_rotors(scene(undamped(MACHINES[name]), (0.0,)))[0]
        own = replace(own, spin=2500.0)
        fine = own.up_to(HZ * 4000.0)
        for low, high in ((100.0, 20000.0), (-20000.0, -100.0)):
            box = Box(complex(low, -5000.0), complex(high, 5000.0))
            by_sign = abs(modes_below(own, high) - modes_below(own, low))
            assert by_sign == poles_inside(Shooting.of(fine), box) >= 4


def test_modes_that_coincide_have_their_own_vectors() -> None:
    """A round rotor told to have two planes: at rest every root is double."""
    nearly = LinearSupport("c", 0.1, {("y", "y"): 1.0, ("z", "z"): 1.0 + 1e-8})
    rotor = exact_rotor(replace(HELD, supports=(*HELD.supports, nearly)), 0.0, NO_SEATS)
    assert rotor.planes == 2
    one = exact_rotor(HELD, 0.0, NO_SEATS)
    equations = Shooting.of(rotor.up_to(30000.0))
    box = Box(complex(100.0, -5000.0), complex(20000.0, 5000.0))
    found = modes_inside(equations, box, np.zeros(0, dtype=complex))
    assert len(found) == 2 * (modes_below(one, 20000.0) - modes_below(one, 100.0)) >= 4
    for first, second in zip(found[::2], found[1::2], strict=True):
        assert first.omega == pytest.approx(second.omega, rel=1e-7)
        share = abs(np.vdot(first.unknowns, second.unknowns)) ** 2
        share /= np.vdot(first.unknowns, first.unknowns).real
        assert share / np.vdot(second.unknowns, second.unknowns).real < 0.9


# --- receptances -------------------------------------------------------------------------------


def test_reciprocity_at_rest() -> None:
    """All matrices are symmetric there: response and excitation may change places."""
    even = replace(UNEVEN, stiffness={**UNEVEN.stiffness, ("z", "y"): 3e7})
    found = scene(flagship(supports=(even,)), (0.0,))
    there = pairs("Oc2.y/O3.thz", "Oc2.z/Oc1.y", "O1.thy/Oc2.thz")
    back = tuple((excitation, response) for response, excitation in there)
    h = exact_receptance(found, there + back, FREQUENCY)[0]
    np.testing.assert_allclose(h[:3], h[3:], rtol=1e-8)


@pytest.mark.parametrize("name", ["plain", "uneven"])
def test_static_limit_is_the_flexibility(name: str) -> None:
    """Elements of any length are exact there, without axial force."""
    found = scene(MACHINES[name], SPEEDS, axial_stiffening=False)
    h = exact_receptance(found, pairs(*PAIRS), np.array([1e-4]))[..., 0]
    mesh = station_mesh(found.spindle)
    for row in range(len(SPEEDS)):
        full = FullRotor(found.spindle, mesh, found.seat_stiffness[row], found.speed[row])
        flexibility = np.linalg.inv(full.stiffness)
        for k, (response, excitation) in enumerate(pairs(*PAIRS)):
            points = found.spindle.points
            i = full.row(points[response.point], response.direction)
            j = full.row(points[excitation.point], excitation.direction)
            scale = math.sqrt(flexibility[i, i] * flexibility[j, j])
            assert h[row, k].real == pytest.approx(flexibility[i, j], rel=1e-7, abs=1e-8 * scale)


def test_weight_varies_along_the_shaft() -> None:
    """A hanging shaft: fine elements, each with its mean force, and pieces of the same mesh."""
    own = scene(MACHINES["plain"], (0.0,), gravity="-x", element_length=0.003)
    found = campbell.solve(own, CampbellSpec(2000.0, shapes=False))
    frequency = np.sort(found.frequency[0, [kind == "bending" for kind in found.kind]])
    inside = frequency[frequency < 2000.0]
    exact = np.sort(np.abs(exact_poles(own, 2000.0)[0].imag)) / HZ
    assert inside == pytest.approx(exact[: len(inside)], rel=2e-5)


# --- what it cannot be -------------------------------------------------------------------------


def test_modal_damping_and_coupled_motions_are_refused() -> None:
    with pytest.raises(InvalidInput, match="no modes to damp one by one"):
        exact_rotors(scene(mfw2310(), (0.0,)))
    joined = flagship(supports=(LinearSupport("s", 0.2, {("x", "y"): 1e7}),))
    with pytest.raises(InvalidInput, match="couples bending"):
        exact_rotors(scene(joined, (0.0,)))
