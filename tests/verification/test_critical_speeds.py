"""Critical speeds of any order: published, by dense matrices, by closed forms, on real bearings."""

from __future__ import annotations

import math
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator
from scipy.linalg import eigvals

import rotordyn
from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.unbalance import solve as unbalance
from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.equation.mesh import build_mesh
from rotordyn.machine.inertia import rotor_inertia
from rotordyn.machine.lumped import PointMass
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.modes import roots
from rotordyn.modes.character import across
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.loads import Unbalance
from rotordyn.scene.scene import Scene
from tests.literature.test_rotor_friswell import base, overhung
from tests.oracles.exact_shaft.poles import exact_mode
from tests.oracles.exact_shaft.rotor import exact_rotor
from tests.oracles.full_rotor import FullRotor
from tests.oracles.idealised import times
from tests.oracles.rotors import STEEL, support, uniform
from tests.oracles.spindles import RPM, mfw2310

NO_SEATS = np.zeros((0, 5, 5))


def answered(
    spindle: Spindle,
    rpm: Any,
    highest: float,
    orders: tuple[float, ...] = (1,),
    element: float | None = None,
    **conditions: Any,
) -> Any:
    speed = np.asarray(rpm, float) * RPM
    scene = Scene(spindle, Conditions(element_length=element, **conditions), speed, highest)
    return campbell.solve(scene, CampbellSpec(highest, shapes=False, engine_orders=orders))


def bending(result: Any, order: float) -> np.ndarray:
    return np.flatnonzero(
        (result.critical_order == order) & (np.array(result.critical_kind) == "bending")
    )


@pytest.mark.parametrize(
    ("rotor", "expected", "whirl"),
    [
        (base((1e6, 1e6)), [825.16, 829.90, 2487.90, 2756.31, 5379.57, 8841.20], "bfbfbf"),
        (overhung(), [832.73, 890.82, 5026.38, 6063.89, 6117.71], "bfbfb"),
    ],
    ids=["5.9.1", "5.9.9"],
)
def test_published_synchronous_criticals_from_two_speeds(
    rotor: Spindle, expected: list[float], whirl: str
) -> None:
    """Friswell and others 2010; nothing between 0 and 9000 rpm is sampled."""
    found = answered(rotor, [0, 9000], 400.0, element=0.25)
    own = bending(found, 1)
    assert found.critical_speed[own] / RPM == pytest.approx(expected, abs=6e-3)
    assert "".join(found.critical_whirl[k][0] for k in own) == whirl
    assert [found.critical_excited[k] for k in own] == [letter == "f" for letter in whirl]
    assert found.critical_damping[own] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(("coupling", "excited"), [(4e6, True), (1e5, False)])
def test_unbalance_excites_an_axial_mode_that_supports_couple_to_bending(
    coupling: float, excited: bool
) -> None:
    """A rigid body on springs between x and y: its two frequencies, and its response
    [[kx − m Ω² + icΩ, k], [k, ky − m Ω² + icΩ]] (x, y) = (0, u Ω²) with a peak at the axial one."""
    kx, ky, damping, u = 2e7, 6e6, 300.0, 1e-4
    held = [
        LinearSupport(
            name,
            x,
            {pair: 0.5 * size for pair, size in stiffness(kx, ky, coupling).items()},
            {(way, way): 0.5 * damping for way in "xyz"},
        )
        for name, x in (("a", 0.0), ("b", 0.4))
    ]
    spindle = replace(uniform(0.4, 0.1, supports=held), points={"mid": 0.2})
    mass, plain = rotor_inertia(spindle).mass, np.array([[kx, coupling], [coupling, ky]])
    expected = math.sqrt(np.linalg.eigvalsh(plain)[1] / mass)
    speed = np.linspace(0.0, 1.5 * expected, 5)
    scene = Scene(spindle, Conditions(rotor="rigid"), speed, 1000.0, (0.2,))
    found: Any = campbell.solve(scene, CampbellSpec(1000.0, shapes=False))
    own = found.critical_kind.index("axial")
    assert found.critical_speed[own] == pytest.approx(expected, rel=1e-4)
    assert found.critical_excited[own] == excited
    assert found.excited_by[found.kind.index("axial")] == ("either" if excited else "")
    moved = unbalance.solve(scene, UnbalanceSpec(("mid",), (Unbalance("mid", u),)))
    at = moved.fine_speed
    dynamic = plain + (1j * damping * at - mass * at**2)[:, None, None] * np.eye(2)
    closed = np.linalg.solve(dynamic, np.outer(u * at**2, [0.0, 1.0])[..., None])[..., 0]
    np.testing.assert_allclose(moved.fine_displacement[:, 0, 0], closed[:, 1], rtol=1e-6)
    near = np.abs(moved.critical_speed / expected - 1.0) < 1e-4
    assert near.any() == excited
    along = np.abs(closed[at > 0.9 * expected, 0]).max()
    assert (along > 10.0 * u / mass) == excited


def test_a_mode_moves_across_the_axis_if_it_does_at_any_speed() -> None:
    """From a thousandth of its energy on."""
    linear: Any = SimpleNamespace(energy_of=lambda kind: np.array([True, False]))
    along, hardly, coupled = [0.0, 1.0], [0.03, 1.0], [0.04, 1.0]
    assert not across(linear, np.array([along, hardly], dtype=complex))
    assert across(linear, np.array([along, coupled], dtype=complex))
    assert across(linear, 1j * np.array(coupled))


def stiffness(kx: float, ky: float, coupling: float) -> dict[tuple[str, str], float]:
    """Between x and y, z as y."""
    own = {("x", "x"): kx, ("y", "y"): ky, ("z", "z"): ky}
    return {**own, ("x", "y"): coupling, ("y", "x"): coupling}


@pytest.mark.few(4)
@pytest.mark.parametrize("highest", [10.0, 14.5, 90.0, 101.5, 150.0])
@pytest.mark.parametrize("skew", [1.0, 0.9], ids=["isotropic", "planes differ"])
def test_reported_are_those_in_the_band_by_the_mode_that_has_the_frequency(
    skew: float, highest: float
) -> None:
    """A narrower band has the same ones as a wide one, up to its end and by the same names; each
    name is that of the mode with that frequency where the speed is one of the case."""
    rotor = overhung()
    softer = tuple(
        replace(s, stiffness={k: v * (skew if k == ("z", "z") else 1.0) for k, v in rates.items()})
        for s in rotor.supports
        for rates in [s.stiffness]
    )
    rotor = replace(rotor, supports=softer)
    wide = answered(rotor, np.linspace(0.0, 9000.0, 31), 400.0, (1, 2), element=0.25)
    inside = wide.critical_order * wide.critical_speed <= 2.0 * math.pi * highest
    found = answered(rotor, [0, 4000, 9000], highest, (1, 2), element=0.25)
    assert found.critical_speed == pytest.approx(wide.critical_speed[inside], rel=1e-5)
    if not inside.any():
        return
    assert np.isin(found.critical, found.mode).all()
    every = np.union1d([0, 4000, 9000], found.critical_speed / RPM)
    there = answered(rotor, every, highest, (1, 2), element=0.25)
    for name, speed, order in zip(
        found.critical, found.critical_speed, found.critical_order, strict=True
    ):
        row = int(np.abs(there.speed - speed).argmin())
        turning = there.frequency[row, there.mode.index(name)]
        assert turning == pytest.approx(order * speed / (2.0 * math.pi), rel=1e-6)


@pytest.mark.few(5)
@pytest.mark.parametrize("order", [0.43, 1, 1.5, 2, 5])
@pytest.mark.parametrize("stiffness", [(1e6, 1e6), (1e6, 0.3e6), (1e6, 1e6, 0.5e6)])
def test_any_order_by_dense_matrices(stiffness: tuple[float, ...], order: float) -> None:
    """All of K q = (nΩ)² (M − iG/n) q of the assembled matrices, none missing, none besides."""
    rotor = base(stiffness)
    top = 6000.0
    mesh = build_mesh(rotor, 0.25)
    still, turning = (FullRotor(rotor, mesh, NO_SEATS, spin) for spin in (0.0, 1.0))
    gyroscopic = turning.damping - still.damping
    squares = eigvals(still.stiffness, still.mass - 1j * gyroscopic / order)
    spins = np.sort(np.sqrt(squares.real[squares.real > 0])) / order
    expected = spins[spins < top * RPM]
    found = answered(rotor, [0, 2500, top], order * top / 60.0, (order,), element=0.25)
    assert found.critical_speed[bending(found, order)] == pytest.approx(expected, rel=1e-7)


@pytest.mark.parametrize("order", [0.43, 1.5])
@pytest.mark.parametrize("stiffness", [(1e6, 1e6), (1e6, 0.3e6)], ids=["isotropic", "differ"])
def test_without_damping_the_eigenproblem_of_the_order_needs_no_search(
    stiffness: tuple[float, ...], order: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One look at each speed it gives, and no secant, finds all there are."""
    asked = base(stiffness), [0, 2500, 6000], order * 100.0, (order,)
    searched = answered(*asked, element=0.25)
    monkeypatch.setattr(roots, "ITERATIONS", 1)
    found = answered(*asked, element=0.25)
    own = bending(searched, order)
    assert len(own) >= 3
    assert found.critical_speed[bending(found, order)] == pytest.approx(
        searched.critical_speed[own], rel=1e-6
    )


@pytest.mark.parametrize("order", [0.43, 0.5, 1.0, 1.5, 1.7, 2.37])
@pytest.mark.parametrize(("polar", "diametral"), [(0.02, 0.05), (0.09, 0.05)], ids=["long", "flat"])
def test_a_rigid_rotor_in_closed_form(polar: float, diametral: float, order: float) -> None:
    """m (nΩ)² = 2k in translation, (Id ∓ Ip/n) (nΩ)² = 2kb² in tilt: whirl forward has a critical
    speed of order n only where n > Ip/Id, whirl back always; of order 1 unbalance excites but
    forward whirl, of another a force may point anywhere."""
    light = times(STEEL, density=1e-3 / STEEL.density)
    k, b, top = 3e6, 0.1, 20000 * RPM
    ends = (support("front", 0.15 - b, (k, k)), support("rear", 0.15 + b, (k, k)))
    body = PointMass("body", 0.15, 6.0, polar, diametral)
    rotor = uniform(0.3, 0.02, light, masses=(body,), supports=ends)
    found = answered(rotor, [0, 20000], order * 20000 / 60.0, (order,), rotor="rigid")
    whole = {"forward": [math.sqrt(2.0 * k / 6.0) / order], "backward": []}
    whole["backward"] += whole["forward"]
    for side, whirl in ((1.0, "forward"), (-1.0, "backward")):
        inertia = diametral - side * polar / order
        if inertia > 0.0:
            whole[whirl].append(math.sqrt(2.0 * k * b**2 / inertia) / order)
    assert (len(whole["forward"]) == 2) == (order > polar / diametral)
    for whirl, speeds in whole.items():
        own = [j for j in bending(found, order) if found.critical_whirl[j] == whirl]
        expected = sorted(speed for speed in speeds if speed < top)
        assert found.critical_speed[own] == pytest.approx(expected, rel=1e-6)
        assert all(found.critical_excited[own] == (order != 1.0 or whirl == "forward"))


@pytest.mark.parametrize("order", [0.43, 0.5, 1.5])
def test_a_fine_diagram_crosses_the_line_at_the_critical_speeds(order: float) -> None:
    """Damped, and the planes differ: the curves of the modes, of 2 % steps, meet f = n Ω/2π where
    the search, from three speeds, has found it."""
    rotor = base((1e6, 0.7e6), damping=300.0)
    found = answered(rotor, [0, 3000, 6000], order * 100.0, (order,), element=0.25)
    fine = answered(rotor, np.linspace(0, 6000, 51), order * 100.0, (), element=0.25)
    crossings = []
    for k in np.flatnonzero(~fine.mostly_overdamped & (np.array(fine.kind) == "bending")):
        miss = PchipInterpolator(
            fine.speed, fine.frequency[:, k] - order * fine.speed / (2.0 * math.pi)
        )
        crossings += [x for x in miss.roots(extrapolate=False) if x > 0.0]
    own = found.critical_speed[bending(found, order)]
    assert len(own) >= 3
    assert own == pytest.approx(np.sort(crossings), rel=1e-5)


@pytest.mark.parametrize("order", [0.5, 1, 2.37, 3])
def test_damped_criticals_turn_at_the_multiple(order: float) -> None:
    """At each speed found the assembled matrices have a pole with |Im λ| = nΩ and that damping."""
    rotor = base((1e6, 0.7e6), damping=1e3)
    mesh = build_mesh(rotor, 0.25)
    found = answered(rotor, [0, 3000, 6000], order * 100.0, (order,), element=0.25)
    own = bending(found, order)
    assert len(own) >= 4
    assert (found.critical_damping[own] > 0.01).all()
    for k in own:
        spin = found.critical_speed[k]
        poles = FullRotor(rotor, mesh, NO_SEATS, spin).poles(1e4)
        near = poles[np.abs(poles.imag - order * spin).argmin()]
        assert near.imag == pytest.approx(order * spin, rel=1e-6)
        assert -near.real / abs(near) == pytest.approx(found.critical_damping[k], rel=1e-5)


def test_torsion_and_axial_motion_in_closed_form() -> None:
    """A bar free to turn, π n c/L; held along its axis at one end, π c/2L."""
    held = LinearSupport("held", 0.0, {("x", "x"): 1e13, ("y", "y"): 1e8, ("z", "z"): 1e8})
    bar = uniform(
        2.0,
        0.05,
        supports=[
            held,
            replace(held, name="far", x=2.0, stiffness={("y", "y"): 1e8, ("z", "z"): 1e8}),
        ],
    )
    found = answered(bar, [0, 20000], 1000.0, (2, 4), accuracy=1e-7)
    wave = {
        "axial": 0.5 * math.pi / 2.0 * math.sqrt(STEEL.young_modulus / STEEL.density),
        "torsion": math.pi / 2.0 * math.sqrt(STEEL.shear_modulus / STEEL.density),
    }
    for kind, omega in wave.items():
        own = np.array(found.critical_kind) == kind
        expected = [omega / n for n in (2, 4) if omega / n <= 20000 * RPM]
        assert found.critical_speed[own] == pytest.approx(expected, rel=1e-4)
        assert set(np.array(found.critical_whirl)[own]) <= {""}


@pytest.mark.few(1)
@pytest.mark.parametrize("order", [2.37, 3])
def test_bearings_that_change_with_speed(order: float) -> None:
    """The flagship: a mode of the machine solved at the speed found turns at nΩ exactly; the
    sampling does not matter."""
    coarse = answered(mfw2310(), [0, 12000, 24000], 1500.0, (order,))
    fine = answered(mfw2310(), np.arange(0, 24001, 2000), 1500.0, (order,))
    own = bending(coarse, order)
    assert len(own) >= 2
    assert fine.critical_speed[bending(fine, order)] == pytest.approx(
        coarse.critical_speed[own], rel=1e-9
    )
    for k in own:
        spin = coarse.critical_speed[k]
        there = answered(mfw2310(), [spin / RPM, 24000], 1500.0)
        turning = 2.0 * math.pi * there.frequency[0]
        nearest = int(np.abs(turning - order * spin).argmin())
        assert turning[nearest] == pytest.approx(order * spin, rel=1e-8)
        assert there.damping_ratio[0, nearest] == pytest.approx(
            coarse.critical_damping[k], rel=1e-6
        )


def test_the_frames_and_the_exact_shaft_agree() -> None:
    rotor = overhung()
    inertial, turning = (
        answered(rotor, [0, 4000, 7000], 150.0, (0.43, 1, 2), formulation=f, accuracy=1e-6)
        for f in ("inertial", "rotating")
    )
    assert set(inertial.critical_order) == {0.43, 1.0, 2.0}
    assert turning.critical_speed == pytest.approx(inertial.critical_speed, rel=1e-7)
    assert turning.critical == inertial.critical
    for order, spin, whirl in zip(
        inertial.critical_order, inertial.critical_speed, inertial.critical_whirl, strict=True
    ):
        exact = exact_rotor(rotor, spin, np.zeros((0, 5, 5)))
        omega = order * spin * (-1.0 if whirl == "backward" else 1.0)
        found = exact_mode(exact, omega).omega
        assert abs(found) == pytest.approx(order * spin, rel=1e-6)


@pytest.mark.parametrize("share", [0.1, 0.5, 0.75])
def test_a_mass_of_nothing_leaves_the_words_of_whirl(share: float) -> None:
    """Its node changes the extremes over nodes, hardly the share that moves the other way."""
    case = rotordyn.load("lalanne_ferraris")
    assert case.spindle is not None
    rotor, speeds = case.spindle, np.array(case.speeds)[[0, -1]]
    spec = replace(case.analyses["campbell"], shapes=False)
    at = rotor.shaft.start + share * (rotor.shaft.end - rotor.shaft.start)
    added = replace(rotor, masses=(*rotor.masses, PointMass("none", at, 0.0)))
    one, other = (
        campbell.solve(Scene(each, case.conditions, speeds, spec.max_frequency), spec)
        for each in (rotor, added)
    )
    assert other.critical_speed == pytest.approx(one.critical_speed, rel=1e-3)
    assert other.critical_whirl == one.critical_whirl
    assert "mixed" in one.critical_whirl


def test_parts_that_whirl_either_way_are_called_mixed() -> None:
    """Between the two criticals of an uneven pair: against the orbits of the assembled matrices."""
    rotor = base((1e6, 0.2e6))
    found = answered(rotor, [0, 5000, 10000], 400.0, (1, 2, 3), element=0.25)
    mesh = build_mesh(rotor, 0.25)
    seen = set()
    for k in bending(found, 1).tolist() + bending(found, 2).tolist() + bending(found, 3).tolist():
        omega = found.critical_order[k] * found.critical_speed[k]
        full = FullRotor(rotor, mesh, NO_SEATS, found.critical_speed[k])
        dynamic = full.stiffness + 1j * omega * full.damping - omega**2 * full.mass
        vector = np.linalg.svd(dynamic)[2][-1].conj()
        y, z = (
            vector[full.selection.rows("y", mesh.nodes)],
            vector[full.selection.rows("z", mesh.nodes)],
        )
        turn = np.abs(y + 1j * z) ** 2 - np.abs(y - 1j * z) ** 2
        size = np.abs(y) ** 2 + np.abs(z) ** 2
        shares = [size[turn * way > 0.0].sum() / size.sum() for way in (1.0, -1.0)]
        assert (found.critical_whirl[k] == "mixed") == (min(shares) > 0.01)
        seen.add(found.critical_whirl[k])
    assert seen >= {"mixed", "forward", "backward"}
