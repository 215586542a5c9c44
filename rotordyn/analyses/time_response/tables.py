"""Tables of the response over time."""

from __future__ import annotations

from rotordyn.results.layout import Layout

LAYOUTS = (
    Layout("time_response", ("speed", "time", "point"), ("axis",)),
    Layout("time_response_bearings", ("speed", "time", "bearing"), ("axis",)),
    Layout("time_response_forces", ("time", "force")),
    Layout("time_response_largest", ("speed", "point")),
    Layout("time_response_peak_loads", ("speed", "bearing")),
    Layout("time_response_sleeves", ("speed", "time", "sleeve")),
    Layout("time_response_stops", ("speed", "sleeve")),
)
