"""Small analytic results and one realistic spindle, the input of every figure and file test."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from bearings import AngularContactBallBearing, Material
from rotordyn.analyses.bearing.result import BearingMapResult
from rotordyn.analyses.campbell.result import CampbellResult
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.control.result import ControlResult
from rotordyn.analyses.frf.measured import measured_fields
from rotordyn.analyses.frf.result import (
    FrequencyResponse,
    FrfResult,
    InertanceResult,
    MobilityResult,
)
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.measured_response import Port
from rotordyn.analyses.preload.result import PreloadResult
from rotordyn.analyses.section_forces.result import SectionForcesResult
from rotordyn.analyses.stiffness.result import StiffnessResult
from rotordyn.analyses.stiffness.spec import StiffnessSpec
from rotordyn.analyses.unbalance.result import UnbalanceResult
from rotordyn.machine.lumped import PointMass
from rotordyn.machine.reference import Reference
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.sleeve import Sleeve, Spring
from rotordyn.machine.spindle import Spindle
from rotordyn.results.declaration import declared

TOP = 24000.0 * math.pi / 30.0
_SECTIONS = (
    ("amb_target", 39.4, 61.1, 14.7),
    ("tool_shank", 26.4, 33.1, 14.7),
    ("hsk_flange", 26.0, 63.0, 14.7),
    ("nose", 18.6, 90.3, 33.4),
    ("front_seats", 75.8, 77.4, 40.0),
    ("front_to_motor", 70.0, 66.0, 40.0),
    ("motor", 146.3, 102.0, 40.0),
    ("motor_to_rear", 61.2, 83.5, 40.0),
    ("rear_seats", 39.5, 71.0, 40.0),
    ("tail", 25.0, 64.0, 40.0),
)
DOFS = ("x", "y", "z", "thy", "thz")
NODE_DOFS = ("x", "y", "z", "thx", "thy", "thz")
SOURCE = "Noël (2013)"


@dataclass(frozen=True)
class SampleCase:
    """As much of a case as figures and summary look at."""

    name: str = "mfw2310"
    title: str = "Fischer MFW 2310, reconstructed"
    spindle: Spindle | None = None
    bearing: AngularContactBallBearing | None = None
    conditions: Any = None
    references: tuple[Reference, ...] = ()
    analyses: dict[str, Any] = field(default_factory=dict)

    @property
    def known(self) -> tuple[Reference, ...]:
        return self.references


def ball_bearing(pitch: float, balls: int) -> AngularContactBallBearing:
    return AngularContactBallBearing(
        ball_diameter=9.525e-3,
        pitch_diameter=pitch,
        balls=balls,
        contact_angle=math.radians(25.0),
        inner_conformity=0.56,
        outer_conformity=0.571,
    )


def spindle() -> Spindle:
    """The reconstructed MFW 2310."""
    steel, laminated = Material("steel", 210e9, 0.3, 7850.0), Material("motor", 210e9, 0.3, 8130.0)
    sections = tuple(
        Section(n / 1e3, do / 1e3, di / 1e3, laminated if name == "motor" else steel, name)
        for name, n, do, di in _SECTIONS
    )
    front, rear = ball_bearing(0.09, 25), ball_bearing(0.0775, 21)
    places = (("a", front, 28.6, 1), ("b", front, 48.6, 1), ("c", front, 84.4, -1))
    places += (("d", rear, 380.9, -1), ("e", rear, 402.4, -1))
    return Spindle(
        name="mfw2310",
        title="Fischer MFW 2310, reconstructed",
        shaft=Shaft(-0.0918, sections),
        masses=(
            PointMass("clamping_front", 0.0486, 1.44, 2.88e-4, 4.44e-4),
            *(
                PointMass(f"drawbar_{k}", x, 0.2, 4e-5, 5.964e-5)
                for k, x in enumerate((0.17903, 0.23755, 0.29607), start=1)
            ),
            PointMass("release_unit", 0.4239, 2.19, 6.8438e-4, 7.9844e-4),
        ),
        seats=tuple(BearingSeat(n, b, x / 1e3, s) for n, b, x, s in places),
        sleeves=(
            Sleeve("front sleeve", ("c",), Spring(574.0, 6.2e6), stop_travel=52.2e-6),
            Sleeve("rear sleeve", ("d", "e"), Spring(528.0, 5.49e6)),
        ),
        points={
            "Oc2": -0.0524,
            "Oc1": -0.0721,
            "nose": 0.0,
            "O1": 0.0386,
            "O2": 0.0844,
            "O3": 0.39165,
        },
        references=references(),
    )


def references() -> tuple[Reference, ...]:
    def at(*rpm: float) -> tuple[float, ...]:
        return tuple(n * math.pi / 30.0 for n in rpm)

    published = (
        Reference(
            "radial_stiffness",
            "published",
            SOURCE,
            at(0, 6000, 12000, 18000, 24000),
            (142e6, 138e6, 110e6, 84e6, 73.5e6),
            remark="The thesis mixes two signs of the gyroscopic moment.",
        ),
        Reference(
            "radial_stiffness",
            "measured",
            SOURCE,
            at(4000, 24000),
            (134e6, 56.3e6),
            remark="Measured on the real spindle, model-free.",
        ),
        Reference("preload_sum", "published", SOURCE, at(24000), (1750.0,)),
        Reference(
            "sleeve_displacement",
            "measured",
            SOURCE,
            at(16000, 24000),
            (-37.0e-6, -80.2e-6),
            subject="rear sleeve",
        ),
        Reference(
            "bending_frequency",
            "published",
            SOURCE,
            at(0, 0, 0, 0),
            (903.0, 1350.0, 1580.0, 2860.0),
        ),
    )
    return published


def speeds(count: int = 49) -> Any:
    return np.linspace(0.0, TOP, count)


def preload(count: int = 49) -> PreloadResult:
    """Loads grow with speed², equal in a tandem pair; the front sleeve stops at 18 000 rpm."""
    speed = speeds(count)
    s = (speed / TOP)[:, None] ** 2
    rest = np.array([551.0, 551.0, 574.0, 264.0, 264.0])
    load = rest * (1.0 + s * np.array([1.31, 1.31, 1.97, 0.2, 0.2]))
    ones = np.ones_like(load)
    inner, outer = 0.47 + 0.18 * s * ones, 0.44 - 0.25 * s * ones
    stiffness = np.einsum("sb,ij->sbij", 1e8 * (1.0 - 0.3 * s) * ones, np.diag([1.0, 3, 3, 1, 1]))
    front = -np.minimum(52.2e-6, 92.8e-6 * s[:, 0])
    rear = -115.2e-6 * s[:, 0]
    position = np.column_stack([8e-6 * s[:, 0], front, rear])
    return PreloadResult(
        speed=speed,
        bearing=("a", "b", "c", "d", "e"),
        sleeve=("front sleeve", "rear sleeve"),
        body=("shaft", "front sleeve", "rear sleeve"),
        dof=DOFS,
        dof_other=DOFS,
        outcome=("solved",) * count,
        axial_load=load,
        mounted_load=rest,
        mounted_preload=np.array([574.0, 528.0]),
        ring_offset=np.array([np.nan, np.nan]),
        deflection=load * 2e-8,
        stiffness=stiffness,
        inner_angle=inner,
        outer_angle=outer,
        inner_load=load / 25.0 / np.sin(inner),
        outer_load=load / 25.0 / np.sin(outer),
        inner_pressure=1.3e9 * (load / rest) ** (1 / 3),
        outer_pressure=1.1e9 * (load / rest) ** (1 / 3) * (1.0 + 0.3 * s),
        centrifugal_force=100.0 * s * ones,
        gyroscopic_moment=0.04 * s * ones,
        inner_required_friction=0.1 * s * ones,
        outer_required_friction=0.06 * s * ones,
        slipping=np.full(np.broadcast_shapes(np.shape(s), np.shape(ones)), ""),
        growth=43.2e-6 + 7.3e-6 * s * ones,
        film_growth=0.0 * s * ones,
        speed_factor=speed[:, None] * 30.0 / math.pi * np.array([90.0] * 3 + [77.5] * 2),
        position=position,
        spring_force=np.column_stack([574.0 - 6.2e6 * front, 528.0 - 5.49e6 * rear]),
        stop_force=np.column_stack([np.maximum(0.0, 900.0 * (s[:, 0] - 0.5625)), 0.0 * rear]),
        friction_force=np.zeros((count, 2)),
        friction_limit=np.zeros(2),
        stop_reached=np.column_stack([s[:, 0] >= 0.5625, np.zeros(count, bool)]),
        stop_speed=np.array([0.75 * TOP, np.nan]),
    )


_MODES = (
    ("1 bw", 903.0, -210.0, -1, "bending"),
    ("1 fw", 903.0, -190.0, 1, "bending"),
    ("2 bw", 1349.0, -180.0, -1, "bending"),
    ("2 fw", 1349.0, -140.0, 1, "bending"),
    ("3 bw", 1587.0, -60.0, -1, "bending"),
    ("3 fw", 1587.0, -30.0, 1, "bending"),
    ("4 bw", 2859.0, -29.0, -1, "bending"),
    ("4 fw", 2859.0, 29.0, 1, "bending"),
    ("axial", 260.0, 90.0, 0, "axial"),
    ("torsion", 2974.0, 0.0, 0, "torsion"),
)


def campbell(count: int = 49) -> CampbellResult:
    """Frequencies quadratic in speed, shapes of a free beam."""
    speed = speeds(count)
    s = (speed / TOP)[:, None]
    rest, change = (np.array([m[k] for m in _MODES]) for k in (1, 2))
    whirl = np.array([m[3] for m in _MODES]) * np.sign(s)
    node = np.linspace(-0.0918, 0.4364, 61)
    xi = (node - node[0]) / np.ptp(node)
    shape = np.zeros((2, len(_MODES), node.size, 6), complex)
    for k, (_, _, _, turn, kind) in enumerate(_MODES):
        wave = np.cos((k // 2 + 1) * math.pi * xi)
        if kind == "bending":
            shape[:, k, :, 1], shape[:, k, :, 2] = wave, -1j * turn * wave
        else:
            shape[:, k, :, 0 if kind == "axial" else 3] = wave if kind == "torsion" else 1.0
    shape[1] *= np.exp(0.7j)
    return CampbellResult(
        speed=speed,
        mode=tuple(m[0] for m in _MODES),
        node=node,
        dof=NODE_DOFS,
        rotor=("spindle",),
        node_rotor=("spindle",) * node.size,
        speed_ratio=np.ones(1),
        critical_rotor=("spindle",),
        shape_speed=speed[[0, -1]],
        critical=("axial",),
        engine_order=np.ones(1),
        outcome=("solved",) * count,
        frequency=rest + change * s**2,
        damping_ratio=np.full((count, len(_MODES)), 0.02),
        frequency_error=1e-6 * np.abs(np.full((count, len(_MODES)), 0.02)),
        damping_error=1e-6 * np.abs(np.full((count, len(_MODES)), 0.02)),
        max_frequency=4000.0,
        unconverged="",
        pole=2.0 * math.pi * (rest + change * s**2) * (1j - 0.02),
        free=np.full(count, 2.0),
        stopped=np.zeros(count),
        overdamped=np.zeros((count, len(_MODES)), dtype=bool),
        followed=np.ones((count, len(_MODES)), dtype=bool),
        decrement=np.full((count, len(_MODES)), 0.02 * 2.0 * math.pi),
        whirl=whirl,
        whirl_degree=whirl,
        rigid_share=np.full((count, len(_MODES)), 0.1),
        character=tuple(m[4] for m in _MODES),
        kind=tuple(m[4] for m in _MODES),
        shape=shape,
        critical_speed=np.array([0.85 * TOP]),
        stability_threshold=math.inf,
        threshold_is_bound=False,
        unstable_mode="",
        critical_order=np.ones(1),
        critical_kind=("axial",),
        critical_whirl=("",),
        critical_damping=np.array([0.02]),
        critical_excited=np.array([True]),
        excited_by=tuple({1: "forward", -1: "backward"}.get(m[3], "") for m in _MODES),
        passing=(),
        passing_frequency=np.zeros((len(speed), 0)),
    )


def frf(count: int = 49, points: int = 2000) -> FrfResult:
    """Sums of single-degree resonances that follow the sample Campbell diagram."""
    speed, frequency = speeds(count), np.linspace(2.0, 4000.0, points)
    s = (speed / TOP)[:, None]
    total = np.zeros((count, 4, points), complex)
    for k, (_, rest, change, _, kind) in enumerate(_MODES):
        if kind != "bending":
            continue
        own = rest + change * s**2
        damping = (0.012 + 0.004 * (k // 2)) * (1.0 + s)
        part = own**2 / (own**2 - frequency**2 + 2j * damping * own * frequency)
        weights = np.array([1.0, 0.6 * (-1.0) ** (k // 2), 0.3, 0.2 * (-1.0) ** (k // 2)])
        total += 8e-10 * weights[:, None] * part[:, None, :]
    is_slice = np.isin(np.arange(count), [0, count // 2, count - 1])
    none = np.full((count, 4, 0), np.nan)
    rows = np.flatnonzero(is_slice)
    spec = FrfSpec((1.0,), ((Port("a", "y"),) * 2,))
    return FrfResult(
        speed=speed,
        frequency=frequency,
        pair=("Oc2.y / Oc2.y", "Oc1.y / Oc2.y", "O2.y / Oc2.y", "O3.y / Oc2.y"),
        outcome=("solved",) * count,
        receptance=total,
        unstable=np.zeros(count, dtype=bool),
        is_slice=is_slice,
        error=np.full(4, 3e-5),
        error_asked=1e-3,
        resonance=np.arange(0),
        peak_frequency=none,
        peak_value=none + 0j,
        peak_damping=none,
        light_mode=("",) * 4,
        slice_speed=speed[rows],
        place=np.arange(points),
        slice_frequency=np.broadcast_to(frequency, (len(rows), points)),
        slice_value=total[rows],
        line=(),
        line_rotor=(),
        line_order=np.zeros(0),
        line_frequency=np.zeros((count, 0)),
        line_value=np.zeros((count, 0, 4), complex),
        step=np.arange(0),
        line_speed=np.zeros((0, 0)),
        line_curve=np.zeros((0, 0, 4), complex),
        crossing=np.arange(0),
        line_peak_speed=np.zeros((0, 4, 0)),
        line_peak_value=np.zeros((0, 4, 0), complex),
        **measured_fields(spec, speed, frequency, (), lambda *_: total, (none, none)),
    )


def frf_of(
    kind: type[MobilityResult | InertanceResult], count: int = 49, points: int = 2000
) -> FrequencyResponse:
    """The same as velocity or acceleration over force."""
    own = frf(count, points)
    power = 1 if kind is MobilityResult else 2
    turned = (2j * math.pi * own.frequency) ** power
    values: Any = {kind.kind: own.receptance * turned, "slice_value": own.slice_value * turned}
    shared = {name: getattr(own, name) for name in declared(own)}
    shared = {name: value for name, value in shared.items() if name not in {"receptance", *values}}
    return kind(**shared, **values)


def stiffness(count: int = 49) -> StiffnessResult:
    """Softening springs; a second stop as fifth variant."""
    speed, force = speeds(count), np.linspace(0.0, 500.0, 11)
    s = (speed / TOP)[:, None] ** 2
    loss = np.array([0.38, 0.38, 0.42, 0.63, 0.5])
    tangent = 142.7e6 * (1.0 - loss * s) * np.array([1.0, 1.0, 0.854, 1.0, 1.0])
    deflection = force / tangent[..., None] * (1.0 + 0.1 * force / 500.0)
    return StiffnessResult(
        speed=speed,
        variant=("nonlinear", "full", "diagonal", "constant_preload", "second_stop"),
        force=force,
        outcome=("solved",) * count,
        deflection=deflection,
        tangent=tangent,
        stop_speed=np.zeros(0),
        stop_tangent=np.zeros((0, 5)),
        secant=tangent / 1.1,
        bearing=("B1", "B2"),
        axial_load=np.full((count, 11, 2), 550.0),
        radial_load=force[:, None] * np.array([1.4, 0.4]) * np.ones((count, 1, 1)),
        ball_load=(30.0 + 0.2 * force)[:, None] * np.ones((count, 1, 2)),
        unloading_force=np.array([np.full(count, np.nan), np.linspace(480.0, 220.0, count)]).T,
        unloaded_ball=np.array([np.full(count, np.nan), np.full(count, 11.0)]).T,
        unloaded_azimuth=np.array([np.full(count, np.nan), np.full(count, np.pi)]).T,
    )


def section_forces(count: int = 49) -> SectionForcesResult:
    """A beam on two ends, a force in its middle that grows with speed, a torque behind it."""
    speed, edges = speeds(count), np.linspace(-0.0918, 0.4364, 41)
    cut = np.stack([edges[:-1], edges[1:]], axis=1).ravel()
    middle, long = edges[20], edges[-1] - edges[0]
    front = np.repeat(edges[:-1] < middle, 2)
    force = 100.0 + 900.0 * (speed / TOP)[:, None] ** 2
    shear = np.where(front, -force / 2.0, force / 2.0)
    moment = force / 2.0 * np.where(front, cut - edges[0], edges[-1] - cut)
    torque = np.where(front, 0.0, 40.0) * np.ones_like(force)
    bow = -1e-8 * force * np.sin(np.pi * (cut - edges[0]) / long)
    none, stress = np.zeros_like(shear), np.abs(moment) / 1e-5
    reaction = np.zeros((count, 2, 6))
    reaction[:, :, 1] = force / 2.0
    return SectionForcesResult(
        speed=speed,
        cut=cut,
        support=("front", "rear"),
        component=("Fx", "Fy", "Fz", "Mx", "My", "Mz"),
        twist_limit=("middle to end",),
        outcome=("solved",) * count,
        outer_diameter=np.full(cut.size, 0.07),
        inner_diameter=np.full(cut.size, 0.04),
        normal_force=none,
        shear_force_y=shear,
        shear_force_z=none,
        torque=torque,
        bending_moment_y=none,
        bending_moment_z=moment,
        axial_displacement=none,
        deflection_y=bow,
        deflection_z=none,
        twist=torque * 1e-6,
        slope_y=none,
        slope_z=none,
        normal_stress=stress,
        torsion_stress=torque * 1e4,
        von_mises_stress=np.sqrt(stress**2 + 3.0 * (torque * 1e4) ** 2),
        support_station=edges[[0, -1]],
        reaction=reaction,
        departure=np.full(reaction.shape[:2], 0.02),
        allowed_twist=np.array([1e-3]),
        bore=np.array([0.0]),
        twist_between=np.full((count, 1), 5e-4),
        required_diameter=np.full((count, 1), 0.03955),
    )


def unbalance(count: int = 49) -> UnbalanceResult:
    """A point mass on springs that differ between y and z, and a second point that follows it."""
    speed = speeds(count)
    own = TOP * np.array([0.45, 0.6])
    w = speed[:, None]
    gain = w**2 / (own**2 - w**2 + 0.04j * own * w) * np.array([1.0, -1.0j])
    moved = 1e-6 * np.stack([gain, 0.3 * gain.conj()], axis=1)
    ahead = 0.5 * np.abs(moved[..., 0] + 1j * moved[..., 1])
    behind = 0.5 * np.abs(moved[..., 0] - 1j * moved[..., 1])
    return UnbalanceResult(
        unstable=np.zeros(speed.size, dtype=bool),
        rotor="spindle",
        grade_speed=0.0,
        speed_ratio=1.0,
        speed=speed,
        point=("Oc2", "O3"),
        axis=("y", "z"),
        support=("front", "rear"),
        unbalance=("tool",),
        critical=("bending 1", "bending 2"),
        outcome=("",) * count,
        displacement=moved,
        amplitude=np.abs(moved),
        phase=np.angle(moved),
        major_axis=ahead + behind,
        minor_axis=ahead - behind,
        inclination=np.zeros((count, 2)),
        force=moved * 1e8,
        force_amplitude=(ahead + behind) * 1e8,
        departure=np.full(moved.shape[:2], 0.02),
        unbalance_station=np.array([-0.0524]),
        unbalance_size=np.array([1e-5]),
        unbalance_angle=np.array([0.5]),
        critical_speed=own,
        critical_damping=np.full(2, 0.02),
        fine_speed=speed,
        fine_displacement=moved,
        fine_major_axis=ahead + behind,
        fine_minor_axis=ahead - behind,
        fine_force_amplitude=(ahead + behind) * 1e8,
        fine_departure=np.full(moved.shape[:2], 0.02),
        force_unbounded=np.full(2, np.nan),
        film_orbit=np.full(moved.shape[:2], np.nan),
        film_ratio=np.full(2, np.nan),
        resonance=np.arange(0),
        peak_speed=np.zeros((2, 0)),
        peak_amplitude=np.zeros((2, 0)),
        run=("up in 1 s",),
        run_outcome=("",),
        run_speed=np.linspace(0.0, 1000.0, 5),
        run_amplitude=np.full((1, 5, 2), 1e-6),
        run_peak=np.full((1, 2), 1e-6),
        run_peak_speed=np.full((1, 2), 500.0),
        run_force=np.full((1, 5, 2), 100.0),
        run_force_peak=np.full((1, 2), 100.0),
        run_force_peak_speed=np.full((1, 2), 500.0),
        run_departure=np.full((1, 2), 0.02),
        run_error=np.array([1e-5]),
        unstable_range=np.arange(0),
        unstable_from=np.zeros(0),
        unstable_to=np.zeros(0),
        unstable_pole=np.zeros(0, dtype=complex),
        model_frequency=4000.0,
        error=np.array([1e-5, 2e-5]),
        error_asked=1e-3,
    )


def bearing(count: int = 13, warm: float = np.nan) -> BearingMapResult:
    """K grows with the cube root of the load and falls with speed; frozen it errs to −16 %.

    ``warm`` 1: it has temperatures.
    """
    speed, load = speeds(count), np.array([250.0, 500.0, 1000.0, 1500.0, 2000.0])
    s = (speed / TOP)[:, None] ** 2
    k = 1.4e8 * (load / 1000.0) ** (1 / 3) / (1.0 + 3.0 * s * 500.0 / load)
    ones = np.ones_like(k)
    complete = k[..., None, None] * np.diag([1.0, 2.1, 2.1, 1e-3, 1e-3])
    frozen = complete * (1.0 - 40.0 * s / load)[..., None, None]
    return BearingMapResult(
        speed=speed,
        load=load,
        tangent=("complete", "frozen"),
        dof=DOFS,
        dof_other=DOFS,
        outcome=np.full((count, load.size), "solved"),
        deflection=load / k,
        stiffness=np.stack([complete, frozen], axis=2),
        radial_deflection=np.zeros_like(k),
        tilt=np.zeros_like(k),
        loaded_ball=np.zeros(k.shape, int),
        **one_ball(load, s, ones),
        inner_angle=0.44 + 0.2 * s * ones,
        outer_angle=0.44 - 0.2 * s * ones,
        inner_load=load / 10.0 * ones,
        outer_load=load / 10.0 + 100.0 * s,
        inner_pressure=1.5e9 * ones,
        outer_pressure=1.4e9 * ones + 3e8 * s,
        centrifugal_force=100.0 * s * ones,
        gyroscopic_moment=0.04 * s * ones,
        inner_required_friction=0.1 * s * ones,
        outer_required_friction=0.06 * s * ones,
        required_friction=0.02 * s * ones,
        open_side=np.zeros(k.shape, dtype=int),
        slipping=np.full(np.broadcast_shapes(np.shape(s), np.shape(ones)), ""),
        inner_spin_to_roll=0.08 + 0.2 * s * ones,
        outer_spin_to_roll=0.01 * s * ones,
        attitude=0.3 * ones + 0.0 * s,
        revolutions=1e9 / (1.0 + s) * ones,
        dynamic_rating=36e3,
        groove_rating=36e3,
        limiting=np.full(k.shape, "o"),
        equivalent_load=load * ones + 0.0 * s,
        rating_factor=1.0 * ones + 0.0 * s,
        static_safety=30.0 * ones - 5.0 * s,
        contact_heat=10.0 * s * ones,
        spin_heat=5.0 * s * ones,
        viscous_heat=50.0 * s * ones,
        film=3e-7 * ones + 0.0 * s,
        axial_force=load * ones + 0.0 * s,
        film_growth=0.0 * ones + 0.0 * s,
        ball_temperature=warm * (40.0 + 60.0 * s * ones),
        inner_temperature=warm * (35.0 + 30.0 * s * ones),
        outer_temperature=warm * (30.0 + 20.0 * s * ones),
        speed_limit=warm * TOP * (1.0 - load / 1e4),
        control=np.full(k.shape, "outer"),
        control_agrees=np.full(k.shape, True),
    )


def one_ball(load, s, ones) -> dict[str, Any]:
    """Its contacts i and o: ellipses of 0.1 rad either side, far from the shoulders at 0.9 rad."""
    q = np.stack([load / 10.0 * ones, load / 10.0 + 100.0 * s], axis=-1)[:, :, None]
    angle = np.stack([0.44 + 0.2 * s * ones, 0.44 - 0.2 * s * ones], axis=-1)[:, :, None]
    return dict(
        ball=np.zeros(1),
        contact=("i", "o"),
        contacts=np.full(q.shape[:-1], 2),
        contact_load=q,
        contact_angle=angle,
        contact_pressure=1.5e9 * np.ones_like(q),
        ring_deflection=0.0 * q,
        ellipse_length=4e-4 * np.ones_like(q),
        ellipse_width=1e-4 * np.ones_like(q),
        ellipse_lower=angle - 0.1,
        ellipse_upper=angle + 0.1,
        truncated=np.zeros_like(q),
        shoulder_angle=np.full(2, 0.9),
        middle_angle=np.full(2, np.nan),
    )


def control(count: int = 13) -> ControlResult:
    """The inner race controls above 4 n², the outer race up to 3 n² (n in 1000 rpm)."""
    speed, load = speeds(count), np.geomspace(10.0, 3000.0, 40)
    n2 = (speed * 30.0 / np.pi / 1000.0) ** 2
    boundary = np.array([4.0 * n2, 3.0 * n2])
    boundary[:, 0] = np.nan
    absence = np.full(boundary.shape, "", dtype="<U40")
    absence[:, 0] = "inner race controls", "outer race does not"
    unit = (np.pi / 30.0 * 1000.0) ** -2
    return ControlResult(
        speed=speed,
        load=load,
        boundary=("inner", "outer"),
        term=("quadratic", "linear", "constant"),
        outcome=("",) * count,
        radial=0.0,
        resting_weight=1.3,
        boundary_load=boundary,
        boundary_absence=absence,
        boundary_pressure=1e9 + 1e5 * boundary,
        changes=np.isfinite(boundary).astype(int),
        fit=np.array([[4.0 * unit, 0.0, 0.0], [3.0 * unit, 0.0, 0.0]]),
        fit_misfit=np.array([1.5, 0.5]),
        fit_absence=("", ""),
        state=np.full((count, load.size), ""),
        inner_margin=load / 100.0 - n2[:, None] / 25.0,
        outer_margin=3.0 * n2[:, None] / 100.0 - load / 100.0,
    )


def results(count: int = 49, points: int = 2000) -> dict[str, Any]:
    return {
        "preload": preload(count),
        "campbell": campbell(count),
        "frf": frf(count, points),
        "stiffness": stiffness(count),
        "section_forces": section_forces(count),
    }


def case() -> SampleCase:
    analyses = {
        "campbell": CampbellSpec(max_frequency=3500.0, teeth=(3, 8)),
        "stiffness": StiffnessSpec("Oc2"),
    }
    return SampleCase(spindle=spindle(), references=references(), analyses=analyses)
