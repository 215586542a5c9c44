"""A section whose mass is not that of its material: inertia, weight and modes."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rotordyn
from bearings import Material
from rotordyn.errors import InvalidInput
from rotordyn.machine import LinearSupport, Section, Shaft, Spindle
from rotordyn.machine.inertia import mass_in_front, rotor_inertia
from rotordyn.preload.shortening import strain_integral

STEEL = Material("steel", 210e9, 0.3, 7800.0)
HEAVY = replace(STEEL, name="heavy", density=9100.0)
ROTOR = Section(0.2, 0.08, 0.02, STEEL, "rotor", rear_outer_diameter=0.07)


def spindle(middle: Section) -> Spindle:
    """``middle`` between two journals on springs."""
    journal = Section(0.1, 0.05, 0.02, STEEL)
    spring = {("y", "y"): 2e8, ("z", "z"): 1e8}
    supports = tuple(LinearSupport(n, x, stiffness=spring) for n, x in (("a", 0.05), ("b", 0.35)))
    return Spindle("s", Shaft(0.0, (journal, middle, journal)), supports=supports)


def test_inertia_is_that_of_a_material_of_this_density() -> None:
    given, made = (spindle(s) for s in (replace(ROTOR, mean_density=9100.0), _of(HEAVY)))
    assert rotor_inertia(given) == rotor_inertia(made)
    x = np.linspace(0.0, 0.4, 9)
    assert np.array_equal(mass_in_front(given.shaft, x), mass_in_front(made.shaft, x))
    assert rotor_inertia(given).mass > 1.05 * rotor_inertia(spindle(ROTOR)).mass


def test_shortening_keeps_the_material() -> None:
    shafts = [spindle(s).shaft for s in (ROTOR, replace(ROTOR, mean_density=9100.0), _of(HEAVY))]
    plain, given, made = (strain_integral(shaft, 0.0, 0.4) for shaft in shafts)
    assert given == plain
    assert abs(made) > 1.05 * abs(plain)


CASE = """
title: windings in the rotor
spindle:
  shaft:
    start: 0 mm
    material: steel_rotor
    sections:
      - {length: 100 mm, outer_diameter: 50 mm}
      - {name: rotor, length: 200 mm, outer_diameter: 80 mm, mean_density: %s}
      - {length: 100 mm, outer_diameter: 50 mm}
  supports:
    - {name: a, x: 50 mm, stiffness: {yy: 200 N/um, zz: 200 N/um}}
    - {name: b, x: 350 mm, stiffness: {yy: 200 N/um, zz: 200 N/um}}
speeds: [0 rpm, 10000 rpm]
analyses: {campbell: {max_frequency: 2000 Hz}}
"""


def test_a_case_and_its_modes(tmp_path: Path) -> None:
    """Forward, backward and still modes are those of a section of such a material."""
    (tmp_path / "case.yaml").write_text(CASE % "9.1 g/cm^3")
    case = rotordyn.load(tmp_path / "case.yaml")
    assert case.spindle is not None
    (_, rotor, _) = sections = case.spindle.shaft.sections
    assert (rotor.mean_density, rotor.density) == (9100.0, 9100.0)
    material = replace(rotor.material, density=9100.0)
    made = (sections[0], replace(rotor, material=material, mean_density=None), sections[2])
    other = replace(case.spindle, shaft=replace(case.spindle.shaft, sections=made))
    found = rotordyn.run(case)["campbell"].frequency.values
    assert np.array_equal(found, rotordyn.run(replace(case, spindle=other))["campbell"].frequency)
    path = "spindle.shaft.sections.rotor.mean_density"
    lighter = rotordyn.run(case.vary({path: "5000 kg/m^3"}))["campbell"].frequency.values
    assert (lighter[:, :2] > 1.1 * found[:, :2]).all()


def test_a_density_without_its_unit_or_out_of_range(tmp_path: Path) -> None:
    for given, why in (("9100", "no unit|unit"), ("0.5 kg/m^3", "density out of range")):
        (tmp_path / "case.yaml").write_text(CASE % given)
        with pytest.raises(InvalidInput, match=why):
            rotordyn.load(tmp_path / "case.yaml")
    with pytest.raises(InvalidInput, match="density out of range"):
        replace(ROTOR, mean_density=1e6)


def _of(material: Material) -> Section:
    return replace(ROTOR, material=material)
