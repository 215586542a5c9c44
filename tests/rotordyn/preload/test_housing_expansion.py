"""Expansion of the housing along the axis: by default that of its material in the fits."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from bearings import Material
from bearings.materials import SILICON_NITRIDE, STEEL
from rotordyn.case.model import model
from rotordyn.machine import Fits, RingGrowth, Temperatures
from rotordyn.machine.shaft import Shaft
from rotordyn.machine.sleeve import Spring
from rotordyn.machine.spindle import Spindle
from rotordyn.preload.shortening import thermal_shifts
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.spindles import ROOT, RPM
from tests.verification.test_heat_balance import FLOW

ALUMINIUM = Material("aluminium", 71e9, 0.33, 2700.0, 23.5e-6)
UNKNOWN = Material("no known one", 71e9, 0.33, 2700.0)
MATERIALS = ROOT / "models" / "materials"
SPEED = np.array([4000.0]) * RPM
WARM = Temperatures(shaft=36.0, housing=32.0)


def machine(*housings: Material, shaft: Material = STEEL) -> Spindle:
    """The grinding spindle, rigidly preloaded, each bearing fitted in a housing of its material,
    the last of which serves all others."""
    found = model("spindles", "grinding_spindle")
    around = [*housings, *housings[-1:] * len(found.seats)]
    seats = found.seats
    if housings:
        seats = tuple(
            replace(
                seat,
                bearing=replace(seat.bearing, ball_material=STEEL),
                growth=RingGrowth(),
                fits=Fits(
                    shaft="k5",
                    housing="H6",
                    bore_diameter=0.07,
                    outside_diameter=0.11,
                    housing_material=material,
                ),
            )
            for seat, material in zip(seats, around, strict=False)
        )
    sections = tuple(replace(section, material=shaft) for section in found.shaft.sections)
    return replace(
        found,
        shaft=Shaft(found.shaft.start, sections),
        seats=seats,
        sleeves=(replace(found.sleeves[0], spring=Spring(400.0, np.inf)),),
        discs=(),
    )


def test_a_machine_of_one_material_that_warms_evenly_keeps_its_place() -> None:
    even = Temperatures(shaft=60.0, housing=60.0)
    for material in (STEEL, ALUMINIUM):
        shift = thermal_shifts(machine(material, shaft=material), np.zeros(1), even)
        assert np.abs(shift).max() < 1e-18


def test_the_default_is_the_material_of_the_fits_where_it_is_one() -> None:
    def shift(spindle: Spindle, given: float | None = None) -> Any:
        return thermal_shifts(spindle, np.zeros(1), replace(WARM, housing_expansion=given))

    light, mixed = machine(ALUMINIUM), machine(ALUMINIUM, STEEL)
    assert np.array_equal(shift(light), shift(light, 23.5e-6))
    assert np.array_equal(shift(mixed), shift(mixed, 11.5e-6))
    assert np.array_equal(shift(machine()), shift(machine(), 11.5e-6))
    assert np.ptp(shift(light) - shift(light, 11.5e-6)) == pytest.approx(12e-6 * 12.0 * 0.24)


def test_heat_flow_has_it_too() -> None:
    def shifted(spindle: Spindle, given: float | None = None) -> Any:
        flow = replace(FLOW, shaft=40.0, housing=35.0, housing_expansion=given)
        return Scene(spindle, Conditions(heat_flow=flow), SPEED).preload.seat_load()

    light = machine(ALUMINIUM)
    assert shifted(light) == pytest.approx(shifted(light, 23.5e-6), rel=1e-12)
    bare = machine()
    assert (shifted(bare, 23.5e-6) > shifted(bare) + 100.0).all(), "O: a long housing loads them"


def said(spindle: Spindle, words: str, **conditions: Any) -> list[str]:
    scene = Scene(spindle, Conditions(**(conditions or {"temperatures": WARM})), SPEED)
    assert scene.preload.usable.all()
    return [each for each in scene.warnings if words in each]


def test_two_expansions_of_one_housing_are_doubted() -> None:
    def given(alpha: float) -> Temperatures:
        return replace(WARM, housing_expansion=alpha)

    light = machine(ALUMINIUM)
    for wrong in (11.5e-6, 16e-6):
        assert len(said(light, "housing expands by", temperatures=given(wrong))) == 1
    assert not said(light, "housing expands by", temperatures=given(23e-6))
    assert not said(light, "housing expands by")
    assert not said(machine(STEEL), "housing expands by", temperatures=given(10.8e-6))
    (two,) = said(machine(ALUMINIUM, STEEL), "housing expands by")
    assert "1.15e-05 1/K around bearing b and by 2.35e-05 around bearing a" in two
    flow = replace(FLOW, housing_expansion=11.5e-6)
    assert said(light, "housing expands by", heat_flow=flow)


def test_a_housing_of_unknown_material_is_doubted_where_aluminium_would_tell() -> None:
    """By the load of the machine with an aluminium housing, solved again."""
    bare, words = machine(), "the material of the housing is not given"
    warm = Temperatures(shaft=21.0, housing=21.0)
    (sentence,) = said(bare, words, temperatures=warm)
    added = float(sentence.split("add about ")[1].split(" N")[0])
    light = replace(warm, housing_expansion=23.5e-6)
    one, other = (
        Scene(bare, Conditions(temperatures=t), SPEED).preload.seat_load() for t in (warm, light)
    )
    assert added == pytest.approx(np.abs(other - one).max(), rel=0.25), "to first order"
    assert not said(bare, words, temperatures=light)
    assert not said(machine(STEEL), words)
    assert not said(bare, words, temperatures=Temperatures(shaft=24.0))
    assert not said(bare, words, temperatures=Temperatures(shaft=20.1, housing=20.1))
    assert said(bare, words, heat_flow=FLOW)


def test_materials_without_an_expansion_are_named_with_their_parts() -> None:
    words = "has no thermal_expansion"
    (sentence,) = said(machine(UNKNOWN, shaft=UNKNOWN), words)
    assert sentence.startswith("shaft and housing of no known one: ")
    assert not said(machine(UNKNOWN, shaft=UNKNOWN), words, friction=0.2)
    along = machine(UNKNOWN)  # the material of its housing is known, not the fit there
    seats = tuple(
        replace(s, fits=Fits(shaft="k5", bore_diameter=0.07, housing_material=UNKNOWN))
        for s in along.seats
    )
    (sentence,) = said(replace(along, seats=seats), words)
    assert sentence.startswith("housing of no known one: ")
    assert not said(machine(STEEL), words)
    balls = replace(SILICON_NITRIDE, thermal_expansion=None)
    bare = machine()
    seats = tuple(replace(s, bearing=replace(s.bearing, ball_material=balls)) for s in bare.seats)
    (sentence,) = said(replace(bare, seats=seats), words, heat_flow=FLOW)
    assert sentence.startswith("balls of silicon nitride: ")


@pytest.mark.parametrize("path", sorted(MATERIALS.glob("*.yaml")), ids=lambda path: path.stem)
def test_every_model_of_a_material_says_how_it_expands(path: Path) -> None:
    """Cemented carbide expands by less than half of what steel does, silicon nitride by less."""
    usual = {"cemented_carbide": (4.9e-6, 5.7e-6), "silicon_nitride": (2.5e-6, 3.5e-6)}
    alpha = model("materials", path.stem).thermal_expansion
    low, high = usual.get(path.stem, (10e-6, 13e-6))
    assert alpha is not None
    assert low <= alpha <= high
