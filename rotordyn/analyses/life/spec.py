"""Specification of the life and heat of bearings (SI; temperatures in °C)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated

from rotordyn.description import Description, Faults, known
from rotordyn.machine.assembly import unknown
from rotordyn.quantity import Choice, Duration, Force, Load, Name, Preload, Share, Speed
from rotordyn.results.display import RPM
from rotordyn.scene.loads import PointLoad
from rotordyn.scene.lubrication import ELLIPSE, LOSS_MODELS, Lubrication
from rotordyn.scene.spec import Setting, Spec, placed

RELIABILITIES = (0.90, 0.95, 0.96, 0.97, 0.98, 0.99)
UNTILTED = (True, True, True, False, False)
_SUM = 1e-6  # by which shares may miss 1


@dataclass(frozen=True, slots=True)
class LoadStep(Description):
    """One step of a load spectrum."""

    share: Annotated[Share, "share of the time; those of all steps add up to 100 %"]
    speed: Annotated[Speed, "spindle speed"]
    axial_force: Annotated[
        Force,
        "axial force on the front end of the shaft, towards +x, in addition to that of "
        "the conditions",
    ] = 0.0
    loads: Annotated[
        tuple[PointLoad, ...], "static loads on the shaft, besides those of the conditions"
    ] = ()
    radial: Annotated[
        Mapping[Name, Preload],
        "radial load on bearings by name; they keep the axial load of their preload, without tilt",
    ] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class LifeSpec(Spec):
    """Life, static safety, heat, films and defect frequencies of every bearing over speed."""

    lubricant: Annotated[
        Lubrication | None, "oil; without it heat, films and modified life are not computed"
    ] = None
    dynamic_ratings: Annotated[
        Mapping[Name, Load],
        "catalogue rating C of ONE bearing each, by name; by default computed from the grooves",
    ] = field(default_factory=dict)
    static_ratings: Annotated[
        Mapping[Name, Load],
        "catalogue rating C0, likewise, for the static safety, Cu of the modified life, and the "
        "`palmgren` moment",
    ] = field(default_factory=dict)
    reliability: Annotated[float, Choice(RELIABILITIES), "reliability of the modified life"] = 0.90
    target: Annotated[
        Duration | None, "required life of every bearing; a warning says where it is not reached"
    ] = None
    spectrum: Annotated[
        tuple[LoadStep, ...],
        "load spectrum: loads and speeds with their shares of time, which give one life",
    ] = ()
    heat: Annotated[
        str,
        Choice(LOSS_MODELS),
        "`ellipse`: sliding in the contact ellipses; `palmgren`: Palmgren's load-dependent moment; "
        "the viscous part is Palmgren's in both ([theory](theory/life.md#friction-and-heat))",
    ] = ELLIPSE

    def _faults(self) -> Faults:
        if self.heat != ELLIPSE and self.lubricant is None:
            yield ("heat",), "heat needs an oil: give lubricant"
        total = sum(step.share for step in self.spectrum)
        if self.spectrum and known(total) and abs(total - 1.0) > _SUM:
            yield (
                ("spectrum",),
                f"shares add up to {100.0 * total:.6g} %: allowed: 100 %",
            )

    def faults_on(self, setting: Setting) -> Faults:
        seats = {seat.name: seat.bearing for seat in setting.spindle.seats}
        places: list[tuple[str | int, ...]] = [
            (key, name)
            for key in ("dynamic_ratings", "static_ratings")
            for name in getattr(self, key)
        ]
        for index, step in enumerate(self.spectrum):
            places += [("spectrum", index, "radial", name) for name in step.radial]
            for name, radial in step.radial.items():
                bearing = seats.get(name)  # None also where its model is faulty
                load = (0.0, radial, 0.0, 0.0, 0.0)
                if bearing is not None and (why := bearing.refusal(load, UNTILTED)):
                    yield ("spectrum", index, "radial", name), why
            yield from self._loads(setting, index, step)
            if step.speed > setting.top:
                yield (
                    ("spectrum", index, "speed"),
                    "above the speeds of the case, up to which warnings are checked: given "
                    f"{step.speed * RPM.factor:.6g} rpm; allowed: up to "
                    f"{setting.top * RPM.factor:.6g} rpm, or add speeds to the case",
                )
        for path in places:
            for sentence in unknown("bearing", str(path[-1]), list(seats)):
                yield path, sentence
        if setting.conditions.bearings == "static":
            yield (), "needs bearings at speed: given conditions.bearings: static"

    def _loads(self, setting: Setting, index: int, step: LoadStep) -> Faults:
        for place, load in enumerate(step.loads):
            yield from placed(load.at, setting.spindle, ("spectrum", index, "loads", place, "at"))
        if step.radial and (step.loads or setting.loaded):
            yield (
                ("spectrum", index, "radial"),
                "given beside loads across the axis, from which radial loads of bearings follow: "
                "allowed: loads of this step instead",
            )
