"""Whirl degree, decrement and labels by closed forms."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

import rotordyn
from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.equation.dofs import DIRECTIONS
from rotordyn.machine.lumped import PointMass
from rotordyn.machine.support import LinearSupport
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.idealised import idealised
from tests.oracles.rotors import STEEL, support, uniform
from tests.oracles.spindles import RPM

LIGHT = idealised("light", 2.1e14, 0.3, 1e-3)


def test_whirl_degree_of_a_tilting_disc() -> None:
    """A disc on two uneven springs that hold its tilt: θ̈ = −κ θ ∓ Ω (Ip/Id) θ̇′.

    With a = κy − ω², b = κz − ω² the amplitudes are as iΩpω to a, and the degree is 2r/(1 + r²).
    """
    arm, mass, polar, tilted = 0.5, 50.0, 3.0, 2.0
    ky, kz, spin = 1e6, 1.5e6, 400.0
    disc = PointMass("disc", arm, mass, polar, tilted)
    held = [support(name, x, (ky, kz)) for name, x in (("a", 0.0), ("b", 2 * arm))]
    rotor = uniform(2 * arm, 0.2, LIGHT, masses=(disc,), supports=held)
    scene = Scene(rotor, Conditions(accuracy=1e-8), np.array([0.0, spin]), 100.0)
    found = campbell.solve(scene, CampbellSpec(100.0, shapes=False))
    stiff = np.array([2.0 * k * arm**2 / tilted for k in (ky, kz)])
    turn = spin * polar / tilted
    middle = 0.5 * (stiff.sum() + turn**2)
    squares = middle + np.array([-1.0, 1.0]) * math.sqrt(middle**2 - stiff.prod())
    for square, sense in zip(squares, (-1.0, 1.0), strict=True):
        omega = math.sqrt(square)
        own = int(np.abs(2.0 * math.pi * found.frequency[1] - omega).argmin())
        assert 2.0 * math.pi * found.frequency[1, own] == pytest.approx(omega, rel=1e-4)
        ratio = turn * omega / (stiff[0] - square)
        degree = 2.0 * abs(ratio) / (1.0 + ratio**2)
        assert found.whirl_degree[1, own] == pytest.approx(sense * degree, abs=1e-3)
        assert found.whirl[1, own] == sense
        assert found.rigid_share[1, own] == pytest.approx(1.0, abs=1e-4)
        assert found.character[own] == "rigid-body bending"
    assert found.whirl_degree[0] == pytest.approx(0.0, abs=1e-9)


def test_at_rest_whirl_and_shapes_are_those_of_slow_rotation() -> None:
    """On an elastic housing both planes are solved together; its modes at rest are pairs of one
    pole, of which rounding made any basis. Circular ones are exact here, at rest as at speed."""
    elastic = rotordyn.load("spindle_on_housing").variants["elastic"]
    spec = CampbellSpec(1200.0)
    case = replace(elastic, speeds=(0.0, 6000.0 * RPM), analyses={"campbell": spec})
    found = rotordyn.run(case)["campbell"]
    bent = found.kind.values == "bending"
    assert bent.sum() == 6
    names = [f"bending {k} {way}" for k in (1, 2, 3) for way in ("backward", "forward")]
    assert found.mode.values[bent].tolist() == names
    assert np.abs(found.whirl_degree.values[:, bent]) == pytest.approx(1.0, abs=1e-6)
    assert found.frequency.values[0, bent][::2] == pytest.approx(
        found.frequency.values[0, bent][1::2], rel=1e-9
    )
    along_y, along_z = (found.shape.values[0, bent][..., DIRECTIONS.index(n)] for n in ("y", "z"))
    assert np.abs(along_y) == pytest.approx(np.abs(along_z), abs=1e-6)


@pytest.mark.parametrize("ratio", [1.05, 1.5])
def test_at_rest_uneven_supports_have_planar_shapes(ratio: float) -> None:
    """However little they differ: exact, since nothing couples the planes there."""
    held = [support(name, x, (1e9, ratio * 1e9)) for name, x in (("a", 0.0), ("b", 1.0))]
    rotor = uniform(1.0, 0.01, STEEL, supports=held)
    scene = Scene(rotor, Conditions(), np.array([0.0, 500.0]), 400.0)
    found = campbell.solve(scene, CampbellSpec(400.0))
    split = np.diff(found.frequency[0])[::2] / found.frequency[0, ::2]
    assert 1e-9 < split.min() < 1e-6
    assert found.whirl_degree[0] == pytest.approx(0.0, abs=1e-4)
    across = np.abs(found.shape[0, :, :, [DIRECTIONS.index(n) for n in ("y", "z")]]).max(axis=2)
    assert across.min(axis=0) == pytest.approx(0.0, abs=1e-4)


def test_decrement_and_rigid_body_labels() -> None:
    """On soft springs the lowest modes are rigid-body motions; δ = 2πζ/√(1 − ζ²)."""
    soft = {("x", "x"): 1e4, ("y", "y"): 1e5, ("z", "z"): 1e5}
    ends = [
        LinearSupport(name, x, soft, dict.fromkeys(soft, 40.0))
        for name, x in (("a", 0.0), ("b", 1.0))
    ]
    bar = uniform(1.0, 0.05, STEEL, supports=ends)
    scene = Scene(bar, Conditions(), np.array([0.0, 500.0]), 3000.0)
    found = campbell.solve(scene, CampbellSpec(3000.0, shapes=False))
    ratio = found.damping_ratio
    assert (ratio > 0.0)[:, np.array(found.kind) != "torsion"].all()
    expected = 2.0 * math.pi * ratio / np.sqrt(1.0 - ratio**2)
    assert found.decrement == pytest.approx(expected, rel=1e-9, abs=1e-12)
    labels = dict(zip(found.mode, found.character, strict=True))
    for name, label in {
        "bending 1 forward": "rigid-body bending",
        "bending 2 backward": "rigid-body bending",
        "bending 3 forward": "bending",
        "axial 1": "rigid-body axial",
        "axial 2": "axial",
        "torsion 1": "torsion",
    }.items():
        assert labels[name] == label
    along = int(found.mode.index("axial 1"))
    mass = STEEL.density * math.pi * 0.05**2 / 4.0
    pole = np.roots([mass, 80.0, 2e4])[0]
    assert 2.0 * math.pi * found.frequency[0, along] == pytest.approx(abs(pole.imag), rel=1e-5)
    assert found.decrement[0, along] == pytest.approx(
        -2.0 * math.pi * pole.real / abs(pole.imag), rel=1e-4
    )


def test_a_rotor_has_four_rigid_body_modes_of_bending_at_most() -> None:
    """On stiff springs the rigid motions are in more modes; the four largest shares are given."""
    held = [support("a", 0.085, (1e9, 1e9)), support("b", 0.515, (6e8, 4e8))]
    disc = PointMass("disc", 0.0, 5.0, 0.1, 0.075)
    rotor = uniform(0.645, 0.1, STEEL, inner=0.062, masses=(disc,), supports=held)
    scene = Scene(rotor, Conditions(), np.array([0.0]), 2500.0)
    found = campbell.solve(scene, CampbellSpec(2500.0, shapes=False))
    share = found.rigid_share[0]
    assert (share > 0.5).sum() == 5
    called = [k for k, word in enumerate(found.character) if word == "rigid-body bending"]
    assert sorted(called) == sorted(np.argsort(-share)[:4].tolist())
