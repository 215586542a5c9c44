"""Loss factors of shaft and supports: closed forms of a disc on a shaft, dense matrices in circular
coordinates, viscous dampers of equal work, balance of energy."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import rotordyn
from rotordyn.allowance import within
from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.result import CampbellResult
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.frf import solve as frf
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.measured_response import Port
from rotordyn.analyses.unbalance import solve as unbalance
from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.equation.hysteresis import Hysteretic, Signs, signs_of
from rotordyn.errors import InvalidInput, TooCostly
from rotordyn.machine.housing import RigidHousing
from rotordyn.machine.lumped import PointMass
from rotordyn.machine.rotor import RayleighDamping
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.loads import Unbalance
from rotordyn.scene.scene import Scene
from tests.oracles.dense_rotor.assemble import rotor_matrices
from tests.oracles.dense_rotor.selection import LATERAL
from tests.oracles.full_rotor import FullRotor
from tests.oracles.idealised import idealised
from tests.oracles.rotors import STEPPED, support, uniform
from tests.oracles.spindles import system_of

Complex = NDArray[np.complex128]
LIGHT = idealised("light", 2.1e11, 0.3, 1.0)
LENGTH, MASS, ETA = 0.6, 20.0, 0.04
HALF = math.sin(0.5 * math.atan(ETA))  # damping ratio of k (1 + iη)
HZ = 2.0 * math.pi
FORMULATIONS = pytest.mark.parametrize("formulation", ["inertial", "rotating"])


def disc(
    eta: float = ETA,
    outer: float = 0.0,
    *,
    beside: tuple[float, float] = (0.0, 0.0),
    loss: float = 0.0,
    **changes: Any,
) -> Spindle:
    """A mass amidships on a light shaft; a damper ``outer`` and a spring ``beside`` (along y, z) of
    factor ``loss`` between the mass and ground."""
    damper = {("y", "y"): outer, ("z", "z"): outer}
    spring = {("y", "y"): beside[0], ("z", "z"): beside[1]}
    held = (
        support("a", 0.0, (1e12, 1e12)),
        support("b", LENGTH, (1e12, 1e12)),
        LinearSupport("aside", LENGTH / 2, spring, damper, loss_factor=loss),
    )
    body = PointMass("disc", LENGTH / 2, MASS, 1e-6, 1e-6)
    own: dict[str, Any] = {"points": {"disc": LENGTH / 2}, "loss_factor": eta, **changes}
    return replace(uniform(LENGTH, 0.03, LIGHT, masses=(body,), supports=held), **own)


def scene(spindle: Spindle, speed: list[float], highest: float = 150.0, **changes: Any) -> Scene:
    ports = tuple(spindle.points.values())
    return Scene(spindle, Conditions(**changes), np.array(speed), highest, ports)


def modes(
    spindle: Spindle, speed: list[float], highest: float = 150.0, **changes: Any
) -> CampbellResult:
    asked = CampbellSpec(highest, shapes=False)
    return campbell.solve(scene(spindle, speed, highest, **changes), asked)


def responses(spindle: Spindle, speed: list[float], omega: NDArray[np.float64]) -> Complex:
    """yy, zz, zy, yz of the point ``disc`` (speeds, 4, frequencies)."""
    ends = [tuple(Port("disc", way) for way in pair) for pair in ("yy", "zz", "zy", "yz")]
    spec = FrfSpec(tuple((omega / HZ).tolist()), tuple(ends))  # type: ignore[arg-type]
    return frf.solve(scene(spindle, speed, float(omega.max() / HZ)), spec).receptance  # type: ignore[attr-defined,no-any-return]


def still() -> tuple[float, float]:
    """ω and k of the disc on the shaft."""
    omega = HZ * modes(disc(0.0), [0.0]).frequency[0, 0]
    return omega, MASS * omega**2


@FORMULATIONS
def test_damping_ratio_in_closed_form(formulation: str) -> None:
    """sin(½ atan η) for all whirl slower than the shaft's turning back, and forward whirl faster
    than the shaft; its negative for forward whirl slower than the shaft. No gyroscopic effect."""
    omega, _ = still()
    found = modes(disc(), [0.0, 0.5 * omega, 2.0 * omega], formulation=formulation)
    assert found.mode == ("bending 1 backward", "bending 1 forward")
    expected = [[HALF, HALF], [HALF, HALF], [HALF, -HALF]]
    np.testing.assert_allclose(found.damping_ratio, expected, rtol=1e-4)


@pytest.mark.few(1)
@FORMULATIONS
def test_the_threshold_is_the_critical_speed(formulation: str) -> None:
    """Whatever the factor; there, in itself, the shaft does not move and nothing is lost."""
    omega, _ = still()
    for eta in (1e-4, ETA, 0.5):
        found = modes(disc(eta), [0.0, 3.0 * omega, 6.0 * omega], formulation=formulation)
        assert found.stability_threshold == pytest.approx(omega, rel=1e-6)
        assert found.unstable_mode == "bending 1 forward"
        first = found.critical_whirl.index("forward")
        assert found.critical_speed[first] == pytest.approx(omega, rel=1e-6)
        assert abs(found.critical_damping[first]) < 1e-9
        back = found.critical_whirl.index("backward")
        expected = math.sin(0.5 * math.atan(eta))
        assert found.critical_damping[back] == pytest.approx(expected, rel=1e-3)


def test_modes_that_take_longer_than_allowed_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rotordyn.allowance.CORRECTION", 1e9)
    with within(100.0), pytest.raises(TooCostly, match=r"loss factors: .* \d+ modes"):
        modes(disc(), [0.0])


@pytest.mark.few(2)
@pytest.mark.parametrize("order", [0.43, 0.5, 1.0, 1.5, 2.37])
def test_damping_at_critical_speeds_of_any_order(order: float) -> None:
    """At ω = nΩ forward whirl is slower than the shaft where n < 1, which drives it, and faster
    where n > 1, which damps it; whirl back is damped always."""
    omega, _ = still()
    asked = CampbellSpec(150.0, shapes=False, engine_orders=(order,))
    found = campbell.solve(scene(disc(), [0.0, 1.5 * omega / order]), asked)
    assert found.critical_speed == pytest.approx([omega / order] * 2, rel=2e-3)
    ratio = dict(zip(found.critical_whirl, found.critical_damping, strict=True))
    assert ratio["backward"] == pytest.approx(HALF, rel=1e-3)
    assert ratio["forward"] == pytest.approx(np.sign(order - 1.0) * HALF, rel=1e-3, abs=1e-9)


@pytest.mark.few(1)
@pytest.mark.parametrize("order", [0.6, 1.0, 1.5])
def test_damping_at_critical_speeds_where_planes_are_one_for_a_while(order: float) -> None:
    """The same beside a spring that differs in both planes at high speeds only, of a tenth of the
    stiffness of the shaft and without loss."""
    omega, k = still()
    spring = {("y", "y"): 0.1 * k, ("z", "z"): (0.1 * k, 0.1 * k, 0.3 * k)}
    table = (0.0, 2.0 * omega, 3.0 * omega)
    aside = LinearSupport("aside", LENGTH / 2, spring, {}, speeds=table)
    rotor = replace(disc(), supports=(*disc().supports[:2], aside))
    asked = CampbellSpec(150.0, shapes=False, engine_orders=(order,))
    found = campbell.solve(scene(rotor, [0.0, 1.4 * omega, 2.9 * omega]), asked)
    assert found.critical_speed == pytest.approx([math.sqrt(1.1) * omega / order] * 2, rel=2e-3)
    ratio = dict(zip(found.critical_whirl, found.critical_damping, strict=True))
    half = math.sin(0.5 * math.atan(ETA / 1.1))
    assert ratio["backward"] == pytest.approx(half, rel=1e-3)
    assert ratio["forward"] == pytest.approx(np.sign(order - 1.0) * half, rel=1e-3, abs=1e-9)


@pytest.mark.few(2)
@pytest.mark.parametrize("ratio", [0.0, 0.5, 0.999, 1.001, 2.0])
def test_an_outer_damper_forbids_growth_at_all_speeds_or_at_none(ratio: float) -> None:
    """Of c ω against η k: above 1 forward whirl never grows, below it does from ω on."""
    omega, stiff = still()
    outer = ratio * ETA * stiff / omega
    found = modes(disc(outer=outer), [0.0, 0.7 * omega, 3.0 * omega, 6.0 * omega])
    if ratio > 1.0:
        assert found.stability_threshold == math.inf
    else:
        assert found.stability_threshold == pytest.approx(omega, rel=1e-3)
    for row, side in ((1, 1.0), (3, -1.0)):
        roots = np.roots([MASS, outer, stiff * (1.0 + 1j * side * ETA)])
        forward = roots[roots.imag > 0.0][0]
        ratio_found = found.damping_ratio[row, found.mode.index("bending 1 forward")]
        assert ratio_found == pytest.approx(-forward.real / abs(forward), abs=1e-4 * ETA)


@pytest.mark.few(1)
@pytest.mark.parametrize("loss", [0.0, 0.05, 0.9])
def test_supports_against_shaft(loss: float) -> None:
    """η_n k_n outside against η k inside: growth beyond ω where the shaft loses more, else none."""
    _, stiff = still()
    beside = 0.4 * stiff
    whole = math.sqrt((stiff + beside) / MASS)
    spindle = disc(beside=(beside, beside), loss=loss)
    found = modes(spindle, [0.0, 2.0 * whole])
    for row, side in ((0, 1.0), (1, -1.0)):
        k = stiff * (1.0 + 1j * side * ETA) + beside * (1.0 + 1j * loss)
        expected = math.sin(0.5 * np.angle(k))
        forward = found.damping_ratio[row, found.mode.index("bending 1 forward")]
        assert forward == pytest.approx(expected, rel=1e-3, abs=1e-6)
    if loss * beside > ETA * stiff:
        assert found.stability_threshold == math.inf
    else:
        assert found.stability_threshold == pytest.approx(whole, rel=1e-3)


def test_viscous_and_hysteretic_damping_together() -> None:
    """c_i (Ω − ω) + η k = c_e ω + η_n k_n at the threshold."""
    _, stiff = still()
    inner, outer, beside, loss = 2e-5 * stiff, 4e-4 * stiff, 0.3 * stiff, 0.15
    whole = math.sqrt((stiff + beside) / MASS)
    spindle = disc(
        outer=outer,
        beside=(beside, beside),
        loss=loss,
        rayleigh=RayleighDamping(stiffness=inner / stiff),
        internal_damping=1.0,
    )
    expected = whole + (outer * whole + loss * beside - ETA * stiff) / inner
    found = modes(spindle, [0.0, 2.0 * whole, 40.0 * whole])
    assert 3.0 * whole < expected < 40.0 * whole
    assert found.stability_threshold == pytest.approx(expected, rel=1e-3)


def test_the_difference_of_two_planes_holds_the_shaft() -> None:
    """k ± Δ along y, z: a real skew η k across, so that growth begins only where η k > Δ."""
    omega, stiff = still()
    for share in (0.5, 0.95, 1.05, 3.0):
        spread = share * ETA * stiff
        spindle = disc(beside=(2.0 * spread, 0.0))
        found = modes(spindle, [3.0 * omega])
        k = np.array([[stiff + 2.0 * spread, ETA * stiff], [-ETA * stiff, stiff]]) / MASS
        roots = np.sqrt(-np.linalg.eigvals(k) + 0j)
        roots = np.where(roots.imag < 0.0, -roots, roots)
        expected = np.sort(-roots.real / np.abs(roots))
        assert (expected[0] < -1e-3) == (share < 1.0)
        np.testing.assert_allclose(np.sort(found.damping_ratio[0]), expected, atol=2e-3 * ETA)


def test_peak_at_rest_and_sides_of_the_speed() -> None:
    """H of whirl is 1/(k (1 + iη sgn(ω − Ω)) − m ω²), at its peak 1/kη, and of whirl back 1/(k
    (1 + iη) − m ω²); of a force in one plane yy = (H₊ + H₋)/2 and zy = −i (H₊ − H₋)/2."""
    omega, stiff = still()
    grid = np.sort(np.append(np.linspace(0.705, 1.295, 24), [0.9, 1.0, 1.1])) * omega
    speed = [0.0, 0.9 * omega, 1.1 * omega]
    found = responses(disc(), speed, grid)
    for row, spin in enumerate(speed):
        sign = np.where(np.abs(grid - spin) < 1e-9 * spin, 0.0, np.sign(grid - spin))
        plus = 1.0 / (stiff * (1.0 + 1j * ETA * sign) - MASS * grid**2)
        minus = 1.0 / (stiff * (1.0 + 1j * ETA) - MASS * grid**2)
        same, across = 0.5 * (plus + minus), -0.5j * (plus - minus)
        expected = np.stack([same, same, across, -across])
        scale = np.abs(minus).max()
        np.testing.assert_allclose(found[row], expected, rtol=0.0, atol=3e-4 * scale)
    peak = np.abs(found[0, 0]).max()
    assert peak == pytest.approx(1.0 / (ETA * stiff), rel=1e-3)


def whole_machine(eta: float, **changes: Any) -> Spindle:
    """A stepped shaft with masses on two soft supports, everything of one loss factor."""
    ends = tuple(
        replace(s, damping={}, loss_factor=eta, stiffness=k)
        for s, k in zip(
            (support("l", 0.0, (1e8, 1e8)), support("r", 0.19, (6e7, 6e7))),
            ({("y", "y"): 1e8, ("z", "z"): 1e8}, {("y", "y"): 6e7, ("z", "z"): 6e7}),
            strict=True,
        )
    )
    own: dict[str, Any] = {"supports": ends, "loss_factor": eta, "points": {"disc": 0.1}}
    return replace(STEPPED, **{**own, **changes})


def test_one_factor_everywhere_turns_every_stiffness_alike() -> None:
    """At rest K (1 + iη): every bending mode has λ = λ₀ √(1 + iη), axial motion and torsion of the
    free shaft as well, and H(ω) is H₀ at √(ω²/(1 + iη)) over 1 + iη."""
    lossy, plain = (modes(whole_machine(eta), [0.0], 8000.0) for eta in (ETA, 0.0))
    assert len(lossy.mode) == len(plain.mode) >= 8
    swinging = plain.rigid_share[0] < 2.0
    stretched = abs(np.sqrt(1.0 + 1j * ETA).real)
    np.testing.assert_allclose(
        lossy.frequency[0, swinging], plain.frequency[0, swinging] * stretched, rtol=1e-9
    )
    np.testing.assert_allclose(lossy.damping_ratio, HALF, rtol=1e-6)
    assert {"bending", "axial", "torsion"} == set(lossy.kind)


def uneven(eta: float = 0.1, loss: float = 0.3, **changes: Any) -> Spindle:
    """On supports that tell directions apart, one of them tilted, with different factors."""
    left = LinearSupport(
        "l", 0.0, {("y", "y"): 1e8, ("z", "z"): 7e7, ("y", "z"): 1e7, ("z", "y"): 1e7}
    )
    right = support("r", 0.19, (6e7, 9e7), 300.0)
    held = (replace(left, loss_factor=loss), replace(right, loss_factor=0.05))
    own: dict[str, Any] = {"supports": held, "loss_factor": eta, "points": {"disc": 0.1}}
    return replace(STEPPED, **{**own, **changes})


class Circular:
    """Dense matrices of all DOF, with losses by whirl: p = (y + iz)/√2, q = (y − iz)/√2.

    Of e^(iωt), p is the amplitude of forward whirl and q the conjugate of that of backward whirl.
    """

    def __init__(self, found: Scene, row: int) -> None:
        spindle, mesh = found.spindle, found.mesh
        self.spin = float(found.speed[row])
        self.dense = FullRotor(spindle, mesh, np.zeros((0, 5, 5)), self.spin)
        shaft = rotor_matrices(spindle, mesh, LATERAL).stiffness
        nothing = np.zeros_like(shaft)
        for held in spindle.supports:
            only = replace(spindle, supports=(held,))
            own = FullRotor(only, mesh, np.zeros((0, 5, 5)), 0.0).stiffness - shaft
            nothing = nothing + held.loss_factor * own
        self.supports, self.shaft = nothing, spindle.loss_factor * shaft
        # y, z and thz, −thy of a node are the real and imaginary parts of r and of its tilt
        self.turn = np.zeros((len(shaft), len(shaft)), dtype=complex)
        for node in range(mesh.nodes):
            at = {f: self.dense.selection.row(node, f) for f in ("y", "z", "thy", "thz")}
            for y, z, sign in ((at["y"], at["z"], 1.0), (at["thz"], at["thy"], -1.0)):
                self.turn[y, [y, z]] = 1.0, 1j * sign
                self.turn[z, [y, z]] = 1.0, -1j * sign
        self.forward = np.zeros(len(shaft), dtype=bool)
        for node in range(mesh.nodes):
            for freedom in ("y", "thz"):
                self.forward[self.dense.selection.row(node, freedom)] = True
        self.turn /= math.sqrt(2.0)

    def stiffness(self, omega: float) -> Complex:
        ahead, behind = np.sign(omega - self.spin), np.sign(omega + self.spin)
        side = np.where(self.forward, ahead, behind)
        lossy = self.turn.conj().T @ (1j * side[:, None] * (self.turn @ self.shaft))
        return np.asarray(
            self.dense.stiffness + lossy + 1j * np.sign(omega) * self.supports, dtype=complex
        )

    def poles(self, omega: float) -> Complex:
        inverse = np.linalg.inv(self.dense.mass)
        k, c = inverse @ self.stiffness(omega), inverse @ self.dense.damping
        n = len(k)
        return np.linalg.eigvals(np.block([[np.zeros((n, n)), np.eye(n)], [-k, -c]]))

    def response(self, omega: float, x: float) -> Complex:
        """yy, zz, zy, yz."""
        own = self.dense
        z = self.stiffness(omega) + 1j * omega * own.damping - omega**2 * own.mass
        rows = [own.row(x, way) for way in "yz"]
        h = np.linalg.solve(z, np.eye(len(z))[:, rows])[rows]
        return np.array([h[0, 0], h[1, 1], h[1, 0], h[0, 1]])


@pytest.mark.parametrize("machine", [uneven, whole_machine])
def test_against_dense_matrices_by_whirl(machine: Callable[..., Spindle]) -> None:
    """Poles, each with the signs of its own frequency, none missing, and receptances."""
    spindle, speed = machine(0.1), [0.0, 4000.0, 9000.0]
    fine = {"element_length": 0.01}
    found = scene(spindle, speed, 2500.0, **fine)
    poles = system_of(found).modes.pole
    grid = HZ * np.array([200.0, 700.0, 1400.0, 2300.0])
    spec = FrfSpec(
        tuple((grid / HZ).tolist()),
        tuple((Port("disc", a), Port("disc", b)) for a, b in ("yy", "zz", "zy", "yz")),
    )
    ours = frf.solve(found, spec)
    for row, spin in enumerate(speed):
        dense = Circular(found, row)
        exact = []
        for low, high in ((0.0, spin), (spin, HZ * 2200.0)):
            own = dense.poles(0.5 * (low + high)) if high > low else np.zeros(0)
            exact.append(own[(own.imag > max(low, 1.0)) & (own.imag <= high)])
        whole = np.concatenate(exact)
        mine = poles[row][(poles[row].imag > 1.0) & (poles[row].imag < HZ * 2200.0)]
        if system_of(found).whirling:  # backward whirl by its conjugate
            back = poles[row][(poles[row].imag < -1.0) & (poles[row].imag > -HZ * 2200.0)]
            mine = np.concatenate([mine, back.conj()])
        assert len(mine) == len(whole) >= 4
        for pole in mine:
            assert np.abs(whole - pole).min() < 1e-4 * abs(pole)
        for k, omega in enumerate(grid):
            expected = dense.response(omega, 0.1)
            scale = np.abs(expected).max()
            np.testing.assert_allclose(
                ours.receptance[row, :, k], expected, rtol=0.0, atol=2e-3 * scale
            )


def test_isotropic_form_is_the_limit_of_the_real_one() -> None:
    """Supports that differ by 1e-7, and a link to axial motion as weak: poles and receptances."""
    even = whole_machine(0.1)
    first, *others = even.supports
    tilted = {**first.stiffness, ("y", "y"): 1e8 * (1.0 + 1e-7)}
    linked = {**first.stiffness, ("x", "x"): 10.0, ("x", "y"): 1.0, ("y", "x"): 1.0}
    speed, grid = [0.0, 4000.0], HZ * np.linspace(100.0, 2000.0, 40)
    found = scene(even, speed, 2000.0)
    assert system_of(found).whirling
    h = responses(even, speed, grid)
    for entries in (tilted, linked):
        near = replace(even, supports=(replace(first, stiffness=entries), *others))
        other = scene(near, speed, 2000.0)
        real = system_of(other)
        assert not real.whirling
        for row in range(len(speed)):
            poles = system_of(found).modes.pole[row]
            poles = poles[(np.abs(poles.imag) > 1.0) & (np.abs(poles.imag) < HZ * 2500.0)]
            for pole in poles:
                gap = np.abs(real.modes.pole[row] - pole).min()
                assert gap < 1e-5 * abs(pole), (row, pole)
        peak = np.abs(h).max()
        np.testing.assert_allclose(responses(near, speed, grid), h, rtol=0.0, atol=1e-5 * peak)


def test_a_viscous_damper_of_equal_work_at_one_frequency() -> None:
    """Whirl at ω meets β |ω − Ω| = η: internal damping β K, and c ω = η k at supports."""
    eta, spin = 0.02, 3000.0
    lossy = whole_machine(eta)
    for omega in (1500.0, 2600.0, 3500.0, 9000.0):
        grid = np.array([omega, 1.01 * omega])
        h = responses(lossy, [0.0, spin], grid)[:, :, 0]
        dampers = tuple(
            replace(
                s,
                loss_factor=0.0,
                damping={pair: eta * float(k) / omega for pair, k in s.stiffness.items()},  # type: ignore[arg-type]
            )
            for s in lossy.supports
        )
        for row, turning, side in ((0, omega, 1.0), (1, omega - spin, 1.0), (1, omega + spin, -1)):
            viscous = replace(
                lossy,
                supports=dampers,
                loss_factor=0.0,
                rayleigh=RayleighDamping(stiffness=eta / abs(turning)),
                internal_damping=1.0,
            )
            other = responses(viscous, [0.0, spin], grid)[:, :, 0]
            whirl = [each[row, 0] + 1j * side * each[row, 2] for each in (h, other)]
            assert whirl[0] == pytest.approx(whirl[1], rel=1e-7)


def test_power_put_in_is_power_lost() -> None:
    """A force along y does the work η k ω (±|R₊|² + |R₋|²) of whirl forward and backward."""
    omega, stiff = still()
    spindle = disc(beside=(0.2 * stiff, 0.0))
    grid = omega * np.array([0.6, 0.95, 1.05, 1.09, 1.3])
    speed = [0.0, 1.02 * omega, 2.0 * omega]
    found = responses(spindle, speed, grid)
    for row, spin in enumerate(speed):
        y, z = found[row, 0], found[row, 2]
        forward, backward = 0.5 * (y + 1j * z), 0.5 * (y - 1j * z)
        given = 0.5 * (1j * grid * y).real
        parts = ETA * stiff * grid * np.array([np.abs(forward) ** 2, np.abs(backward) ** 2])
        lost = np.sign(grid - spin) * parts[0] + parts[1]
        assert (np.abs(given - lost) < 1e-3 * parts.sum(axis=0)).all()


def turning(spindle: Spindle, speed: list[float], **changes: Any) -> Any:
    spec = UnbalanceSpec(("disc",), unbalances=(Unbalance("disc", 1e-4),))
    return unbalance.solve(scene(spindle, speed, **changes), spec)


@FORMULATIONS
def test_unbalance_of_an_isotropic_rotor_bends_the_shaft_for_good(formulation: str) -> None:
    """So its loss does nothing, and the response is that without it, through the critical speed."""
    omega, stiff = still()
    outer = 2.0 * ETA * stiff / omega
    speed = (omega * np.array([0.5, 0.98, 1.0, 1.02, 3.0])).tolist()
    lossy, plain = (
        turning(disc(eta, outer), speed, formulation=formulation) for eta in (0.04, 0.0)
    )
    assert set(lossy.outcome) == {""}
    for ours, theirs in ((lossy.displacement, plain.displacement), (lossy.force, plain.force)):
        # rounding beside pins of 1e12 N/m, five decades above the shaft
        np.testing.assert_allclose(ours, theirs, rtol=0.0, atol=1e-7 * np.abs(theirs).max())


def test_unbalance_without_damping_has_no_answer_where_it_meets_the_critical_speed() -> None:
    omega, _ = still()
    exact = modes(disc(), [0.0, 2.0 * omega]).critical_speed.min()
    found = turning(disc(), [0.5 * omega, exact, 2.0 * omega])
    assert found.outcome[0] == ""
    assert "undamped critical speed" in found.outcome[1]
    assert found.outcome[2] == ""
    assert found.unstable.tolist() == [False, False, True]


def test_unbalance_on_uneven_and_lossy_supports() -> None:
    """Backward whirl moves the shaft in itself, forward whirl does not; forces of a support lag."""
    omega, stiff = still()
    beside, loss = (0.3 * stiff, 0.1 * stiff), 0.2
    spindle = disc(beside=beside, loss=loss, outer=ETA * stiff / omega)
    spins = [0.7 * omega, 1.1 * omega, 1.4 * omega]
    found = turning(spindle, spins)
    assert set(found.outcome) == {""}
    backward = 0.5 * np.array([[1.0, -1j], [1j, 1.0]])  # (Y, Z) to the part of q
    for row, spin in enumerate(spins):
        k = np.diag(beside) * (1.0 + 1j * loss) + stiff * (np.eye(2) + 1j * ETA * backward)
        z = k + (1j * spin * ETA * stiff / omega - MASS * spin**2) * np.eye(2)
        expected = np.linalg.solve(z, 1e-4 * spin**2 * np.array([1.0, -1j]))
        np.testing.assert_allclose(found.displacement[row, 0], expected, rtol=2e-3)
        at = found.support.index("aside")
        damped = np.array(beside) * (1.0 + 1j * loss) + 1j * spin * ETA * stiff / omega
        np.testing.assert_allclose(
            found.force[row, at], -damped * found.displacement[row, 0], rtol=1e-9
        )


def test_housings_carry_lossy_supports() -> None:
    """On a housing too heavy to move the machine is the one on ground; its factors act on it."""
    even = whole_machine(0.1)
    heavy = RigidHousing(
        "rock", ("l", "r"), 0.1, 1e5, {("y", "y"): 1e3, ("z", "z"): 1e3}, {}, 1e5, 1e5
    )
    housed = replace(even, housings=(heavy,))
    speed, grid = [0.0, 4000.0], HZ * np.linspace(300.0, 2000.0, 10)
    a, b = (responses(each, speed, grid) for each in (even, housed))
    np.testing.assert_allclose(b, a, rtol=0.0, atol=1e-3 * np.abs(a).max())
    ours, theirs = (modes(each, speed, 2000.0) for each in (even, housed))
    seen = [r.damping_ratio[:, [k == "bending" for k in r.kind]] for r in (ours, theirs)]
    for row in range(2):
        for ratio in seen[0][row]:
            assert np.nanmin(np.abs(seen[1][row] - ratio)) < 1e-3


def test_a_rotor_of_many_modes_begins_to_grow_at_its_first_forward_critical_speed() -> None:
    plain = whole_machine(0.0)
    spindle = replace(plain, loss_factor=0.01)
    found = modes(spindle, [0.0, 3000.0, 9000.0, 16000.0], 6000.0)
    forward = [w == "forward" for w in found.critical_whirl]
    first = found.critical_speed[forward].min()
    assert found.stability_threshold == pytest.approx(first, rel=1e-8)
    other = modes(plain, [0.0, 16000.0], 6000.0)
    seen = other.critical_speed[[w == "forward" for w in other.critical_whirl]]
    np.testing.assert_allclose(found.critical_speed[forward], seen, rtol=1e-9)


def test_a_sign_that_never_changes_drives_forward_whirl_at_rest() -> None:
    """A skew stiffness η K at every frequency, λ = ±iω √(1 − iη): forward whirl would grow at all
    speeds, at rest too, where no direction is forward; whirl back decays. Beyond the whirl's own
    frequency it is the same as ours."""
    omega, _ = still()
    found = scene(disc(), [0.0, 0.5 * omega, 2.0 * omega])
    skew = system_of(found).lossy.with_signs(Signs(-1, 0, 1)).pole
    ours = system_of(found).modes.pole

    def whirling(poles: Complex, side: float) -> Complex:
        turning = side * poles.imag / omega
        return np.array([p[(t > 0.5) & (t < 2.0)][0] for p, t in zip(poles, turning, strict=True)])

    exact = np.sqrt(1.0 - 1j * ETA)
    assert exact.imag == pytest.approx(-ETA / 2.0, rel=1e-3)
    for side in (1.0, -1.0):
        poles = whirling(skew, side) / omega
        np.testing.assert_allclose(poles, side * 1j * exact, rtol=1e-3)
        np.testing.assert_allclose(poles.real, -side * exact.imag, rtol=1e-3)
    growth = whirling(ours, 1.0).real / omega, whirling(ours, -1.0).real / omega
    np.testing.assert_allclose(growth[0], ETA / 2.0 * np.array([-1.0, -1.0, 1.0]), rtol=1e-3)
    np.testing.assert_allclose(growth[1], -ETA / 2.0, rtol=1e-3)


@pytest.mark.few(2)
@pytest.mark.parametrize("machine", [uneven, whole_machine])
@pytest.mark.parametrize("eta", [0.02, 0.5])
def test_the_number_of_modes(machine: Callable[..., Spindle], eta: float) -> None:
    """As many as dense matrices have, each with the signs of its own frequency."""
    speed, highest = [0.0, 4000.0, 9000.0], 2000.0
    found = scene(machine(eta), speed, highest, element_length=0.01)
    answered = campbell.solve(found, CampbellSpec(highest, shapes=False))
    assert set(answered.kind) == {"bending"}
    for row, spin in enumerate(speed):
        dense, count = Circular(found, row), 0
        for low, high in ((0.0, spin), (spin, HZ * highest)):
            if high > low:
                imag = dense.poles(0.5 * (low + high)).imag
                count += int(((imag > max(low, 1.0)) & (imag <= high)).sum())
        assert (answered.frequency[row] <= highest).sum() == count


def test_estimated_errors_are_those_without_losses_nearly() -> None:
    lossy, plain = (uneven(eta, eta) for eta in (1e-3, 0.0))
    spec = FrfSpec((200.0, 400.0, 900.0), ((Port("disc", "y"), Port("disc", "y")),))
    errors = []
    for spindle in (lossy, plain):
        found = scene(spindle, [0.0, 4000.0], 2000.0, accuracy=1e-3)
        errors.append(
            (
                np.nanmax(campbell.solve(found, CampbellSpec(2000.0)).frequency_error),
                frf.solve(found, spec).error[0],
            )
        )
    np.testing.assert_allclose(errors[0], errors[1], rtol=0.05)


def test_refused_by_a_description() -> None:
    skew = {("y", "y"): 1e6, ("z", "z"): 1e6, ("y", "z"): 2e5, ("z", "y"): -2e5}
    with pytest.raises(
        InvalidInput, match="needs a symmetric stiffness: given yz 200000 and zy -200000"
    ):
        LinearSupport("s", 0.0, skew, loss_factor=0.1)
    with pytest.raises(InvalidInput, match="needs a positive semidefinite stiffness"):
        LinearSupport("s", 0.0, {("y", "y"): -1.0}, loss_factor=0.1)
    with pytest.raises(InvalidInput, match="stiffness: missing key"):
        LinearSupport("s", 0.0, loss_factor=0.1)
    with pytest.raises(InvalidInput, match=r"ratio out of range: given 1\.5"):
        replace(STEPPED, loss_factor=1.5)
    semi = {("y", "y"): 1e6, ("z", "z"): 1e6, ("y", "z"): 1e6, ("z", "y"): 1e6}
    assert LinearSupport("s", 0.0, semi, loss_factor=0.1).loss_factor == 0.1


def test_read_from_a_case(tmp_path: Path) -> None:
    path = tmp_path / "case.yaml"
    path.write_text(
        "spindle: friswell_two_discs\n"
        "override: {damping.loss_factor: 1 %, supports.left.loss_factor: 0.2}\n"
        "speeds: [0 rpm]\nanalyses: {campbell: {}}\n"
    )
    spindle = rotordyn.load(path).spindle
    assert spindle is not None
    assert spindle.loss_factor == 0.01
    assert [s.loss_factor for s in spindle.supports] == [0.2, 0.0]


@pytest.mark.parametrize("stiff", [(2e7, 2e7), (2e7, 3e7)], ids=["alike", "apart"])
def test_every_mode_is_one_of_the_system_that_answers_it(
    stiff: tuple[float, float], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Modes are corrected one by one from those without loss; all modes of the whole system with
    the signs of each are the reference. None is found twice."""
    monkeypatch.delattr(Hysteretic, "_of_whole_systems")
    held = tuple(
        replace(support(name, x, stiff), loss_factor=0.1) for name, x in (("a", 0.0), ("b", 0.25))
    )
    spindle = replace(STEPPED, supports=held, loss_factor=0.05)
    own = scene(spindle, [0.0, 700.0, 6000.0], 3000.0)
    (bending,) = own.with_motions(("bending",))
    lossy, found = own.system(bending).lossy, own.system(bending).modes.pole
    assert lossy is not None
    compared = 0
    for row, spin in enumerate(own.speed):
        swinging = (np.abs(found[row].imag) > 1.0) & (np.abs(found[row].imag) < HZ * 3000.0)
        for pole in found[row][swinging]:
            turning = pole.imag if lossy.whirling else abs(pole.imag)
            signs = signs_of(np.array([turning]), np.array([spin]), whirling=lossy.whirling)
            every = lossy.with_signs(Signs(*map(int, signs[0]))).pole[row]
            every = every.conj() if pole.imag < 0.0 and not lossy.whirling else every
            assert np.abs(every - pole).min() < 1e-9 * abs(pole)
            assert (np.abs(found[row] - pole) < 1e-9 * abs(pole)).sum() == 1
            assert abs(pole.real) > 1e-4 * abs(pole)
            compared += 1
    assert compared >= 12


@pytest.mark.parametrize("spin", [1750.0, 3400.0])
def test_lossy_supports_decide_on_which_side_of_the_shaft_whirl_is(spin: float) -> None:
    """Forward whirl that is slower than the shaft without any loss and faster with that of the
    supports is answered by a shaft that it overtakes."""
    held = tuple(
        replace(support(name, x, (2e7, 2e7)), loss_factor=1.0)
        for name, x in (("a", 0.0), ("b", 0.25))
    )
    own = scene(replace(STEPPED, supports=held, loss_factor=0.05), [spin], 3000.0)
    (bending,) = own.with_motions(("bending",))
    lossy, found = own.system(bending).lossy, own.system(bending).modes.pole[0]
    assert lossy is not None
    assert lossy.whirling
    plain, led, ahead, slower = (
        lossy.with_signs(Signs(*signs)).pole[0]
        for signs in ((0, 0, 0), (0, 0, 1), (1, 0, 1), (-1, 0, 1))
    )
    (below,) = plain[(plain.imag > 0.9 * spin) & (plain.imag < spin)]
    (above,) = led[(led.imag > spin) & (led.imag < 1.15 * spin)]
    expected, other = (each[np.abs(each - above).argmin()] for each in (ahead, slower))
    assert np.abs(found - expected).min() < 1e-9 * abs(below)
    assert np.abs(found - other).min() > 1e-3 * abs(below)
