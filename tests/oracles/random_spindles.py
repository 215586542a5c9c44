"""Spindles as random as a designer could make them."""

from __future__ import annotations

import math
from typing import Any

from hypothesis import strategies as st

from bearings import STEEL, AngularContactBallBearing
from rotordyn.machine.growth import ComputedShortening, QuadraticInSpeed, RingGrowth
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.sleeve import Sleeve, Spring
from rotordyn.machine.spindle import Spindle
from tests.oracles.spindles import TOP


def bearing(pitch: float, angle: float, ball: float) -> AngularContactBallBearing:
    """As many balls as fit with a fifth of the circle left free."""
    return AngularContactBallBearing(
        ball_diameter=ball,
        pitch_diameter=pitch,
        balls=int(0.8 * math.pi / math.asin(ball / pitch)),
        contact_angle=math.radians(angle),
        inner_conformity=0.54,
        outer_conformity=0.53,
    )


@st.composite
def spindles(draw: Any) -> Spindle:
    """Two to six bearings in front and rear groups, the rear ones on one or two sleeves.

    Springs 1 to 50 N/µm or rigid, 50 to 2000 N, some with a stop.
    """
    count = draw(st.integers(2, 6))
    front = draw(st.integers(1, count - 1))
    side = draw(st.sampled_from([1, -1]))
    models = [
        bearing(*(draw(st.sampled_from(values)) for values in ((0.05, 0.07, 0.09), (15, 20, 25),
                                                               (6.35e-3, 9.525e-3))))
        for _ in range(2)
    ]  # fmt: skip
    growth = RingGrowth(
        draw(st.sampled_from([0.0, 5e-6, 15e-6])),
        QuadraticInSpeed(draw(st.floats(0.0, 10e-6)), TOP),
    )
    damping = dict(radial_damping=1000.0, axial_damping=1000.0)
    seats = tuple(
        BearingSeat(f"b{k}", models[k >= front], 0.03 + 0.05 * k, side if k < front else -side,
                    growth, **damping)
        for k in range(count)
    )  # fmt: skip
    rear = [s.name for s in seats[front:]]
    split = draw(st.integers(1, len(rear)))
    groups = [g for g in (rear[:split], rear[split:]) if g]
    sleeves = tuple(
        Sleeve(
            f"s{k}",
            tuple(group),
            Spring(draw(st.floats(50.0, 2000.0)), draw(_stiffness())),
            draw(st.sampled_from([math.inf, math.inf, 5e-6, 40e-6])),
        )
        for k, group in enumerate(groups)
    )
    shaft = Shaft(0.0, (Section(0.4, 0.045, 0.015, STEEL),))
    shortening = draw(st.sampled_from([None, ComputedShortening(0.03)]))
    return Spindle(
        "random", shaft, seats=seats, sleeves=sleeves, points={"tip": 0.0}, shortening=shortening
    )


def _stiffness() -> st.SearchStrategy[float]:
    return st.one_of(st.floats(1e6, 50e6), st.just(math.inf))
