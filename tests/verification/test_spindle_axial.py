"""Axial motion and torsion of the spindle against all DOF of the rod and its sleeves."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import eigh

from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.frf import solve as frf
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.machine.inertia import rotor_inertia
from rotordyn.machine.spindle import Spindle
from rotordyn.scene.scene import Scene
from tests.oracles.dense_rotor.assemble import axial_rod, torsion_rod
from tests.oracles.spindles import mfw2310, pairs, scene, system_of, undamped, with_sleeve

FREQUENCY = np.linspace(5.0, 4000.0, 300)
BARE = undamped(mfw2310())
SPRINGS = {"front": 6.20e6, "rear": 5.49e6}


def axial_matrices(found: Scene, row: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Mass, damping, stiffness with one freedom more per sleeve; a closed stop is rigid."""
    spindle, mesh = found.spindle, found.mesh
    rod = axial_rod(spindle, mesh)
    sleeves = [s.name for s in spindle.sleeves]
    size, nodes = mesh.nodes + len(sleeves), mesh.nodes
    mass, damping, stiffness = (np.zeros((size, size)) for _ in range(3))
    mass[:nodes, :nodes], stiffness[:nodes, :nodes] = rod.mass, rod.stiffness
    for k, seat in enumerate(spindle.seats):
        link = np.zeros(size)
        link[mesh.node_of(seat.x)] = 1.0
        sleeve = spindle.sleeve_of(seat.name)
        if sleeve is not None:
            link[nodes + sleeves.index(sleeve.name)] = -1.0
        stiffness += found.seat_stiffness[row, k, 0, 0] * np.outer(link, link)
        damping += seat.axial_damping * np.outer(link, link)
    for k, sleeve in enumerate(spindle.sleeves):
        stiffness[nodes + k, nodes + k] += SPRINGS[sleeve.name]
    held = found.preload.net.held[found.bearing_row[row], 1:]
    kept = [*range(nodes), *(nodes + np.flatnonzero(~held))]
    return tuple(m[np.ix_(kept, kept)] for m in (mass, damping, stiffness))  # type: ignore[return-value]


def receptance(found: Scene, row: int) -> np.ndarray:
    mass, damping, stiffness = axial_matrices(found, row)
    node = found.mesh.node_of(-0.0524)
    unit = np.eye(len(mass))[node]
    dynamic = (stiffness + 1j * w * damping - w**2 * mass for w in 2 * math.pi * FREQUENCY)
    return np.array([np.linalg.solve(d, unit)[node] for d in dynamic])


def axial(found: Scene, row: int) -> np.ndarray:
    """Angular frequencies, ascending."""
    imag = system_of(found, "axial").pole[row].imag
    return np.sort(imag[np.isfinite(imag)])


def ours(found: Scene) -> np.ndarray:
    spec = FrfSpec(tuple(FREQUENCY), pairs("Oc2.x/Oc2.x"))
    return frf.solve(found, spec).receptance[:, 0]


@pytest.mark.parametrize("row", [0, 1], ids=["rest", "24000 rpm, front stop closed"])
def test_receptance_with_massless_sleeves(row: int) -> None:
    """Damped bearings in series with springs; sleeves get a small mass only to be counted."""
    found = scene(mfw2310(rotor_damping=()), (0, 24000), ports=(-0.0524,))
    assert found.preload.net.held[:, 1].tolist() == [False, True]
    exact = receptance(found, row)
    assert np.abs(ours(found)[row] - exact).max() < 2e-3 * np.abs(exact).max()


@pytest.mark.parametrize("row", [0, 1], ids=["rest", "24000 rpm, front stop closed"])
def test_undamped_axial_modes(row: int) -> None:
    found = scene(BARE, (0, 24000))
    mass, _, stiffness = axial_matrices(found, row)
    extra = np.arange(found.mesh.nodes, len(mass))
    free = np.arange(found.mesh.nodes)
    inner = np.linalg.solve(stiffness[np.ix_(extra, extra)], stiffness[np.ix_(extra, free)])
    condensed = stiffness[np.ix_(free, free)] - stiffness[np.ix_(free, extra)] @ inner
    exact = np.sqrt(eigh(condensed, mass[np.ix_(free, free)], eigvals_only=True))[:2]
    poles = axial(found, row)[:2]
    assert poles == pytest.approx(exact, rel=1e-3)


def test_no_mode_of_a_shaft_held_as_if_sleeves_could_not_slide() -> None:
    """Near 620 Hz the rotor would sit if the outer rings of the sleeves were held."""
    found = scene(BARE, (0,))
    mass = 21.35
    grounded = math.sqrt(found.seat_stiffness[0, :, 0, 0].sum() / mass) / (2 * math.pi)
    sliding = math.sqrt(_series(found) / mass) / (2 * math.pi)
    modes = campbell.solve(found, CampbellSpec(2000.0))
    axial = [f for f, kind in zip(modes.frequency[0], modes.kind, strict=True) if kind == "axial"]
    assert len(axial) == 1
    assert axial[0] == pytest.approx(sliding, rel=0.03)
    assert abs(axial[0] - grounded) > 100.0


def _series(found: Scene) -> float:
    k = found.seat_stiffness[0, :, 0, 0]
    springs = SPRINGS["front"], SPRINGS["rear"]
    behind = [1 / (1 / a + 1 / b) for a, b in zip((k[2], k[3] + k[4]), springs, strict=True)]
    return float(k[0] + k[1] + sum(behind))


def test_closed_stop_grounds_its_sleeve() -> None:
    """With a stop that is reached from the first speed on, static flexibility loses the spring."""
    tight = with_sleeve(BARE, "front", stop_travel=0.0)
    found = scene(tight, (6000,), ports=(-0.0524,))
    assert found.preload.net.held[0, 1]
    low = frf.solve(found, FrfSpec((0.01,), pairs("Oc2.x/Oc2.x"))).receptance[0, 0, 0].real
    _, _, stiffness = axial_matrices(found, 0)
    node = found.mesh.node_of(-0.0524)
    assert low == pytest.approx(np.linalg.inv(stiffness)[node, node], rel=1e-3)


def test_rigidly_preloaded_sleeves_do_not_slide() -> None:
    sleeves = tuple(
        replace(s, spring=replace(s.spring, stiffness=math.inf), stop_travel=math.inf)
        for s in BARE.sleeves
    )
    found = scene(replace(BARE, sleeves=sleeves), (0,))
    first = axial(found, 0)[0]
    rigid = math.sqrt(found.seat_stiffness[0, :, 0, 0].sum() / 21.35)
    assert first == pytest.approx(rigid, rel=0.03)


def test_a_heavy_sleeve_is_a_mass_of_its_own() -> None:
    spindle = with_sleeve(BARE, "rear", mass=3.0)
    found = scene(spindle, (0,))
    mass, _, stiffness = axial_matrices(found, 0)
    mass[-1, -1], mass[-2, -2] = 3.0, 1e-6
    exact = np.sqrt(eigh(stiffness, mass, eigvals_only=True))[:3]
    ours_ = axial(found, 0)[:3]
    assert ours_ == pytest.approx(exact, rel=2e-3)


@pytest.mark.parametrize("spindle", [BARE, mfw2310()], ids=["undamped", "damped"])
def test_torsion_is_free_and_does_not_depend_on_the_speed(spindle: Spindle) -> None:
    found = scene(spindle, (0, 24000))
    modes = campbell.solve(found, CampbellSpec(6000.0))
    torsion = [k for k, kind in enumerate(modes.kind) if kind == "torsion"]
    rod = torsion_rod(spindle, found.mesh)
    exact = np.sqrt(eigh(rod.stiffness, rod.mass, eigvals_only=True)[1:]) / (2 * math.pi)
    damping = spindle.rotor_damping[-1] if spindle.rotor_damping else 0.0
    damped = exact[: len(torsion)] * math.sqrt(1.0 - damping**2)
    assert len(torsion) == int((exact < 6000).sum()) >= 2
    assert modes.frequency[0, torsion] == pytest.approx(damped, rel=1e-6)
    assert (modes.frequency[0, torsion] == modes.frequency[1, torsion]).all()
    assert (modes.whirl[:, torsion] == 0).all()
    assert modes.damping_ratio[0, torsion] == pytest.approx(damping, abs=1e-9)


def test_axial_and_lateral_pairs_in_one_question() -> None:
    found = scene(BARE, (0, 24000), ports=(-0.0524,))
    spec = FrfSpec((100.0, 900.0), pairs("Oc2.y/Oc2.y", "Oc2.x/Oc2.x", "Oc2.thx/Oc2.thx"))
    h = frf.solve(found, spec).receptance
    assert np.isfinite(h).all()
    alone = FrfSpec((100.0, 900.0), pairs("Oc2.x/Oc2.x"))
    assert (frf.solve(found, alone).receptance[:, 0] == h[:, 1]).all()


def test_free_spin_answers_a_torque_with_its_inertia() -> None:
    """Far below the first torsion mode H = −1/(J ω²); above, all modes of the rod count."""
    found = scene(mfw2310(), (0, 24000), ports=(-0.0524,))
    frequency = np.array([10.0, 100.0, 1000.0, 2900.0])
    spec = FrfSpec(tuple(frequency), pairs("Oc2.thx/Oc2.thx"))
    h = frf.solve(found, spec).receptance[:, 0]
    polar = rotor_inertia(found.spindle).polar
    assert h[:, 0] == pytest.approx(np.full(2, -1.0 / (polar * (20 * math.pi) ** 2)), rel=1e-3)
    rod = torsion_rod(found.spindle, found.mesh)
    squares, shapes = eigh(rod.stiffness, rod.mass)
    squares[0] = 0.0
    amplitude = shapes[found.mesh.node_of(-0.0524)] ** 2
    ratio = np.where(squares > 0.0, found.spindle.rotor_damping[-1], 0.0)
    omega = 2 * math.pi * frequency[:, None]
    exact = (amplitude / (squares - omega**2 + 2j * ratio * np.sqrt(squares) * omega)).sum(axis=1)
    assert h[0] == pytest.approx(exact, rel=1e-4)
