"""Squeeze-film dampers: pressure integrated numerically, a rigid rotor in closed form, faults."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.integrate import dblquad
from scipy.optimize import brentq

from rotordyn.analyses.frf import solve as frf
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.section_forces import solve as section_forces
from rotordyn.analyses.section_forces.spec import SectionForcesSpec
from rotordyn.analyses.unbalance import solve as unbalance
from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.analyses.unbalance.summary import warnings
from rotordyn.equation.squeeze_film import film_coefficients
from rotordyn.errors import InvalidInput
from rotordyn.machine.inertia import rotor_inertia
from rotordyn.machine.rotor import Rotor
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.squeeze_film import FILMS, SqueezeFilmDamper
from rotordyn.modes.criticals import criticals_up_to
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.loads import PointLoad, Unbalance
from rotordyn.scene.scene import Scene
from tests.oracles.rotors import support, uniform
from tests.oracles.spindles import pairs, poles

LENGTH, SPRING = 0.4, 2e6
FILM = SqueezeFilmDamper("left film", 0.0, 0.01, 0.02, 0.05, 1e-4, 0.4)
SPEED = np.array([0.0, 80.0, 400.0, 1500.0])
KINDS = pytest.mark.parametrize("film", FILMS)
RIGID = Conditions(rotor="rigid")


def machine(film: str) -> Spindle:
    """A uniform shaft between two springs, each with a film beside it."""
    springs = [support(name, x, (SPRING, SPRING)) for name, x in (("a", 0.0), ("b", LENGTH))]
    left = replace(FILM, film=film)
    films = left, replace(left, name="right film", x=LENGTH)
    rotor = uniform(LENGTH, 0.05, supports=springs)
    return replace(rotor, dampers=films, points={"mid": LENGTH / 2.0})


def scene(film: str) -> Scene:
    return Scene(machine(film), RIGID, SPEED, 500.0, (LENGTH / 2.0,))


def integrated(damper: SqueezeFilmDamper, whirl: float) -> tuple[float, float]:
    """Force of the film along the displacement and along the velocity, by its pressure
    6 μ (∂h/∂t) (s² − L²/4) / h³ at θ from the displacement and s along the axis."""
    e, half = damper.eccentricity_ratio * damper.clearance, damper.length / 2.0

    def pressure(s: float, angle: float) -> float:
        h, squeeze = damper.clearance - e * math.cos(angle), -whirl * e * math.sin(angle)
        return 6.0 * damper.viscosity * squeeze * (s * s - half * half) / h**3

    end = math.pi if damper.film == "cavitated" else 2.0 * math.pi
    radial, along = (
        -damper.radius
        * dblquad(lambda s, a, way=way: pressure(s, a) * way(a), 0.0, end, -half, half)[0]
        for way in (math.cos, math.sin)
    )
    return radial, along


@KINDS
@pytest.mark.parametrize("eps", [0.01, 0.4, 0.8])
def test_coefficients_are_those_of_the_pressure_integrated(film: str, eps: float) -> None:
    damper, whirl = replace(FILM, film=film, eccentricity_ratio=eps), 700.0
    radial, along = integrated(damper, whirl)
    stiffness, damping = film_coefficients(damper)
    e = eps * damper.clearance
    assert along == pytest.approx(-damping * whirl * e, rel=1e-7)
    assert radial == pytest.approx(-stiffness * whirl * e, rel=1e-7, abs=1e-7 * abs(along))


def test_pressure_of_the_cavitated_film_is_positive_where_it_acts() -> None:
    """Half of the full film acts, and half of its damping is left."""
    half, whole = (film_coefficients(replace(FILM, film=film)) for film in FILMS)
    assert whole == (0.0, pytest.approx(2.0 * half[1], rel=1e-15))
    assert half[1] == pytest.approx(math.pi * 0.01 * 0.05 * 200.0**3 / (2.0 * 0.84**1.5), rel=1e-12)
    assert half[0] == pytest.approx(2.0 * 0.01 * 0.05 * 200.0**3 * 0.4 / 0.84**2, rel=1e-12)


def parts(film: str) -> tuple[np.ndarray, float, float]:
    """Stiffness of a spring and film (speeds,), damping of a film, mass of the rotor."""
    stiffness, damping = film_coefficients(machine(film).dampers[0])
    return SPRING + stiffness * SPEED, damping, rotor_inertia(machine(film)).mass


@KINDS
def test_rigid_rotor_under_unbalance(film: str) -> None:
    """(2 K − M Ω² + 2 iΩC) r = U Ω²; each film has its share −(K_f + iΩC) r."""
    held, damping, mass = parts(film)
    size = 1e-5
    found = unbalance.solve(scene(film), UnbalanceSpec(("mid",), (Unbalance("mid", size),)))
    stiff = 2.0 * held - mass * SPEED**2 + 2j * SPEED * damping
    expected = size * SPEED**2 / stiff
    np.testing.assert_allclose(found.displacement[:, 0, 0], expected, rtol=1e-8)
    assert found.support == ("a", "b", "left film", "right film")
    force = np.asarray(found.force)[:, 2, 0]
    np.testing.assert_allclose(force, -(held - SPRING + 1j * SPEED * damping) * expected, rtol=1e-8)
    at = np.isin(found.fine_speed, SPEED)
    assert np.isnan(found.film_orbit[:, :2]).all()
    np.testing.assert_allclose(found.film_orbit[at, 2], np.abs(expected) / 1e-4, rtol=1e-8)


def test_orbits_beyond_what_a_film_is_computed_for_are_reported() -> None:
    """0.4 of the clearance is assumed; the largest orbit is in proportion to the unbalance."""

    def told(size: float) -> list[str]:
        spec = UnbalanceSpec(("mid",), (Unbalance("mid", size),))
        return warnings(unbalance.solve(scene("cavitated"), spec))

    one = UnbalanceSpec(("mid",), (Unbalance("mid", 1e-5),))
    largest = float(np.nanmax(unbalance.solve(scene("cavitated"), one).film_orbit))
    assert not told(0.45e-5 / largest)
    left, _ = told(0.6e-5 / largest)
    assert "squeeze film left film is 60 % of its clearance" in left
    small, _ = told(0.25e-5 / largest)
    assert "is 25 % of its clearance" in small
    assert "agrees with the orbit, from 25 % to 40 %" in small
    assert "computed for 40 %: try eccentricity_ratio: 60 %" in left
    assert "no film allows such an orbit" in told(1.1e-5 / largest)[0]


@KINDS
def test_free_motion_of_a_rigid_rotor(film: str) -> None:
    """M p² + 2 C p + 2 K = 0 of the motion across the axis, with a thin oil: underdamped."""
    spindle = machine(film)
    spindle = replace(
        spindle, dampers=tuple(replace(each, viscosity=1e-3) for each in spindle.dampers)
    )
    found = Scene(spindle, RIGID, SPEED, 500.0, (LENGTH / 2.0,))
    stiffness, damping = film_coefficients(spindle.dampers[0])
    mass = rotor_inertia(spindle).mass
    for row, speed in enumerate(SPEED):
        held = SPRING + stiffness * speed
        exact = (-damping + 1j * math.sqrt(2.0 * held * mass - damping**2)) / mass
        off = np.sort(np.abs(poles(found, row) - exact))
        assert off[1] < 1e-7 * abs(exact), "forward and backward"


@KINDS
def test_receptance_of_a_rigid_rotor(film: str) -> None:
    held, damping, mass = parts(film)
    spec = FrfSpec(frequencies=(5.0, 40.0, 300.0), pairs=pairs("mid.y/mid.y"))
    found: Any = frf.solve(scene(film), spec)
    omega = 2.0 * math.pi * np.array(spec.frequencies)
    expected = 1.0 / (2.0 * held[:, None] - mass * omega**2 + 2j * omega * damping)
    np.testing.assert_allclose(np.squeeze(found.response), expected, rtol=1e-7)


@KINDS
def test_a_film_carries_no_standing_load(film: str) -> None:
    spec = SectionForcesSpec(loads=(PointLoad("mid", Fy=100.0),))
    found: Any = section_forces.solve(scene(film), spec)
    share = np.asarray(found.reaction)[:, :, 1]
    np.testing.assert_allclose(share[:, 0], -50.0, rtol=1e-9)
    np.testing.assert_allclose(share[:, 2], 0.0, atol=1e-9)


@pytest.mark.parametrize("ratio", [3.0, -3.0])
def test_a_film_whirls_with_the_rotor_that_is_out_of_balance(ratio: float) -> None:
    """A rigid rotor on springs k from the spindle turns at three times its speed."""
    k, size = 8e6, 1e-5
    between = [
        replace(support(f"to {name}", x, (k, k)), holds="spindle", against="outer")
        for name, x in (("a", 0.0), ("b", LENGTH))
    ]
    spindle = machine("cavitated")
    outer = Rotor(
        "outer", ratio, uniform(LENGTH, 0.1, inner=0.06).shaft, points={"ring": LENGTH / 2.0}
    )
    spindle = replace(spindle, rotors=(outer,), supports=(*spindle.supports, *between))
    spec = UnbalanceSpec(("mid",), (Unbalance("outer.ring", size),))
    found = unbalance.solve(Scene(spindle, RIGID, SPEED, 500.0, (LENGTH / 2.0,)), spec)
    stiffness, damping = film_coefficients(FILM)
    masses = [rotor_inertia(each).mass for each in (spindle, spindle.part("outer"))]
    for row, whirl in enumerate(abs(ratio) * SPEED[1:], start=1):
        film = stiffness * whirl + 1j * whirl * damping
        own = 2.0 * (SPRING + film + k) - masses[0] * whirl**2
        other = 2.0 * k - masses[1] * whirl**2
        moved = 2.0 * k * size * whirl**2 / (own * other - 4.0 * k**2)
        assert found.displacement[row, 0, 0] == pytest.approx(moved, rel=1e-7)
        place = found.support.index("left film")
        assert found.force[row, place, 0] == pytest.approx(-film * moved, rel=1e-7)
        at = int(np.argmin(np.abs(found.fine_speed - SPEED[row])))
        assert found.film_orbit[at, place] == pytest.approx(abs(moved) / 1e-4, rel=1e-7)


def test_engine_orders_whirl_at_their_multiple_of_the_speed() -> None:
    """Critical speed of order 3, and the receptance at 3Ω, of a film that whirls at 3Ω."""
    thin = tuple(replace(each, viscosity=2e-3) for each in machine("cavitated").dampers)
    spindle = replace(machine("cavitated"), dampers=thin)
    stiffness, damping = film_coefficients(thin[0])
    mass = rotor_inertia(spindle).mass

    def miss(turning: float) -> float:
        held = SPRING + stiffness * turning
        return math.sqrt(2.0 * held * mass - damping**2) / mass - turning

    expected = float(brentq(miss, 1.0, 5000.0)) / 3.0
    one = Scene(spindle, RIGID, SPEED, 500.0, (LENGTH / 2.0,))
    found = critical_speeds_of(one, 3.0)
    assert min(abs(each / expected - 1.0) for each in found) < 1e-7
    spec = FrfSpec((), pairs("mid.y/mid.y"), engine_orders=(3.0,))
    line: Any = frf.solve(one, spec)
    fine = np.squeeze(line.line_speed)
    assert len(fine) > len(SPEED)
    for speed, values in ((SPEED, line.line_value), (fine, line.line_curve)):
        whirl = 3.0 * speed
        exact = 1.0 / (2.0 * (SPRING + stiffness * whirl + 1j * whirl * damping) - mass * whirl**2)
        np.testing.assert_allclose(np.squeeze(values), exact, rtol=1e-7)


def critical_speeds_of(scene: Scene, order: float) -> list[float]:
    return [each.speed for each in criticals_up_to(scene, order, (order,))]


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"viscosity": 0.0}, "viscosity"),
        ({"eccentricity_ratio": 1.0}, "eccentricity_ratio"),
        ({"film": "half"}, "film: not one of its choices"),
        (
            {"clearance": 0.05},
            "clearance: not thin: given 0.05 m; allowed: below the radius, 0.05 m",
        ),
    ],
)
def test_faults_of_a_film(changes: dict[str, Any], sentence: str) -> None:
    with pytest.raises(InvalidInput, match=sentence):
        replace(FILM, **changes)


def test_faults_of_a_machine() -> None:
    spindle = machine("full")
    with pytest.raises(InvalidInput, match="name"):
        replace(spindle, dampers=(replace(FILM, name="a"),))
    with pytest.raises(InvalidInput, match="left film"):
        replace(spindle, dampers=(replace(FILM, x=1.0),))
