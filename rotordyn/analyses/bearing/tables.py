"""Layout of the result in tables."""

from __future__ import annotations

from rotordyn.results.layout import Layout

LAYOUTS = (
    Layout("bearing", ("speed", "load")),
    Layout("bearing_stiffness", ("speed", "load", "tangent"), ("dof", "dof_other")),
    Layout("bearing_balls", ("speed", "load", "ball")),
    Layout("bearing_contacts", ("speed", "load", "ball", "contact")),
    Layout("bearing_grooves", ("contact",)),
)
