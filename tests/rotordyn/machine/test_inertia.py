"""Inertia in closed form, against known bodies and against thin slices."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from rotordyn.machine.inertia import rotor_inertia
from rotordyn.machine.lumped import Disc, PointMass
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from tests.oracles.rotors import STEEL, STEPPED, uniform


def test_solid_cylinder() -> None:
    length, radius = 0.4, 0.03
    mass = STEEL.density * math.pi * radius**2 * length
    found = rotor_inertia(uniform(length, 2 * radius))
    assert found.mass == pytest.approx(mass)
    assert found.centre == pytest.approx(length / 2)
    assert found.polar == pytest.approx(mass * radius**2 / 2)
    assert found.diametral == pytest.approx(mass * (radius**2 / 4 + length**2 / 12))


def test_cutting_a_section_changes_nothing() -> None:
    parts = (Section(0.1, 0.06, 0.02, STEEL), Section(0.3, 0.06, 0.02, STEEL))
    cut = rotor_inertia(Spindle("cut", Shaft(0.0, parts)))
    whole = rotor_inertia(uniform(0.4, 0.06, inner=0.02))
    for key in ("mass", "centre", "polar", "diametral"):
        assert getattr(cut, key) == pytest.approx(getattr(whole, key))


def test_point_masses_and_discs() -> None:
    disc = Disc("disc", 0.4, 0.2, 0.06, 0.02, STEEL)
    rotor = replace(uniform(0.4, 0.06), discs=(disc,), masses=(PointMass("m", 0.0, 3.0),))
    bare, body = rotor_inertia(uniform(0.4, 0.06)), disc.as_point_mass()
    found = rotor_inertia(rotor)
    mass = bare.mass + body.mass + 3.0
    centre = (bare.mass * 0.2 + body.mass * 0.4) / mass
    assert found.mass == pytest.approx(mass)
    assert found.centre == pytest.approx(centre)
    assert found.polar == pytest.approx(bare.polar + body.polar_inertia)
    moved = bare.mass * (0.2 - centre) ** 2 + body.mass * (0.4 - centre) ** 2 + 3 * centre**2
    assert found.diametral == pytest.approx(bare.diametral + body.diametral_inertia + moved)


def test_stepped_rotor_against_slices() -> None:
    found, edges = rotor_inertia(STEPPED), STEPPED.shaft.boundaries
    thickness = (edges[-1] - edges[0]) / 32000
    x = edges[0] + thickness * (np.arange(32000) + 0.5)
    sections = [STEPPED.shaft.section_at(float(v)) for v in x]
    outer, inner, density = (
        np.array([get(s) for s in sections])
        for get in (
            lambda s: s.outer_diameter,
            lambda s: s.inner_diameter,
            lambda s: s.material.density,
        )
    )
    slices = density * math.pi / 4 * (outer**2 - inner**2) * thickness
    mass = slices.sum() + sum(m.mass for m in STEPPED.masses)
    first = (slices * x).sum() + sum(m.mass * m.x for m in STEPPED.masses)
    assert found.mass == pytest.approx(mass, rel=1e-6)
    assert found.centre == pytest.approx(first / mass, rel=1e-6)
    own = (slices * ((outer**2 + inner**2) / 16 + (x - found.centre) ** 2)).sum()
    lumped = sum(m.diametral_inertia + m.mass * (m.x - found.centre) ** 2 for m in STEPPED.masses)
    assert found.diametral == pytest.approx(own + lumped, rel=1e-6)
