"""The number of modes that is told against counts made by other means."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from rotordyn.analysis.certificate import certificate
from rotordyn.numerics.reduction import RitzBasis
from rotordyn.system import fineness, flexibility, lateral_rotor
from rotordyn.system.hierarchy import Hierarchy
from rotordyn.system.leakage import Leakage
from rotordyn.system.unreduced import MaterialDamping

from benchmarks import random_rotors
from rotordyn.analysis import campbell
from rotordyn.analysis.scene import Scene
from rotordyn.analysis.specs import CampbellSpec, Conditions
from rotordyn.machine.damping import RayleighDamping
from rotordyn.machine.housing import RigidHousing
from rotordyn.machine.joint import Joint
from rotordyn.machine.spindle import Spindle
from rotordyn.model.mesh import build_mesh
from rotordyn.report.warnings import result_warnings
from tests.oracles.exact_shaft.count import modes_below, whirl_frequencies
from tests.oracles.exact_shaft.rotor import exact_rotor
from tests.oracles.full_rotor import FullRotor
from tests.oracles.rotors import STEEL, support, uniform
from tests.oracles.spindles import RPM, mfw2310
from tests.oracles.stepped_rotors import stepped_rotor

NO_SEATS = np.zeros((0, 5, 5))
HZ = 2.0 * math.pi


def answered(spindle: Spindle, speed: list[float], highest: float, **conditions: Any) -> Any:
    scene = Scene(spindle, Conditions(**conditions), np.array(speed), highest)
    return campbell.answer(scene, CampbellSpec(highest, shapes=False))


@pytest.mark.parametrize("seed", range(12))
def test_isotropic_rotors_by_inertia_of_the_exact_shaft(seed: int) -> None:
    """Wittrick and Williams' count of both whirls: without elements, without eigenvalues."""
    rng = np.random.default_rng(seed)
    spindle = stepped_rotor(rng)
    still = whirl_frequencies(exact_rotor(spindle, 0.0, NO_SEATS), 6)
    speed = [0.5 * still[0], 4.0 * still[0]]
    highest = min(1.02 * still[5] / HZ, 9.9e5)
    result = answered(spindle, speed, highest)
    bending = np.array([kind == "bending" for kind in result.kind])
    others = (result.frequency[:, ~bending] <= highest).sum(axis=1)
    for row, spin in enumerate(speed):
        exact = exact_rotor(spindle, spin, NO_SEATS)
        expected = sum(modes_below(exact, side * HZ * highest) for side in (-1, 1))
        assert result.modes_below[row] - others[row] == expected
    assert result.certified.all()


@pytest.mark.parametrize("seed", range(8))
def test_anisotropic_damped_rotors_by_all_eigenvalues(seed: int) -> None:
    """Against the dense eigenproblem of many standard elements, no freedom left out."""
    rng = np.random.default_rng(100 + seed)
    spindle = stepped_rotor(rng, isotropic=False, damped=True)
    short = spindle.shaft.end / 120.0
    mesh = build_mesh(spindle, short)
    spin = 300.0
    poles = FullRotor(spindle, mesh, NO_SEATS, spin).poles(1e5)
    light = poles[np.abs(poles) < 1.05 * poles.imag]
    gaps = np.diff(light.imag[:9]) / light.imag[:8]
    place = 3 + int(gaps[3:8].argmax())
    highest = 0.5 * (light.imag[place] + light.imag[place + 1])
    expected = int((np.abs(poles) < highest).sum())
    result = answered(spindle, [spin], highest / HZ, element_length=short)
    bending = np.array([kind == "bending" for kind in result.kind])
    others = (result.frequency[:, ~bending] <= highest / HZ).sum(axis=1)
    assert result.certified.all()
    assert result.modes_below - others == pytest.approx(expected)


@pytest.mark.parametrize("highest", [4000.0, 9000.0])
def test_a_free_bar_by_closed_form(highest: float) -> None:
    """Axial n c/2L, torsional n ct/2L, and bending by the count of the exact shaft."""
    bar = uniform(
        1.0, 0.05, supports=[support("a", 0.2, (1e8, 1e8)), support("b", 0.8, (1e8, 1e8))]
    )
    result = answered(bar, [0.0, 500.0], highest)
    wave = np.sqrt([STEEL.young_modulus / STEEL.density, STEEL.shear_modulus / STEEL.density])
    expected = np.floor(2.0 * highest / wave).sum()
    for row, spin in enumerate((0.0, 500.0)):
        exact = exact_rotor(bar, spin, NO_SEATS)
        bending = sum(modes_below(exact, side * HZ * highest) for side in (-1, 1))
        assert result.modes_below[row] == expected + bending
    assert result.certified.all()


def test_bearings_damping_drawbar_and_both_frames() -> None:
    """The flagship: unsymmetric tangents, modal damping; the count does not depend on the frame."""
    speed = (np.array([0.0, 12000.0, 24000.0]) * RPM).tolist()
    inertial = answered(mfw2310(), speed, 4000.0)
    assert inertial.certified.all()
    turning = answered(mfw2310(), speed, 4000.0, formulation="rotating")
    softened = answered(mfw2310(), speed, 4000.0, formulation="fixed-frame softening")
    assert turning.certified.all()
    assert softened.certified.all()
    assert turning.modes_below == pytest.approx(inertial.modes_below)
    assert inertial.modes_found == pytest.approx(inertial.modes_below)


WALL = RigidHousing("wall", ("a",), 0.0, 5.0, {("y", "y"): 1e8, ("z", "z"): 1e8})


@pytest.mark.parametrize(
    "more",
    [{}, {"housings": (WALL,)}, {"joints": (Joint("cone", 0.4, tilt=1e6, tilt_damping=5.0),)}],
    ids=["grounded", "on a housing", "with a joint that damps"],
)
def test_a_mode_that_the_basis_lacks_is_noticed(
    more: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The second bending vector is put among those left out: no proof, and the warning says so."""
    whole = flexibility.ritz_basis

    def poorer(*arguments: Any) -> RitzBasis:
        basis = whole(*arguments)
        kept = np.delete(np.arange(basis.vectors.shape[1]), 3)
        lost = basis.vectors[:, 3:4]
        return replace(
            basis,
            vectors=basis.vectors[:, kept],
            values=basis.values[kept],
            are_modes=basis.are_modes[kept],
            rest=np.concatenate([lost, basis.rest], axis=1),
            rest_values=np.append(basis.values[3], basis.rest_values),
            rest_mass=np.concatenate([np.zeros((1, len(kept))), basis.rest_mass[:, kept]]),
            rounding=basis.rounding[kept],
        )

    ends = [support("a", 0.0, (1e7, 1e7)), support("b", 1.0, (1e7, 1e7))]
    rotor = replace(uniform(1.0, 0.05, supports=ends), **more)
    complete = answered(rotor, [100.0], 2000.0)
    assert complete.certified.all()
    monkeypatch.setattr(flexibility, "ritz_basis", poorer)
    result = answered(rotor, [100.0], 2000.0)
    assert not result.certified.any()
    assert np.isnan(result.modes_below).all()
    assert result.modes_found[0] < complete.modes_below[0]
    (sentence,) = result_warnings({"campbell": result})
    assert "not certified at 1 of 1 speeds" in sentence


def test_more_modes_are_taken_where_the_count_is_not_proven(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """With free-free modes up to the band only, the first basis is too poor."""
    monkeypatch.setattr(fineness, "CUTOFF", 0.6)
    rotor = uniform(
        1.0, 0.02, supports=[support("a", 0.0, (1e7, 1e7)), support("b", 1.0, (1e7, 1e7))]
    )
    asked: list[float] = []
    whole = lateral_rotor.free_vectors
    monkeypatch.setattr(
        lateral_rotor, "free_vectors", lambda *a: (asked.append(a[3]), whole(*a))[1]
    )
    result = answered(rotor, [100.0], 6000.0)
    assert result.certified.all()
    assert len(asked) > 1
    assert np.diff(np.log2(asked)) == pytest.approx(1.0)


@pytest.mark.parametrize("seed", [1, 7, 29, 309, 359])
def test_poles_of_long_random_rotors_by_one_dense_solve(seed: int) -> None:
    """Up to sixty sections on damped uneven supports: the survey of the benchmarks, a few of it.

    In 309 a mode hardly swings, in 359 one is damped so strongly that its |pole| lies beyond the
    edge and its frequency below: both are counted, and not compared.
    """
    found = random_rotors.against_dense(seed)
    assert found["modes"] > 3
    assert (found["missing"], found["spurious"], found["warnings"]) == (0, 0, 0)
    assert found["certified"]
    assert found["counted"] == found["in_disc"] >= found["modes"]
    assert max(found["errors"]) < 1e-5


def bounds(spindle: Spindle) -> np.ndarray:
    """What has to be below 1 for bending up to 2 kHz."""
    scene = Scene(spindle, Conditions(), np.array([0.0, 300.0]), 2000.0)
    return certificate(scene, "bending", HZ * 2000.0).bound


def test_forces_of_supports_on_housings_count_as_those_on_ground(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Without static answers to them these forces rule the bound; a heavy housing is ground."""
    whole = flexibility.ritz_basis

    def unanswered(mass: Any, stiffness: Any, cutoff: float, loads: Any, *rest: Any) -> RitzBasis:
        return whole(mass, stiffness, cutoff, loads[:, :0], *rest)

    ends = [support("a", 0.0, (2e8, 1e8)), support("b", 1.0, (2e8, 1e8))]
    rotor = uniform(1.0, 0.05, supports=ends)
    ground = RigidHousing("wall", ("a",), 0.0, 5e4, {("y", "y"): 1e12, ("z", "z"): 1e12})
    answered_for = bounds(rotor)
    monkeypatch.setattr(flexibility, "ritz_basis", unanswered)
    bare, housed = bounds(rotor), bounds(replace(rotor, housings=(ground,)))
    assert (bare > 50.0 * answered_for).all()
    assert housed == pytest.approx(bare, rel=1e-2)


def test_dampers_of_joints_without_answers_leave_no_proof(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    ends = [support("a", 0.2, (1e8, 1e8), 1e3), support("b", 0.8, (1e8, 1e8), 1e3)]
    joint = Joint("cone", 0.4, tilt=1e6, tilt_damping=100.0)
    rotor = replace(uniform(1.0, 0.05, supports=ends), joints=(joint,))
    assert (bounds(rotor) < 0.1).all()
    none = property(lambda elements: np.zeros((elements.size, 0)))
    monkeypatch.setattr(Hierarchy, "damper_loads", none)
    assert (bounds(rotor) > 1.0).all()


def test_short_waves_that_turning_friction_stills_leave_no_proof() -> None:
    """λ → iΩ − 1/β for ever shorter waves under C = βK that turns: the more of them are kept, the
    more lie in the disc; few that damp little are counted as before."""
    ends = [support("a", 0.0, (1e8, 1e8)), support("b", 1.0, (1e8, 1e8))]
    rotor = replace(uniform(1.0, 0.05, supports=ends), internal_damping=1.0)
    stilled = replace(rotor, rayleigh=RayleighDamping(stiffness=1.0 / 5000.0))
    few, more = (answered(stilled, [3000.0], 2000.0, accuracy=a) for a in (1e-4, 1e-7))
    assert more.modes_found > few.modes_found
    assert not few.certified.any()
    assert not more.certified.any()
    light = replace(rotor, rayleigh=RayleighDamping(10.0, 1e-6), rotor_damping=(0.01, 0.03))
    assert answered(light, [0.0, 3000.0], 2000.0).certified.all()


@pytest.mark.parametrize("seed", range(4))
def test_modal_damping_of_modes_left_out_is_not_underrated(seed: int) -> None:
    """What it adds to the bounds, against the sum over all modes of the free rotor."""
    rng = np.random.default_rng(seed)
    ratio = float(rng.uniform(0.05, 0.5))
    plain = stepped_rotor(rng)
    still = whirl_frequencies(exact_rotor(plain, 0.0, NO_SEATS), 4)
    rotor = replace(plain, rotor_damping=(ratio,))
    system = Scene(rotor, Conditions(), np.zeros(1), 1.02 * still[3] / HZ).bending
    whole, radius = system.unreduced, 1.2 * still[3:]
    assert whole is not None
    basis = whole.basis
    undamped = replace(whole, material=MaterialDamping())
    with_it, without = (
        Leakage(system, each, np.zeros(1), radius[:1], np.zeros(1)) for each in (whole, undamped)
    )
    damping = radius[0] * 2.0 * ratio * np.sqrt(basis.rest_values)
    shares = np.linalg.lstsq(basis.rest, whole.rest.vectors, rcond=None)[0]
    own = np.linalg.norm(shares.T @ (damping[:, None] * shares), 2)
    assert own <= (with_it.own() - without.own())[0] * (1.0 + 1e-6) < 10.0 * own
    vectors = rng.standard_normal((1, len(basis.values), 20))
    met = shares.T @ (damping[:, None] * (basis.rest_mass @ vectors[0]))
    told = with_it.forces(vectors + 0j, 1.0) - without.forces(vectors + 0j, 1.0)
    assert (np.linalg.norm(met, axis=0) <= told[0] * (1.0 + 1e-6)).all()


def test_motions_that_hardly_swing_ask_for_no_more_modes(monkeypatch: pytest.MonkeyPatch) -> None:
    """Their told error is no frequency's: dampers that hold both ends are answered at once."""
    ends = [support("a", 0.1, (1e7, 2e7), 1e5), support("b", 0.9, (1e7, 1e7), 1e5)]
    asked: list[float] = []
    whole = lateral_rotor.free_vectors
    monkeypatch.setattr(
        lateral_rotor, "free_vectors", lambda *a: (asked.append(a[3]), whole(*a))[1]
    )
    result = answered(uniform(1.0, 0.05, supports=ends), [0.0, 500.0], 3000.0)
    assert result.mostly_overdamped.any()
    assert np.nanmax(result.frequency_error) > 1e-4 > result.largest_error
    assert result.certified.all()
    assert len(asked) == 1
