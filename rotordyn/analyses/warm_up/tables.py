"""How its result is laid out in tables."""

from __future__ import annotations

from rotordyn.results.layout import Layout

LAYOUTS = (
    Layout("warm_up", ("speed", "bearing")),
    Layout("warm_up_over_time", ("speed", "time", "bearing"), repeating=True),
)
