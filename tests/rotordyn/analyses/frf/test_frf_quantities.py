"""Receptance, mobility, inertance: derivatives of one motion, and the matrix of pairs."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import rotordyn
from bearings import Material
from rotordyn.analyses import Conditions, FrfSpec
from rotordyn.analyses.frf.result import FrequencyResponse
from rotordyn.analyses.solving import solve_spindle
from rotordyn.errors import InvalidInput
from rotordyn.machine import LinearSupport, PointMass, Section, Shaft, Spindle
from rotordyn.machine.inertia import rotor_inertia
from tests.oracles.spindles import pairs

K, C = 3e6, 900.0
STEEL = Material("steel", 210e9, 0.3, 7850.0)


def body() -> Spindle:
    ends = (("left", 0.0), ("right", 0.4))
    matrix = {("y", "y"): K / 2, ("z", "z"): K / 2}
    damper = {("y", "y"): C / 2, ("z", "z"): C / 2}
    return Spindle(
        "body",
        Shaft(0.0, (Section(0.4, 0.05, 0.0, STEEL),)),
        masses=(PointMass("disc", 0.2, 8.0),),
        supports=tuple(LinearSupport(n, x, matrix, damper) for n, x in ends),
        points={"disc": 0.2},
    )


def solved(quantity: str, conditions: Conditions | None = None) -> FrequencyResponse:
    spec = FrfSpec(tuple(np.linspace(5.0, 200.0, 40)), pairs("disc.y/disc.y"), quantity=quantity)
    own = conditions or Conditions(rotor="rigid")
    result = solve_spindle(body(), own, (0.0,), {"frf": spec}, lambda name: None).results["frf"]
    assert isinstance(result, FrequencyResponse)
    return result


@pytest.mark.parametrize(
    ("quantity", "power"), [("receptance", 0), ("mobility", 1), ("inertance", 2)]
)
def test_single_mass_closed_form(quantity: str, power: int) -> None:
    """(iω)ᵖ / (k − mω² + iωc); at resonance the mobility is 1/c."""
    result = solved(quantity)
    assert result.kind == quantity
    w, mass = 2.0 * math.pi * result.frequency, rotor_inertia(body()).mass
    closed = (1j * w) ** power / (K - mass * w**2 + 1j * w * C)
    np.testing.assert_allclose(result.response[0, 0], closed, rtol=1e-9)
    if quantity == "mobility":
        assert np.abs(result.response).max() == pytest.approx(1.0 / C, rel=0.1)


def test_error_is_over_the_largest_value_of_the_quantity() -> None:
    """Coarse elements against fine ones."""
    for quantity in ("receptance", "inertance"):
        rough = solved(quantity, Conditions(element_length=0.2))
        fine = solved(quantity, Conditions(accuracy=1e-7))
        off = np.abs(rough.response - fine.response).max() / np.abs(fine.response).max()
        assert off / 3.0 < rough.error[0] < 3.0 * off


def test_rotating_frame_has_receptances_only() -> None:
    with pytest.raises(InvalidInput, match="mobility in a frame that rotates"):
        solved("mobility", Conditions(formulation="rotating"))


def test_matrix_is_every_response_to_every_excitation(tmp_path: Path) -> None:
    path = tmp_path / "case.yaml"
    path.write_text(
        "spindle: friswell_two_discs\nspeeds: [0 rpm]\nanalyses:\n  frf:\n"
        "    frequencies: [10 Hz, 20 Hz]\n    quantity: inertance\n"
        "    pairs: [{response: left_disc.z, excitation: right_disc.z}]\n"
        "    matrix:\n      responses: [left_disc.y, left_disc.z]\n"
        "      excitations: [left_disc.y, right_disc.z]\n"
    )
    found = rotordyn.run(rotordyn.load(path))["frf"]
    assert list(found.pair.values) == [
        "left_disc.z / right_disc.z",
        "left_disc.y / left_disc.y",
        "left_disc.y / right_disc.z",
        "left_disc.z / left_disc.y",
    ]
    assert found["inertance"].attrs["units"] == "m s-2 N-1"
    assert "receptance" not in found
