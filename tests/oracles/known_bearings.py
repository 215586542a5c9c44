"""Bearings of the literature that the tests share."""

from __future__ import annotations

import math

from bearings import AngularContactBallBearing, DeepGrooveBallBearing, Material

RPM = 2.0 * math.pi / 60.0
DEGREE = math.pi / 180.0
HARRIS_STEEL = Material("steel of Harris' examples", 206e9, 0.3, 7800.0)
ISO_STEEL = Material("steel of ISO/TS 16281", 210e9, 0.3, 7800.0)
HYPOTHESES = ("hybrid", "outer", "inner", "geometric")
SHARINGS = ("equal", "outer", "inner", "hybrid")

# Noël (2013), spindle bearing of the MFW 2310; ball count and ring modulus as inferred there.
VEX70 = AngularContactBallBearing(
    ball_diameter=9.525e-3,
    pitch_diameter=90e-3,
    balls=25,
    contact_angle=25 * DEGREE,
    inner_conformity=0.56,
    outer_conformity=0.54,
)

# The same with the outer conformity identified on the spindle (phase 6).
VEX70_IDENTIFIED = AngularContactBallBearing(
    ball_diameter=9.525e-3,
    pitch_diameter=90e-3,
    balls=25,
    contact_angle=25 * DEGREE,
    inner_conformity=0.56,
    outer_conformity=0.571,
)

# Harris, Rolling Bearing Analysis: the 218 angular-contact bearing of his examples.
HARRIS_218 = AngularContactBallBearing(
    ball_diameter=22.23e-3,
    pitch_diameter=125.3e-3,
    balls=16,
    contact_angle=40 * DEGREE,
    inner_conformity=0.5232,
    outer_conformity=0.5232,
    ball_material=HARRIS_STEEL,
    ring_material=HARRIS_STEEL,
)

# Harris: the 209 deep-groove bearing.
HARRIS_209 = AngularContactBallBearing(
    ball_diameter=12.7e-3,
    pitch_diameter=65e-3,
    balls=9,
    contact_angle=0.0,
    inner_conformity=0.52,
    outer_conformity=0.52,
    ball_material=HARRIS_STEEL,
    ring_material=HARRIS_STEEL,
)

HARRIS_209_DEEP = DeepGrooveBallBearing(
    ball_diameter=12.7e-3,
    pitch_diameter=65e-3,
    balls=9,
    radial_clearance=0.0,
    ball_material=HARRIS_STEEL,
    ring_material=HARRIS_STEEL,
)

# A deep-groove bearing solved by a commercial code after ISO/TS 16281.
ISO_DEEP_GROOVE = AngularContactBallBearing(
    ball_diameter=11.5e-3,
    pitch_diameter=43.5e-3,
    balls=7,
    contact_angle=0.0,
    inner_conformity=0.52,
    outer_conformity=0.53,
    ball_material=ISO_STEEL,
    ring_material=ISO_STEEL,
)
