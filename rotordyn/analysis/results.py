"""What the analyses answer: frozen arrays that know their dimensions and units, nothing else.

Dimensions: ``speed`` [rad/s], ``bearing``, ``sleeve``, ``body``, ``mode``, ``frequency`` [Hz],
``pair``, ``variant``, ``force`` [N], ``load`` [N], ``tangent``, ``node``, ``dof``, ``cut`` [m],
``support``. A value that does not exist is NaN only where an ``outcome`` of the same speed, an
``absence``, or the label of the same mode says why.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from rotordyn.analysis.display import GRAM_MILLIMETRE, MEGAPASCAL, MILLIMETRE, response_unit
from rotordyn.analysis.result import coordinate, quantity

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Flags = NDArray[np.bool_]
Words = tuple[str, ...]
ROUNDING = 1e-6  # of a damping ratio
CREEPING = 0.99  # damping ratio above which a motion hardly swings


@dataclass(frozen=True)
class PreloadResult:
    """The dynamic preload state; bearings in their own frames (x loads the balls)."""

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    bearing: Words = coordinate("bearing", unit="", label="bearing")
    sleeve: Words = coordinate("sleeve", unit="", label="sleeve")
    body: Words = coordinate("body", unit="", label="body")
    dof: Words = coordinate("dof", unit="", label="freedom")
    dof_other: Words = coordinate("dof_other", unit="", label="freedom")
    outcome: Words = quantity("speed", unit="", label="outcome")
    axial_load: Array = quantity("speed", "bearing", unit="N", label="axial load")
    deflection: Array = quantity("speed", "bearing", unit="m", label="axial deflection")
    stiffness: Array = quantity(
        "speed", "bearing", "dof", "dof_other", unit="N/m, N/rad, N·m/rad", label="stiffness"
    )
    inner_angle: Array = quantity("speed", "bearing", unit="rad", label="inner contact angle")
    outer_angle: Array = quantity("speed", "bearing", unit="rad", label="outer contact angle")
    inner_load: Array = quantity("speed", "bearing", unit="N", label="inner ball load")
    outer_load: Array = quantity("speed", "bearing", unit="N", label="outer ball load")
    inner_pressure: Array = quantity("speed", "bearing", unit="Pa", label="inner peak pressure")
    outer_pressure: Array = quantity("speed", "bearing", unit="Pa", label="outer peak pressure")
    centrifugal_force: Array = quantity("speed", "bearing", unit="N", label="centrifugal force")
    gyroscopic_moment: Array = quantity("speed", "bearing", unit="N·m", label="gyroscopic moment")
    inner_grip: Array = quantity("speed", "bearing", unit="1", label="grip needed, inner race")
    outer_grip: Array = quantity("speed", "bearing", unit="1", label="grip needed, outer race")
    slipping: NDArray[np.str_] = quantity("speed", "bearing", unit="", label="race that slips")
    growth: Array = quantity("speed", "bearing", unit="m", label="ring growth")
    speed_factor: Array = quantity("speed", "bearing", unit="mm/min", label="speed factor n·dm")
    position: Array = quantity("speed", "body", unit="m", label="axial shift from rest")
    spring_force: Array = quantity("speed", "sleeve", unit="N", label="spring force")
    stop_force: Array = quantity("speed", "sleeve", unit="N", label="stop force")
    stop_reached: Flags = quantity("speed", "sleeve", unit="", label="stop reached")
    stop_speed: Array = quantity("sleeve", unit="rad/s", label="speed at which the stop is reached")


@dataclass(frozen=True)
class CampbellResult:
    """Damped modes over speed, each followed by its shape.

    ``whirl``: +1 forward, −1 backward, 0 none (axial, torsion, or planar motion);
    ``whirl_degree``: share of the kinetic energy in forward circular motion less that in backward,
    from −1 to 1. ``decrement``: logarithmic, −2π Re λ / |Im λ|. ``kind``: ``"bending"``,
    ``"axial"`` or ``"torsion"``; ``rigid_share``: of the kinetic energy, in motions of a rigid
    shaft; ``character``: the kind, as a rigid-body motion where that is most of it.
    ``shape``: displacements of the nodes at the speeds ``shape_speed``, scaled to a largest
    translation (or rotation) of 1, complex.
    ``certified``: the number of modes up to the highest frequency asked for is proven
    (``modes_below``, NaN where it is not) and as many were followed (``modes_found``);
    ``no_proof``: what in the machine keeps it from being proven, or "". Modes so
    strongly damped that their |pole| lies beyond the disc of that proof are not counted.
    ``stability_threshold``: lowest speed of the range at which a mode begins to grow, infinite
    where none does; ``first_to_grow``: that mode, or "". ``rotor``: the spindle's shaft and further
    rotors, at ``speed_ratio`` times its speed; ``node_rotor``: the one that a node is of; whirl is
    forward the way the spindle turns. ``critical``: the mode that turns at ``critical_order`` times
    the speed of ``critical_rotor`` where the spindle has ``critical_speed``, with its kind and
    damping ratio there;
    ``critical_whirl``: forward, backward, planar, or mixed where parts of the shaft whirl either
    way; ``critical_excited``: false where a force that turns with the shaft does no work on it
    (order 1; axial, torsion, backward whirl of an isotropic rotor).
    """

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    mode: Words = coordinate("mode", unit="", label="mode")
    node: Array = coordinate("node", unit="m", label="station", printed=MILLIMETRE)
    dof: Words = coordinate("dof", unit="", label="freedom")
    rotor: Words = coordinate("rotor", unit="", label="rotor")
    shape_speed: Array = coordinate("shape_speed", unit="rad/s", label="speed of the shapes")
    critical: Words = coordinate("critical", unit="", label="critical speed")
    outcome: Words = quantity("speed", unit="", label="outcome")
    frequency: Array = quantity("speed", "mode", unit="Hz", label="damped frequency")
    frequency_error: Array = quantity(
        "speed", "mode", unit="1", label="estimated relative error of the frequency"
    )
    resolved_frequency: float = quantity(unit="Hz", label="highest frequency the mesh resolves")
    free: Array = quantity(
        "speed", unit="1", label="eigenvalues at zero, of motions that nothing holds: no modes"
    )
    node_rotor: Words = quantity("node", unit="", label="rotor of the node")
    speed_ratio: Array = quantity("rotor", unit="1", label="speed over that of the spindle")
    certified: Flags = quantity("speed", unit="", label="number of modes proven")
    no_proof: str = quantity(unit="", label="what keeps their number from being proven")
    modes_below: Array = quantity("speed", unit="1", label="modes below the highest frequency")
    modes_found: Array = quantity("speed", unit="1", label="modes followed below it")
    damping_ratio: Array = quantity("speed", "mode", unit="1", label="damping ratio")
    decrement: Array = quantity("speed", "mode", unit="1", label="logarithmic decrement")
    whirl: Array = quantity("speed", "mode", unit="1", label="whirl direction")
    whirl_degree: Array = quantity("speed", "mode", unit="1", label="forward less backward share")
    rigid_share: Array = quantity("speed", "mode", unit="1", label="share of rigid-body motion")
    kind: Words = quantity("mode", unit="", label="kind")
    character: Words = quantity("mode", unit="", label="character")
    shape: Complex = quantity("shape_speed", "mode", "node", "dof", unit="1", label="mode shape")
    stability_threshold: float = quantity(unit="rad/s", label="speed from which a mode grows")
    first_to_grow: str = quantity(unit="", label="mode that grows from there")
    critical_speed: Array = quantity("critical", unit="rad/s", label="critical speed")
    critical_rotor: Words = quantity("critical", unit="", label="rotor that excites")
    critical_order: Array = quantity("critical", unit="1", label="order of its rotation")
    critical_kind: Words = quantity("critical", unit="", label="kind of critical speed")
    critical_whirl: Words = quantity("critical", unit="", label="whirl at the critical speed")
    critical_damping: Array = quantity("critical", unit="1", label="damping ratio there")
    critical_excited: Flags = quantity("critical", unit="", label="excited by what turns")

    @property
    def unstable(self) -> Flags:
        """Where a mode grows by itself (speeds, modes)."""
        return np.asarray(self.damping_ratio < -ROUNDING)

    @property
    def creeping(self) -> Flags:
        """Modes that hardly swing at any speed (modes,): counted, but neither drawn nor listed."""
        return np.asarray(~(self.damping_ratio <= CREEPING).any(axis=0))


@dataclass(frozen=True)
class TurningCampbellResult(CampbellResult):
    """The same with bending seen from the frame that turns with the shaft.

    A mode that whirls at ω (its sign the direction) in the fixed frame has |ω − Ω| there. Its
    ``whirl``, ``damping_ratio`` and ``shape`` stay those of the fixed frame, and so do axial motion
    and torsion. Synchronous forward whirl stands still: a critical speed is where it meets 0.
    """

    frequency: Array = quantity(
        "speed", "mode", unit="Hz", label="damped frequency in the turning frame"
    )
    frequency_error: Array = quantity(
        "speed", "mode", unit="1", label="estimated error over the frequency in the fixed frame"
    )


@dataclass(frozen=True)
class FrequencyResponse:
    """Complex frequency responses at independent speed and frequency; ``pair`` reads ``out / in``.

    Subclasses add the values, whose name is their ``kind``. What was ``measured`` has frequencies
    of its own, NaN beyond its last ``sample``; its highest peaks stand beside the computed ones
    next to them, NaN where there are fewer. ``likeness``: frequency response assurance criterion.
    """

    kind: ClassVar[str]

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    frequency: Array = coordinate("frequency", unit="Hz", label="frequency")
    pair: Words = coordinate("pair", unit="", label="response / excitation")
    outcome: Words = quantity("speed", unit="", label="outcome")
    is_slice: Flags = quantity("speed", unit="", label="drawn as slice")
    error: Array = quantity("pair", unit="1", label="estimated error over the largest value")
    measured: Words = coordinate("measured", unit="", label="measured response")
    sample: NDArray[np.int_] = coordinate("sample", unit="", label="sample")
    peak: NDArray[np.int_] = coordinate("peak", unit="", label="peak")
    measured_pair: Words = quantity("measured", unit="", label="response / excitation")
    measured_speed: Array = quantity("measured", unit="rad/s", label="speed")
    measured_frequency: Array = quantity("measured", "sample", unit="Hz", label="frequency")
    measured_response: Complex = quantity(
        "measured", "sample", unit="SI, as computed", label="measured, as the computed quantity"
    )
    measured_peak: Array = quantity("measured", "peak", unit="Hz", label="measured peak")
    measured_peak_amplitude: Array = quantity(
        "measured", "peak", unit="SI, as computed", label="amplitude of the measured peak"
    )
    computed_peak: Array = quantity("measured", "peak", unit="Hz", label="computed peak")
    computed_peak_amplitude: Array = quantity(
        "measured", "peak", unit="SI, as computed", label="amplitude of the computed peak"
    )
    likeness: Array = quantity("measured", unit="1", label="likeness of measured and computed")

    @property
    def response(self) -> Complex:
        """The values of its kind (speeds, pairs, frequencies)."""
        values: Complex = getattr(self, self.kind)
        return values

    def unit(self, pair: int) -> str:
        """SI unit of the values of a pair."""
        return response_unit(self.pair[pair], self.kind)


@dataclass(frozen=True)
class FrfResult(FrequencyResponse):
    """Receptance: displacement over force."""

    kind: ClassVar[str] = "receptance"

    receptance: Complex = quantity(
        "speed", "pair", "frequency", unit="m/N, rad/N, rad/(N·m)", label="receptance"
    )


@dataclass(frozen=True)
class MobilityResult(FrequencyResponse):
    """Mobility: velocity over force, iω times the receptance."""

    kind: ClassVar[str] = "mobility"

    mobility: Complex = quantity(
        *("speed", "pair", "frequency"),
        unit="(m/s)/N, (rad/s)/N, (rad/s)/(N·m)",
        label="mobility",
    )


@dataclass(frozen=True)
class InertanceResult(FrequencyResponse):
    """Inertance: acceleration over force, −ω² times the receptance."""

    kind: ClassVar[str] = "inertance"

    inertance: Complex = quantity(
        *("speed", "pair", "frequency"),
        unit="(m/s²)/N, (rad/s²)/N, (rad/s²)/(N·m)",
        label="inertance",
    )


@dataclass(frozen=True)
class TurningFrfResult(FrfResult):
    """The same in the frame that turns with the shaft: y, z, force and frequency belong to it.

    In the complex form H there at ω is H of the fixed frame at ω + Ω. Axial motion and torsion are
    the same in both.
    """

    frequency: Array = coordinate("frequency", unit="Hz", label="frequency in the turning frame")
    receptance: Complex = quantity(
        "speed",
        "pair",
        "frequency",
        unit="m/N, rad/N, rad/(N·m)",
        label="receptance in the turning frame",
    )


@dataclass(frozen=True)
class StiffnessResult:
    """Deflection of a point under a radial force, for each way of modelling the bearings."""

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    variant: Words = coordinate("variant", unit="", label="bearing model")
    force: Array = coordinate("force", unit="N", label="radial force")
    outcome: Words = quantity("speed", unit="", label="outcome")
    deflection: Array = quantity("speed", "variant", "force", unit="m", label="deflection")
    tangent: Array = quantity("speed", "variant", unit="N/m", label="tangent stiffness at no load")
    secant: Array = quantity("speed", "variant", unit="N/m", label="secant stiffness at full load")


@dataclass(frozen=True)
class SectionForcesResult:
    """Section forces, elastic line and stress along the shaft under static loads.

    ``cut``: both ends of every element, so that a station with a point load comes twice, just in
    front of it and just behind. Section forces are those that the part behind a cut puts on the
    part in front. Stresses are at the outer fibre. ``reaction``: load of a bearing or support on
    the shaft. ``required_diameter``: of a uniform shaft with ``bore`` that just keeps to
    ``allowed_twist``.
    """

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    cut: Array = coordinate("cut", unit="m", label="station", printed=MILLIMETRE)
    support: Words = coordinate("support", unit="", label="support")
    component: Words = coordinate("component", unit="", label="component")
    twist_limit: Words = coordinate("twist_limit", unit="", label="twist limit")
    outcome: Words = quantity("speed", unit="", label="outcome")
    outer_diameter: Array = quantity("cut", unit="m", label="outer diameter", printed=MILLIMETRE)
    inner_diameter: Array = quantity("cut", unit="m", label="inner diameter", printed=MILLIMETRE)
    normal_force: Array = quantity("speed", "cut", unit="N", label="normal force N")
    shear_force_y: Array = quantity("speed", "cut", unit="N", label="shear force Ty")
    shear_force_z: Array = quantity("speed", "cut", unit="N", label="shear force Tz")
    torque: Array = quantity("speed", "cut", unit="N·m", label="torque Mt")
    bending_moment_y: Array = quantity("speed", "cut", unit="N·m", label="bending moment My")
    bending_moment_z: Array = quantity("speed", "cut", unit="N·m", label="bending moment Mz")
    axial_displacement: Array = quantity("speed", "cut", unit="m", label="axial displacement")
    deflection_y: Array = quantity("speed", "cut", unit="m", label="deflection y")
    deflection_z: Array = quantity("speed", "cut", unit="m", label="deflection z")
    twist: Array = quantity("speed", "cut", unit="rad", label="twist θx")
    slope_y: Array = quantity("speed", "cut", unit="rad", label="slope θy")
    slope_z: Array = quantity("speed", "cut", unit="rad", label="slope θz")
    normal_stress: Array = quantity(
        "speed", "cut", unit="Pa", label="normal stress", printed=MEGAPASCAL
    )
    torsion_stress: Array = quantity(
        "speed", "cut", unit="Pa", label="shear stress of torsion", printed=MEGAPASCAL
    )
    von_mises_stress: Array = quantity(
        "speed", "cut", unit="Pa", label="von Mises stress", printed=MEGAPASCAL
    )
    support_station: Array = quantity("support", unit="m", label="station", printed=MILLIMETRE)
    reaction: Array = quantity("speed", "support", "component", unit="N, N·m", label="reaction")
    allowed_twist: Array = quantity("twist_limit", unit="rad", label="allowed twist")
    bore: Array = quantity("twist_limit", unit="m", label="bore", printed=MILLIMETRE)
    twist_between: Array = quantity("speed", "twist_limit", unit="rad", label="twist")
    required_diameter: Array = quantity(
        *("speed", "twist_limit"),
        unit="m",
        label="outer diameter that just keeps to it",
        printed=MILLIMETRE,
    )


@dataclass(frozen=True)
class UnbalanceResult:
    """Steady motion by unbalance: y(t) = Re(``displacement`` e^(i|r|Ωt)), z likewise.

    ``rotor`` is out of balance, of ``speed_ratio`` r; ``speed`` Ω is that of the spindle.
    Amplitudes are zero to peak. At t = 0 the mark of the rotor from which angles count points to y,
    so that ``phase`` is how far a motion leads it. Axes of the orbit: half lengths,
    ``minor_axis`` below zero where the orbit runs against the spindle; ``inclination`` of the major
    one from y to z. ``force``: of a bearing or support on what it holds, ``force_amplitude`` the
    major half axis of its hodograph. ``critical_speed``: synchronous criticals among the speeds.
    """

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    point: Words = coordinate("point", unit="", label="point")
    axis: Words = coordinate("axis", unit="", label="axis")
    support: Words = coordinate("support", unit="", label="support")
    unbalance: Words = coordinate("unbalance", unit="", label="unbalance")
    critical: Words = coordinate("critical", unit="", label="critical speed")
    outcome: Words = quantity("speed", unit="", label="outcome")
    displacement: Complex = quantity("speed", "point", "axis", unit="m", label="displacement")
    amplitude: Array = quantity("speed", "point", "axis", unit="m", label="amplitude, zero to peak")
    phase: Array = quantity("speed", "point", "axis", unit="rad", label="phase lead")
    major_axis: Array = quantity("speed", "point", unit="m", label="major half axis of the orbit")
    minor_axis: Array = quantity(
        "speed", "point", unit="m", label="minor half axis of the orbit, backward below 0"
    )
    inclination: Array = quantity(
        "speed", "point", unit="rad", label="inclination of the major axis"
    )
    force: Complex = quantity("speed", "support", "axis", unit="N", label="force on the shaft")
    force_amplitude: Array = quantity(
        "speed", "support", unit="N", label="amplitude of the force, zero to peak"
    )
    rotor: str = quantity(unit="", label="rotor out of balance")
    speed_ratio: float = quantity(unit="1", label="its speed over that of the spindle")
    unbalance_station: Array = quantity("unbalance", unit="m", label="station", printed=MILLIMETRE)
    unbalance_size: Array = quantity(
        "unbalance", unit="kg·m", label="unbalance", printed=GRAM_MILLIMETRE
    )
    unbalance_angle: Array = quantity("unbalance", unit="rad", label="angle")
    critical_speed: Array = quantity("critical", unit="rad/s", label="critical speed, 1× rotation")
    error: Array = quantity("point", unit="1", label="estimated error over the largest value")


@dataclass(frozen=True)
class BearingMapResult:
    """A single bearing under axial load and speed, its tilts blocked."""

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    load: Array = coordinate("load", unit="N", label="axial load")
    tangent: Words = coordinate("tangent", unit="", label="tangent")
    dof: Words = coordinate("dof", unit="", label="freedom")
    dof_other: Words = coordinate("dof_other", unit="", label="freedom")
    outcome: NDArray[np.str_] = quantity("speed", "load", unit="", label="outcome")
    deflection: Array = quantity("speed", "load", unit="m", label="axial deflection")
    stiffness: Array = quantity(
        *("speed", "load", "tangent", "dof", "dof_other"),
        unit="N/m, N/rad, N·m/rad",
        label="stiffness",
    )
    inner_angle: Array = quantity("speed", "load", unit="rad", label="inner contact angle")
    outer_angle: Array = quantity("speed", "load", unit="rad", label="outer contact angle")
    inner_load: Array = quantity("speed", "load", unit="N", label="inner ball load")
    outer_load: Array = quantity("speed", "load", unit="N", label="outer ball load")
    inner_pressure: Array = quantity("speed", "load", unit="Pa", label="inner peak pressure")
    outer_pressure: Array = quantity("speed", "load", unit="Pa", label="outer peak pressure")
    centrifugal_force: Array = quantity("speed", "load", unit="N", label="centrifugal force")
    gyroscopic_moment: Array = quantity("speed", "load", unit="N·m", label="gyroscopic moment")
    inner_grip: Array = quantity("speed", "load", unit="1", label="grip needed, inner race")
    outer_grip: Array = quantity("speed", "load", unit="1", label="grip needed, outer race")
    slipping: NDArray[np.str_] = quantity("speed", "load", unit="", label="race that slips")
    inner_spin_to_roll: Array = quantity(
        "speed", "load", unit="1", label="spin-to-roll ratio, inner race"
    )
    outer_spin_to_roll: Array = quantity(
        "speed", "load", unit="1", label="spin-to-roll ratio, outer race"
    )
    control: NDArray[np.str_] = quantity("speed", "load", unit="", label="controlling race")
    control_agrees: Flags = quantity("speed", "load", unit="", label="kinematics agrees")


@dataclass(frozen=True)
class ControlResult:
    """Which race controls the balls of a single bearing over axial load and speed, tilts blocked.

    ``boundary``: of the inner race, the load above which it controls; of the outer race, the load
    up to which it does. ``fit``: of F = a ω² + b ω + c. A load or fit that does not exist is NaN
    beside its ``absence``, a margin beside its ``state``.
    """

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    load: Array = coordinate("load", unit="N", label="axial load")
    boundary: Words = coordinate("boundary", unit="", label="boundary of control by race")
    term: Words = coordinate("term", unit="", label="term of the fit")
    outcome: Words = quantity("speed", unit="", label="outcome")
    radial: float = quantity(unit="1", label="radial over axial load")
    resting_weight: float = quantity(
        unit="1", label="friction moment, inner over outer race, at equal ball loads"
    )
    boundary_load: Array = quantity("boundary", "speed", unit="N", label="load at the boundary")
    boundary_absence: NDArray[np.str_] = quantity(
        "boundary", "speed", unit="", label="why there is no boundary"
    )
    boundary_pressure: Array = quantity(
        "boundary", "speed", unit="Pa", label="peak pressure at the boundary"
    )
    changes: NDArray[np.int_] = quantity(
        "boundary", "speed", unit="1", label="changes of control over the loads"
    )
    fit: Array = quantity(
        "boundary", "term", unit="N/(rad/s)², N/(rad/s), N", label="quadratic fit over speed"
    )
    fit_misfit: Array = quantity("boundary", unit="N", label="largest misfit of the fit")
    fit_absence: Words = quantity("boundary", unit="", label="why there is no fit")
    state: NDArray[np.str_] = quantity("speed", "load", unit="", label="state")
    inner_margin: Array = quantity(
        "speed", "load", unit="1", label="margin of control by the inner race"
    )
    outer_margin: Array = quantity(
        "speed", "load", unit="1", label="margin of control by the outer race"
    )


Result = (
    PreloadResult
    | CampbellResult
    | FrequencyResponse
    | StiffnessResult
    | SectionForcesResult
    | UnbalanceResult
    | BearingMapResult
    | ControlResult
)


def turning(result: object) -> bool:
    """True where frequencies are those seen from the frame that turns with the shaft."""
    return isinstance(result, TurningCampbellResult | TurningFrfResult)
