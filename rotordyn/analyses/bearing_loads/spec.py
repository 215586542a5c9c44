"""Specification of the loads of bearings and balls."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from rotordyn.quantity import Whole
from rotordyn.scene.spec import Spec

MOST_STEPS = 1000


@dataclass(frozen=True, slots=True)
class BearingLoadsSpec(Spec):
    """Loads of bearings and balls at every speed, under the static loads of the conditions."""

    loss_steps: Annotated[
        int,
        Whole(0, MOST_STEPS),
        "steps in which the loads across the axis increase to find where a ball loses contact; 0: "
        "contact loss is not computed",
    ] = 20
