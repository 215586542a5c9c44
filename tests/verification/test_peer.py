"""The comparison with a peer: our side of it, how errors are judged, and what is kept."""

from __future__ import annotations

import copy
import math
from typing import Any

import numpy as np
import pytest

from benchmarks.peer import machine
from benchmarks.peer.cases import CAMPBELL, FINE, RESPONSE, SAME, spindle
from benchmarks.peer.dense import of_ours, of_theirs
from benchmarks.peer.judged import (
    SAMPLE,
    SPEEDS,
    exact_modes,
    exact_response,
    mode_errors,
    off,
    our_modes,
    our_response,
    partners,
    response_errors,
)
from docs.generate.peer import peer_parts, peer_seconds
from docs.generate.times import measured
from rotordyn.equation.mesh import build_mesh
from tests.oracles.full_rotor import FullRotor

NO_SEATS = np.zeros((0, 5, 5))
TOP = machine.FREQUENCIES[-1]
kinds = pytest.mark.parametrize("kind", machine.KINDS)


def cells(text: str) -> list[list[str]]:
    lines = [line for line in text.splitlines() if line.startswith("|")][2:]
    return [[cell.strip() for cell in line.split("|")[1:-1]] for line in lines]


def test_the_machine_has_60_equal_elements_and_5_bearings() -> None:
    assert len(machine.diameters()) == machine.NODES - 1 == 60
    for kind in machine.KINDS:
        built = spindle(kind)
        assert built.shaft.end == pytest.approx(0.6)
        assert len(built.supports) == 5
    uneven = spindle(machine.GENERAL).supports[0]
    assert uneven.stiffness["y", "z"] != uneven.stiffness["z", "y"]
    assert uneven.damping["y", "y"] != uneven.damping["z", "z"]


@kinds
def test_dense_matrices_are_those_of_every_dof(kind: str) -> None:
    """Against the plain assembly, node by node, of the same 60 elements."""
    built = spindle(kind)
    whole = FullRotor(built, build_mesh(built, SAME.element_length), NO_SEATS, machine.SPEED)
    ours = of_ours(built, None, TOP, machine.SPEED)
    few = ours.poles(machine.SPEED)[: machine.MODES]
    assert few == pytest.approx(whole.poles(TOP * 2)[: machine.MODES], rel=1e-7)
    rows = [whole.row(machine.STATIONS[30], name) for name in machine.MOTIONS]
    load = whole.row(machine.STATIONS[machine.INPUT], "y")
    frequency = np.array(SAMPLE[::20])
    wanted = whole.receptance([(row, load) for row in rows], frequency).T
    found = ours.response(machine.SPEED, 2.0 * math.pi * frequency, 4 * machine.INPUT)[:, 30]
    assert np.abs(found - wanted).max() < 1e-7 * np.abs(wanted).max()


@pytest.mark.long
def test_our_side_equals_a_dense_solve_where_that_is_asked() -> None:
    kind = "anisotropic, damped"
    modes = of_ours(spindle(kind), FINE.accuracy, machine.BAND, machine.SPEEDS[-1])
    found = our_modes(kind, FINE, SPEEDS[::4])
    dense = [modes.poles(spin)[:8] for spin in SPEEDS[::4]]
    errors = [
        abs(a - b) / abs(a)
        for own, whole in zip(found, dense, strict=True)
        for a, b in partners(whole, own)
    ]
    assert len(errors) == 8 * len(found) == 16
    assert max(errors) < 1e-9
    response = our_response(RESPONSE, kind, FINE)
    whole = of_ours(spindle(kind), FINE.accuracy, TOP, machine.SPEED)
    assert response_errors(response, response, whole)["discrete"] < 1e-7


@pytest.mark.few(1)
@kinds
def test_our_side_is_near_the_exact_shaft(kind: str) -> None:
    for own, truth in zip(our_modes(kind, FINE), exact_modes(kind), strict=True):
        assert own[: machine.MODES] == pytest.approx(truth[: machine.MODES], rel=1e-7)
    truth = exact_response(RESPONSE, kind)
    assert np.median(off(our_response(RESPONSE, kind, FINE), truth)) < 1e-7


def test_a_mode_moved_or_lost_is_noticed() -> None:
    truth = np.array([100j, 200j, 201j, 300j])
    assert len(partners(truth, truth)) == 4
    assert len(partners(truth, truth[[0, 1, 3]])) == 3
    moved = dict(partners(truth, truth * (1.0 + 1e-4)))
    assert [abs(moved[t] / t - 1.0) for t in truth] == pytest.approx([1e-4] * 4)
    dense = of_ours(spindle(machine.ISOTROPIC), None, TOP, machine.SPEEDS[-1])
    top = SPEEDS[-1:]
    poles = [dense.poles(top[0])[: machine.MODES]]
    assert mode_errors(poles, poles, dense, top) == {"true": 0.0, "discrete": 0.0, "missing": 0}
    found = mode_errors([poles[0][:-1] * (1.0 + 1e-4)], poles, dense, top)
    assert found["missing"] == 1
    assert found["true"] == pytest.approx(1e-4)
    assert found["discrete"] == pytest.approx(1e-4)


def test_an_error_of_tilts_is_not_hidden_by_deflections() -> None:
    rng = np.random.default_rng(1)
    wanted = rng.normal(size=(3, machine.NODES, 4)) + 0j
    wanted[..., :2] *= 1e3
    found = wanted.copy()
    found[1, 7, 3] *= 1.1
    apart = off(found, wanted)
    assert apart[1, 1] > 0.01 * abs(wanted[1, 7, 3]) / np.abs(wanted[1, :, 2:]).max()
    assert not apart[[0, 2]].any()
    assert not apart[:, 0].any()


def test_matrices_that_couple_bending_with_other_motions_are_refused() -> None:
    size = 6 * machine.NODES
    arrays = {name: np.eye(size) for name in ("mass", "damping", "spin", "stiffness")}
    assert len(of_theirs(arrays, (0, 1, 3, 4)).mass) == 4 * machine.NODES
    arrays["damping"][0, 2] = 1.0
    with pytest.raises(ValueError, match="couple bending"):
        of_theirs(arrays, (0, 1, 3, 4))


@kinds
def test_both_sides_had_the_same_machine(kind: str) -> None:
    """With the same elements both miss the exact shaft by the same."""
    errors: dict[str, Any] = measured()["peer"]["errors"][kind]
    ours, theirs = errors["60 standard elements"], errors["peer"]
    assert ours["campbell"]["true"] == pytest.approx(theirs["campbell"]["true"], rel=1e-3)
    assert all(e["campbell"]["missing"] == 0 for e in errors.values() if "campbell" in e)
    both = (side["all responses"]["true"] for side in (ours, theirs))
    assert next(both) == pytest.approx(next(both), rel=1e-3)


def test_a_missed_target_says_by_how_much() -> None:
    found = copy.deepcopy(measured()["peer"])
    line = next(own for own in found["threads"]["1"]["ours"] if own["work"] == CAMPBELL)
    theirs = peer_seconds(found["threads"]["1"]["theirs"], line["kind"], CAMPBELL)
    line["seconds"] = theirs / 150.0
    missed = ["150 ×", "300 ×", "**missed by a factor of 2**"]
    assert cells(peer_parts(found)["peer-times"])[0][-3:] == missed
    line["seconds"] = theirs / 301.0
    assert cells(peer_parts(found)["peer-times"])[0][-1] == "met"
