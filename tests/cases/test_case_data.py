"""Data files of the cases are what their generator writes:  python -m docs.generate.case_data"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cache

import numpy as np
import pytest
from scipy.linalg import eigh

import rotordyn
from docs.generate import case_data
from rotordyn.machine.housing import ReducedHousing
from tests.oracles.plain_rotor import PlainRotor

RPM = math.pi / 30.0
NAMES = [
    "oil_film.csv",
    "housing_mass.mtx",
    "housing_stiffness.mtx",
    "housing_damping.mtx",
    "made_up_tap.csv",
    "made_up_blank.csv",
]


@cache
def made() -> dict[str, str]:
    """Contents by name."""
    return dict(case_data.files())


def numbers(text: str) -> Iterator[float]:
    """All of a file but its remarks and its head."""
    lines = [line for line in text.splitlines() if line and line[0] not in "#%"]
    for line in lines[1:]:
        yield from map(float, line.split(","))


@pytest.mark.parametrize("name", NAMES)
def test_files_are_what_the_generator_writes(name: str) -> None:
    kept = (case_data.DATA / name).read_text(encoding="utf-8")
    remarks = [line for line in kept.splitlines() if line[0] in "#%"]
    assert remarks == [line for line in made()[name].splitlines() if line[0] in "#%"]
    ours, theirs = (np.array(list(numbers(text))) for text in (kept, made()[name]))
    scale = np.abs(theirs).max()
    np.testing.assert_allclose(ours, theirs, rtol=2e-4, atol=1e-9 * scale)


def test_no_other_data_files() -> None:
    kept = {path.name for path in case_data.DATA.iterdir()}
    assert list(made()) == NAMES
    assert kept == {*NAMES, "exciter_on_hsk.yaml"}
    assert "NOT A MEASUREMENT" in made()["made_up_tap.csv"].splitlines()[0]


def test_oil_film_of_the_book() -> None:
    """Friswell and others 2010, example 5.5.1, as ROSS (Timbó and others 2020) has it in its tests:
    relative to the print 1e-6."""
    eccentricity, stiffness, damping = case_data.film(1500.0 * RPM)
    assert eccentricity == pytest.approx(0.266298, rel=2e-6)
    assert case_data.film(2000.0 * RPM)[0] == pytest.approx(0.212571, rel=3e-6)
    printed = [[12.80796, 16.393593], [-25.060393, 8.815303]]
    assert stiffness / 1e6 == pytest.approx(np.array(printed), rel=1e-6)
    printed = [[232.89693, -81.924371], [-81.924371, 294.911619]]
    assert damping / 1e3 == pytest.approx(np.array(printed), rel=1e-6)


def test_rotor_on_oil_films() -> None:
    """5.9.6 from its case file, at a row of the table: the poles of matrices written down apart
    from the program."""
    found = rotordyn.run(rotordyn.load("friswell_oil_films"))["campbell"]
    for rpm in (500.0, 1500.0, 4500.0):
        row = int(np.abs(found.speed_rpm.values - rpm).argmin())
        every = poles(rpm * RPM, *case_data.film(rpm * RPM)[1:])
        for ours, ratio in zip(
            found.frequency.values[row], found.damping_ratio.values[row], strict=True
        ):
            if ratio == 0.0:
                continue  # torsion
            pole = 2.0 * math.pi * ours * complex(-ratio / math.sqrt(1.0 - ratio**2), 1.0)
            assert np.abs(every / pole - 1.0).min() < 2e-5
    assert 2000.0 * RPM < float(found.stability_threshold) < 2250.0 * RPM


def test_half_speed_whirl_of_the_rotor_on_oil_films() -> None:
    """At each critical speed of order ½, with films on the straight line between two breakpoints of
    their table, those matrices have a pole with |Im λ| = Ω/2 and that damping. Forward whirl hardly
    grows there: the threshold is near."""
    found = rotordyn.run(rotordyn.load("friswell_oil_films"))["campbell"]
    half = np.flatnonzero(found.critical_order.values == 0.5)
    assert len(half) == 2
    for k in half:
        spin = float(found.critical_speed.values[k])
        below = 100.0 * math.floor(spin / (100.0 * RPM))
        share = spin / (100.0 * RPM) - below / 100.0
        breakpoints = [case_data.film((below + ahead) * RPM)[1:] for ahead in (0.0, 100.0)]
        held = [(1.0 - share) * low + share * high for low, high in zip(*breakpoints, strict=True)]
        every = poles(spin, *held)
        near = every[np.abs(every.imag - 0.5 * spin).argmin()]
        assert near.imag == pytest.approx(0.5 * spin, rel=1e-5)
        assert -near.real / abs(near) == pytest.approx(found.critical_damping.values[k], abs=2e-6)
    at = found.critical_speed.values[half][found.critical_whirl.values[half] == "forward"]
    assert at == pytest.approx(float(found.stability_threshold), rel=0.01)


def poles(spin: float, stiffness: np.ndarray, damping: np.ndarray) -> np.ndarray:
    """Of the rotor on films of this stiffness and damping, turning with ``spin``."""
    mass, gyroscopic, damped, held = films().matrices()
    damped = damped + spin * gyroscopic
    for node in (0, 6):
        place = np.ix_([4 * node, 4 * node + 2], [4 * node, 4 * node + 2])
        held[place] += stiffness
        damped[place] += damping
    size = len(mass)
    state = np.block([[np.zeros((size, size)), np.eye(size)]] * 2)
    state[size:, :size] = -np.linalg.solve(mass, held)
    state[size:, size:] = -np.linalg.solve(mass, damped)
    return np.linalg.eigvals(state)


def films() -> PlainRotor:
    """The rotor without its films."""
    nu = 211.0 / (2.0 * 81.2) - 1.0
    kappa = 6.0 * (1.0 + nu) ** 2 / (7.0 + 12.0 * nu + 4.0 * nu**2)

    def disc(node: int, outer: float) -> tuple[int, float, float, float]:
        mass = 7810.0 * math.pi / 4.0 * (outer**2 - 0.05**2) * 0.07
        polar = mass * (outer**2 + 0.05**2) / 8.0
        return node, mass, polar, polar / 2.0 + mass * 0.07**2 / 12.0

    return PlainRotor(1.5, 0.05, 6, 211e9, 81.2e9, kappa, 7810.0, (disc(2, 0.28), disc(4, 0.35)))


def test_cartridge_is_the_beam_and_the_body() -> None:
    """The reduced model has the lowest modes of its beam; the rigid body of the case has its mass,
    its inertia and its flange."""
    x, mass, stiffness = case_data.tube()
    reduced = case_data.housing()
    whole = np.sqrt(eigh(stiffness, mass, eigvals_only=True)[:3])
    few = np.sqrt(eigh(reduced["stiffness"], reduced["mass"], eigvals_only=True)[:6:2])
    assert few == pytest.approx(whole, rel=1e-4)
    case = rotordyn.load("spindle_on_housing")
    body, elastic = (case.variants[name].spindle.housings[0] for name in ("body", "elastic"))  # type: ignore[union-attr]
    shift, tilt = np.zeros((2, len(mass)))
    shift[::2], tilt[::2], tilt[1::2] = 1.0, x - body.x, 1.0
    assert body.mass == pytest.approx(shift @ mass @ shift, rel=1e-3)
    assert shift @ mass @ tilt == pytest.approx(0.0, abs=1e-3 * body.mass)
    assert body.diametral_inertia == pytest.approx(tilt @ mass @ tilt, rel=1e-3)
    named = {("y", "y"): (shift, shift), ("y", "thz"): (shift, tilt), ("thz", "thz"): (tilt, tilt)}
    for pair, (one, other) in named.items():
        assert body.stiffness[pair] == pytest.approx(one @ stiffness @ other, rel=1e-3)
        turned = tuple({"y": "z", "thz": "thy"}[way] for way in pair)
        sign = -1.0 if "y" in pair and "thz" in pair else 1.0
        assert body.stiffness[turned] == sign * body.stiffness[pair]
    assert isinstance(elastic, ReducedHousing)
    assert elastic.places[:5] == ("a.y", "b.y", "c.y", "d.y", "e.y")
