"""Descriptions of models in separate files, and the folder of the library with them."""

from __future__ import annotations

from bearings.bearing import BallBearing
from bearings.materials import Material
from rotordyn.analyses.stability_lobes.workpiece import Workpiece
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.tool import Tool

MODELS: dict[type, str] = {
    Spindle: "spindles",
    Tool: "tools",
    BallBearing: "bearings",
    Material: "materials",
    Workpiece: "workpieces",
}
