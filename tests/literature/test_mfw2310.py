"""Fischer MFW 2310, reconstructed: what an independent code finds with the same rotor.

Source of every expected value: the table of the reconstruction (26 parameters fitted to results of
Noël 2013, chapter IV), columns "found" at rest and "physical sign, outer control, equal sharing" at
24 000 rpm. Tolerance 0.5 % at rest and 1 % at speed, or the last printed digit where that is
coarser. Frequencies of that table are undamped.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest

from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.preload.spec import PreloadSpec
from rotordyn.analyses.stiffness.spec import StiffnessSpec
from rotordyn.machine.growth import ComputedShortening
from rotordyn.preload.shortening import seat_shifts, strain_integral
from tests.oracles.spindles import RPM, TOP, answers, case, mfw2310, undamped

SPEEDS = (0, 6000, 12000, 18000, 24000)
AT_REST, AT_SPEED = 5e-3, 1e-2


@cache
def static(rotor: str = "flexible") -> Any:
    """Preload and stiffness over speed."""
    asked = {"preload": PreloadSpec(), "stiffness": StiffnessSpec("Oc2", 500.0, 2)}
    return answers(mfw2310(), SPEEDS, asked, rotor=rotor)


@cache
def frequencies(rotor: str, kind: str = "bending") -> np.ndarray:
    """Undamped frequencies at rest and at top speed (2, modes), ascending."""
    found = answers(
        undamped(mfw2310()), (0, 24000), {"campbell": CampbellSpec(4200.0, shapes=False)},
        rotor=rotor,
    )["campbell"]  # fmt: skip
    chosen = np.array([k == kind for k in found.kind])
    return np.sort(found.frequency[:, chosen], axis=1)


def tangent(variant: str, rotor: str = "flexible") -> np.ndarray:
    result = static(rotor)["stiffness"]
    return result.tangent[:, result.variant.index(variant)] / 1e6


def test_model_is_outer_control_with_equal_sharing() -> None:
    assert (case().conditions.kinematics, case().conditions.moment_sharing) == ("outer", "equal")


# --- at rest --------------------------------------------------------------------------------


def test_rest_rigid_rotor_modes() -> None:
    found = frequencies("rigid")[0]
    assert found[:4] == pytest.approx([1083, 1083, 1523, 1523], rel=AT_REST)


def test_rest_flexible_modes() -> None:
    found = frequencies("flexible")[0]
    expected = np.repeat([903.4, 1349.0, 1587.0, 2859.0], 2)
    assert found[:8] == pytest.approx(expected, rel=AT_REST)


def test_rest_flexible_modes_to_the_digits_printed() -> None:
    found = frequencies("flexible")[0, :8:2]
    assert np.abs(found - [903.4, 1349, 1587, 2859]) == pytest.approx(0.0, abs=0.6)


def test_rest_stiffness() -> None:
    assert tangent("full", "rigid")[0] == pytest.approx(458.0, rel=AT_REST)
    assert tangent("full")[0] == pytest.approx(142.7, rel=AT_REST)
    assert tangent("nonlinear")[0] == pytest.approx(142.7, rel=AT_REST)
    assert tangent("constant_preload")[0] == pytest.approx(142.7, rel=AT_REST)


def test_rest_diagonal_stiffness_loses() -> None:
    """−14.6 %: compared as the ratio of the stiffnesses, 0.5 % of which is 0.4 points."""
    assert tangent("diagonal")[0] / tangent("full")[0] == pytest.approx(1 - 0.146, rel=AT_REST)


def test_rest_torsion_is_free() -> None:
    assert frequencies("flexible", "torsion")[0, 0] == pytest.approx(2974.0, rel=AT_REST)


def test_rest_preloads() -> None:
    """Exactly what the springs state: (P1 + P2)/2, P1, P2/2 (thesis, table 3.7)."""
    found = static()["preload"].axial_load[0]
    assert found == pytest.approx([551, 551, 574, 264, 264], rel=1e-9)


@pytest.mark.parametrize(("x", "expected"), [(0.39165, -29.4), (0.0844, -3.1), (0.0, 2.9)])
def test_centrifugal_shortening(x: float, expected: float) -> None:
    """Positions 3, 2 and the nose at 24 000 rpm; the closed form, printed to 0.1 µm."""
    found = strain_integral(mfw2310().shaft, 0.0386, x) * TOP**2 * 1e6
    assert found == pytest.approx(expected, abs=0.05)


def test_computed_shortening_of_the_seats() -> None:
    spindle = mfw2310(shortening=ComputedShortening(0.0386))
    shifts = seat_shifts(spindle, np.array([0.0, TOP]))[1] * 1e6
    assert shifts[[0, 1]].sum() == pytest.approx(0.0, abs=0.06)
    assert shifts[2] == pytest.approx(-3.1, abs=0.05)
    assert shifts[[3, 4]].mean() == pytest.approx(-29.4, abs=0.05)


# --- at speed -------------------------------------------------------------------------------


def test_speed_radial_stiffness() -> None:
    expected = [138.0, 106.8, 83.3, 88.4]
    assert tangent("full")[1:] == pytest.approx(expected, rel=AT_SPEED)
    assert tangent("nonlinear")[1:] == pytest.approx(expected, rel=AT_SPEED)


def test_speed_front_stop_reached_between_18000_and_24000() -> None:
    preload = static()["preload"]
    assert preload.stop_reached.tolist() == [[False, False]] * 4 + [[True, False]]
    assert 18000 < preload.stop_speed[0] / RPM < 24000
    assert np.isnan(preload.stop_speed[1])
    assert preload.position[4, 1] == pytest.approx(-52.2e-6, rel=1e-12)


def test_speed_preload_sum_and_rear_sleeve() -> None:
    """Sum of preloads 2550 N = the load of positions 2 and 3; up2 −115.2 µm."""
    preload = static()["preload"]
    assert preload.axial_load[4, 2:].sum() == pytest.approx(2550.0, rel=AT_SPEED)
    assert preload.position[4, 2] == pytest.approx(-115.2e-6, rel=AT_SPEED)


def test_speed_rigid_rotor_stiffness() -> None:
    assert tangent("full", "rigid")[4] == pytest.approx(166.3, rel=AT_SPEED)


def test_speed_rigid_rotor_modes() -> None:
    """475.2 and 946.7 Hz lie midway between backward and forward whirl."""
    found = frequencies("rigid")[1]
    assert found[:4].reshape(2, 2).mean(axis=1) == pytest.approx([475.2, 946.7], rel=AT_SPEED)
    assert found[0] < 475.2 < found[1]
    assert found[2] < 946.7 < found[3]


def test_speed_diagonal_and_constant_preload() -> None:
    """−11.95 % and −63.4 %: compared as ratios of stiffnesses."""
    full = tangent("full")[4]
    assert tangent("diagonal")[4] / full == pytest.approx(1 - 0.1195, rel=AT_SPEED)
    assert tangent("constant_preload")[4] / full == pytest.approx(1 - 0.634, rel=AT_SPEED)


def test_speed_effects_are_what_softens() -> None:
    """The same spindle with bearings as at rest keeps its stiffness."""
    asked = {"stiffness": StiffnessSpec("Oc2", 500.0, 1, ("full", "nonlinear"))}
    found = answers(mfw2310(), (0, 24000), asked, bearings="static")["stiffness"].tangent
    assert found / 1e6 == pytest.approx(np.full((2, 2), 142.7), rel=AT_REST)


def test_spin_softening_in_the_fixed_frame_is_ten_percent_wrong() -> None:
    """Mode 1 from 900/906 to 808/814 Hz, flexible rotor, bearings as at rest, 24 000 rpm.

    Known from an independent code with the same rotor; Ω² M_ω is subtracted as by Cao and Altintas
    (2004) and in equation (1.3) of the thesis.
    """
    found = {}
    for option in ("inertial", "fixed-frame softening"):
        result = answers(
            mfw2310(), (0, 24000), {"campbell": CampbellSpec(4000.0)},
            bearings="static", formulation=option,
        )["campbell"]  # fmt: skip
        rows = [result.mode.index(f"bending 1 {side}") for side in ("backward", "forward")]
        found[option] = result.frequency[1, rows]
    assert found["inertial"] == pytest.approx([900, 906], rel=0.003)
    assert found["fixed-frame softening"] == pytest.approx([808, 814], rel=0.003)
