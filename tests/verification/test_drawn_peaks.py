"""Drawn responses of shipped machines: every resonance as high as on a dense grid, no kinks."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rotordyn
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.job import solve
from rotordyn.job.figures import figures
from tests.oracles.spindles import RPM

FEW, MANY = 30, 20001  # frequencies


def responses(name: str, rpm: float, count: int):
    """The FRF alone, at one speed, at so many frequencies; case and result."""
    case = rotordyn.load(name)
    spec = case.analyses["frf"]
    frequency = tuple(np.linspace(spec.frequencies[0], spec.frequencies[-1], count))
    slices = (rpm * RPM,)
    few = FrfSpec(frequency, spec.pairs[:1], slices, quantity=spec.quantity)
    alone = replace(case, speeds=slices, analyses={"frf": few})
    return alone, solve(alone).results["frf"]


@pytest.mark.parametrize(
    ("name", "rpm"),
    [("mfw2310", 24000.0), ("friswell_oil_films", 1500.0), ("friswell_coaxial", 15000.0)],
)
def test_lines_drawn_at_resonances_are_those_of_a_dense_grid(name: str, rpm: float) -> None:
    """Of 30 frequencies: 1 % at the peaks; 6 % around them, down to 0.3 of their height."""
    case, result = responses(name, rpm, FEW)
    _, dense = responses(name, rpm, MANY)
    draw = dict(figures(case, {"frf": result}))["frf_amplitude_phase"]
    line = max(draw().axes[0].get_lines(), key=lambda each: len(each.get_xdata()))
    at, drawn = (np.asarray(values, dtype=float) for values in line.get_data())
    frequency, size = dense.frequency, np.abs(dense.response[0, 0])
    scale = np.nanmax(drawn) / np.nanmax(np.abs(result.curve(0, 0)[1]))  # to the unit of the axis
    there = np.exp(np.interp(frequency, at, np.log(drawn))) / scale
    tops = np.flatnonzero((size[1:-1] > size[:-2]) & (size[1:-1] > size[2:])) + 1
    assert len(tops) >= 2
    for top in tops:
        error = np.abs(there / size - 1.0)
        near = (np.abs(frequency / frequency[top] - 1.0) < 0.1) & (size > 0.3 * size[top])
        assert error[top] < 0.01, frequency[top]
        assert error[near].max() < 0.06, frequency[top]
