"""Free motions over speed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from rotordyn.arrays import Array, Complex, Flags, Words
from rotordyn.modes.overdamped import ROUNDING, is_overdamped
from rotordyn.results.declaration import Absence, coordinate, quantity
from rotordyn.results.display import MILLIMETRE, PER_SECOND

NOT_FOLLOWED = Absence("at a speed at which the mode is not followed", beside="followed")
UNREFINED = Absence("where the model is not refined")
STILL = Absence("of a motion that does not oscillate", beside="frequency")


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
    ``pole``: λ of e^(λt) with Im λ ≥ 0. ``overdamped``: its damping ratio is above ``OVERDAMPED``,
    so that the motion hardly oscillates. ``unconverged``: what still changes by more than the
    accuracy asked for as the model is refined, a sentence, or "". ``stability_threshold``: lowest
    speed of the range at which a mode begins to grow, infinite where none does;
    ``threshold_is_bound``: the mode grows at the lowest speed at which it is solved already, so
    that its threshold is there or below; ``unstable_mode``: that mode, "a divergence" of a motion
    that does not vibrate, or "". ``rotor``: the spindle's shaft and further rotors, at
    ``speed_ratio`` times its speed; ``node_rotor``: the rotor of each node; whirl is forward in the
    direction in which the spindle turns. ``engine_order``: those whose critical speeds were sought;
    ``critical``: the mode that turns at ``critical_order`` times the speed of ``critical_rotor``
    where the spindle has ``critical_speed``, with its kind and damping ratio there; all are listed
    where it turns at ``max_frequency`` at most; ``critical_whirl``: forward, backward, planar, or
    mixed where parts of the shaft whirl either way; ``critical_excited``: false where a force that
    turns with the shaft does no work on it (order 1; axial, torsion, backward whirl of an isotropic
    rotor); a force of another order may point anywhere. ``excited_by``: direction of the rotating
    unbalance that excites a mode, forward, backward or either; "" of axial motion and torsion.
    ``passing``: defects of bearings, of identical bearings once.
    """

    turning_frame: ClassVar[bool] = False

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    mode: Words = coordinate("mode", unit="", label="mode")
    node: Array = coordinate("node", unit="m", label="station", printed=MILLIMETRE)
    dof: Words = coordinate("dof", unit="", label="DOF")
    rotor: Words = coordinate("rotor", unit="", label="rotor")
    shape_speed: Array = coordinate("shape_speed", unit="rad/s", label="speed of the shapes")
    critical: Words = coordinate("critical", unit="", label="critical speed")
    engine_order: Array = coordinate("engine_order", unit="1", label="engine order")
    passing: Words = coordinate("passing", unit="", label="defect of a bearing")
    outcome: Words = quantity("speed", unit="", label="outcome")
    followed: Flags = quantity("speed", "mode", unit="", label="followed")
    frequency: Array = quantity(
        "speed", "mode", unit="Hz", label="damped frequency", absent=(NOT_FOLLOWED,)
    )
    frequency_error: Array = quantity(
        "speed",
        "mode",
        unit="1",
        label="estimated relative error of the frequency",
        absent=(
            NOT_FOLLOWED,
            UNREFINED,
        ),
    )
    damping_error: Array = quantity(
        "speed",
        "mode",
        unit="1",
        label="estimated error of the damping ratio",
        absent=(
            NOT_FOLLOWED,
            UNREFINED,
        ),
    )
    max_frequency: float = quantity(
        unit="Hz", label="highest frequency of modes and critical speeds"
    )
    unconverged: str = quantity(unit="", label="what changes as the model is refined")
    pole: Complex = quantity(
        "speed", "mode", unit="rad/s", label="pole", printed=PER_SECOND, absent=(NOT_FOLLOWED,)
    )
    stopped: Array = quantity("speed", unit="1", label="number of sleeves at their stops")
    free: Array = quantity(
        "speed", unit="1", label="zero eigenvalues of rigid-body motion, which are not modes"
    )
    node_rotor: Words = quantity("node", unit="", label="rotor of the node")
    speed_ratio: Array = quantity("rotor", unit="1", label="speed ratio to the spindle")
    damping_ratio: Array = quantity(
        "speed", "mode", unit="1", label="damping ratio", absent=(NOT_FOLLOWED,)
    )
    overdamped: Flags = quantity("speed", "mode", unit="", label="overdamped")
    decrement: Array = quantity(
        "speed",
        "mode",
        unit="1",
        label="logarithmic decrement",
        absent=(NOT_FOLLOWED,),
        infinite=(STILL,),
    )
    whirl: Array = quantity(
        "speed", "mode", unit="1", label="whirl direction", absent=(NOT_FOLLOWED,)
    )
    whirl_degree: Array = quantity(
        "speed", "mode", unit="1", label="forward minus backward share", absent=(NOT_FOLLOWED,)
    )
    rigid_share: Array = quantity(
        "speed", "mode", unit="1", label="share of rigid-body motion", absent=(NOT_FOLLOWED,)
    )
    kind: Words = quantity("mode", unit="", label="kind")
    excited_by: Words = quantity("mode", unit="", label="direction of the exciting unbalance")
    character: Words = quantity("mode", unit="", label="character")
    shape: Complex = quantity(
        "shape_speed",
        "mode",
        "node",
        "dof",
        unit="1",
        label="mode shape",
        absent=(
            Absence("at a speed at which the mode is not followed", by=("shape_speed", "mode")),
        ),
    )
    stability_threshold: float = quantity(
        unit="rad/s",
        label="speed from which a mode is unstable",
        infinite=(Absence("where no mode is unstable", beside="unstable_mode"),),
    )
    threshold_is_bound: bool = quantity(unit="", label="the threshold may be lower")
    unstable_mode: str = quantity(unit="", label="mode that is unstable from there")
    critical_speed: Array = quantity("critical", unit="rad/s", label="critical speed")
    critical_rotor: Words = quantity("critical", unit="", label="exciting rotor")
    critical_order: Array = quantity("critical", unit="1", label="order of the excitation")
    critical_kind: Words = quantity("critical", unit="", label="kind of critical speed")
    critical_whirl: Words = quantity("critical", unit="", label="whirl at the critical speed")
    critical_damping: Array = quantity(
        "critical", unit="1", label="damping ratio at the critical speed"
    )
    critical_excited: Flags = quantity("critical", unit="", label="excited by the rotation")
    passing_frequency: Array = quantity("speed", "passing", unit="Hz", label="defect frequency")

    @property
    def unstable(self) -> Flags:
        """Whether a mode is unstable (speeds, modes)."""
        return np.asarray(self.damping_ratio < -ROUNDING)

    @property
    def mostly_overdamped(self) -> Flags:
        """Modes (modes,) overdamped at most speeds: counted, neither drawn nor listed."""
        return is_overdamped(self.damping_ratio)

    @property
    def largest_error(self) -> float:
        """Largest error of the frequencies where modes are not overdamped."""
        oscillating = ~self.mostly_overdamped & ~self.overdamped
        return float(np.nanmax(np.where(oscillating, self.frequency_error, 0.0), initial=0.0))


@dataclass(frozen=True)
class TurningCampbellResult(CampbellResult):
    """Campbell result with bending observed from the rotating frame.

    A mode that whirls at ω (its sign the direction) in the fixed frame has |ω − Ω| there. Its
    ``whirl``, ``damping_ratio`` and ``shape`` stay those of the fixed frame, and so do axial motion
    and torsion. Synchronous forward whirl stands still: a critical speed is where it meets 0.
    """

    turning_frame: ClassVar[bool] = True

    frequency: Array = quantity(
        "speed", "mode", unit="Hz", label="damped frequency in the rotating frame"
    )
    frequency_error: Array = quantity(
        "speed", "mode", unit="1", label="estimated error over the frequency in the fixed frame"
    )
