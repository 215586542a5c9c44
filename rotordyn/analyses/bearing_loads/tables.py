"""Layout of the result in tables."""

from __future__ import annotations

from rotordyn.results.layout import Layout

LAYOUTS = (
    Layout("bearing_loads", ("speed", "bearing")),
    Layout("ball_loads", ("speed", "bearing", "ball"), repeating=True),
)
