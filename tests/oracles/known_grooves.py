"""Four-point-contact and deep-groove bearings that the tests share."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearings import (
    SILICON_NITRIDE,
    AngularContactBallBearing,
    DeepGrooveBallBearing,
    FourPointBallBearing,
    Material,
    ThrustBallBearing,
)
from tests.oracles.four_point import Drawing, GrooveOracle
from tests.oracles.known_bearings import RPM

LACROIX_STEEL = Material("steel of Lacroix' examples", 200e9, 0.3, 7850.0)
STEEL_PARTS = dict(ball_material=LACROIX_STEEL, ring_material=LACROIX_STEEL)

# Lacroix (2014), four-point bearings of his tests and examples: section 2.4, tables 4.9 and 5.1.
QJ218 = Drawing(
    ball_diameter=22.225e-3,
    pitch_diameter=125e-3,
    balls=15,
    contact_angle=math.radians(35.0),
    inner_conformity=0.5167,
    outer_conformity=0.5321,
    inner_shim=0.3574e-3,
    outer_shim=0.8068e-3,
    **STEEL_PARTS,
)
QJ218_THINNED = replace(
    QJ218,
    inner_conformity=0.5138,
    outer_conformity=0.5301,
    inner_shim=0.2897e-3,
    outer_shim=0.7495e-3,
)
R24_14 = Drawing(
    ball_diameter=20.638e-3,
    pitch_diameter=158e-3,
    balls=20,
    contact_angle=math.radians(40.0),
    inner_conformity=0.5195,
    outer_conformity=0.5124,
    inner_shim=0.2e-3,
    outer_shim=0.21e-3,
    **STEEL_PARTS,
)
R20_10 = replace(R24_14, contact_angle=math.radians(27.67))
DRAWINGS = {"QJ218": QJ218, "QJ218_thin": QJ218_THINNED, "R24_14": R24_14}

# A 6210 deep-groove bearing: common dimensions, radial clearance of 20 µm; steel and hybrid.
CLEARANCE = 20e-6


def drawn_6210(clearance: float = CLEARANCE, *, hybrid: bool = False) -> Drawing:
    """Its drawing, the free contact angle from cos α = 1 − Pd/(2 BD)."""
    free = (0.515 + 0.525 - 1.0) * 12.7e-3
    return Drawing(
        ball_diameter=12.7e-3,
        pitch_diameter=70e-3,
        balls=10,
        contact_angle=math.acos(1.0 - clearance / (2.0 * free)),
        inner_conformity=0.515,
        outer_conformity=0.525,
        ball_material=SILICON_NITRIDE if hybrid else LACROIX_STEEL,
        ring_material=LACROIX_STEEL,
    )


def common(drawing: Drawing) -> dict[str, Any]:
    """Arguments that all kinds have."""
    names = ("ball_diameter", "pitch_diameter", "balls", "inner_conformity", "outer_conformity")
    parts = (*names, "ball_material", "ring_material")
    return {name: getattr(drawing, name) for name in parts}


def four_point(drawing: Drawing, **play: float) -> FourPointBallBearing:
    """By the free contact angle of the drawing unless a play is given instead."""
    play = play or {"contact_angle": drawing.contact_angle}
    shims = dict(inner_shim=drawing.inner_shim, outer_shim=drawing.outer_shim)
    return FourPointBallBearing(**common(drawing), **shims, **play)


def deep_groove(drawing: Drawing) -> DeepGrooveBallBearing:
    """By the free contact angle."""
    return DeepGrooveBallBearing(**common(drawing), contact_angle=drawing.contact_angle)


def angular_contact(drawing: Drawing) -> AngularContactBallBearing:
    """The bearing whose balls touch as those of the drawing do under thrust towards +x."""
    return AngularContactBallBearing(**common(drawing), contact_angle=drawing.contact_angle)


def thrust(drawing: Drawing) -> ThrustBallBearing:
    """The bearing of one groove a washer, at 90°."""
    return ThrustBallBearing(**common(drawing))


def lever(drawing: Drawing) -> NDArray[np.float64]:
    """What makes all five components of a load forces, and those of a displacement lengths."""
    return GrooveOracle(drawing).lever


def mixed_loads(count: int, seed: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Loads of either thrust with radial loads and moments, and speeds, a part at rest."""
    rng = np.random.default_rng(seed)
    thrown = rng.uniform(-1.0, 1.0, (count, 5)) * [40e3, 12e3, 12e3, 400.0, 400.0]
    thrown[:, 1:] *= rng.uniform(size=(count, 1))
    return thrown, rng.choice([0.0, 3000.0, 9000.0, 14000.0], count) * RPM
