"""Result of a stability analysis: stable depth of cut over speed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.arrays import Array, Flags, Words
from rotordyn.results.declaration import Absence, coordinate, quantity
from rotordyn.results.display import MEGAPASCAL, MILLIMETRE, Shown, number

REMOVAL = Shown("cm³/min", 60e6)


STABLE = Absence("where no depth is unstable", beside="loss")
CUT = Absence("where the cut is not stable or not solved", beside="cut_is_stable")
NO_MOTOR = Absence("where no motor is given")
NO_TORQUE = Absence("where the force does not brake the spindle")
NO_FLIP = Absence("where none is found before the next speed", by=("cutting_speed",))
NO_TEST = Absence("without a measured spindle")
ANY_DEPTH = Absence("where no depth is unstable", by=("cutting_speed",))


@dataclass(frozen=True)
class StabilityLobesResult:
    """Limits at ``cutting_speed``, each with the receptance of the machine at that speed; infinite
    where no depth is unstable.

    ``waves``: periods of the chatter from one tooth to the next, over the longest pitch.
    ``flip_depth``: least depth of period doubling before the next speed, at ``flip_speed``, by the
    modes of the nearest speed, where a mode passes k + ½ waves.
    ``motor_depth``: depth that takes the torque of the ``motor`` on average, and ``motor_removal``
    by the lesser of it and the limit. ``at_rest``: limit by the receptance of the machine at rest;
    ``even``: limit of as many evenly spaced teeth, NaN where the teeth are evenly spaced;
    ``measured``: limit of the tool on the measured spindle, NaN without one, with its
    ``measured_chatter`` and ``measured_doubt``, what makes its tip doubtful; above ``measured_to``,
    its last frequency, limit and chatter are those of the machine as computed at rest, which is
    lower there. ``least``, ``most``: over the intervals of the case and all sources of the cutting
    coefficients. ``source``: sources of a workpiece, that of the limits first; none where the case
    gives coefficients itself.
    ``planned_depth``: of the planned cut, with its feed by tooth, at ``milling_speed``: the speeds
    of the cutter, none without such a cut; where it is stable it has the error of every ``wall``
    that it leaves, least and largest over its depth, of the deepest tooth, positive where material
    is left, the mean displacement of the tip against the workpiece, its peak-to-peak vibration, the
    largest force, mean torque and power, and the removal rate (``planned_removal``).
    ``edges_chatter``: edge forces that follow the vibration may cause chatter. ``idle_teeth`` cut
    nothing, by their run-out. The vibration moves the ends of its own contact:
    ``contact_departure``, the change of the vibration by that, and ``vibration_error``, the
    remaining change in its iteration, both over its size.
    ``resonance_width``: twice the least damping ratio of the high modes that a multiple of the
    frequency of the teeth meets before the next speed, the width of resonances over speed; 0 where
    none is met.
    ``pocket``: maxima of the depth over speed, the deepest first. ``error``: largest change of a
    limit at some speeds by a model of twice the frequencies, over the limit.
    """

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    outcome: Words = quantity("speed", unit="", label="outcome")
    cutting_speed: Array = coordinate("cutting_speed", unit="rad/s", label="speed of the cutter")
    cutting_outcome: Words = quantity("cutting_speed", unit="", label="outcome")
    depth: Array = quantity(
        "cutting_speed",
        unit="m",
        label="stable depth of cut",
        printed=MILLIMETRE,
        infinite=(Absence("where no depth is unstable", beside="loss"),),
    )
    chatter: Array = quantity(
        "cutting_speed", unit="Hz", label="chatter frequency", absent=(STABLE,)
    )
    waves: Array = quantity(
        "cutting_speed", unit="1", label="waves from tooth to tooth", absent=(STABLE,)
    )
    loss: Words = quantity("cutting_speed", unit="", label="loss of stability")
    flip_depth: Array = quantity(
        "cutting_speed",
        unit="m",
        label="depth of period doubling before the next speed",
        printed=MILLIMETRE,
        absent=(NO_FLIP,),
        infinite=(NO_FLIP,),
    )
    flip_speed: Array = quantity(
        "cutting_speed", unit="rad/s", label="speed of the period doubling", absent=(NO_FLIP,)
    )
    mode_frequency: Array = quantity(
        "cutting_speed",
        unit="Hz",
        label="nearest mode",
        absent=(Absence("without a chatter frequency", beside="chatter"),),
    )
    mode_damping: Array = quantity(
        "cutting_speed",
        unit="1",
        label="damping ratio of the nearest mode",
        absent=(Absence("without a chatter frequency", beside="chatter"),),
    )
    removal: Array = quantity(
        "cutting_speed",
        unit="m³/s",
        label="removal rate at the limit",
        printed=REMOVAL,
        infinite=(Absence("where no depth is unstable", beside="loss"),),
    )
    motor: str = quantity(unit="", label="motor")
    motor_depth: Array = quantity(
        "cutting_speed",
        unit="m",
        label="depth of cut at the limit of the motor",
        printed=MILLIMETRE,
        absent=(NO_MOTOR,),
        infinite=(NO_TORQUE,),
    )
    motor_removal: Array = quantity(
        "cutting_speed",
        unit="m³/s",
        label="removal rate within the limits of stability and motor",
        printed=REMOVAL,
        absent=(NO_MOTOR,),
        infinite=(Absence("where neither motor nor chatter limits the depth", beside="loss"),),
    )
    at_rest: Array = quantity(
        "cutting_speed",
        unit="m",
        label="stable depth of cut with the receptance at rest",
        printed=MILLIMETRE,
        infinite=(ANY_DEPTH,),
    )
    even: Array = quantity(
        "cutting_speed",
        unit="m",
        label="stable depth of cut of evenly spaced teeth",
        printed=MILLIMETRE,
        absent=(Absence("where the teeth are evenly spaced"),),
        infinite=(ANY_DEPTH,),
    )
    measured: Array = quantity(
        "cutting_speed",
        unit="m",
        label="stable depth of cut on the measured spindle",
        printed=MILLIMETRE,
        absent=(NO_TEST,),
        infinite=(ANY_DEPTH,),
    )
    measured_chatter: Array = quantity(
        "cutting_speed",
        unit="Hz",
        label="chatter frequency on the measured spindle",
        absent=(NO_TEST, ANY_DEPTH),
    )
    measured_doubt: str = quantity(
        unit="", label="what makes the tip on the measured spindle doubtful"
    )
    measured_to: float = quantity(
        unit="Hz", label="frequency up to which the spindle is measured", absent=(NO_TEST,)
    )
    least: Array = quantity(
        "cutting_speed",
        unit="m",
        label="least limit of the band",
        printed=MILLIMETRE,
        infinite=(ANY_DEPTH,),
    )
    most: Array = quantity(
        "cutting_speed",
        unit="m",
        label="largest limit of the band",
        printed=MILLIMETRE,
        infinite=(ANY_DEPTH,),
    )
    workpiece: str = quantity(unit="", label="material of the workpiece")
    workpiece_mode: NDArray[np.int_] = coordinate(
        "workpiece_mode", unit="", label="mode of the workpiece"
    )
    workpiece_frequency: Array = quantity(
        "workpiece_mode", unit="Hz", label="frequency of the mode"
    )
    source: NDArray[np.int_] = coordinate("source", unit="", label="source of the coefficients")
    tangential: Array = quantity(
        "source", unit="Pa", label="tangential cutting coefficient", printed=MEGAPASCAL
    )
    radial: Array = quantity(
        "source", unit="Pa", label="radial cutting coefficient", printed=MEGAPASCAL
    )
    pocket: NDArray[np.int_] = coordinate("pocket", unit="", label="pocket")
    pocket_speed: Array = quantity("pocket", unit="rad/s", label="speed of the cutter")
    pocket_depth: Array = quantity(
        "pocket", unit="m", label="stable depth of cut", printed=MILLIMETRE
    )
    pocket_removal: Array = quantity(
        "pocket", unit="m³/s", label="removal rate at the limit", printed=REMOVAL
    )
    pocket_from: Array = quantity(
        "pocket", unit="rad/s", label="speed from which 80 % of the depth are stable"
    )
    pocket_to: Array = quantity(
        "pocket", unit="rad/s", label="speed to which 80 % of the depth are stable"
    )
    planned_depth: float = quantity(
        unit="m",
        label="planned depth of cut",
        printed=MILLIMETRE,
        absent=(Absence("where no cut is planned"),),
    )
    planned_feed: float = quantity(
        unit="m",
        label="planned feed per tooth",
        printed=MILLIMETRE,
        absent=(Absence("where no cut is planned"),),
    )
    milling_speed: Array = coordinate("milling_speed", unit="rad/s", label="speed of the cutter")
    wall: Words = coordinate("wall", unit="", label="wall")
    direction: Words = coordinate("direction", unit="", label="direction")
    cut_is_stable: Flags = quantity("milling_speed", unit="", label="stable")
    surface_error_least: Array = quantity(
        *("milling_speed", "wall"), unit="m", label="least error of the wall", absent=(CUT,)
    )
    surface_error_most: Array = quantity(
        *("milling_speed", "wall"), unit="m", label="largest error of the wall", absent=(CUT,)
    )
    tip_deflection: Array = quantity(
        *("milling_speed", "direction"),
        unit="m",
        label="mean displacement of the tip",
        absent=(CUT,),
    )
    tip_vibration: Array = quantity(
        *("milling_speed", "direction"),
        unit="m",
        label="vibration of the tip from peak to peak",
        absent=(CUT,),
    )
    cutting_force: Array = quantity(
        "milling_speed", unit="N", label="largest cutting force", absent=(CUT,)
    )
    cutting_torque: Array = quantity(
        "milling_speed", unit="N·m", label="mean torque", absent=(CUT,)
    )
    cutting_power: Array = quantity("milling_speed", unit="W", label="mean power", absent=(CUT,))
    planned_removal: Array = quantity(
        "milling_speed",
        unit="m³/s",
        label="removal rate of the planned cut",
        printed=REMOVAL,
        absent=(CUT,),
    )
    vibration_error: Array = quantity(
        "milling_speed", unit="1", label="relative error of the vibration", absent=(CUT,)
    )
    contact_departure: Array = quantity(
        "milling_speed",
        unit="1",
        label="relative change of the vibration by its moving contact",
        absent=(CUT,),
    )
    resonance_width: Array = quantity(
        "milling_speed",
        unit="1",
        label="relative width of the sharpest resonance between this speed and the next",
        absent=(CUT,),
    )
    edges_chatter: Flags = quantity(
        "milling_speed", unit="", label="may chatter by edge forces that follow the vibration"
    )
    idle_teeth: int = quantity(unit="", label="number of teeth that do not cut")
    modelled: float = quantity(unit="Hz", label="frequency up to which the machine is modelled")
    error: float = quantity(unit="1", label="change of a limit by a finer model")
    error_asked: float = quantity(unit="1", label="largest change asked for")


def banded(result: StabilityLobesResult) -> bool:
    """Return whether limits have a band, by intervals or by several sources."""
    return not np.allclose(result.least, result.most, rtol=1e-12, equal_nan=True)


def in_mm(value: float) -> str:
    """Format a length [m] in millimetres."""
    return f"{number(value * MILLIMETRE.factor, 2)} mm"
