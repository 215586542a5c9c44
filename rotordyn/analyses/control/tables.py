"""Layout of the result in tables."""

from __future__ import annotations

from rotordyn.results.layout import Layout

LAYOUTS = (
    Layout("control", ("speed", "boundary")),
    Layout("control_margins", ("speed", "load")),
    Layout("control_fits", ("boundary",), ("term",)),
)
