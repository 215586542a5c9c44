"""Conical sections: mass in closed form, frequencies by Bessel functions, rate of the steps."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import iv, jv, kv, yv

import rotordyn
from rotordyn.analysis.scene import Scene
from rotordyn.analysis.specs import Conditions
from rotordyn.errors import InvalidInput
from rotordyn.machine.cone import MOST, STEP, cone
from rotordyn.machine.inertia import rotor_inertia
from rotordyn.machine.shaft import Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from tests.oracles.rotors import STEEL

LENGTH, THICK, THIN = 1.0, 0.0025, 0.001
CLAMP = {("y", "y"): 1e9, ("z", "z"): 1e9, ("thy", "thy"): 1e7, ("thz", "thz"): 1e7}


def made(step: float) -> Spindle:
    """A slender frustum, clamped at its thick end."""
    sections = cone(LENGTH, (THICK, THIN), (0.0, 0.0), STEEL, step=step)
    return Spindle("cone", Shaft(0.0, sections), supports=(LinearSupport("c", 0.0, CLAMP),))


def frequencies(step: float) -> np.ndarray:
    scene = Scene(made(step), Conditions(accuracy=1e-7), np.zeros(1), 75.0)
    pole = scene.system(scene.with_motions(("bending",))[0]).pole[0].imag
    return np.sort(pole[pole > 1.0])[:6:2]  # both whirls of each mode are alike


def exact() -> np.ndarray:
    """Clamped–free frustum (Euler–Bernoulli), d ~ s from its tip: v = s⁻¹ Z₂(2 √(β s)).

    With Z any of J₂, Y₂, I₂, K₂, from d/ds of s^(−n/2) Z_n(2√(βs)), v′ ~ s^(−3/2) Z₃ and, with the
    moment EI v″ ~ s² Z₄ and the shear (EI v″)′ ~ s^(3/2) Z₃, up to powers of β and signs.
    """
    tip = LENGTH * THIN / (THICK - THIN)
    wave = math.sqrt(7800.0 * 16.0 / 2.1e11) * tip / THIN  # β = √(ρ A / E I) s ω at any s

    def determinant(omega: float) -> float:
        beta = omega * wave
        near, far = (2.0 * math.sqrt(beta * s) for s in (tip, tip + LENGTH))
        clamped = [
            [jv(2, far), yv(2, far), iv(2, far), kv(2, far)],
            [-jv(3, far), -yv(3, far), iv(3, far), -kv(3, far)],
        ]
        free = [
            [jv(4, near), yv(4, near), iv(4, near), kv(4, near)],
            [jv(3, near), yv(3, near), iv(3, near), -kv(3, near)],
        ]
        rows = np.array(clamped + free)
        return float(np.linalg.det(rows / np.abs(rows).max(axis=0)))

    grid = np.linspace(2.0, 375.0, 3000)
    values = [determinant(w) for w in grid]
    crossed = np.flatnonzero(np.sign(values[:-1]) != np.sign(values[1:]))
    return np.array([brentq(determinant, grid[k], grid[k + 1], xtol=1e-12) for k in crossed[:3]])


def test_a_cantilever_in_bessel_functions() -> None:
    assert frequencies(STEP) == pytest.approx(exact(), rel=2e-4)


def test_the_steps_err_with_their_square() -> None:
    coarse, half, fine = (frequencies(step) for step in (0.16, 0.08, 0.01))
    ratio = (coarse - fine) / (half - fine)
    assert ratio == pytest.approx([4.0] * 3, rel=0.15)
    assert np.abs(frequencies(STEP) / fine - 1.0).max() < 2e-4


def test_mass_and_inertia_of_a_frustum() -> None:
    r, q, h = 0.05, 0.02, 0.12
    sections = cone(h, (2 * r, 2 * q), (0.0, 0.0), STEEL)
    found = rotor_inertia(Spindle("cone", Shaft(0.0, sections)))
    mass = 7800.0 * math.pi * h / 3.0 * (r * r + r * q + q * q)
    assert found.mass == pytest.approx(mass, rel=1e-12)
    assert found.polar == pytest.approx(0.3 * mass * (r**5 - q**5) / (r**3 - q**3), rel=1e-4)
    centre = h * (r * r + 2 * r * q + 3 * q * q) / (4 * (r * r + r * q + q * q))
    assert found.centre == pytest.approx(centre, rel=2e-4)


def test_a_cone_of_equal_ends_is_a_cylinder() -> None:
    (one,) = cone(0.1, (0.05, 0.05), (0.02, 0.02), STEEL, "a")
    assert (one.length, one.outer_diameter, one.inner_diameter, one.name) == (0.1, 0.05, 0.02, "a")


def test_walls_too_thin_or_steep() -> None:
    with pytest.raises(InvalidInput, match="no wall left at the rear end"):
        cone(0.1, (0.05, 0.02), (0.0, 0.02), STEEL)
    with pytest.raises(InvalidInput, match=f"too steep for {MOST} cylinders"):
        cone(0.1, (0.05, 0.05), (0.0, 0.0499999), STEEL)


CASE = """
title: shaft with a conical end
spindle:
  shaft:
    start: 0 mm
    material: steel_rotor
    sections:
      - {name: nose, length: 100 mm, outer_diameter: 30 mm, %s}
      - {length: 0.3 m, outer_diameter: 60 mm}
  supports:
    - {name: front, x: 120 mm, stiffness: {yy: 30 N/um, zz: 30 N/um}}
    - {name: rear, x: 350 mm, stiffness: {yy: 30 N/um, zz: 30 N/um}}
speeds: [0 rpm]
analyses: {campbell: {max_frequency: 800 Hz}}
"""


def test_a_cone_in_a_case(tmp_path: Path) -> None:
    rear = "inner_diameter: 10 mm, rear_outer_diameter: 60 mm, rear_inner_diameter: 20 mm"
    (tmp_path / "case.yaml").write_text(CASE % rear)
    case = rotordyn.load(tmp_path / "case.yaml")
    assert case.spindle is not None
    *nose, last = case.spindle.shaft.sections
    by_hand = cone(0.1, (0.03, 0.06), (0.01, 0.02), nose[0].material, "nose")
    assert nose == [replace(each) for each in by_hand]
    assert last.outer_diameter == 0.06
    assert rotordyn.run(case)["campbell"].frequency.size > 0


def test_a_cone_without_a_wall_is_refused(tmp_path: Path) -> None:
    (tmp_path / "case.yaml").write_text(CASE % "rear_inner_diameter: 40 mm")
    with pytest.raises(InvalidInput, match=r"nose: no wall left at the rear end: inner"):
        rotordyn.load(tmp_path / "case.yaml")
