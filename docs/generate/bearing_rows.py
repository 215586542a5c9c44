"""Accuracy of single bearings."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from bearings import STEEL, AngularContactBallBearing, Material
from bearings.geometry import geometry
from bearings.ring.state import BearingState
from benchmarks.bearing.subject import VEX70
from docs.generate.rows import Row

Array = NDArray[np.float64]
RPM = math.pi / 30.0
FAST = 30000.0 * RPM
HYPOTHESES = ("hybrid", "outer", "inner", "geometric")
TWO_CODES = "two independent codes; geometry of Harris, *Rolling Bearing Analysis*"
NOEL = "independent recomputation of Noël (2013); published: "

HARRIS_218 = AngularContactBallBearing(
    ball_diameter=22.23e-3,
    pitch_diameter=125.3e-3,
    balls=16,
    contact_angle=math.radians(40.0),
    inner_conformity=0.5232,
    outer_conformity=0.5232,
    ball_material=Material("steel", 206e9, 0.3, 7800.0),
    ring_material=STEEL,
)


def bearing_rows() -> list[Row]:
    """Contacts, published bearings, and the two checks that need no reference."""
    return [
        _contacts(),
        _harris("at rest", 0.0, (36.097, 41.5019, 1678.88, 765.08, 485.12)),
        _harris("at 10 000 rpm", 1e4 * RPM, (14.916, 49.9613, 1453.09, 288.05, 171.66)),
        Row(
            "VEX 70, 1000 N at rest: Kxx, Kyy [N/µm]",
            _diagonal(_thrust(1000.0, 0.0)),
            0.005,
            NOEL + "140, 301",
            (139.2, 299.1),
        ),
        Row(
            "VEX 70, 1000 N at 30 000 rpm: Kxx, Kyy [N/µm]",
            _diagonal(_thrust(1000.0, FAST)),
            0.005,
            NOEL + "24.1, 33.1",
            (23.9, 32.6),
        ),
        Row(
            "VEX 70, 2000 N: loss of Kxx, Kyy to 30 000 rpm [%]",
            _losses(),
            0.005,
            NOEL + "72.5, 77.9",
            (69.8, 75.1),
        ),
        Row(
            "complete K against finite differences, 80 random states, four hypotheses",
            (_worst_tangent(),),
            1e-6,
            "loads of the bearing itself",
        ),
        Row(
            "axial equilibrium of balls and ring, the same states",
            (_worst_balance(),),
            1e-10,
            "equation of equilibrium",
        ),
    ]


def _contacts() -> Row:
    inner, outer = geometry(HARRIS_218.grooves).inner, geometry(HARRIS_218.grooves).outer
    found = (inner.stiffness / 1e10, outer.stiffness / 1e10, inner.ellipticity, outer.ellipticity)
    return Row(
        "Hertz contacts of the Harris 218: k [10¹⁰ N/m^1.5], κ, inner and outer",
        found,
        1e-5,
        "exact elliptic integrals, computed separately",
        (4.07062, 4.23417, 8.15514, 6.89741),
    )


def _harris(when: str, speed: float, expected: tuple[float, ...]) -> Row:
    s = HARRIS_218.equilibrium(
        load=[17800.0, 0, 0, 0, 0], speed=speed, kinematics="outer", moment_sharing="outer"
    )
    found = (
        float(s.displacement[0]) * 1e6,
        math.degrees(float(s.inner_angle[0])),
        float(s.inner_load[0]),
        *_diagonal(s),
    )
    what = f"Harris 218, 17 800 N {when}: δx [µm], αi [°], Qi [N], Kxx, Kyy [N/µm]"
    return Row(what, found, 1e-4, TWO_CODES, expected)


def _thrust(force: float, speed: float) -> BearingState:
    return VEX70.equilibrium(load=[force, 0, 0, 0, 0], speed=speed)


def _diagonal(state: BearingState) -> tuple[float, ...]:
    k = state.stiffness("complete") / 1e6
    return float(k[0, 0]), float(k[1, 1])


def _losses() -> tuple[float, ...]:
    rest, fast = (_diagonal(_thrust(2000.0, speed)) for speed in (0.0, FAST))
    return tuple(100.0 * (1.0 - b / a) for a, b in zip(rest, fast, strict=True))


def _random_loads() -> tuple[Array, Array]:
    """Loads (20, 5) [N, N·m] with a thrust that keeps all balls loaded, and speeds (20,)."""
    draw = np.random.default_rng(2310)
    thrust = draw.uniform(800.0, 4000.0, 20)
    side = draw.uniform(-0.25, 0.25, (20, 2)) * thrust[:, None]
    load = np.column_stack([thrust, side, draw.uniform(-5.0, 5.0, (20, 2))])
    return load, draw.uniform(0.0, 24000.0, 20) * RPM


def _worst_tangent() -> float:
    return max(_tangent_error(hypothesis) for hypothesis in HYPOTHESES)


def _tangent_error(hypothesis: str) -> float:
    """max |ΔK| / max |K|, tilts and moments scaled by dm/2, against five-point differences."""
    load, speed = _random_loads()
    state = VEX70.equilibrium(load=load, speed=speed, kinematics=hypothesis)
    lever = 2.0 / VEX70.pitch_diameter
    scale = np.array([1.0, 1.0, 1.0, lever, lever])
    step = 1e-8 * np.diag(scale)
    offsets = np.array([1.0, -1.0, 2.0, -2.0])[:, None, None] * step
    moved = state.displacement[:, None, None] + offsets
    f = VEX70.equilibrium(displacement=moved, speed=speed[:, None, None], kinematics=hypothesis)
    rise = 8.0 * (f.load[:, 0] - f.load[:, 1]) - (f.load[:, 2] - f.load[:, 3])
    slope = (rise / (12.0 * np.diag(step)[:, None])).swapaxes(1, 2)
    weight = np.outer(scale, scale)
    miss = np.abs((state.stiffness() - slope) * weight).max(axis=(1, 2))
    return float((miss / np.abs(slope * weight).max(axis=(1, 2))).max())


def _worst_balance() -> float:
    """Σ (Qi sin αi + λi Mg cos αi/D) against the requested axial load, λi = 1."""
    load, speed = _random_loads()
    s = VEX70.equilibrium(load=load, speed=speed)
    share = s.gyroscopic_moment / VEX70.ball_diameter * np.cos(s.inner_angle)
    carried = (s.inner_load * np.sin(s.inner_angle) + share).sum(axis=-1)
    return float(np.abs(carried / load[:, 0] - 1.0).max())
