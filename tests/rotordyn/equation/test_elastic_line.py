"""Deflection of a cantilever under line loads: closed forms of Timoshenko, in both planes."""

from __future__ import annotations

import numpy as np
import pytest

from rotordyn.equation.elastic_line import Compliance, elastic_line
from rotordyn.equation.section_forces import section_forces

LENGTH, EI, GA, EA, GI = 0.7, 3.0e4, 5.0e6, 4.0e8, 2.0e4  # m, N·m², N, N, N·m²
LOAD = 900.0  # N/m
# Largest load LOAD at the free end and at the held one, w in both rows of a line load: tip from
# bending w L⁴/(c EI) and shear w L²/(d κGA), slope w L³/(e EI).
FORMS = {
    "uniform": ((1.0, 1.0), 8.0, 2.0, 6.0),
    "to the free end": ((0.0, 1.0), 120.0 / 11.0, 3.0, 8.0),
    "to the held end": ((1.0, 0.0), 30.0, 6.0, 24.0),
}


@pytest.mark.parametrize("name", FORMS)
@pytest.mark.parametrize("elements", [1, 3])
def test_tip_under_line_loads(name: str, elements: int) -> None:
    (front, rear), bending, shear, slope = FORMS[name]
    x = LENGTH * np.linspace(0.0, 1.0, elements + 1) ** 1.5
    h = np.diff(x)
    powers = np.stack([h ** (k + 1) / (k + 1) for k in range(5)])
    give = Compliance(powers / EA, powers / GA, powers / EI, powers / GI)
    size = LOAD * (front + (rear - front) * x / LENGTH)
    moved = []
    for place in (1, 2):
        line = np.zeros((elements, 2, 3))
        line[:, 0, place], line[:, 1, place] = size[:-1], size[1:]
        forces = section_forces(x, np.zeros((elements + 1, 6)), line)
        moved.append(elastic_line(x, give, forces, line)[-1])
    tip = LOAD * LENGTH**4 / (bending * EI) + LOAD * LENGTH**2 / (shear * GA)
    turned = LOAD * LENGTH**3 / (slope * EI)
    scale = np.array([tip, tip, tip, turned, turned, turned])
    assert moved[0] / scale == pytest.approx(np.array([0, 1, 0, 0, 0, 1]), abs=1e-12)
    assert moved[1] / scale == pytest.approx(np.array([0, 0, 1, 0, -1, 0]), abs=1e-12)
