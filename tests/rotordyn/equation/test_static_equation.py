"""The shaft at rest: closed forms under line loads, exact cones, short and many sections."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from rotordyn.equation.mesh import build_mesh
from rotordyn.equation.static_equation import LoadCase, StaticEquation, Undetermined
from rotordyn.equation.term import State
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from tests.oracles.stepped_rotors import STEEL

LENGTH, DIAMETER, KAPPA = 0.7, 0.03, 0.8
E, G = STEEL.young_modulus, STEEL.young_modulus / 2.6
AREA, INERTIA = np.pi / 4 * DIAMETER**2, np.pi / 64 * DIAMETER**4
LOAD = 900.0  # N/m
WALL = LinearSupport("wall", 0.0, rigid=("x", "y", "z", "thx", "thy", "thz"))
AT_REST = State(np.zeros(1), np.zeros((1, 0, 6, 6)), np.zeros((1, 0), dtype=bool))
# Largest load LOAD at the free end and at the held one, w in both rows of a line load: tip from
# bending w L⁴/(c EI) and shear w L²/(d κGA), slope w L³/(e EI).
FORMS = {
    "uniform": ((1.0, 1.0), 8.0, 2.0, 6.0),
    "to the free end": ((0.0, 1.0), 120.0 / 11.0, 3.0, 8.0),
    "to the held end": ((1.0, 0.0), 30.0, 6.0, 24.0),
}


def shaft(*sections: Section, supports: tuple[LinearSupport, ...] = (WALL,)) -> Spindle:
    return Spindle("shaft", Shaft(0.0, sections, KAPPA), supports=supports)


def equation(spindle: Spindle) -> StaticEquation:
    return StaticEquation(spindle, build_mesh(spindle), np.zeros((0, 6)))


def loaded(spindle: Spindle, force: np.ndarray, line: np.ndarray | None = None) -> np.ndarray:
    """Displacements (nodes, 6) by ``force`` (6,) on the rear end, and a line load."""
    solver = equation(spindle)
    point = np.zeros((1, solver.mesh.nodes, 6))
    point[0, -1] = force
    none = np.zeros((solver.mesh.nodes - 1, 2, 3))
    case = LoadCase(point, none if line is None else line)
    return solver.solve(AT_REST, [case])[0].displacement[0]


@pytest.mark.parametrize("name", FORMS)
def test_tip_of_a_cantilever_under_line_loads(name: str) -> None:
    (front, rear), bending, shear, slope = FORMS[name]
    spindle = shaft(Section(0.2, DIAMETER, 0.0, STEEL), Section(0.5, DIAMETER, 0.0, STEEL))
    x = build_mesh(spindle).x
    size = LOAD * (front + (rear - front) * x / LENGTH)
    moved = []
    for place in (1, 2):
        line = np.zeros((len(x) - 1, 2, 3))
        line[:, 0, place], line[:, 1, place] = size[:-1], size[1:]
        moved.append(loaded(spindle, np.zeros(6), line)[-1])
    tip = LOAD * LENGTH**4 / (bending * E * INERTIA) + LOAD * LENGTH**2 / (shear * KAPPA * G * AREA)
    turned = LOAD * LENGTH**3 / (slope * E * INERTIA)
    scale = np.array([tip, tip, tip, turned, turned, turned])
    assert moved[0] / scale == pytest.approx(np.array([0, 1, 0, 0, 0, 1]), abs=1e-11)
    assert moved[1] / scale == pytest.approx(np.array([0, 0, 1, 0, -1, 0]), abs=1e-11)


@pytest.mark.parametrize("rear", [0.005, 0.029, 0.2])
def test_a_cone_gives_as_its_strain_integrated(rear: float) -> None:
    """Tip of a conical cantilever under forces and moments, by quadrature of its strain."""
    cone = Section(LENGTH, DIAMETER, 0.0, STEEL, rear_outer_diameter=rear)

    def give(power: int, arm: int) -> float:
        """∫ (L − x)^arm / d^power dx."""
        at = lambda x: (LENGTH - x) ** arm / (DIAMETER + (rear - DIAMETER) * x / LENGTH) ** power  # noqa: E731
        return quad(at, 0.0, LENGTH, epsrel=1e-12)[0]

    bending, area = 64.0 / (np.pi * E), 4.0 / np.pi
    tip = bending * give(4, 2) + area / (KAPPA * G) * give(2, 0)
    wanted = {
        (0, 0): area / E * give(2, 0),
        (1, 1): tip,
        (1, 5): bending * give(4, 1),
        (2, 2): tip,
        (2, 4): -bending * give(4, 1),
        (3, 3): 32.0 / (np.pi * G) * give(4, 0),
        (5, 5): bending * give(4, 0),
    }
    flexibility = np.array([loaded(shaft(cone), unit)[-1] for unit in np.eye(6)]).T
    for place, value in wanted.items():
        assert flexibility[place] == pytest.approx(value, rel=2e-8), place


@pytest.mark.parametrize("short", [1e-3, 1e-5, 1e-6, 2e-7])
def test_a_short_section_takes_no_digits(short: float) -> None:
    """A beam cut twice at next to the same place deflects as the whole."""
    pieces = (0.3, short, LENGTH - 0.3 - short)
    moved = loaded(
        shaft(*(Section(piece, DIAMETER, 0.0, STEEL) for piece in pieces)),
        np.array([0.0, 100.0, 0.0, 0.0, 0.0, 0.0]),
    )
    tip = 100.0 * (LENGTH**3 / (3.0 * E * INERTIA) + LENGTH / (KAPPA * G * AREA))
    assert moved[-1, 1] == pytest.approx(tip, rel=1e-11)


def test_ten_thousand_sections() -> None:
    pieces = (Section(LENGTH / 10_000, DIAMETER, 0.0, STEEL),) * 10_000
    moved = loaded(shaft(*pieces), np.array([0.0, 100.0, 0.0, 0.0, 0.0, 0.0]))
    tip = 100.0 * (LENGTH**3 / (3.0 * E * INERTIA) + LENGTH / (KAPPA * G * AREA))
    assert moved[-1, 1] == pytest.approx(tip, rel=1e-9)


def beside_a_wall(distance: float) -> Spindle:
    """A cantilever with a second wall beside the first, at a ``distance`` over its length."""
    second = replace(WALL, name="beside", x=distance * LENGTH)
    return shaft(Section(LENGTH, DIAMETER, 0.0, STEEL), supports=(WALL, second))


@pytest.mark.parametrize("distance", [1e-2, 1e-5, 4e-7])
def test_a_second_wall_beside_the_first_takes_no_digits(distance: float) -> None:
    """The shaft deflects as one held by the second wall alone."""
    moved = loaded(beside_a_wall(distance), np.eye(6)[1])
    arm = (1.0 - distance) * LENGTH
    tip = arm**3 / (3.0 * E * INERTIA) + arm / (KAPPA * G * AREA)
    assert moved[-1, 1] == pytest.approx(tip, rel=1e-9)


def test_rigid_supports_that_elasticity_does_not_distinguish_are_undetermined() -> None:
    with pytest.raises(Undetermined):
        loaded(beside_a_wall(1e-8), np.eye(6)[1])


def test_a_shaft_goes_the_other_way_than_its_rings_are_offset() -> None:
    """Two rigid rings, thicker by e on one side, move the shaft by −e there, straight between."""
    pin = LinearSupport("pin", 0.0, rigid=("x", "y", "z", "thx"))
    slide = LinearSupport("slide", LENGTH, rigid=("y", "z"))
    solver = equation(shaft(Section(LENGTH, DIAMETER, 0.0, STEEL), supports=(pin, slide)))
    none, offset = np.zeros((1, solver.mesh.nodes, 6)), np.zeros((2, 6))
    offset[:, 1] = 3e-6, -1e-6
    line = np.zeros((solver.mesh.nodes - 1, 2, 3))
    moved = solver.solve(AT_REST, [LoadCase(none, line, offset)])[0].displacement[0, :, 1]
    assert moved == pytest.approx(np.interp(solver.mesh.x, [0.0, LENGTH], [-3e-6, 1e-6]), abs=1e-17)


def test_nothing_holds_the_shaft() -> None:
    with pytest.raises(Undetermined):
        loaded(shaft(Section(LENGTH, DIAMETER, 0.0, STEEL), supports=()), np.eye(6)[1])
