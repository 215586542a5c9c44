"""Axial shift of the seats: prescribed, and the closed form against plain quadrature."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from bearings.materials import STEEL
from rotordyn.machine.growth import ComputedShortening, PrescribedShortening
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.machine.temperatures import Temperatures
from rotordyn.preload.history import history
from rotordyn.preload.play import axial_run_up
from rotordyn.preload.shortening import expansion, seat_shifts, strain_integral
from rotordyn.preload.together import dynamic_preload
from tests.oracles.rotors import STEPPED
from tests.oracles.spindles import TOP, conditions, mfw2310, with_sleeve

STIFF = 2e7  # N/m


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


def held_along(x: float, reference: float, friction: float = 0.0) -> Spindle:
    """The flagship with a spring along the axis at ``x``, its front sleeve without a stop."""
    ours = with_sleeve(mfw2310(), "front", stop_travel=math.inf, friction=friction)
    along = LinearSupport("brush", x, {("x", "x"): STIFF, ("y", "y"): 1e3, ("z", "z"): 1e3})
    rule = ComputedShortening(reference)
    return replace(ours, supports=(*ours.supports, along), shortening=rule)


@pytest.mark.parametrize("warm", [None, Temperatures(shaft=45.0, housing=30.0)])
def test_a_support_along_the_axis_holds_the_shaft_where_it_is(
    warm: Temperatures | None,
) -> None:
    """Which station is said not to shift changes nothing; the position of the support does."""
    speed, law = np.array([0.0, TOP]), conditions().law
    front, rear = mfw2310().shaft.start, mfw2310().shaft.end
    one, same, other = (
        dynamic_preload(held_along(x, reference), speed, law, 0.0, warm)
        for x, reference in ((rear, 0.0), (rear, 0.3), (front, 0.0))
    )
    assert same.seat_load() == pytest.approx(one.seat_load(), rel=1e-8)
    assert np.abs(other.seat_load() / one.seat_load() - 1.0).max() > 0.05
    strain = strain_integral(mfw2310().shaft, 0.0, rear) * speed**2
    if warm is not None:
        strain = strain + expansion(mfw2310().shaft, 0.0, rear) * 25.0
        strain -= STEEL.expansion * rear * 10.0
    thrust = np.array([seat.thrust for seat in mfw2310().seats])
    pushed = -STIFF * (one.shift[:, 0] + strain)
    assert one.seat_load() @ thrust == pytest.approx(pushed, abs=1e-6)
    assert abs(pushed[1]) > 100.0


def test_history_and_play_hold_it_there_too() -> None:
    """Friction that is almost nothing leaves the state without any."""
    speed, law = np.array([0.0, 0.5, 1.0]) * TOP, conditions().law
    machine, bare = (held_along(mfw2310().shaft.end, 0.0, limit) for limit in (1e-3, 0.0))
    plain = dynamic_preload(bare, speed, law)
    path = history(replace(plain, spindle=machine), 0.0)
    for there, position in zip(path.run_up(), plain.shift, strict=True):
        assert not isinstance(there, str)
        assert there.x == pytest.approx(position, abs=2e-9)
    idle = axial_run_up(bare, law, speed).idle
    assert idle - idle[0] == pytest.approx(plain.shift, abs=1e-8)
    assert plain.stop_speeds() == pytest.approx([math.nan, math.nan], nan_ok=True)
    stopped = with_sleeve(bare, "front", stop_travel=10e-6)
    (met, _) = dynamic_preload(stopped, speed, law).stop_speeds()
    gap = dynamic_preload(bare, np.array([met]), law).shift[0, 1]
    assert abs(gap) == pytest.approx(10e-6, rel=1e-6)
