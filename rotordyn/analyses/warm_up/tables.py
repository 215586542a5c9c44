"""Tables of a warm-up."""

from __future__ import annotations

from rotordyn.results.layout import Layout

LAYOUTS = (
    Layout("warm_up", ("speed", "bearing")),
    Layout("warm_up_over_time", ("speed", "time", "bearing"), repeating=True),
)
