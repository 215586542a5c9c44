"""What is reported of the balls of a bearing."""

from __future__ import annotations

FREEDOMS = ("x", "y", "z", "thy", "thz")
BALL_QUANTITIES = (
    "inner_angle",
    "outer_angle",
    "inner_load",
    "outer_load",
    "inner_pressure",
    "outer_pressure",
    "centrifugal_force",
    "gyroscopic_moment",
    "inner_grip",
    "outer_grip",
)
