"""Quantities of bearing engineering, compared with values of catalogues, standards and other codes.

``[M]``: the formula of a standard or book is quoted from memory; its text was not available.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from scipy.optimize import brentq

from bearings import (
    SILICON_NITRIDE,
    STEEL,
    AngularContactBallBearing,
    BallBearing,
    DeepGrooveBallBearing,
    LinearBallGuide,
    Material,
    film,
    fits,
    life,
)
from bearings.fit.compound import Cylinder, compound
from bearings.geometry import geometry
from bearings.ring.state import BearingState
from benchmarks.bearing.subject import VEX70
from docs.generate.heat_rows import PUBLISHED_MOMENT, roller_moment
from docs.generate.rows import Row

RPM, DEGREE, MILLION, MICRON = math.pi / 30.0, math.pi / 180.0, 1e6, 1e-6
CODE = "MASTA, ISO/TS 16281 [M]"
GMN = "GMN, catalogue 4000 0813"
SKF = "SKF, catalogue 6000"
LIGHT = 20.0  # N, under which contact angles stay at their free values
ISO = Material("steel", 210e9, 0.3, 7800.0)
DEEP = DeepGrooveBallBearing(
    11.5e-3,
    43.5e-3,
    7,
    inner_conformity=0.52,
    outer_conformity=0.53,
    ball_material=ISO,
    ring_material=ISO,
    radial_clearance=0.0,
)
S6014C = AngularContactBallBearing(
    11.906e-3, 90e-3, 21, contact_angle=15 * DEGREE, ball_material=STEEL
)


def engineer_rows() -> list[Row]:
    """One row for each published or independent value."""
    return [row for group in GROUPS.values() for row in group()]


def _axial(bearing: BallBearing, force: float, rpm: float = 0.0) -> BearingState:
    return bearing.equilibrium(load=[force, 0.0, 0.0, 0.0, 0.0], speed=rpm * RPM)


def _commercial_code() -> list[Row]:
    pushed = _axial(DEEP, 1000.0)
    across = DEEP.equilibrium(load=[0.0, 1000.0, 0.0, 0.0, 0.0])
    lives = [float(life.reference_life(s, 23_400.0)) / MILLION for s in (across, pushed)]
    moved = across.displacement[1] / MICRON, pushed.displacement[0] / MICRON
    held = [0.0, 0.0, 0.0, 0.0, math.nan]
    tilt = DEEP.equilibrium(load=[*[math.nan] * 4, 1.0], displacement=held).displacement[4]
    radius = 0.5 * DEEP.pitch_diameter
    arm = 1.0 + (DEEP.inner_conformity - 0.5) * DEEP.ball_diameter / radius
    races = [life.life_of(_axial(VEX70, 610.0, rpm), 23e3) for rpm in (0, 10e3, 20e3, 30e3)]
    return [
        Row(
            "L10r under 1000 N radially and axially, Z 7, D 11.5 mm [10⁶ rev]",
            tuple(lives),
            2e-3,
            CODE,
            (13163.019, 2222.7318),
        ),
        Row(
            "displacement of this bearing [µm]",
            tuple(map(float, moved)),
            2e-3,
            "MASTA, with the approximate contacts of the standard",
            (15.1101, 133.5381),
        ),
        Row(
            "tilt of this bearing under 1 N m, groove centres shifted to dm/2 [mrad]",
            (1e3 * float(tilt) * arm**1.25,),
            2e-3,
            "MASTA; with the exact groove centres the tilt is 1.3 % less",
            (3.6957,),
        ),
        Row(
            "L10r of the VEX 70 under 610 N at 0, 10, 20, 30 thousand rpm [10⁶ rev]",
            tuple(float(each.revolutions) / MILLION for each in races),
            1e-3,
            "an independent code, beyond the standard [M]",
            (79_320, 98_700, 64_700, 13_260),
        ),
    ]


def _ratings() -> list[Row]:
    hybrid = replace(S6014C, ball_material=SILICON_NITRIDE)

    def made(conformity: float) -> AngularContactBallBearing:
        return AngularContactBallBearing(
            12.7e-3,
            70e-3,
            15,
            contact_angle=25 * DEGREE,
            inner_conformity=conformity,
            outer_conformity=conformity,
            ball_material=STEEL,
        )

    found = made(brentq(lambda f: float(life.dynamic_rating(made(f))) - 45e3, 0.505, 0.6))
    load = np.outer([380.0, 1140.0, 2280.0], [1.0, 0.0, 0.0, 0.0, 0.0])
    rigidity = 2.0 * MICRON * found.equilibrium(load=load).complete_stiffness[:, 0, 0]
    static = float(life.static_rating(S6014C))
    share = float(life.static_rating(hybrid)) / static
    return [
        Row(
            "C of the S 6014 C [N]",
            (float(life.dynamic_rating(S6014C)),),
            0.006,
            f"{GMN}; ISO 281 [M]",
            (48_500,),
        ),
        Row("C0 of the S 6014 C [N]", (static,), 0.03, f"{GMN}; ISO 76 [M]", (46_000,)),
        Row("C0 of the S 6014 C, hybrid over steel", (share,), 0.01, f"{GMN}; ISO 76 [M]", (0.70,)),
        Row(
            "axial rigidity of the S 6210 E, conformities fitted to its C, three preloads [N/µm]",
            tuple(rigidity.tolist()),
            0.02,
            f"{GMN}; ISO 281 [M]",
            (177, 271, 363),
        ),
    ]


def _catalogue_lives() -> list[Row]:
    revolutions = float(life.basic_life(55.3e3, 10e3))
    found = revolutions / MILLION, revolutions / 3000.0 / 60.0
    what = "L10, L10h of the 6309, 10 kN, 3000 rpm [10⁶ rev, h]"
    return [Row(what, found, 3e-3, SKF, (169, 940))]


def _frequencies() -> list[Row]:
    rows = []
    for name, ball, pitch, known in (
        ("6205", 7.94, 39.04, (0.39828, 3.5848, 5.4152, 4.7135 / 2.0)),
        ("ER-16K", 7.9375, 38.5, (0.3969, 3.572, 5.428, 2.32)),
    ):
        bearing = DeepGrooveBallBearing(1e-3 * ball, 1e-3 * pitch, 9, radial_clearance=0.0)
        state = bearing.equilibrium(load=[0.0, 100.0, 0.0, 0.0, 0.0], speed=10.0)
        found = tuple(float(each) for each in life.frequencies(state)[:4])
        source = "CWRU, data sheet" if name == "6205" else "Curtin University, data sheet"
        rows.append(
            Row(f"cage, outer, inner, ball of the {name} per turn", found, 1e-3, source, known)
        )
    return rows


def _fits() -> list[Row]:
    classes = (
        ("k5", 70, (2, 15)),
        ("js5", 70, (-6.5, 6.5)),
        ("h5", 70, (-13, 0)),
        ("H6", 110, (0, 22)),
        ("JS6", 110, (-11, 11)),
        ("JS5", 110, (-7.5, 7.5)),
        ("k5", 50, (2, 13)),
    )
    off = [
        abs(found / MICRON - known)
        for name, size, ends in classes
        for found, known in zip(fits.limits(name, 1e-3 * size), ends, strict=True)
    ]
    bore = fits.bearing_bore(0.070)
    pressed = fits.interference(fits.limits("k5", 0.070), bore)
    shaft, bore75 = fits.limits("j5", 0.075), fits.bearing_bore(0.075)
    loose = fits.interference(shaft, bore75)
    own = (pressed.most, pressed.least, pressed.probable[1], pressed.probable[0])
    nke = (loose.most, loose.least, fits.one_third(shaft, bore75))
    return [
        Row(
            "ISO 286: k5, js5, h5 of 70, H6, JS6, JS5 of 110, k5 of 50 mm, largest error [µm]",
            (max(off),),
            1e-9,
            f"{SKF}, tables",
        ),
        Row(
            "70 k5 in a bore 0/−15: most, least, probable [µm]",
            tuple(float(each) / MICRON for each in own),
            0.05,
            f"{SKF}; agreement within 1 µm required; bore of ISO 492 [M]",
            (30, 2, 26, 6),
        ),
        Row(
            "75 j5 in a bore 0/−15: most, least, probable [µm]",
            tuple(float(each) / MICRON for each in nke),
            0.05,
            "NKE, catalogue",
            (21, -7, 12),
        ),
        Row(
            "interference on a shaft bored to 0.8 over that on a solid one, 6208",
            (_hollow(),),
            2e-3,
            f"Lamé; {SKF}, p. 173: 1.7",
            (1.724,),
        ),
    ]


def _hollow() -> float:
    """Ratio of the pressures of one interference."""
    bore = 20e-3
    pressure = [
        compound(
            [Cylinder(hole * bore, bore, STEEL), Cylinder(bore, bore / 0.77, STEEL)], [1e-5]
        ).pressure[0]
        for hole in (0.0, 0.8)
    ]
    return float(pressure[0] / pressure[1])


def _unloading() -> list[Row]:
    def moved(bearing: BallBearing, force: float) -> float:
        return float(_axial(bearing, force).displacement[0])

    found = []
    for loaded, behind, angle in ((1, 1, 25), (2, 1, 25), (1, 2, 25), (3, 1, 25), (1, 1, 15)):
        rear = replace(VEX70, contact_angle=angle * DEGREE)
        together = moved(VEX70, LIGHT / loaded) + moved(rear, LIGHT / behind)
        alone = VEX70.equilibrium(displacement=[together, 0.0, 0.0, 0.0, 0.0])
        found.append(loaded * float(alone.load[0]) / LIGHT)
    what = "unloading force over preload: DB, 2 and 1, 1 and 2, 3 and 1, 25° against 15°"
    source = "SNFA and GMN, catalogues"
    return [Row(what, tuple(found), 0.012, source, (2.83, 4.16, 2.08, 5.4, 5.9))]


def _friction() -> list[Row]:
    found = roller_moment()
    return [
        Row(
            "φish, φrs, Mrr of the 22208 E, 3500 rpm, 68 mm²/s, Grr 0.26 [1, 1, N mm]",
            (found.inlet, found.starved, found.bare),
            0.01,
            f"{SKF}, p. 104",
            (0.85, 0.80, 437),
        ),
        Row(
            "M of the 22208 E, sliding and drag with factors of roller bearings [N mm]",
            (found.total,),
            0.02,
            f"{SKF}, p. 104; loads, factors of series 222 E and drag variable [M]",
            (PUBLISHED_MOMENT,),
        ),
    ]


def _films() -> list[Row]:
    steel = Material("steel", 200e9, 0.3, 7800.0)
    bearing = DeepGrooveBallBearing(
        12.7e-3,
        64.9985e-3,
        9,
        inner_conformity=0.52,
        outer_conformity=0.52,
        ball_material=steel,
        ring_material=steel,
        radial_clearance=0.0,
    )
    g, modulus = geometry(bearing.grooves), 1.0 / steel.contact_compliance
    found = [
        float(each) / MICRON
        for race, side in ((g.inner, 1.0), (g.outer, -1.0))
        for each in film.hamrock_dowson(
            4944.0,
            6.252,
            6.35e-3 * (1.0 - side * 12.7 / 64.9985),
            modulus,
            race.ellipticity,
            0.04,
            2.3e-8,
        )
    ]
    what = "h_min, h_c of the inner, of the outer race, Hamrock's ball bearing [µm]"
    source = "an independent code [M]; the printed source was not available"
    return [Row(what, tuple(found), 1e-3, source, (0.553, 0.690, 0.661, 0.828))]


def _sleeve() -> list[Row]:
    guide = LinearBallGuide(250, 4e-3, 0.1, 4e-6)
    what = (
        "radial stiffness of a ball sleeve, interference 4 µm, 250 balls of 4 mm on 100 mm [N/µm]"
    )
    source = "Noël (2013), ch. IV: 896 N/µm; balls and shaft are assumed here"
    return [Row(what, (float(guide.stiffness) * MICRON,), 2e-3, source, (896,))]


GROUPS: dict[str, Callable[[], list[Row]]] = {
    "a commercial code": _commercial_code,
    "ratings": _ratings,
    "lives": _catalogue_lives,
    "frequencies": _frequencies,
    "fits": _fits,
    "unloading": _unloading,
    "friction": _friction,
    "films": _films,
    "ball sleeve": _sleeve,
}
