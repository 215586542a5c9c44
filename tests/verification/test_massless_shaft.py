"""Shafts that weigh almost nothing under heavy discs, against static stiffness and the discs."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.linalg import eig
from scipy.optimize import brentq

from rotordyn.analyses import CampbellSpec, Conditions
from rotordyn.analyses.campbell.result import CampbellResult
from rotordyn.analyses.solving import solve_spindle
from rotordyn.machine import Disc, LinearSupport, Section, Shaft, Spindle
from rotordyn.machine.rotor import RayleighDamping
from tests.oracles.idealised import idealised
from tests.oracles.rotors import STEEL
from tests.oracles.spindles import RPM
from tests.oracles.standard_beam import plane_bending

LENGTH, DIAMETER, HELD = 0.8, 0.04, (0.0, 0.6)
SPEEDS = (0.0, 6000.0 * RPM, 12000.0 * RPM)
TOP = 500.0  # Hz


def disc(x: float) -> Disc:
    return Disc(f"d{x * 1e3:.0f}", x, 0.3, 0.04, 0.05, STEEL)


def rotor(
    density: float, discs: tuple[float, ...], k: float, c: float, beta: float = 0.0
) -> Spindle:
    light = idealised("light", 2.1e11, 0.3, density)
    both = [{("y", "y"): value, ("z", "z"): value} for value in (k, c)]
    return Spindle(
        "light",
        Shaft(0.0, (Section(LENGTH, DIAMETER, 0.0, light),), 0.9),
        discs=tuple(disc(x) for x in discs),
        supports=tuple(LinearSupport(f"s{x * 1e3:.0f}", x, *both) for x in HELD),
        internal_damping=1.0 if beta else 0.0,
        rayleigh=RayleighDamping(0.0, beta),
    )


def truth(
    speed: float, discs: tuple[float, ...], k: float, c: float, beta: float = 0.0
) -> np.ndarray:
    """Poles of whirl r = y + i z with elements that have no mass at all."""
    x = np.unique([0.0, LENGTH, *HELD, *discs])
    size, one = 2 * len(x), np.ones(len(x) - 1)
    mass, polar, stiffness, damping = np.zeros((4, size, size))
    elements = plane_bending(
        np.diff(x), DIAMETER * one, 0.0 * one, 2.1e11 * one, 2.1e11 / 2.6 * one, one, 0.9 * one
    )
    for n, own in enumerate(elements.stiffness):
        stiffness[2 * n : 2 * n + 4, 2 * n : 2 * n + 4] += own
    turning = beta * stiffness
    for at in discs:
        body, row = disc(at).as_point_mass(), 2 * int(np.abs(x - at).argmin())
        mass[row, row], mass[row + 1, row + 1] = body.mass, body.diametral_inertia
        polar[row + 1, row + 1] = body.polar_inertia
    for at in HELD:
        row = 2 * int(np.abs(x - at).argmin())
        stiffness[row, row] += k
        damping[row, row] += c
    none, unit = np.zeros((size, size)), np.eye(size)
    pushed = -(stiffness - 1j * speed * turning), -(damping + turning - 1j * speed * polar)
    poles = eig(
        np.block([[none, unit], list(pushed)]), np.block([[unit, none], [none, mass]]), right=False
    )
    return np.asarray(poles[np.isfinite(poles) & (np.abs(poles) < 1e5)])


def solved(spindle: Spindle, **conditions: float) -> CampbellResult:
    asked = {"campbell": CampbellSpec(max_frequency=TOP)}
    own = Conditions(**conditions)  # type: ignore[arg-type]
    result = solve_spindle(spindle, own, SPEEDS, asked, lambda name: None).results["campbell"]
    assert isinstance(result, CampbellResult)
    return result


MACHINES = {
    "between": ((0.25,), 2e7, 1e3),
    "damped": ((0.25,), 2e7, 5e4),
    "soft": ((0.25,), 1e5, 50.0),
    "overhung": ((0.75,), 2e7, 1e3, 1e-5),
    "two": ((0.2, 0.7), 5e6, 2e3, 1e-5),
}


@pytest.mark.few(10)
@pytest.mark.parametrize("conditions", [{}, {"element_length": 0.05}], ids=["accuracy", "standard"])
@pytest.mark.parametrize("density", [1e-3, 1e-5, 1e-7, 1e-9])
@pytest.mark.parametrize("machine", MACHINES)
def test_poles(machine: str, density: float, conditions: dict[str, float]) -> None:
    found = solved(rotor(density, *MACHINES[machine]), **conditions)
    bends = np.array([kind == "bending" for kind in found.kind])
    for row, speed in enumerate(SPEEDS):
        omega, ratio = 2.0 * math.pi * found.frequency[row], found.damping_ratio[row]
        known = bends & np.isfinite(omega) & (omega > 1.0) & (ratio < 0.7)
        size = omega[known] / np.sqrt(1.0 - ratio[known] ** 2)
        poles = -ratio[known] * size + 1j * omega[known]
        exact = truth(speed, *MACHINES[machine])
        exact = exact.real + 1j * np.abs(exact.imag)
        apart = np.abs(poles[:, None] - exact).min(axis=1) / np.abs(poles)
        assert apart.max() < 1e-6
        swings = (-exact.real < 0.7 * np.abs(exact)) & (exact.imag > 1.0)
        inside = known & (omega < 2.0 * math.pi * TOP)
        assert inside.sum() == (swings & (exact.imag < 2.0 * math.pi * TOP)).sum()


@pytest.mark.long
@pytest.mark.parametrize("machine", ["between", "damped", "overhung", "two"])
def test_over_twelve_decades_of_density(machine: str) -> None:
    """The distance to the massless shaft falls in proportion to its mass, down to what accuracy
    and fictitious masses leave; no mode comes or goes."""
    apart = []
    for density in 10.0 ** np.arange(2.0, -11.0, -2.0):
        found, worst = solved(rotor(float(density), *MACHINES[machine])), 0.0
        bends = np.array([kind == "bending" for kind in found.kind])
        for row, speed in enumerate(SPEEDS):
            exact = truth(speed, *MACHINES[machine])
            exact = exact[(-exact.real < 0.7 * np.abs(exact)) & (np.abs(exact.imag) > 1.0)]
            exact = exact.real + 1j * np.abs(exact.imag)
            pole = found.pole[row, bends & (found.damping_ratio[row] < 0.7)]
            inside = pole[pole.imag < 2.0 * math.pi * TOP]
            assert len(inside) == (exact.imag < 2.0 * math.pi * TOP).sum()
            worst = max(worst, np.abs(inside[:, None] / exact - 1.0).min(axis=1).max())
        apart.append(float(worst))
    assert apart[0] < 1e-2
    for before, after in pairwise(apart[:4]):
        assert after < max(0.012 * before, 1e-6)
    assert max(apart[3:]) < 1e-6


@pytest.mark.few(2)
@pytest.mark.parametrize("density", [1e-3, 1e-5, 1e-7, 1e-9])
def test_threshold_of_stability(density: float) -> None:
    machine = ((0.25,), 2e7, 1e3, 2e-4)
    found = solved(rotor(density, *machine))
    exact = brentq(lambda speed: truth(speed, *machine).real.max(), 100.0 * RPM, 12000.0 * RPM)
    assert found.stability_threshold == pytest.approx(exact, rel=1e-5)
    assert np.nanmin(found.damping_ratio[-1]) < 0.0
