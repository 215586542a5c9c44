"""Peaks of responses are the true ones at any grid: closed forms and dense grids."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rotordyn.analyses.frf.result import FrequencyResponse
from rotordyn.analyses.frf.solve import solve
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.frf.summary import summary, warnings
from rotordyn.analyses.frf.uff import write_uff
from rotordyn.analyses.measured_response import QUANTITIES
from rotordyn.machine.inertia import rotor_inertia
from rotordyn.machine.rotor import Place
from rotordyn.machine.spindle import Spindle
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.rotors import STEPPED, support
from tests.oracles.spindles import RPM, pairs
from tests.rotordyn.analyses.frf.test_receptance_errors import machine

K = 1e7
GRID = tuple(np.linspace(20.0, 1500.0, 10))


def single(ratio: float) -> Spindle:
    """A rigid rotor on one spring and one damper at its centre of gravity."""
    body = rotor_inertia(STEPPED)
    damper = 2.0 * ratio * math.sqrt(K * body.mass)
    held = (support("middle", body.centre, (K, K), damper),)
    return replace(STEPPED, supports=held, points={"middle": body.centre})


def solved(spindle: Spindle, speeds: list[float], spec: FrfSpec, rotor: str) -> FrequencyResponse:
    stations = tuple(spindle.points.values())
    scene = Scene(
        spindle, Conditions(accuracy=1e-3, rotor=rotor), np.array(speeds) * RPM, 1500.0, stations
    )
    return solve(scene, spec)


@pytest.mark.parametrize(
    ("ratio", "words"),
    [(0.0, "which has no damping"), (2e-6, "which has a damping ratio of 2e-06 only"), (1e-4, "")],
)
def test_a_peak_that_hardly_anything_damps_is_named(ratio: float, words: str) -> None:
    """A mode whose damping ratio is given; a damper along the axis does not reach it."""
    spindle = single(ratio)
    along = replace(spindle.supports[0], damping={("x", "x"): 10.0, **spindle.supports[0].damping})
    spec = FrfSpec(GRID, pairs("middle.y/middle.y"))
    found = solved(replace(spindle, supports=(along,)), [0.0], spec, "rigid")
    assert np.nanmin(found.peak_damping) == pytest.approx(ratio, rel=1e-4)
    sentences = [sentence for sentence in warnings(found) if "height is meaningless" in sentence]
    assert len(sentences) == bool(words)
    if words:
        hertz = math.sqrt(K / rotor_inertia(STEPPED).mass) / (2.0 * math.pi)
        for part in ("middle.y / middle.y", f"at {hertz:.1f} Hz and 0 rpm", "bending 1", words):
            assert part in sentences[0]


@pytest.mark.parametrize("quantity", QUANTITIES)
@pytest.mark.parametrize("ratio", [1e-4, 1e-2, 0.3])
def test_a_single_mass_on_a_coarse_grid(ratio: float, quantity: str) -> None:
    """|H| = ω^p / |K − M ω² + i C ω|: ten frequencies, the highest value is the true one."""
    spindle = single(ratio)
    mass = rotor_inertia(STEPPED).mass
    spec = FrfSpec(GRID, pairs("middle.y/middle.y"), quantity=quantity)
    found = solved(spindle, [0.0], spec, "rigid")
    power = QUANTITIES.index(quantity)
    own = math.sqrt(K / mass)
    omega = own * np.linspace(1.0 - 5.0 * ratio, 1.0 + 5.0 * ratio, 200001)
    damper = 2.0 * ratio * math.sqrt(K * mass)
    size = np.abs(omega**power / (K - mass * omega**2 + 1j * omega * damper))
    inside = (omega / (2.0 * math.pi) >= GRID[0]) & (omega / (2.0 * math.pi) <= GRID[-1])
    largest = size[inside].max()
    at = omega[inside][size[inside].argmax()] / (2.0 * math.pi)
    np.testing.assert_array_equal(found.frequency, GRID)
    assert np.abs(found.peak_value[0, 0]) == pytest.approx([largest], rel=1e-6)
    assert found.peak_frequency[0, 0] == pytest.approx([at], rel=1e-3 * ratio)
    frequency, values = found.curve(0, 0)
    assert np.abs(values).max() == pytest.approx(largest, rel=1e-6)
    assert set(GRID) <= set(frequency.tolist())
    assert f"at {at:.1f} Hz" in summary(found)[0].replace("\N{NO-BREAK SPACE}", " ")


def test_without_damping_a_peak_has_no_limit() -> None:
    found = solved(single(0.0), [0.0], FrfSpec(GRID, pairs("middle.y/middle.y")), "rigid")
    own = math.sqrt(K / rotor_inertia(STEPPED).mass) / (2.0 * math.pi)
    assert found.peak_frequency[0, 0] == pytest.approx([own], rel=1e-9)
    assert np.isinf(found.peak_value[0, 0]).all()
    assert np.isfinite(found.curve(0, 0)[1]).all()
    assert "unbounded" in summary(found)[0]


@settings(max_examples=4)
@given(
    kind=st.sampled_from(["isotropic", "uneven", "coupled"]),
    rpm=st.floats(0.0, 30000.0),
    count=st.integers(2, 40),
    ends=st.sampled_from(["p0.y/p0.y", "p1.y/p0.y", "p2.thz/p1.y", "p1.z/p0.y"]),
)
def test_random_grids_against_a_dense_one(kind: str, rpm: float, count: int, ends: str) -> None:
    """The highest value between any two frequencies, of peaks or the grid, is that of 30 000."""
    asked, spindle = pairs(ends), machine(kind)
    coarse = solved(spindle, [rpm], FrfSpec(tuple(np.linspace(20, 1500, count)), asked), "flexible")
    dense = solved(spindle, [rpm], FrfSpec(tuple(np.linspace(20, 1500, 30001)), asked), "flexible")
    frequency, size = dense.frequency, np.abs(dense.response[0, 0])
    for low in np.linspace(20.0, 1450.0, 30):
        inside = (frequency >= low) & (frequency <= low + 50.0)
        at, curve = coarse.curve(0, 0)
        drawn = np.exp(np.interp(frequency[inside], at, np.log(np.abs(curve) + 1e-300)))
        top = size[inside].argmax()
        if 0 < top < inside.sum() - 1:
            near = coarse.peak_frequency[0, 0] - frequency[inside][top]
            assert np.nanmin(np.abs(near)) < 5.0
            assert np.nanmax(drawn) > 0.99 * size[inside].max()


def test_files_carry_the_peaks(tmp_path) -> None:
    import pyuff

    found = solved(single(1e-4), [0.0], FrfSpec(GRID, pairs("middle.y/middle.y")), "rigid")
    write_uff(tmp_path / "f.uff", found, case="x", places={"middle": Place("spindle", 0.1)})
    record = pyuff.UFF(str(tmp_path / "f.uff")).read_sets(2)
    assert np.abs(record["data"]).max() == np.abs(found.peak_value[0, 0, 0])
