"""Responses over speed, sampled where they need it."""

from __future__ import annotations

import numpy as np

from rotordyn.machine.temperatures import Temperatures
from rotordyn.scene.sampling import over_speed
from rotordyn.scene.scene import Scene
from tests.oracles.spindles import RPM, mfw2310, scene


def test_speeds_without_a_state_are_omitted_where_a_stop_closes_beside_them() -> None:
    """The shaft is hot about 21500 rpm alone, where it unloads the rear bearings."""
    speeds = (0.0, 19000 * RPM, 21500 * RPM, 24000 * RPM)
    found = scene(
        mfw2310(),
        (0.0, 12000.0, 24000.0),
        temperatures=Temperatures(shaft=(20.0, 20.0, 160.0, 20.0), speeds=speeds),
    )

    def stops(at: Scene) -> list[np.ndarray]:
        return [at.stopped[:, 0].astype(float)]

    none = np.empty(0)
    speed, (closed,) = over_speed(found, stops, lambda each: each[0][:, None], none, none)
    lost = (speed > 21400 * RPM) & (speed < 21600 * RPM)
    assert lost.any()
    assert np.isnan(closed[lost]).all()
    assert closed[[0, -1]].tolist() == [0.0, 1.0]
