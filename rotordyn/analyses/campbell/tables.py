"""Layout of the result in tables."""

from __future__ import annotations

from rotordyn.results.layout import Layout

LAYOUTS = (
    Layout("campbell", ("speed",), ("mode",)),
    Layout("campbell_modes", ("mode",)),
    Layout("campbell_critical", ("critical",)),
    Layout("campbell_shapes", ("shape_speed", "mode", "node"), ("dof",)),
    Layout("campbell_nodes", ("node",), several="rotor"),
    Layout("campbell_bearings", ("speed",), ("passing",)),
    Layout("campbell_rotors", ("rotor",), several="rotor"),
)
