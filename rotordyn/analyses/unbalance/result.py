"""Result of the response to unbalance."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.arrays import Array, Complex, Flags, Words
from rotordyn.results.declaration import Absence, coordinate, quantity
from rotordyn.results.display import GRAM_MILLIMETRE, MILLIMETRE, PER_SECOND
from rotordyn.scene.linearity import LINEAR

NO_RUN = Absence("of a run without a solution", by=("run",))
RUNAWAY = 1e3  # times the largest value of steady rotation: larger motion on a run is growth
FEWER = Absence("beyond the last peak", last="resonance")


@dataclass(frozen=True)
class UnbalanceResult:
    """Steady motion by unbalance: y(t) = Re(``displacement`` e^(i|r|Ωt)), z likewise.

    ``rotor`` is out of balance, of ``speed_ratio`` r; ``speed`` Ω is that of the spindle.
    Amplitudes are zero to peak. At t = 0 the zero mark of angles on the rotor points to y, so that
    ``phase`` is the lead of a motion over it. Axes of the orbit: half lengths, ``minor_axis`` below
    zero where the orbit runs against the spindle; ``inclination`` of the major one from y to z.
    ``force``: of a bearing or support on the part it holds, ``force_amplitude`` the major half axis
    of its hodograph. ``departure``: difference of the dynamic load along the orbit by a bearing's
    law from that by its tangent, over the latter. ``film_orbit``: of journals in squeeze films, and
    ``film_ratio`` the one that these are computed for. ``unstable``: some motion grows there, so
    that the given steady solution is not reached; ``unstable_…``: every range of such speeds among
    those of the case and of runs, and its fastest pole up to ``model_frequency``, or else the
    slowest one beyond. ``fine_…``: at the speeds of the case and at more speeds about every peak
    and wherever curves bend, so that peaks are resolved; NaN at a speed at which a stop closes
    and next to a critical speed without damping, where lines break. ``peak_…``: every peak of a
    point, ascending, NaN where it has fewer, infinite at a critical speed without damping;
    ``force_unbounded``: the first speed at which a force is infinite. ``run_…``: on runs through
    the speeds in given times, the largest major half axis from one ``run_speed`` to the next, and
    of all; of orbits and, ``run_force…``, of forces; ``run_departure``: ``departure`` at the
    largest forces of bearings. ``critical_speed``: synchronous critical speeds in the range.
    ``grade_speed``: of the spindle, for which a balance grade is given; 0 without one.
    """

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    point: Words = coordinate("point", unit="", label="point")
    axis: Words = coordinate("axis", unit="", label="axis")
    support: Words = coordinate("support", unit="", label="support")
    unbalance: Words = coordinate("unbalance", unit="", label="unbalance")
    critical: Words = coordinate("critical", unit="", label="critical speed")
    outcome: Words = quantity("speed", unit="", label="outcome")
    unstable: Flags = quantity("speed", unit="", label="not reached: the machine is unstable")
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
    departure: Array = quantity(
        "speed",
        "support",
        unit="1",
        label="deviation of a bearing's load from its tangent",
        absent=(LINEAR,),
    )
    rotor: str = quantity(unit="", label="rotor with unbalance")
    grade_speed: float = quantity(unit="rad/s", label="highest service speed of the grade")
    speed_ratio: float = quantity(unit="1", label="speed ratio of the rotor to the spindle")
    unbalance_station: Array = quantity("unbalance", unit="m", label="station", printed=MILLIMETRE)
    unbalance_size: Array = quantity(
        "unbalance", unit="kg·m", label="unbalance", printed=GRAM_MILLIMETRE
    )
    unbalance_angle: Array = quantity("unbalance", unit="rad", label="angle")
    critical_speed: Array = quantity("critical", unit="rad/s", label="critical speed, 1× rotation")
    critical_damping: Array = quantity(
        "critical", unit="1", label="damping ratio at the critical speed"
    )
    fine_speed: Array = coordinate("fine_speed", unit="rad/s", label="speed")
    fine_displacement: Complex = quantity(
        "fine_speed",
        "point",
        "axis",
        unit="m",
        label="displacement",
        absent=(
            Absence(
                "at a speed at which a stop closes, or without a steady response",
                by=("fine_speed",),
            ),
        ),
    )
    fine_major_axis: Array = quantity(
        "fine_speed",
        "point",
        unit="m",
        label="major half axis of the orbit",
        absent=(
            Absence(
                "at a speed at which a stop closes, or without a steady response",
                by=("fine_speed",),
            ),
        ),
    )
    fine_minor_axis: Array = quantity(
        "fine_speed",
        "point",
        unit="m",
        label="minor half axis of the orbit, backward below 0",
        absent=(
            Absence(
                "at a speed at which a stop closes, or without a steady response",
                by=("fine_speed",),
            ),
        ),
    )
    fine_force_amplitude: Array = quantity(
        "fine_speed",
        "support",
        unit="N",
        label="amplitude of the force, zero to peak",
        absent=(
            Absence(
                "at a speed at which a stop closes, or without a steady response",
                by=("fine_speed",),
            ),
        ),
    )
    fine_departure: Array = quantity(
        "fine_speed",
        "support",
        unit="1",
        label="deviation of a bearing's load from its tangent",
        absent=(LINEAR._replace(by=("fine_speed", "support")),),
    )
    force_unbounded: Array = quantity(
        "support",
        unit="rad/s",
        label="speed at which the force is unbounded",
        absent=(Absence("of a bounded force", by=("support",)),),
    )
    film_orbit: Array = quantity(
        "fine_speed",
        "support",
        unit="1",
        label="ratio of orbit to clearance of the squeeze film",
        absent=(
            Absence(
                "of bearings and supports, and where there is no motion",
                by=("fine_speed", "support"),
            ),
        ),
    )
    film_ratio: Array = quantity(
        "support",
        unit="1",
        label="ratio of orbit to clearance for which the film is computed",
        absent=(Absence("of bearings and supports", by=("support",)),),
    )
    resonance: NDArray[np.int_] = coordinate("resonance", unit="", label="resonance")
    peak_speed: Array = quantity(
        "point", "resonance", unit="rad/s", label="speed of the peak", absent=(FEWER,)
    )
    peak_amplitude: Array = quantity(
        "point",
        "resonance",
        unit="m",
        label="major half axis at the peak",
        absent=(FEWER,),
        infinite=(Absence("at an undamped critical speed", beside="critical_damping"),),
    )
    run: Words = coordinate("run", unit="", label="run through the speeds")
    run_speed: Array = coordinate("run_speed", unit="rad/s", label="speed during the run")
    run_outcome: Words = quantity("run", unit="", label="outcome of the run")
    run_amplitude: Array = quantity(
        "run",
        "run_speed",
        "point",
        unit="m",
        label="major half axis of the orbit on a run",
        absent=(NO_RUN,),
    )
    run_peak: Array = quantity(
        "run", "point", unit="m", label="largest half axis on a run", absent=(NO_RUN,)
    )
    run_peak_speed: Array = quantity(
        "run", "point", unit="rad/s", label="speed of the largest half axis", absent=(NO_RUN,)
    )
    run_force: Array = quantity(
        "run",
        "run_speed",
        "support",
        unit="N",
        label="amplitude of the force on a run",
        absent=(NO_RUN,),
    )
    run_force_peak: Array = quantity(
        "run", "support", unit="N", label="largest force on a run", absent=(NO_RUN,)
    )
    run_force_peak_speed: Array = quantity(
        "run", "support", unit="rad/s", label="speed of the largest force", absent=(NO_RUN,)
    )
    run_departure: Array = quantity(
        "run",
        "support",
        unit="1",
        label="deviation of a bearing's load from its tangent on a run",
        absent=(NO_RUN, LINEAR._replace(by=("run", "support"))),
    )
    run_error: Array = quantity(
        "run", unit="1", label="estimated error over the largest value", absent=(NO_RUN,)
    )
    unstable_range: NDArray[np.int_] = coordinate(
        "unstable_range", unit="", label="range of unstable speeds"
    )
    unstable_from: Array = quantity("unstable_range", unit="rad/s", label="unstable from")
    unstable_to: Array = quantity("unstable_range", unit="rad/s", label="unstable to")
    unstable_pole: Complex = quantity(
        "unstable_range",
        unit="rad/s",
        label="pole of the most unstable mode",
        printed=PER_SECOND,
    )
    model_frequency: float = quantity(unit="Hz", label="highest frequency of the model")
    error: Array = quantity("point", unit="1", label="estimated error over the largest value")
    error_asked: float = quantity(
        unit="1",
        label="largest error asked for, over the largest value",
        infinite=(Absence("where none is asked for"),),
    )
