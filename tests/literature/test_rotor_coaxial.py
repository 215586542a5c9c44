"""Friswell, Penny, Garvey, Lees: Dynamics of Rotating Machines (2010), the co-axial rotor.

Dimensions of its Tables 6.1 and 6.2; the book plots its frequencies. The values are those of an
independent finite-element code, ROSS 2.3.0, in eight elements between two nodes of the book, the
gyroscopic matrix of its outer rotor times the speed ratio; four elements differ by 2e-6 at most.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.coaxial import COAXIAL, OUTER
from tests.oracles.spindles import RPM, all_poles, system_of

HIGHEST = 360.0
PUBLISHED = {
    (1.5, 0.0): [88.8404, 91.8069, 184.0818, 197.4787, 272.1763, 318.3202, 318.4803, 345.1483],
    (1.5, 5000.0): [68.7173, 114.2139, 177.0509, 200.1813, 271.0753, 283.2055, 323.3984, 344.0548],
    (1.5, 9000.0): [55.2967, 131.4613, 165.6306, 202.6321, 251.0621, 272.7444, 300.4847, 336.0041],
    (1.5, 15000.0): [41.203, 144.6103, 151.4872, 201.7366, 214.9396, 270.3164, 280.5183, 323.933],
    (-1.5, 9000.0): [61.9383, 110.4677, 182.7969, 191.2051, 249.1324, 280.3567, 299.4679, 335.9396],
}


@pytest.mark.parametrize(("ratio", "rpm"), PUBLISHED)
def test_frequencies_of_the_coaxial_rotor(ratio: float, rpm: float) -> None:
    machine = replace(COAXIAL, rotors=(replace(OUTER, speed_ratio=ratio),))
    scene = Scene(machine, Conditions(accuracy=1e-7), np.array([rpm]) * RPM, HIGHEST)
    pole = system_of(scene).pole[0]
    found = np.sort(pole.imag[pole.imag > 1.0])[:8] / (2.0 * np.pi)
    assert found == pytest.approx(PUBLISHED[ratio, rpm], rel=2e-6)


def test_critical_speeds_meet_the_lines_of_both_rotors() -> None:
    speed = np.linspace(0.0, 15000.0, 7) * RPM
    scene = Scene(COAXIAL, Conditions(accuracy=1e-6), speed, HIGHEST)
    found = campbell.solve(scene, CampbellSpec(HIGHEST))
    assert found.rotor == ("spindle", "outer")
    assert found.speed_ratio.tolist() == [1.0, 1.5]
    assert {"spindle", "outer"} == set(found.critical_rotor)
    for name, at in zip(found.critical_rotor, found.critical_speed, strict=True):
        one = Scene(COAXIAL, Conditions(accuracy=1e-6), np.array([at, speed[-1]]), HIGHEST)
        turned = at * {"spindle": 1.0, "outer": 1.5}[name]
        poles = all_poles(one)
        assert np.abs(poles / (1j * turned) - 1.0).min() < 1e-9
