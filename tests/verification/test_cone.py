"""Conical sections: closed forms of mass and deflection, Bessel functions, many cylinders."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.special import iv, jv, kv, yv

import rotordyn
from rotordyn.analyses import EccentricSpan, SectionForcesSpec, UnbalanceSpec
from rotordyn.analyses.solving import solve_spindle
from rotordyn.analyses.unbalance.loads import acting, node_loads
from rotordyn.equation.elements.beam import PlaneBending, beam_matrices, quadrature, shear_parameter
from rotordyn.equation.mesh import Mesh, build_mesh, divided, station_mesh
from rotordyn.equation.section import MIDDLE, sections_at
from rotordyn.errors import InvalidInput
from rotordyn.machine.inertia import mass_in_front, rotor_inertia
from rotordyn.machine.shaft import STEEPEST, Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.preload.shortening import strain_integral
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.loads import PointLoad
from rotordyn.scene.scene import Scene
from rotordyn.surface.rotor import rotor_surface
from tests.oracles.cylinders import cylinders
from tests.oracles.exact_shaft.count import whirl_frequencies
from tests.oracles.exact_shaft.rotor import exact_rotor
from tests.oracles.rotors import STEEL

LENGTH, THICK, THIN = 1.0, 0.0025, 0.001
CLAMP = {("y", "y"): 1e9, ("z", "z"): 1e9, ("thy", "thy"): 1e7, ("thz", "thz"): 1e7}
SPRING = {("y", "y"): 2e8, ("z", "z"): 2e8}
STRONG = Section(0.4, 0.08, 0.02, STEEL, "cone", 0.02, 0.01)
GENTLE = Section(0.4, 0.05, 0.0, STEEL, "cone", 0.0496)
RPM = math.pi / 30.0


def on_springs(*parts: Section) -> Spindle:
    held = (LinearSupport("a", 0.0, SPRING), LinearSupport("b", 0.15, SPRING))
    return Spindle("cone", Shaft(0.0, parts), supports=held)


def frequencies(
    spindle: Spindle, accuracy: float, top: float, speed: float = 0.0, **finer: int
) -> np.ndarray:
    """Whirl frequencies [rad/s], ascending."""
    scene = Scene(spindle, Conditions(accuracy=accuracy), np.array([speed]), top)
    for _ in range(finer.get("finer", 0)):
        scene = scene.refined
    pole = scene.system(scene.with_motions(["bending"])[0]).pole[0].imag
    return np.sort(pole[pole > 1.0])


def test_a_gentle_cone_is_no_mean_cylinder() -> None:
    found = frequencies(on_springs(GENTLE), 1e-6, 2000.0)[0] / (2.0 * math.pi)
    mean = frequencies(on_springs(Section(0.4, 0.0498, 0.0, STEEL)), 1e-6, 2000.0)[0]
    assert found == pytest.approx(336.0165, abs=2e-4)
    assert mean / (2.0 * math.pi) == pytest.approx(334.746, abs=2e-3)


@pytest.mark.parametrize("speed", [0.0, 20000.0 * RPM])
def test_cylinders_converge_to_the_cone(speed: float) -> None:
    """With the square of their length; extrapolated they give the cone."""
    found = frequencies(on_springs(STRONG), 1e-7, 2000.0, speed)[:6]
    coarse, fine = (
        frequencies(on_springs(*cylinders(STRONG, n)), 1e-7, 2000.0, speed)[:6] for n in (400, 800)
    )
    assert found == pytest.approx((4.0 * fine - coarse) / 3.0, rel=2e-8)


@pytest.mark.long
@pytest.mark.parametrize("side", [-1, 1])
def test_cylinders_of_the_exact_shaft(side: int) -> None:
    spin = 20000.0 * RPM
    coarse, fine = (
        whirl_frequencies(
            exact_rotor(on_springs(*cylinders(STRONG, n)), spin, np.zeros((0, 5, 5))), 2, side
        )
        for n in (250, 500)
    )
    truth = np.abs((4.0 * fine - coarse) / 3.0)
    found = frequencies(on_springs(STRONG), 1e-8, 2000.0, spin)
    assert np.abs(found[:, None] / truth - 1.0).min(axis=0).max() < 1e-7


@pytest.mark.parametrize("accuracy", [1e-2, 1e-4, 1e-6])
def test_the_taper_keeps_to_the_accuracy(accuracy: float) -> None:
    """Also where no wave asks for it: one short and steep cone, and a long wave."""
    steep = Section(0.02, 0.06, 0.0, STEEL, "steep", 0.015)
    for parts in ((STRONG,), (Section(0.38, 0.06, 0.0, STEEL), steep)):
        spindle = on_springs(*parts)
        truth = frequencies(spindle, 1e-8, 2000.0)[:4]
        assert frequencies(spindle, accuracy, 2000.0)[:4] == pytest.approx(truth, rel=accuracy)


def test_refinement_shows_the_error_of_the_taper() -> None:
    """One element, of ever higher degree: the change to the next one tells the error."""
    spindle = on_springs(STRONG)
    truth = frequencies(spindle, 1e-8, 2000.0)[:4]
    first = frequencies(spindle, 1e-2, 2000.0)[:4]
    finer = frequencies(spindle, 1e-2, 2000.0, finer=1)[:4]
    assert np.abs(first - finer).max() == pytest.approx(np.abs(first - truth).max(), rel=0.5)


def element_matrices(spindle: Spindle, mesh: Mesh, degree: int) -> PlaneBending:
    """Of every element of a mesh."""
    shear, bend, *_ = (each[:, 0] for each in sections_at(spindle, mesh, MIDDLE))
    phi = shear_parameter(mesh.length, bend, shear)
    along = sections_at(spindle, mesh, quadrature(degree)[0])
    return beam_matrices(mesh.length, phi, *along, degree=degree)


def element_frequency(parts: int, degree: int) -> float:
    """Lowest clamped-free frequency of the strong cone in equal elements of one degree."""
    spindle = Spindle("cone", Shaft(0.0, (STRONG,)))
    mesh = divided(station_mesh(spindle), np.array([parts]))
    own = element_matrices(spindle, mesh, degree)
    inner = own.mass.shape[1] - 4
    size = 2 * (parts + 1) + parts * inner
    mass, stiffness = np.zeros((2, size, size))
    for k in range(parts):
        dofs = np.r_[2 * k : 2 * k + 4, 2 * (parts + 1) + inner * k + np.arange(inner)].astype(int)
        mass[np.ix_(dofs, dofs)] += own.mass[k]
        stiffness[np.ix_(dofs, dofs)] += own.stiffness[k]
    values = np.linalg.eigvals(np.linalg.solve(stiffness[2:, 2:], mass[2:, 2:]))
    return float(values.real.max() ** -0.5)


@pytest.mark.parametrize(("degree", "parts"), [(1, 16), (2, 16), (3, 16)])
def test_elements_converge_as_their_degree_says(degree: int, parts: int) -> None:
    truth = element_frequency(8, 9)
    coarse, fine = (element_frequency(n, degree) / truth - 1.0 for n in (parts, 2 * parts))
    assert coarse > fine > 0.0
    assert math.log2(coarse / fine) == pytest.approx(2 * degree, abs=0.4)


@pytest.mark.parametrize("degree", [1, 2, 5])
def test_an_element_moves_rigidly_and_bends_evenly(degree: int) -> None:
    spindle = Spindle("cone", Shaft(0.0, (STRONG,)))
    mesh = station_mesh(spindle)
    own = element_matrices(spindle, mesh, degree)
    h, rest = STRONG.length, np.zeros(own.mass.shape[1] - 4)
    shift, tilt = np.r_[1.0, 0.0, 1.0, 0.0, rest], np.r_[0.0, 1.0, h, 1.0, rest]
    size = np.abs(own.stiffness[0]).max()
    assert np.abs(own.stiffness[0] @ np.stack([shift, tilt], axis=1)).max() < 1e-13 * size
    inertia = rotor_inertia(spindle)
    assert shift @ own.mass[0] @ shift == pytest.approx(inertia.mass, rel=1e-13)
    assert shift @ own.mass[0] @ tilt == pytest.approx(inertia.mass * inertia.centre, rel=1e-13)
    about_front = inertia.diametral + inertia.mass * inertia.centre**2
    assert tilt @ own.mass[0] @ tilt == pytest.approx(about_front, rel=1e-13)
    assert tilt @ own.polar[0] @ tilt == pytest.approx(inertia.polar, rel=1e-13)
    even = np.r_[0.0, 0.0, h * h / 2.0, h, rest]  # φ = x, v = x²/2
    mean = quad(lambda x: 2.1e11 * inertia_of(STRONG, x / h), 0.0, h)[0]
    assert even @ own.stiffness[0] @ even == pytest.approx(mean, rel=1e-12)


def inertia_of(section: Section, share: float) -> float:
    do, di = (a + share * (b - a) for a, b in (section.outer, section.inner))
    return math.pi / 64.0 * (do**4 - di**4)


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
    """Rotary inertia is 1e-5 of it."""
    section = Section(LENGTH, THICK, 0.0, STEEL, "cone", THIN)
    clamp = (LinearSupport("c", 0.0, CLAMP),)
    spindle = Spindle("cone", Shaft(0.0, (section,), "none"), supports=clamp)
    assert frequencies(spindle, 1e-7, 75.0)[::2][:3] == pytest.approx(exact(), rel=2e-5)


def test_mass_and_inertia_of_a_frustum() -> None:
    r, q, h = 0.05, 0.02, 0.12
    shaft = Shaft(0.0, (Section(h, 2 * r, 0.0, STEEL, "cone", 2 * q),))
    found = rotor_inertia(Spindle("cone", shaft))
    mass = 7800.0 * math.pi * h / 3.0 * (r * r + r * q + q * q)
    centre = h * (r * r + 2 * r * q + 3 * q * q) / (4 * (r * r + r * q + q * q))
    polar = 0.3 * mass * (r**5 - q**5) / (r**3 - q**3)
    about = quad(lambda x: 7800.0 * math.pi * ((r + (q - r) * x / h) * (x - centre)) ** 2, 0.0, h)
    assert found.mass == pytest.approx(mass, rel=1e-13)
    assert found.centre == pytest.approx(centre, rel=1e-13)
    assert found.polar == pytest.approx(polar, rel=1e-13)
    assert found.diametral == pytest.approx(polar / 2.0 + about[0], rel=1e-12)
    part = mass_in_front(shaft, np.array([-1.0, h / 3.0, h, 1.0]))
    middle = r + (q - r) / 3.0
    third = 7800.0 * math.pi * h / 9.0 * (r * r + r * middle + middle * middle)
    assert part == pytest.approx([0.0, third, mass, mass], rel=1e-13)


def test_a_conical_cantilever_under_a_load_and_its_weight() -> None:
    """Tip load F: v = F L³ / (3 E I_thick) · d_thick/d_thin, and 1/κGA; weight by quadrature."""
    h, thick, thin, force = 0.4, 0.08, 0.02, 1000.0
    held = (LinearSupport("wall", 0.0, rigid=("x", "y", "z", "thx", "thy", "thz")),)
    section = Section(h, thick, 0.0, STEEL, "cone", thin)
    spindle = Spindle("cone", Shaft(0.0, (section,), 0.9), supports=held)
    spec = SectionForcesSpec(loads=(PointLoad(h, Fy=force),), gravity="none")
    young, shear = 2.1e11, 0.9 * 2.1e11 / 2.6
    bent = force * h**3 / (3.0 * young * math.pi / 64.0 * thick**4) * thick / thin
    sheared = force * h / (shear * math.pi / 4.0 * thick * thin)
    result = solved(spindle, spec)
    assert result.deflection_y[0, -1] == pytest.approx(bent + sheared, rel=1e-12)
    assert result.outer_diameter[[0, -1]] == pytest.approx([thick, thin])

    def diameter(x: float) -> float:
        return thick + (thin - thick) * x / h

    def behind(x: float, power: int) -> float:
        """∫ρ A g (ξ − x)ᵖ dξ behind x."""
        line = 7800.0 * 9.80665 * math.pi / 4.0
        return quad(lambda s: line * diameter(s) ** 2 * (s - x) ** power, x, h)[0]

    def strain(x: float) -> float:
        turned = behind(x, 1) * (h - x) / (young * math.pi / 64.0 * diameter(x) ** 4)
        return turned + behind(x, 0) / (shear * math.pi / 4.0 * diameter(x) ** 2)

    own = solved(spindle, SectionForcesSpec(gravity="+y"))
    assert own.deflection_y[0, -1] == pytest.approx(quad(strain, 0.0, h)[0], rel=1e-5)
    assert own.bending_moment_z[0, 0] == pytest.approx(behind(0.0, 1), rel=1e-12)


def solved(spindle: Spindle, spec: SectionForcesSpec):  # type: ignore[no-untyped-def]
    asked = {"section_forces": spec}
    found = solve_spindle(spindle, Conditions(), (0.0,), asked, lambda name: None)
    return found.results["section_forces"]


def test_rods_reach_the_closed_form_of_a_horn() -> None:
    """Axial cone, free at both ends: u = Z(x)/s, tan(kL) = k L / (1 + k² a (a + L)) … by quadrature
    of cylinders: with the square of their length."""
    solid = Section(0.4, 0.08, 0.0, STEEL, "cone", 0.02)
    found = along(solid)
    a, h = 0.4 * 0.02 / 0.06, 0.4
    ends = a, a + h

    def free(k: float) -> float:
        """u = (A cos ks + B sin ks)/s with u′ = 0 at s = a and a + h."""
        rows = [
            [-k * math.sin(k * s) * s - math.cos(k * s), k * math.cos(k * s) * s - math.sin(k * s)]
            for s in ends
        ]
        return float(np.linalg.det(rows))

    wave = brentq(free, 0.7 * math.pi / h, 1.6 * math.pi / h)
    assert found == pytest.approx(wave * math.sqrt(2.1e11 / 7800.0), rel=1e-6)


def along(section: Section) -> float:
    scene = Scene(on_springs(section), Conditions(accuracy=1e-7), np.zeros(1), 9000.0)
    pole = scene.system(scene.with_motions(["axial"])[0]).pole[0].imag
    return float(pole[pole > 100.0].min())


def test_unbalance_of_a_span_acts_where_its_mass_is() -> None:
    spindle = replace(on_springs(STRONG), points={"tip": 0.4})
    spec = UnbalanceSpec(points=("tip",), spans=(EccentricSpan(0.0, 0.4, 1e-6, name="all"),))
    inertia, mesh = rotor_inertia(spindle), build_mesh(spindle)
    (whole,) = acting(spindle, mesh, spec)
    assert whole.size == pytest.approx(1e-6 * inertia.mass, rel=1e-12)
    assert whole.place.x == pytest.approx(inertia.centre, rel=1e-12)
    loads = node_loads(spindle, mesh, spec)
    assert loads[:, 0].sum() == pytest.approx(1e-6 * inertia.mass, rel=1e-12)
    moment = (loads[:, 0] * mesh.x + loads[:, 1]).sum()
    assert moment == pytest.approx(1e-6 * inertia.mass * inertia.centre, rel=1e-12)


def test_shortening_follows_the_local_diameters() -> None:
    shaft = Shaft(0.0, (STRONG,))
    fine = Shaft(0.0, cylinders(STRONG, 1000))
    for ends in ((0.0, 0.4), (0.05, 0.33), (0.3, 0.1)):
        assert strain_integral(shaft, *ends) == pytest.approx(
            strain_integral(fine, *ends), rel=1e-6
        )


def test_the_surface_of_a_cone_encloses_its_volume() -> None:
    surface = rotor_surface(on_springs(STRONG), facets=480)
    volume = rotor_inertia(on_springs(STRONG)).mass / 7800.0
    assert surface.volume("shaft") == pytest.approx(volume, rel=1e-4)


def test_a_cone_of_equal_ends_is_a_cylinder() -> None:
    plain = Section(0.4, 0.05, 0.02, STEEL)
    same = replace(plain, rear_outer_diameter=0.05, rear_inner_diameter=0.02)
    one, other = (frequencies(on_springs(each), 1e-6, 2000.0) for each in (plain, same))
    assert np.array_equal(one, other)


def test_walls_too_thin_or_steep() -> None:
    with pytest.raises(InvalidInput, match="no wall left at the rear end"):
        Section(0.1, 0.05, 0.0, STEEL, "", 0.02, 0.02)
    with pytest.raises(InvalidInput, match=f"too steep.*a ratio up to {STEEPEST:g} of either"):
        Section(0.1, 0.05, 0.0, STEEL, "", 0.05, 0.0499999)


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
    read = rotordyn.load(tmp_path / "case.yaml")
    assert read.spindle is not None
    nose, last = read.spindle.shaft.sections
    assert nose == Section(0.1, 0.03, 0.01, nose.material, "nose", 0.06, 0.02)
    assert last.outer == (0.06, 0.06)
    assert rotordyn.run(read)["campbell"].frequency.size > 0
    thicker = rotordyn.vary(read, {"spindle.shaft.sections.nose.rear_outer_diameter": "62 mm"})
    assert thicker.spindle.shaft.sections[0].outer == (0.03, 0.062)


def test_a_cone_without_a_wall_is_refused(tmp_path: Path) -> None:
    (tmp_path / "case.yaml").write_text(
        CASE % "rear_inner_diameter: 40 mm, rear_outer_diameter: 30 mm"
    )
    with pytest.raises(InvalidInput, match=r"nose: no wall left at the rear end: inner"):
        rotordyn.load(tmp_path / "case.yaml")
