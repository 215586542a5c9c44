"""Axial shift of the seats: prescribed, and the closed form against plain quadrature."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad

from rotordyn.machine.growth import ComputedShortening, PrescribedShortening
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.preload.shortening import seat_shifts, strain_integral
from tests.oracles.rotors import STEPPED
from tests.oracles.spindles import TOP, mfw2310


def strain(shaft: Shaft, x: float) -> float:
    """−ν ρ (ro² + ri²) / (2 E) at ``x``, per Ω²."""
    s = shaft.section_at(x)
    m = s.material
    radii = (s.outer_diameter / 2) ** 2 + (s.inner_diameter / 2) ** 2
    return -m.poisson_ratio * m.density * radii / (2 * m.young_modulus)


@pytest.mark.parametrize("shaft", [STEPPED.shaft, mfw2310().shaft], ids=["stepped", "mfw2310"])
@pytest.mark.parametrize(("start", "end"), [(0.02, 0.25), (0.2, -0.04), (0.0, 0.0), (0.01, 0.02)])
def test_closed_form_equals_quadrature(shaft: Shaft, start: float, end: float) -> None:
    edges = [x for x in shaft.boundaries if min(start, end) < x < max(start, end)]
    expected = quad(lambda x: strain(shaft, x), start, end, points=edges or None, epsabs=1e-30)[0]
    assert strain_integral(shaft, start, end) == pytest.approx(expected, rel=1e-10, abs=1e-25)


def test_free_hollow_cylinder_shortens() -> None:
    """−ν ρ Ω² (ro² + ri²) L / (2 E): negative away from the reference on both sides."""
    steel = STEPPED.shaft.sections[0].material
    shaft = Shaft(0.0, (Section(0.4, 0.1, 0.04, steel),))
    shortening = 0.3 * 7800 * (0.05**2 + 0.02**2) * 0.4 / (2 * 2.1e11)
    assert strain_integral(shaft, 0.0, 0.4) == pytest.approx(-shortening, rel=1e-12)
    assert strain_integral(shaft, 0.4, 0.0) == pytest.approx(shortening, rel=1e-12)


def test_shift_is_additive_and_grows_with_the_square_of_speed() -> None:
    spindle = mfw2310(shortening=ComputedShortening(0.0386))
    shifts = seat_shifts(spindle, np.array([0.0, 0.5, 1.0]) * TOP)
    assert shifts[0] == pytest.approx(0.0, abs=1e-20)
    assert shifts[1] == pytest.approx(shifts[2] / 4)
    shaft = spindle.shaft
    parts = strain_integral(shaft, 0.0386, 0.2) + strain_integral(shaft, 0.2, 0.3809)
    assert shifts[2, 3] == pytest.approx(parts * TOP**2)


def test_prescribed_and_none() -> None:
    speed = np.array([TOP, TOP / 2])
    rule = PrescribedShortening(TOP, {"d": -40e-6})
    expected = [[0, 0, 0, -40e-6, 0], [0, 0, 0, -10e-6, 0]]
    assert seat_shifts(mfw2310(shortening=rule), speed) == pytest.approx(np.array(expected))
    assert not seat_shifts(mfw2310(shortening=None), speed).any()
