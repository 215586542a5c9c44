"""Tables of the response to unbalance."""

from __future__ import annotations

from rotordyn.results.layout import Layout

LAYOUTS = (
    Layout("unbalance", ("speed", "point"), ("axis",)),
    Layout("unbalance_forces", ("speed", "support"), ("axis",)),
    Layout("unbalance_curve", ("fine_speed", "point"), ("axis",)),
    Layout("unbalance_force_curve", ("fine_speed", "support"), repeating=True),
    Layout("unbalance_peaks", ("point", "resonance")),
    Layout("unbalance_runs", ("run", "point")),
    Layout("unbalance_run_curve", ("run", "run_speed", "point")),
    Layout("unbalance_run_forces", ("run", "support")),
    Layout("unbalance_run_force_curve", ("run", "run_speed", "support")),
    Layout("unbalance_acting", ("unbalance",)),
    Layout("unbalance_critical", ("critical",)),
)
