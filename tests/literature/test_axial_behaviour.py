"""Chapter III of D. Noël's thesis (IRCCyN, Nantes, 2013): the axial behaviour of the
milling spindle MFW 2310, as falls and ratios where it does not print its parameters."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

import rotordyn
from rotordyn.machine.history import HistoryStep, Past
from rotordyn.preload.friction import operating_state
from rotordyn.preload.state import PreloadState
from tests.oracles.spindles import CASES, RPM

Array = NDArray[np.float64]


@cache
def state(case: str, variant: str, rpm: tuple[float, ...], *steps: HistoryStep) -> PreloadState:
    found = rotordyn.load(CASES / f"{case}.yaml").variants[variant]
    assert found.spindle is not None
    speed = np.array(rpm) * RPM
    return operating_state(found.spindle, speed, found.conditions.law, past=Past(steps))


def slopes(found: PreloadState) -> Array:
    """Axial stiffness at no load, sleeves free (speeds,) [N/µm]: the thesis' equation (3.6)."""
    each, tandem = found.net.response.slope, found.network.tandem
    spring = np.array([[np.inf, *(s.spring.stiffness for s in found.spindle.sleeves)]])
    held = each * tandem
    return np.asarray((1.0 / (1.0 / held + 1.0 / spring)).sum(axis=1) / 1e6)


def fall(values: Array) -> Array:
    """Shares lost from the first value on [%]."""
    return np.asarray(100.0 * (1.0 - values[1:] / values[0]))


def test_a_sprung_preload_lets_the_stiffness_fall() -> None:
    """Fig. 3.5: 331 → 94.3 → 68.5 N/µm at 0, 16, 24 krpm: 71.5 and 79.5 % lost; preload from 1205
    to 1650 N. Assumed: plain bearings without growth, springs of 602 N and 6 N/µm."""
    found = state("mfw2310_rigid_or_sprung", "sprung", (0.0, 16000.0, 24000.0))
    assert fall(slopes(found)) == pytest.approx([71.5, 79.5], abs=3.0)
    assert found.seat_load()[2, :2].sum() == pytest.approx(1650.0, rel=0.1)


def test_a_rigid_preload_keeps_it() -> None:
    """Fig. 3.4: 650 → 441 → 434 N/µm, 32.1 and 33.2 % lost, with the same assumptions."""
    found = state("mfw2310_rigid_or_sprung", "rigid", (0.0, 16000.0, 24000.0))
    assert fall(slopes(found)) == pytest.approx([32.1, 33.2], abs=4.5)
    sprung = state("mfw2310_rigid_or_sprung", "sprung", (0.0, 16000.0, 24000.0))
    assert slopes(sprung)[0] / slopes(found)[0] == pytest.approx(331.0 / 650.0, rel=0.1)
    assert found.seat_load()[2, :2].sum() > 2.5 * 1204.0, "3160 of 1200 N in the thesis"


def test_friction_splits_the_stiffness_at_no_load() -> None:
    """Fig. 3.23: 153 N/µm after the force fell, 139 after it rose, 4000 rpm, measured."""
    found = []
    for last in (1600.0, -1900.0):
        steps = (HistoryStep(run_up=True), HistoryStep(axial_force=last))
        found.append(float(slopes(state("mfw2310_phases", "phase_6", (4000.0,), *steps))[0]))
    assert found == pytest.approx([153.0, 139.0], rel=0.12)
    assert found[0] / found[1] == pytest.approx(153.0 / 139.0, rel=0.06)


@pytest.mark.parametrize(
    ("phase", "known"),
    [(1, 76.7), (2, 63.2), (3, 76.7), (4, 80.2), (5, 80.3)],
)
def test_the_rear_sleeve_in_every_phase(phase: int, known: float) -> None:
    """Tables 3.2 to 3.6 at 24 krpm [µm]: further here, since each set was fitted to a model with
    the other sign of the gyroscopic moment; the first, which has no stop and no shift, is met."""
    found = state("mfw2310_phases", f"phase_{phase}", (0.0, 16000.0, 24000.0))
    moved = -1e6 * found.shift[2, 2]
    assert moved == pytest.approx(known, rel=0.05 if phase == 1 else 0.45)
    assert moved > 0.95 * known


def test_the_front_stop_of_the_smaller_spindle_closes_under_a_force() -> None:
    """MFW 1709, Fig. 3.31: at 24 krpm the stiffness rises under negative forces, as of a stop."""
    case = rotordyn.load(CASES / "mfw1709.yaml")
    assert case.spindle is not None
    speed, law = np.array([24000.0]) * RPM, case.conditions.law
    free, pushed = (operating_state(case.spindle, speed, law, force) for force in (0.0, -1200.0))
    assert not free.net.held.any()
    assert pushed.net.held[0, 1]
