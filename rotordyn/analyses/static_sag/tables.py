"""Layouts of the tables of sag and runout."""

from __future__ import annotations

from rotordyn.results.layout import Layout

LAYOUTS = (
    Layout("static_sag", ("speed", "gauge"), ("direction",), repeating=True),
    Layout("static_sag_line", ("speed", "station"), ("direction",)),
    Layout("static_sag_rings", ("speed", "gauge", "ring"), ("direction",)),
)
