"""The same rotor seen from a rotating frame: every whirl frequency shifts by −Ω, exactly.

With r = ρ e^{iΩt} the translational kinetic energy brings Coriolis terms and −Ω² M_ω; of the
rotations, whose velocities in the rotating frame add Ω likewise, remain (2 Jd − Jp) and
−Ω² (Jd − Jp): only translation softens, rotary inertia of a slender ring stiffens.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import eigvals

from rotordyn.equation.mesh import build_mesh
from rotordyn.machine.support import LinearSupport
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.formulation import SOFTENED
from rotordyn.scene.scene import Scene
from tests.oracles.dense_rotor.assemble import add_at_nodes, bending_plane
from tests.oracles.rotors import STEPPED
from tests.oracles.spindles import system_of
from tests.oracles.whirl import by_modulus, whirl_frequencies

MESH = build_mesh(STEPPED, 0.02)
PLANE = bending_plane(STEPPED, MESH)
SPRING = np.array([[2e8, -2e6], [-2e6, 3e5]])
STIFFNESS = add_at_nodes(PLANE.stiffness, (5, MESH.nodes - 2), np.array([SPRING, SPRING]))
SPIN = 2500.0


def turning_frame(spin: float) -> np.ndarray:
    """Frequencies seen from the frame that rotates with the rotor, ascending."""
    translation, rotary = PLANE.translational_mass, PLANE.mass - PLANE.translational_mass
    coriolis = spin * (2 * translation + 2 * rotary - PLANE.polar)
    stiffness = STIFFNESS - spin**2 * translation + spin**2 * (PLANE.polar - rotary)
    zero, one = np.zeros_like(stiffness), np.eye(len(stiffness))
    # (K′ − ω C′ − ω² M) ρ = 0
    pencil = np.block([[zero, one], [stiffness, -coriolis]])
    inverse = eigvals(np.linalg.solve(pencil, np.block([[one, zero], [zero, PLANE.mass]])))
    assert np.abs(inverse.imag).max() < 1e-6 * np.abs(inverse).max()
    return np.sort(1.0 / inverse.real)


@pytest.mark.parametrize("spin", [SPIN, -SPIN, 4 * SPIN])
def test_frequencies_shift_by_the_spin(spin: float) -> None:
    inertial = np.sort(whirl_frequencies(PLANE.mass, PLANE.polar, STIFFNESS, spin))
    middle = slice(len(inertial) // 2 - 8, len(inertial) // 2 + 8)
    shifted = turning_frame(spin)
    for frequency in inertial[middle]:
        assert np.abs(shifted + spin - frequency).min() < 1e-9 * abs(frequency)


def test_without_coriolis_terms_it_is_wrong() -> None:
    """What subtracting −Ω² M_ω alone does to the first mode: several per cent."""
    softened = STIFFNESS - SPIN**2 * PLANE.translational_mass
    wrong = whirl_frequencies(PLANE.mass, PLANE.polar, softened, SPIN)
    right = whirl_frequencies(PLANE.mass, PLANE.polar, STIFFNESS, SPIN)
    first = slice(0, 2)
    assert (np.abs(wrong[first]) < 0.99 * np.abs(by_modulus(right)[first])).all()


def test_softened_frequencies_of_a_case() -> None:
    """What the formulation `fixed-frame softening` solves, beside dense matrices."""
    held = (5, MESH.nodes - 2)
    supports = tuple(
        LinearSupport(f"s{k}", float(MESH.x[k]), {(w, w): 2e8 for w in "yz"}) for k in held
    )
    spring = np.array([[2e8, 0.0], [0.0, 0.0]])
    stiffness = add_at_nodes(PLANE.stiffness, held, np.array([spring, spring]))
    softened = stiffness - SPIN**2 * PLANE.translational_mass
    dense = np.sort(np.abs(whirl_frequencies(PLANE.mass, PLANE.polar, softened, SPIN)))[:4]
    machine = replace(STEPPED, supports=supports)
    asked = Conditions(formulation=SOFTENED, element_length=0.02)
    scene = Scene(machine, asked, np.array([SPIN]), 3000.0)
    found = np.sort(np.abs(system_of(scene).modes.pole[0].imag))
    assert np.unique(found.round(3))[:4] == pytest.approx(dense, rel=1e-3)
