"""Layouts of the tables of frequency responses."""

from __future__ import annotations

from rotordyn.results.layout import Layout

LAYOUTS = (
    Layout("frf_engine_orders", ("speed", "line"), ("pair",)),
    Layout("frf_measured", ("measured",)),
    Layout("frf_measured_peaks", ("measured", "peak")),
)
