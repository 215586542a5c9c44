"""A case whose shaft is exact: elements converge to it, no mode is missed, none is invented."""

from __future__ import annotations

import math
from dataclasses import fields, replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from rotordyn.analysis import campbell, frf
from rotordyn.analysis.scene import Scene
from rotordyn.analysis.specs import CampbellSpec, Conditions, FrfSpec
from rotordyn.errors import InvalidInput
from rotordyn.exact.box import Box, poles_inside
from rotordyn.exact.count import modes_below
from rotordyn.exact.rotor import exact_rotor
from rotordyn.exact.shooting import Shooting
from rotordyn.exact.spectrum import modes_inside
from rotordyn.machine.drawbar import Drawbar
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.system.mesh import Mesh, station_mesh
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
STRONG = Drawbar(9e6, -0.0524, 0.38, (0.15, 0.3))


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


# --- elements converge to it -------------------------------------------------------------------


def divided(mesh: Mesh, parts: int) -> Mesh:
    """Every element cut into equal ones."""
    share = np.arange(parts) / parts
    x = np.append((mesh.x[:-1, None] + mesh.length[:, None] * share).ravel(), mesh.x[-1])
    rest = {f.name: np.repeat(getattr(mesh, f.name), parts) for f in fields(Mesh)[1:]}
    return Mesh(x, **rest)


@cache
def in_elements(parts: int) -> list[tuple[np.ndarray, np.ndarray]]:
    """Poles and receptances of the flagship at every speed, all freedoms."""
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


@pytest.mark.parametrize("row", range(len(SPEEDS)), ids=["rest", "24000 rpm"])
def test_elements_converge_to_it_with_order_two(row: int) -> None:
    """Halving every element leaves a quarter of the error, in every pole and receptance."""
    found = scene(MACHINES["plain"], SPEEDS, shaft="exact")
    asked = FrfSpec(tuple(FREQUENCY), pairs(*PAIRS))
    exact_h = frf.answer(found, asked).receptance[row]
    modes = found.exact.modes(found.bending_modes, HZ * 3600.0)
    exact = modes.pole[row][np.isfinite(modes.pole[row])]
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


@pytest.mark.parametrize("name", MACHINES)
def test_fine_elements_agree(name: str) -> None:
    """Names, frequencies, damping and receptances, whatever couples planes, sleeves and bar."""
    spec = FrfSpec(tuple(FREQUENCY), pairs(*PAIRS))
    found = []
    for shaft in ("elements", "exact"):
        ports = tuple(MACHINES[name].points.values())
        own = scene(MACHINES[name], SPEEDS, 3500.0, ports, shaft=shaft, element_length=0.003)
        found.append((campbell.answer(own, CampbellSpec(3500.0)), frf.answer(own, spec)))
    (plain, plain_h), (exact, exact_h) = found
    assert plain.mode == exact.mode
    assert np.nanmax(np.abs(plain.frequency / exact.frequency - 1.0)) < 1e-4
    assert np.nanmax(np.abs(plain.damping_ratio - exact.damping_ratio)) < 1e-5
    np.testing.assert_array_equal(plain.whirl, exact.whirl)
    size = np.abs(exact_h.receptance).max(axis=(0, 2), keepdims=True)
    assert np.abs(plain_h.receptance - exact_h.receptance).max() < 0.02 * size.max()
    for pair in range(len(PAIRS)):
        gap = np.abs(plain_h.receptance - exact_h.receptance)[:, pair].max()
        assert gap <= 0.01 * size[0, pair, 0]


def test_shapes_are_those_of_the_elements() -> None:
    """Scaled to a largest translation of one; in isotropic bearings up to a quarter turn."""
    shapes = []
    for shaft in ("elements", "exact"):
        own = scene(MACHINES["uneven"], SPEEDS, 3500.0, shaft=shaft, element_length=0.003)
        shapes.append(campbell.answer(own, CampbellSpec(3500.0)).shape)
    assert np.abs(shapes[0] - shapes[1]).max() < 1e-3


def test_turning_frame_sees_the_same_poles_shifted() -> None:
    found = [
        campbell.answer(
            scene(MACHINES["plain"], SPEEDS, shaft="exact", formulation=formulation),
            CampbellSpec(3000.0),
        )
        for formulation in ("inertial", "rotating")
    ]
    fixed, turning = (r.frequency[1, [n == "bending 1 forward" for n in r.mode]][0] for r in found)
    assert turning == pytest.approx(abs(fixed - SPEEDS[1] / 60.0), rel=1e-10)


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


def random_scenes(seed: int, isotropic: bool, damped: bool) -> tuple[Scene, Scene, float]:
    """In elements of high degree, and exact; and the highest frequency of interest [Hz]."""
    rng = np.random.default_rng(seed)
    spindle = stepped_rotor(rng, isotropic=isotropic, damped=damped)
    rough = Scene(spindle, rough_elements(spindle), np.zeros(1), 10.0).bending_modes.pole[0].imag
    lowest = np.sort(np.abs(rough[np.abs(rough) > 1e-3]))[::2] / HZ
    highest = 1.6 * float(lowest[min(7, len(lowest) - 1)])
    speed = np.array([rng.uniform(0.0, 5.0) * HZ * lowest[0]])
    fine = Conditions(accuracy=1e-6)
    exact = Conditions(shaft="exact")
    return (*(Scene(spindle, c, speed, highest) for c in (fine, exact)), highest)  # type: ignore[return-value]


def vibrations(pole: np.ndarray, isotropic: bool, highest: float) -> np.ndarray:
    """Poles of the band, one of each pair."""
    turning = np.abs(pole.imag) if isotropic else pole.imag
    band = (turning > 2e-4 * HZ * highest) & (turning < HZ * highest)
    return pole[band & (np.abs(pole.real) < HZ * highest)]


@pytest.mark.parametrize("damped", [False, True], ids=["undamped", "damped"])
@pytest.mark.parametrize("isotropic", [True, False], ids=["isotropic", "anisotropic"])
@pytest.mark.parametrize("seed", range(6))
def test_random_rotors(seed: int, isotropic: bool, damped: bool) -> None:
    """Every pole of fine elements is found, and every pole found is one of theirs."""
    fine, exact, highest = random_scenes(seed, isotropic, damped)
    theirs, start = fine.bending_modes.pole[0], exact.bending_modes
    ours = exact.exact.modes(start, HZ * highest).pole[0]
    for one, other in ((ours, theirs), (theirs, ours)):
        sought = vibrations(one, isotropic, highest * 0.99)
        assert len(sought) >= 3
        for pole in sought:
            assert np.abs(other - pole).min() < 2e-5 * abs(pole)
    distinct = np.sort_complex(ours)
    assert (np.abs(np.diff(distinct)) > 0.0).all()


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("damped", [False, True])
def test_starts_only_save_time(seed: int, damped: bool) -> None:
    """Without any, and with all of them at one place, the same modes are found."""
    rng = np.random.default_rng(100 + seed)
    spindle = stepped_rotor(rng, isotropic=bool(seed % 2), damped=damped)
    rough = Scene(spindle, rough_elements(spindle), np.zeros(1), 10.0).bending_modes.pole[0]
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
        own = scene(undamped(MACHINES[name]), (0.0,), shaft="exact").exact.rotors[0]
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
    found = scene(flagship(supports=(even,)), (0.0,), shaft="exact")
    there = pairs("Oc2.y/O3.thz", "Oc2.z/Oc1.y", "O1.thy/Oc2.thz")
    back = tuple((excitation, response) for response, excitation in there)
    spec = FrfSpec(tuple(FREQUENCY), there + back)
    h = frf.answer(found, spec).receptance[0]
    np.testing.assert_allclose(h[:3], h[3:], rtol=1e-8)


@pytest.mark.parametrize("name", ["plain", "uneven"])
def test_static_limit_is_the_flexibility(name: str) -> None:
    """Elements of any length are exact there, without axial force."""
    found = scene(MACHINES[name], SPEEDS, shaft="exact", axial_stiffening=False)
    spec = FrfSpec((1e-4,), pairs(*PAIRS))
    h = frf.answer(found, spec).receptance[..., 0]
    mesh = station_mesh(found.spindle)
    for row in range(len(SPEEDS)):
        full = FullRotor(found.spindle, mesh, found.seat_stiffness[row], found.speed[row])
        flexibility = np.linalg.inv(full.stiffness)
        for k, (response, excitation) in enumerate(spec.pairs):
            points = found.spindle.points
            i = full.row(points[response.point], response.direction)
            j = full.row(points[excitation.point], excitation.direction)
            scale = math.sqrt(flexibility[i, i] * flexibility[j, j])
            assert h[row, k].real == pytest.approx(flexibility[i, j], rel=1e-7, abs=1e-8 * scale)


def test_weight_varies_along_the_shaft() -> None:
    """A hanging shaft: fine elements, each with its mean force, and pieces of the same mesh."""
    found = [
        campbell.answer(
            scene(MACHINES["plain"], (0.0,), shaft=s, gravity="-x", element_length=0.003),
            CampbellSpec(2000.0),
        ).frequency
        for s in ("elements", "exact")
    ]
    assert found[0] == pytest.approx(found[1], rel=2e-5)


# --- what it cannot be -------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("changes", "word"),
    [
        ({"rotor": "rigid"}, "a rigid rotor does not bend"),
        ({"formulation": "fixed-frame softening"}, "a term of the elements"),
    ],
)
def test_conditions_that_contradict_it(changes: dict[str, str], word: str) -> None:
    with pytest.raises(InvalidInput, match=word):
        campbell.answer(
            scene(MACHINES["plain"], (0.0,), shaft="exact", **changes), CampbellSpec(1000.0)
        )


def test_modal_damping_and_coupled_motions_are_refused() -> None:
    with pytest.raises(InvalidInput, match="no modes to damp one by one"):
        campbell.answer(scene(mfw2310(), (0.0,), shaft="exact"), CampbellSpec(1000.0))
    joined = flagship(supports=(LinearSupport("s", 0.2, {("x", "y"): 1e7}),))
    with pytest.raises(InvalidInput, match="couples bending with another motion"):
        scene(joined, (0.0,), shaft="exact").exact.modes(None, 1.0)  # type: ignore[arg-type]
