"""Description of a stability analysis of milling or turning (SI)."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from itertools import compress
from typing import Annotated

from rotordyn.analyses.measured_spindle import MeasuredSpindle, at_front
from rotordyn.analyses.stability_lobes.workpiece import (
    CuttingCoefficient,
    RadialCoefficient,
    Workpiece,
)
from rotordyn.analyses.stability_lobes.workpiece_mode import WorkpieceMode
from rotordyn.description import Description, Faults, ascending, within
from rotordyn.machine.assembly import misnamed, unknown
from rotordyn.machine.plausibility import undamped
from rotordyn.machine.spindle import Spindle
from rotordyn.quantity import (
    Angle,
    Choice,
    Diameter,
    Frequency,
    Length,
    PointName,
    Quantity,
    Sweep,
    TopSpeed,
    Whole,
)
from rotordyn.results.display import RPM
from rotordyn.scene.formulation import ROTATING
from rotordyn.scene.spec import Setting, Spec

MULTI_FREQUENCY, ZERO_ORDER = "multi-frequency", "zero-order"
METHODS = (MULTI_FREQUENCY, ZERO_ORDER)
MILLING = ("up", "down", "slot")
OBLIQUE = math.radians(60.0)
HOPF, FLIP, FOLD, NONE = "hopf", "flip", "fold", ""
REPEATING = {FLIP: "period doubling", FOLD: "repeats with the pattern of teeth"}
WITHOUT_CUT = "without a cut"  # the machine alone is unstable
OF_MILLING = (
    "teeth",
    "pitch",
    "tangential",
    "radial",
    "workpiece",
    "workpiece_modes",
    "helix",
    "cut",
)
ROUND = math.radians(0.1)  # tolerance of the sum of pitches, whose angles may be rounded
SAME = 1e-6  # relative tolerance of a diameter that is given twice
ALIKE = 1e-9  # rad: pitches that differ by less are equal
Immersion = Annotated[float, Quantity("ratio", above="0 %", at_most="100 %")]
Helix = Annotated[float, Quantity("angle", at_least="0 deg", below="90 deg")]
ForceAngle = Annotated[float, Quantity("angle", above="-90 deg", below="90 deg")]
Share = Annotated[float, Quantity("ratio", at_least="0 %", at_most="90 %")]
Pitch = Annotated[float, Quantity("angle", at_least="1 deg", at_most="360 deg")]
Ploughing = Annotated[float, Quantity("stiffness", at_least="0 N/m", at_most="1e9 N/m")]
EdgeForce = Annotated[float, Quantity("stiffness", at_least="0 N/m", at_most="1e6 N/m")]
Runout = Annotated[float, Quantity("length", at_least="-1 mm", at_most="1 mm")]
CutDepth = Annotated[float, Quantity("length", above="0 mm", at_most="1 m")]


@dataclass(frozen=True, slots=True)
class Turning(Description):
    """A cut into a workpiece that turns with the spindle: one edge, always in cut."""

    force: Annotated[CuttingCoefficient, "cutting coefficient, of the whole force"]
    force_angle: Annotated[
        ForceAngle,
        "angle of the cutting force, from the normal to the cut surface towards the cutting speed",
    ] = OBLIQUE
    direction: Annotated[
        Angle, "direction of the normal to the cut surface, from z in the sense of rotation"
    ] = 0.0


@dataclass(frozen=True, slots=True)
class Interval(Description):
    """Relative uncertainty of values of the model, to both sides."""

    stiffness: Annotated[
        Share, "uncertainty of the stiffness of the whole machine, not of a flexible workpiece"
    ] = 0.0
    damping: Annotated[Share, "uncertainty of the damping ratios of all modes"] = 0.0
    coefficients: Annotated[Share, "uncertainty of the cutting coefficients"] = 0.0


@dataclass(frozen=True, slots=True)
class PlannedCut(Description):
    """A milling cut whose forces, forced vibration and error of the surface are computed where it
    is stable, with the ``feed_per_tooth`` of the analysis."""

    depth: Annotated[CutDepth, "axial depth of cut"]
    tangential_edge: Annotated[
        EdgeForce,
        "tangential edge coefficient Kte: edge force by length of edge in cut; it represents wear",
    ] = 0.0
    radial_edge: Annotated[EdgeForce, "radial edge coefficient Kre"] = 0.0
    runout: Annotated[
        tuple[Runout, ...],
        "radial run-out of each tooth (positive: it protrudes), in the order in which they cut",
    ] = ()


@dataclass(frozen=True, slots=True)
class StabilityLobesSpec(Spec):
    """Depth of cut up to which milling or turning is stable, over speed, at every speed's own
    receptance."""

    point: Annotated[PointName, "tip of the tool, or of the workpiece in turning"]
    diameter: Annotated[
        Diameter | None,
        "diameter of the cutter, by default `cutter_diameter` of the tool, or of the "
        "workpiece in turning",
    ] = None
    teeth: Annotated[int, Whole(0, 100), "teeth of the cutter"] = 0
    tangential: Annotated[
        CuttingCoefficient | None, "tangential cutting coefficient Ktc; or `workpiece`"
    ] = None
    radial: Annotated[
        RadialCoefficient | None, "radial cutting coefficient Krc; or `workpiece`"
    ] = None
    workpiece: Annotated[
        Workpiece | None,
        "name or path of a material with its cutting coefficients, of several sources",
    ] = None
    immersion: Annotated[Immersion, "radial depth of cut over diameter"] = 1.0
    milling: Annotated[
        str, Choice(MILLING), "up- or down-milling; in a slot the immersion is 1"
    ] = "slot"
    helix: Annotated[Helix, "helix angle of the edges; zero-order limits do not depend on it"] = 0.0
    feed: Annotated[
        Angle, "direction of the feed, from z in the sense of rotation of the spindle"
    ] = 0.0
    turning: Annotated[Turning | None, "turning in place of milling; zero order is exact"] = None
    process_damping: Annotated[
        Ploughing,
        "force normal to the cut surface per normal velocity, times cutting speed, per depth",
    ] = 0.0
    interval: Annotated[Interval, "uncertainties from which the band of the limits follows"] = (
        field(default_factory=Interval)
    )
    feed_per_tooth: Annotated[
        Length,
        "feed per tooth (in turning per revolution; the average of uneven teeth), for "
        "the removal rate and the planned `cut`; it does not change the limits",
    ] = 1e-4
    method: Annotated[str, Choice(METHODS), "`multi-frequency` is complete, `zero-order` quick"] = (
        MULTI_FREQUENCY
    )
    measured_spindle: Annotated[
        MeasuredSpindle | None,
        "measured receptances of a spindle, with the tool of the case coupled to them; "
        "its lobes are drawn with those of the computed machine "
        "([how](howto/measured_spindle.md))",
    ] = None
    max_frequency: Annotated[
        Frequency,
        "frequency up to which the machine is modelled, raised while that changes the limits",
    ] = 4000.0
    speeds: Annotated[
        tuple[TopSpeed, ...],
        Sweep(),
        "speeds of the limits; the machine is solved at each. By default those of the case above 0",
    ] = ()
    pitch: Annotated[
        tuple[Pitch, ...],
        "angles from each tooth to the one that cut before it, in the order in which "
        "they cut, 360° in total (within 0.1°, to which they are scaled); evenly spaced "
        "by default",
    ] = ()
    cut: Annotated[
        PlannedCut | None,
        "planned cut, for which forces, vibration and the error of the milled surface are computed",
    ] = None
    workpiece_modes: Annotated[
        tuple[WorkpieceMode, ...],
        "modes of a flexible workpiece, such as a thin wall; rigid by default",
    ] = ()

    @property
    def ends(self) -> tuple[float, float]:
        """Entry and exit angle of a tooth [rad], from the normal towards the feed."""
        if self.milling == "up":
            return 0.0, math.acos(1.0 - 2.0 * self.immersion)
        if self.milling == "down":
            return math.acos(2.0 * self.immersion - 1.0), math.pi
        return 0.0, math.pi

    def across(self, spindle: Spindle) -> float | None:
        """Return the diameter of the cutter, or of the work in turning [m]; None if not given."""
        return self.diameter or (None if self.turning else spindle.cutter_diameter)

    @property
    def uneven(self) -> bool:
        """Whether the teeth are unevenly spaced."""
        return any(abs(pitch - self.pitch[0]) > ALIKE for pitch in self.pitch)

    @property
    def pitches(self) -> tuple[float, ...]:
        """``pitch`` [rad], scaled to a sum of 2π."""
        total = math.fsum(self.pitch)
        return tuple(2.0 * math.pi * pitch / total for pitch in self.pitch)

    @property
    def walls(self) -> tuple[str, ...]:
        """Walls that milling leaves: "up" where teeth enter, "down" where they leave."""
        return ("up", "down") if self.milling == "slot" else (self.milling,)

    @property
    def pairs(self) -> tuple[tuple[float, float], ...]:
        """Tangential and radial coefficient [Pa] of every source, the most likely first; in turning
        one pair without meaning."""
        if self.workpiece is not None:
            return self.workpiece.pairs
        return ((self.tangential or 0.0, self.radial or 0.0),)

    def _faults(self) -> Faults:
        yield from ascending("speeds", self.speeds)
        if self.turning is not None:
            for key in OF_MILLING:
                if getattr(self, key):
                    yield (key,), "of milling: given beside turning; leave one of the two out"
            return
        yield from self._milling_faults()

    def _milling_faults(self) -> Faults:
        if not self.teeth:
            yield ("teeth",), "missing key: the number of teeth, or turning"
        total, count = math.fsum(self.pitch), len(self.pitch)
        if not count or not self.teeth or total != total:
            pass  # no pitch, or a fault reported already
        elif count != self.teeth:
            yield ("pitch",), f"given {count} in number; allowed: {self.teeth}, one for each tooth"
        elif abs(total - 2.0 * math.pi) > ROUND:
            yield (
                ("pitch",),
                f"given {math.degrees(total):.6g}° in total; allowed: 360°, a full turn",
            )
        if self.cut is not None and self.teeth and len(self.cut.runout) not in (0, self.teeth):
            count = len(self.cut.runout)
            yield (
                ("cut", "runout"),
                f"given {count} in number; allowed: {self.teeth}, one for each tooth",
            )
        given = [self.tangential is not None, self.radial is not None]
        if self.workpiece is None and not all(given):
            key = "radial" if given[0] else "tangential"
            yield (key,), "missing key: tangential and radial must be given, or workpiece"
        if self.workpiece is not None and any(given):
            beside = " and ".join(compress(("tangential", "radial"), given))
            yield ("workpiece",), f"given beside {beside}: leave one of the two out"
        if self.milling == "slot" and self.immersion != 1.0:
            yield (
                ("immersion",),
                "a slot has the immersion 1: given {given}; allowed: 1, or milling: up or down",
            )
        if self.helix > 0.0 and self.method == ZERO_ORDER and self.cut is None:
            yield (
                ("helix",),
                "zero-order limits do not depend on it: given {given}; leave it out, or take "
                "method: multi-frequency",
            )

    def faults_on(self, setting: Setting) -> Faults:
        if not misnamed(setting.spindle):
            unnamed = [*unknown("point", self.point, [*setting.spindle.places])]
            yield from ((("point",), sentence) for sentence in unnamed)
            if self.measured_spindle is not None and not unnamed:
                yield from self._measured_faults(self.measured_spindle, setting.spindle)
        yield from self._diameter_faults(setting.spindle)
        if setting.conditions.formulation == ROTATING:
            yield (
                (),
                "the cut does not rotate: given beside rotating; allowed: formulation inertial",
            )
        if undamped(setting.spindle):
            yield (
                (),
                "the machine is undamped, so that no cut is stable: give damping.rotor, "
                "damping.bearings, or damping of supports",
            )
        for index, speed in enumerate(self.speeds):
            if speed > setting.top * (1.0 + 1e-9):
                yield (
                    ("speeds", index),
                    "above the highest speed of the case, to which the machine is modelled: "
                    f"allowed: up to {setting.top * RPM.factor:.6g} rpm",
                )
        if not self.speeds and setting.top <= 0.0:
            yield ("speeds",), "no speed above 0: give speeds of the limits here"

    def _diameter_faults(self, spindle: Spindle) -> Faults:
        diameter, of_tool = self.diameter, spindle.cutter_diameter
        if self.across(spindle) is None:
            what = (
                "of the workpiece"
                if self.turning
                else "of the cutter, or cutter_diameter of the tool"
            )
            yield ("diameter",), f"missing key: the diameter {what}"
        elif diameter and of_tool and not self.turning and abs(diameter / of_tool - 1.0) > SAME:
            yield (
                ("diameter",),
                f"given {{given}} beside a tool of {of_tool * 1e3:.6g} mm: leave it out, or "
                "cutter_diameter of the tool",
            )

    def _measured_faults(self, measured: MeasuredSpindle, spindle: Spindle) -> Faults:
        yield from within(("measured_spindle",), measured.faults_on(spindle))
        if self.point and not at_front(spindle, self.point):
            yield (
                ("point",),
                "coupling computes the tip of the tool: given {given}; allowed: the point at its "
                "front end, or no measured_spindle",
            )
