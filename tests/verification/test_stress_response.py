"""Responses where nothing limits them, next to there, and at frequencies beyond sense
(docs/stress.md)."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.frf import solve as frf
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.unbalance import solve as unbalance
from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.case.case import Case
from rotordyn.errors import InvalidInput
from rotordyn.machine.spindle import Spindle
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.loads import Unbalance
from rotordyn.scene.scene import Scene
from tests.oracles.rotors import STEEL, support, uniform
from tests.oracles.spindles import pairs, system_of

HZ = 2.0 * math.pi
HELD = 1e8  # N/m
MASS = STEEL.density * math.pi / 4.0 * 0.05**2 * 0.5
BOUNCE = math.sqrt(2.0 * HELD / MASS) / HZ
UNLIMITED = "the response is unbounded at"


def bar(damping: float = 0.0) -> Spindle:
    held = [support(n, x, (HELD, HELD), damping) for n, x in (("a", 0.05), ("b", 0.45))]
    points = {"middle": 0.25, "tip": 0.0}
    return replace(uniform(0.5, 0.05, supports=held), points=points)


def answered(
    *frequency: float,
    spindle: Spindle | None = None,
    speed: tuple[float, ...] = (0.0,),
    quantity: str = "receptance",
    way: str = "middle.y/middle.y",
    **conditions: Any,
) -> Any:
    own = bar() if spindle is None else spindle
    scene = Scene(own, Conditions(**conditions), np.array(speed), 1000.0, (0.0, 0.25))
    return frf.solve(scene, FrfSpec(frequency, pairs(way), quantity=quantity))


def resonance(**conditions: Any) -> float:
    """A frequency of the very system that answers [Hz]."""
    scene = Scene(bar(), Conditions(**conditions), np.array([0.0, 500.0]), 1000.0, (0.0, 0.25))
    known = np.abs(system_of(scene).modes.pole[0].imag) / HZ
    return float(known[known > 1.0].min())


STANDARD = {"element_length": 0.05}  # no refinement: the modes are those of what answers
KINDS: list[dict[str, Any]] = [
    STANDARD,
    {"rotor": "rigid"},
    {"formulation": "rotating", **STANDARD},
]


@pytest.mark.parametrize("conditions", KINDS, ids=str)
def test_undamped_resonance_has_no_response(conditions: dict[str, str]) -> None:
    """Exactly there, within rounding, and among other frequencies and speeds: one sentence."""
    at = resonance(**conditions)
    for asked in ((at,), (at * (1.0 - 4e-16),), (at * (1.0 + 1e-11),), (10.0, at, 2.0 * at)):
        with pytest.raises(
            InvalidInput, match=f"{UNLIMITED} {str(at)[:7]}.* Hz and 0 rpm"
        ) as refused:
            answered(*asked, speed=(0.0, 500.0), **conditions)
        assert "\n" not in str(refused.value)


@pytest.mark.parametrize("conditions", KINDS, ids=str)
def test_beside_an_undamped_resonance_it_falls_with_the_distance(
    conditions: dict[str, str],
) -> None:
    """H ~ 1/(ω0² − ω²): ten times farther, a tenth."""
    at = resonance(**conditions)
    found = answered(at * (1.0 + 1e-7), at * (1.0 + 1e-6), speed=(0.0, 500.0), **conditions)
    size = np.abs(found.receptance[0, 0])
    assert size[0] / size[1] == pytest.approx(10.0, rel=1e-3)


@pytest.mark.parametrize("share", [1e-7, 1e-5, 1e-2])
def test_resonance_with_next_to_no_damping_in_closed_form(share: float) -> None:
    """A rigid rotor bounces by 1/(2k + 2ciω − mω²); a hundred-millionth of critical is enough."""
    damping = share * math.sqrt(2.0 * HELD * MASS)
    frequency = BOUNCE * np.array([1.0 - 1e-3, 1.0 - share, 1.0, 1.0 + share, 1.5])
    omega = HZ * np.unique(frequency)
    expected = 1.0 / (2.0 * HELD + 2j * damping * omega - MASS * omega**2)
    found = answered(*np.unique(frequency), spindle=bar(damping), rotor="rigid").receptance
    assert found[0, 0] == pytest.approx(expected, rel=1e-7)


def test_a_mode_that_no_force_moves_is_no_resonance() -> None:
    """Pitch does not move the middle: next to its frequency the bounce answers as ever."""
    scene = Scene(bar(), Conditions(rotor="rigid"), np.array([0.0]), 2000.0, (0.25,))
    found = campbell.solve(scene, CampbellSpec(2000.0, shapes=False)).frequency[0]
    pitch = float(found[found > 1.1 * BOUNCE].min())
    expected = 1.0 / (2.0 * HELD - MASS * (HZ * pitch) ** 2)
    value = answered(pitch * (1.0 + 1e-10), rotor="rigid").receptance.item()
    assert value == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize("frequency", [1e-300, 1e-150, 1e-30, 1e-9])
def test_next_to_no_frequency_is_rest(frequency: float) -> None:
    """A held shaft answers with its flexibility; velocity and acceleration with ω and ω² of it."""
    still = answered(1e-3).receptance.item().real
    for power, quantity in enumerate(("receptance", "mobility", "inertance")):
        result = answered(frequency, quantity=quantity)
        expected = still * (HZ * frequency) ** power
        assert abs(getattr(result, quantity).item()) == pytest.approx(
            expected, rel=1e-6, abs=1e-320
        )


@pytest.mark.parametrize("way", ["middle.x/middle.x", "middle.y/middle.y"])
@pytest.mark.parametrize("conditions", [{}, {"rotor": "rigid"}], ids=str)
def test_a_free_body_at_next_to_no_frequency(conditions: dict[str, str], way: str) -> None:
    """It answers with 1/(mω²), and with a sentence where that is no number."""
    free = replace(bar(), supports=())
    value = answered(1e-100, spindle=free, way=way, **conditions).receptance.item()
    assert value.real == pytest.approx(-1.0 / (MASS * (HZ * 1e-100) ** 2), rel=1e-6)
    for frequency in (5e-324, 1e-200):
        with pytest.raises(InvalidInput, match=UNLIMITED):
            answered(frequency, 10.0, spindle=free, way=way, **conditions)


@pytest.mark.parametrize("quantity", ["receptance", "mobility", "inertance"])
def test_rest_itself_is_no_frequency(quantity: str) -> None:
    with pytest.raises(InvalidInput, match="frequency out of range: given 0 Hz; allowed: above 0"):
        answered(0.0, quantity=quantity)


@pytest.mark.parametrize(
    ("frequencies", "said"),
    [
        ((10.0, 5.0), "not in ascending order: given 5 Hz after 10 Hz"),
        ((5.0, 5.0), "repeated: given 5 Hz after 5 Hz"),
        ((), "no frequencies"),
    ],
)
def test_lists_of_frequencies_ascend(frequencies: tuple[float, ...], said: str) -> None:
    with pytest.raises(InvalidInput, match=said):
        FrfSpec(frequencies, pairs("tip.y/tip.y"))


def test_more_values_than_fit_are_refused() -> None:
    spec = FrfSpec(tuple(np.linspace(1.0, 2000.0, 100_000)), pairs("tip.y/tip.y"))
    speeds = tuple(np.linspace(0.0, 100.0, 1001))
    with pytest.raises(InvalidInput, match=r"given 1.001e\+08 \(.*: 1001 × 1 × 100000\)"):
        Case("many", "many", speeds, {"frf": spec}, spindle=bar())


def test_unbalance_at_a_critical_speed_solved_for() -> None:
    """The critical speed that is reported is the one at which there is no steady response."""
    spindle = bar()
    spec = UnbalanceSpec(("tip",), (Unbalance("tip", 1e-6),))
    speeds = np.array([0.0, 6000.0])
    scene = Scene(spindle, Conditions(element_length=0.05), speeds, 6000.0 / HZ, (0.0,))
    (critical,) = unbalance.solve(scene, spec).critical_speed
    at = Scene(
        spindle, Conditions(element_length=0.05), np.array([critical, 6000.0]), 6000.0 / HZ, (0.0,)
    )
    resonant = unbalance.solve(at, spec)
    assert "an undamped critical speed" in resonant.outcome[0]
    assert np.isnan(resonant.displacement[0]).all()
    near = Scene(
        spindle,
        Conditions(element_length=0.05),
        critical * np.array([1 - 1e-6, 1 + 1e-6]),
        6000.0 / HZ,
        (0.0,),
    )
    phase = unbalance.solve(near, spec).displacement[:, 0, 0]
    assert np.isfinite(phase).all()
    assert phase[0].real * phase[1].real < 0.0
