"""Result of a warm-up: temperatures and preload over time."""

from __future__ import annotations

from dataclasses import dataclass

from rotordyn.arrays import Array, Words
from rotordyn.results.declaration import Absence, coordinate, quantity

OVER = ("speed", "time", "bearing")
BY = ("speed", "bearing")
LATER = Absence("after the end, where the warm-up ends early", last="time")
UNBALANCED = Absence("where there is no thermal balance", by=BY)
UNFITTED = Absence("for rings without an interference fit as mounted", by=("bearing",))
NONE_THROUGH = Absence("where every speed ends early")
ENOUGH = 1.0  # K: largest change by the last halving, small against the error of all hypotheses


@dataclass(frozen=True)
class WarmUpResult:
    """Temperatures and loads of every bearing over time from the start.

    ``ended`` [s]: the last instant with values, ``ending`` why it is not the end of the duration.
    ``axial_load`` in the frame of a bearing, below 0 where one that carries both directions is
    loaded from the other side; ``largest_load``: its largest amount, at ``largest_time``;
    ``…_fit_pressure``: 0 where a ring is loose; ``steady_load``, ``steady_…``: in thermal balance;
    ``unbalanced``: why there is none. ``error``: largest change of a temperature by halving the
    steps [K], of speeds that do not end early.
    """

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    time: Array = coordinate("time", unit="s", label="time from the start")
    bearing: Words = coordinate("bearing", unit="", label="bearing")
    outcome: Words = quantity("speed", unit="", label="outcome")
    ended: Array = quantity("speed", unit="s", label="last instant with values")
    ending: Words = quantity("speed", unit="", label="why it ends there")
    axial_load: Array = quantity(*OVER, unit="N", label="axial load", absent=(LATER,))
    ball_temperature: Array = quantity(
        *OVER, unit="degC", label="temperature of the balls", absent=(LATER,)
    )
    inner_temperature: Array = quantity(
        *OVER, unit="degC", label="temperature of the inner ring", absent=(LATER,)
    )
    outer_temperature: Array = quantity(
        *OVER, unit="degC", label="temperature of the outer ring", absent=(LATER,)
    )
    shaft_temperature: Array = quantity("time", unit="degC", label="temperature of the shaft")
    housing_temperature: Array = quantity("time", unit="degC", label="temperature of the housing")
    heat: Array = quantity(*OVER, unit="W", label="heat", absent=(LATER,))
    inner_fit_pressure: Array = quantity(
        *OVER, unit="Pa", label="pressure of the inner ring on the shaft", absent=(LATER, UNFITTED)
    )
    outer_fit_pressure: Array = quantity(
        *OVER,
        unit="Pa",
        label="pressure of the outer ring in the housing",
        absent=(LATER, UNFITTED),
    )
    ring_stress: Array = quantity(
        *OVER,
        unit="Pa",
        label="Tresca stress of the inner ring by its fit",
        absent=(LATER, UNFITTED),
    )
    largest_load: Array = quantity(*BY, unit="N", label="largest axial load")
    largest_time: Array = quantity(*BY, unit="s", label="time of the largest axial load")
    steady_load: Array = quantity(
        *BY, unit="N", label="axial load in thermal balance", absent=(UNBALANCED,)
    )
    steady_ball_temperature: Array = quantity(
        *BY, unit="degC", label="temperature of the balls in balance", absent=(UNBALANCED,)
    )
    steady_inner_temperature: Array = quantity(
        *BY, unit="degC", label="temperature of the inner ring in balance", absent=(UNBALANCED,)
    )
    steady_outer_temperature: Array = quantity(
        *BY, unit="degC", label="temperature of the outer ring in balance", absent=(UNBALANCED,)
    )
    unbalanced: Words = quantity("speed", unit="", label="why there is no thermal balance")
    error: float = quantity(
        unit="K", label="estimated error of temperatures", absent=(NONE_THROUGH,)
    )
