"""A free rotor moves as a rigid body: six motions without strain, with the inertia of its parts."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bearings.materials import Material
from rotordyn.equation.mesh import build_mesh
from rotordyn.machine.inertia import rotor_inertia
from rotordyn.machine.lumped import PointMass
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from tests.oracles.dense_rotor.assemble import RotorMatrices, bending_plane, rotor_matrices
from tests.oracles.dense_rotor.selection import ALL
from tests.oracles.rotors import STEPPED
from tests.oracles.whirl import frequencies_at_rest


def motions(x: np.ndarray, centre: float) -> dict[str, np.ndarray]:
    """The six rigid motions about the centre of gravity, each as a vector of all DOF."""
    shapes = {name: np.zeros((len(x), 6)) for name in ALL.names}
    for column, name in enumerate(ALL.names):
        shapes[name][:, column] = 1.0
    shapes["thy"][:, 2] = -(x - centre)
    shapes["thz"][:, 1] = x - centre
    return {name: shape.ravel() for name, shape in shapes.items()}


def relative_strain(rotor: RotorMatrices, vector: np.ndarray) -> float:
    """Force left by a motion, over what single DOF would need."""
    return float(
        (
            np.abs(rotor.stiffness @ vector) / (np.abs(rotor.stiffness) @ np.abs(vector) + 1e-300)
        ).max()
    )


def assert_rigid_body(spindle: Spindle, element_length: float | None = None) -> None:
    mesh, inertia = build_mesh(spindle, element_length), rotor_inertia(spindle)
    rotor = rotor_matrices(spindle, mesh)
    rigid = motions(mesh.x, inertia.centre)
    expected = {
        **dict.fromkeys(("x", "y", "z"), inertia.mass),
        "thx": inertia.polar,
        **dict.fromkeys(("thy", "thz"), inertia.diametral),
    }
    basis = np.array([rigid[name] for name in ALL.names])
    sizes = np.array([expected[name] for name in ALL.names])
    scale = np.sqrt(np.outer(sizes, sizes))
    assert basis @ rotor.mass @ basis.T / scale == pytest.approx(np.eye(6), abs=1e-9)
    assert max(relative_strain(rotor, vector) for vector in basis) < 1e-9
    turning = basis @ rotor.gyroscopic @ basis.T
    skew = np.zeros((6, 6))
    skew[4, 5], skew[5, 4] = inertia.polar, -inertia.polar
    assert turning / inertia.polar == pytest.approx(skew / inertia.polar, abs=1e-8)


def test_stepped() -> None:
    assert_rigid_body(STEPPED, 0.008)


def test_exactly_six_zero_frequencies() -> None:
    rotor = rotor_matrices(STEPPED, build_mesh(STEPPED, 0.02))
    found = frequencies_at_rest(rotor.mass, rotor.stiffness)
    assert (found[:6] < 1e-4 * found[6]).all()
    assert found[6] > 1e3


def test_translational_mass_is_what_translates_across_the_axis() -> None:
    mesh, inertia = build_mesh(STEPPED), rotor_inertia(STEPPED)
    rotor = rotor_matrices(STEPPED, mesh)
    rigid = motions(mesh.x, inertia.centre)
    assert rigid["y"] @ rotor.translational_mass @ rigid["y"] == pytest.approx(inertia.mass)
    assert rigid["z"] @ rotor.translational_mass @ rigid["z"] == pytest.approx(inertia.mass)
    assert not (rotor.translational_mass @ rigid["x"]).any()
    assert not (rotor.translational_mass @ rigid["thx"]).any()
    bodies = sum(m.diametral_inertia for m in STEPPED.lumped)
    rotary = sum(
        s.material.density * s.length * np.pi * (s.outer_diameter**4 - s.inner_diameter**4) / 64
        for s in STEPPED.shaft.sections
    )
    tilted = rigid["thz"] @ rotor.translational_mass @ rigid["thz"]
    assert tilted == pytest.approx(inertia.diametral - rotary - bodies)


materials = st.builds(
    Material,
    st.just("any"),
    st.floats(1e9, 6e11),
    st.floats(0.0, 0.49),
    st.floats(1e3, 2e4),
)


@st.composite
def spindles(draw: st.DrawFn) -> Spindle:
    """1–20 sections, bored or solid, length over diameter 0.05–1000, with two point masses."""
    count = draw(st.integers(1, 20))
    diameter = draw(st.floats(0.01, 0.5))
    length = min(diameter * 10 ** draw(st.floats(np.log10(0.05), 3.0)), 100.0)
    parts = np.array(draw(st.lists(st.floats(0.05, 1.0), min_size=count, max_size=count)))
    sections = tuple(
        Section(part, outer, outer * draw(st.floats(0.0, 0.95)), draw(materials))
        for part in map(float, length * parts / parts.sum())
        for outer in [diameter * draw(st.floats(0.3, 1.0))]
    )
    start = draw(st.floats(-1.0, 0.0)) * length
    masses = tuple(
        PointMass(name, start + draw(st.integers(0, 16)) / 16 * length, draw(st.floats(0.0, 5.0)))
        for name in "ab"
    )
    return Spindle("random", Shaft(start, sections), masses=masses)


def semi_definite(matrix: np.ndarray, tolerance: float) -> bool:
    """No negative eigenvalue, rows scaled to a unit diagonal."""
    scale = 1.0 / np.sqrt(np.where(np.diag(matrix) > 0, np.diag(matrix), 1.0))
    return bool(np.linalg.eigvalsh(scale[:, None] * matrix * scale)[0] > -tolerance)


@settings(max_examples=60, deadline=None)
@given(spindles())
def test_any_rotor(spindle: Spindle) -> None:
    length = (spindle.shaft.end - spindle.shaft.start) / 10
    assert_rigid_body(spindle, length)
    plane = bending_plane(spindle, build_mesh(spindle, length))
    for matrix in (plane.mass, plane.polar, plane.stiffness, plane.translational_mass):
        assert (matrix == matrix.T).all()
        assert semi_definite(matrix, 1e-12)
    assert np.linalg.eigvalsh(plane.mass)[0] > 0.0
