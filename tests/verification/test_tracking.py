"""Modes through crossings and veerings, from few speeds: systems whose lines are known."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.result import CampbellResult
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.machine.lumped import PointMass
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.modes import branches
from rotordyn.numerics.follow import doubts, follow
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.rotors import STEEL, support, uniform
from tests.oracles.spindles import RPM
from tests.oracles.steps import steps_of


def pair(at: float, coupling: float) -> np.ndarray:
    """Two lines of slopes ±1 that meet at 0.37, joined by ``coupling``."""
    return np.array([[2.0 + (at - 0.37), coupling], [coupling, 2.0 - (at - 0.37)]])


def tracked(coupling: float, at: np.ndarray) -> tuple[np.ndarray, int]:
    """Values of both paths at the steps ``at``, and how many more were looked at."""
    steps = {float(x): np.linalg.eigh(pair(x, coupling)) for x in at}
    for _ in range(40):
        places = sorted(steps)
        vectors = [steps[x][1] + 0j for x in places]
        values = [steps[x][0] for x in places]
        wanted = doubts(np.array(places), steps_of(vectors, values), 10.0, 1e-9)
        if not wanted:
            break
        steps |= {x: np.linalg.eigh(pair(x, coupling)) for x in wanted}
    path = follow(steps_of(vectors, values))
    assert path.shape[1] == 2
    found = np.array([v[p] for v, p in zip(values, path, strict=True)])
    return found[np.searchsorted(places, at)], len(places) - len(at)


@pytest.mark.parametrize("count", [2, 3, 5, 11])
@pytest.mark.parametrize("coupling", [0.3, 1e-1, 1e-2, 1e-3, 1e-4, 2e-5])
def test_lines_that_veer_never_swap(coupling: float, count: int) -> None:
    """Exact: 2 ± √((x − 0.37)² + c²), whatever the steps."""
    at = np.linspace(0.0, 1.0, count)
    found, more = tracked(coupling, at)
    half = np.hypot(at - 0.37, coupling)
    assert found == pytest.approx(2.0 + half[:, None] * [-1.0, 1.0], abs=1e-12)
    assert more < 60


@pytest.mark.parametrize("count", [2, 3, 5, 11, 101])
def test_lines_that_cross_never_swap(count: int) -> None:
    """Exact: 2 ± (x − 0.37). A step on the crossing itself is no harm."""
    at = np.linspace(0.0, 1.0, count)
    found, more = tracked(0.0, at)
    assert found == pytest.approx(2.0 + (at - 0.37)[:, None] * [1.0, -1.0], abs=1e-9)
    assert more < 6


def disc_at(x: float) -> Spindle:
    """On two equal springs; midway the disc's tilt does not move its centre."""
    disc = PointMass("disc", x, 20.0, 2.0, 1.02)
    held = (support("a", 0.0, (5e7, 5e7)), support("b", 0.6, (5e7, 5e7)))
    return uniform(0.6, 0.05, STEEL, masses=(disc,), supports=held)


def lines(spindle: Spindle, rpm: Any) -> dict[str, np.ndarray]:
    scene = Scene(spindle, Conditions(), np.asarray(rpm, float) * RPM, 400.0)
    found = campbell.solve(scene, CampbellSpec(400.0, shapes=False))
    return dict(zip(found.mode, found.frequency.T, strict=True))


@pytest.mark.parametrize("rpm", [[0, 20000], [0, 5000, 20000], range(0, 20001, 1000)])
def test_a_disc_midway_tilts_through_the_pair_below(rpm: Any) -> None:
    """Symmetry keeps tilt and translation apart: a crossing, even from its two ends."""
    found = lines(disc_at(0.3), rpm)
    falling, straight = found["bending 2 backward"], found["bending 1 backward"]
    assert falling[0] > 1.4 * straight[0]
    assert falling[-1] < 0.5 * straight[-1]
    assert np.ptp(straight) < 1.0


@pytest.mark.parametrize("away", [0.02, 1e-3, 5e-5])
@pytest.mark.parametrize("rpm", [[0, 20000], [0, 5000, 20000], range(0, 20001, 1000)])
def test_a_disc_a_little_aside_veers(rpm: Any, away: float) -> None:
    """Without symmetry the lines of one whirl never meet, however closely they pass."""
    found = lines(disc_at(0.3 + away), rpm)
    assert (found["bending 1 backward"] < found["bending 2 backward"]).all()
    assert found["bending 1 backward"][0] > 2.0 * found["bending 1 backward"][-1]


@pytest.mark.parametrize(
    ("table", "across", "given"),
    [
        ([0, 20, 700, 800], [1.3e6, 1e6, 1e6, 1.3e6], [0, 20, 700, 800]),
        ([0, 100, 700, 800], [1.3e6, 1e6, 1e6, 1.3e6], [0, 800]),
        ([0, 400, 800], [1e6, 1.3e6, 1e6], [0, 800]),
    ],
)
def test_supports_alike_in_both_planes_at_some_speeds_only(
    table: list[float], across: list[float], given: list[float]
) -> None:
    """At these speeds whirl is solved as one plane, whether they are given, stand in a table, or
    are looked at to tell crossings; the modes there are those of supports that are always alike."""

    def found(stiffness: list[float]) -> CampbellResult:
        entries = {("y", "y"): (1e6,) * len(table), ("z", "z"): tuple(stiffness)}
        damping = {pair: (50.0,) * len(table) for pair in entries}
        speeds = tuple(map(float, table))
        held = [
            LinearSupport(name, x, entries, damping, speeds=speeds)
            for name, x in (("a", 0.0), ("b", 0.6))
        ]
        disc = PointMass("disc", 0.3, 20.0, 6.0, 4.0)
        rotor = uniform(0.6, 0.05, STEEL, masses=(disc,), supports=held)
        scene = Scene(rotor, Conditions(), np.array(given, dtype=float), 300.0)
        return campbell.solve(scene, CampbellSpec(300.0, shapes=False))

    alike, mixed = found([1e6] * len(table)), found(across)
    assert mixed.frequency.shape[1] == 4
    assert np.isfinite(mixed.frequency).all()
    assert mixed.unconverged == ""
    same = [k for k, speed in enumerate(given) if across[table.index(speed)] == 1e6]
    for row in same:
        expected = np.sort(alike.frequency[row])
        assert np.sort(mixed.frequency[row]) == pytest.approx(expected, rel=1e-6)


def test_the_expected_pole_is_that_of_the_derivative() -> None:
    """Against a fine difference of the poles: the error of λ − w (λ ΔD + ΔK) v is of 2nd order."""
    errors, moved = [], np.zeros(0)
    for end in (902.0, 904.0):
        scene = Scene(disc_at(0.32), Conditions(), np.array([900.0, end]), 400.0)
        sweep = branches._Sweep.of(scene, scene.with_motions(("bending",))[0], 2500.0)
        (first, other), expected = sweep.pole, sweep.ahead(math.inf)[0]
        nearest = [other[np.nanargmin(np.abs(other - p))] for p in expected]
        errors.append(np.abs(np.array(nearest) - expected))
        moved = np.abs(expected - first)
    chosen = (np.abs(first.imag) < 2.0 * math.pi * 400.0) & (moved > 0.01)
    assert chosen.sum() >= 3
    assert (errors[1] < 0.05 * moved)[chosen].all()
    order = math.log2(float(np.median(errors[1][chosen] / errors[0][chosen])))
    assert order == pytest.approx(2.0, abs=0.2)


@pytest.mark.parametrize("between", [1e5, 1e7])
def test_modes_overdamped_between_two_speeds_lose_no_others(between: float) -> None:
    """Tables of damping with a peak between: there the planes have more overdamped poles."""
    damping = (10.0, 10.0, between, 10.0, 10.0)
    held = tuple(
        LinearSupport(
            name,
            x,
            {("y", "y"): 5e7, ("z", "z"): 2e7},
            {("y", "y"): damping, ("z", "z"): damping},
            speeds=tuple(np.array([0.0, 1000.0, 1500.0, 2000.0, 3000.0]) * RPM),
        )
        for name, x in (("a", 0.0), ("b", 0.6))
    )
    speed = np.array([0.0, 1000.0, 2000.0, 3000.0]) * RPM
    scene = Scene(uniform(0.6, 0.05, STEEL, supports=held), Conditions(), speed, 3000.0)
    found = branches.branches_of(scene, 2.0 * math.pi * 3000.0, ("bending",))
    assert len(found) >= 8
    assert all(np.isfinite(b.pole).all() for b in found if b.frequency[0] < 1000.0)
