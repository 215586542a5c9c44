"""The flagship spindle and its questions, as the tests ask them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.contract import Spec
from rotordyn.analyses.measured_response import Port
from rotordyn.analyses.solving import solve_spindle
from rotordyn.case.case import Case
from rotordyn.case.model import model
from rotordyn.case.read import load
from rotordyn.equation.free_motion import FreeMotions
from rotordyn.equation.mesh import ELEMENTS_OVER_LENGTH
from rotordyn.machine.spindle import Spindle
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene

ROOT = Path(__file__).resolve().parents[2]
CASES = ROOT / "cases"
RPM = math.pi / 30.0
TOP = 24000.0 * RPM


@cache
def case(name: str = "mfw2310") -> Case:
    """A case of the project, by name; of the flagship with the VEX 60 its rotor was fitted with.

    Published and independent values are of that bearing; the maker's is that of the case itself.
    """
    found = load(CASES / f"{name}.yaml")
    return as_fitted(found) if name.startswith("mfw2310") else found


def as_fitted(found: Case) -> Case:
    """The flagship with its rear bearings as they were when its rotor was fitted."""
    fitted = model("bearings", "vex60_fitted")
    rear = {
        f"spindle.bearings.{name}.model.{key}": getattr(fitted, key)
        for name in "de"
        for key in ("ball_diameter", "balls")
    }
    variants = {name: variant.vary(rear) for name, variant in found.variants.items()}
    return replace(found.vary(rear), variants=variants)


def mfw2310(**changes: Any) -> Spindle:
    """The flagship with its tool, some of its fields replaced."""
    return replace(case().spindle, **changes)


def conditions(**changes: Any) -> Conditions:
    """The flagship's: outer control, equal sharing."""
    return replace(case().conditions, **changes)


def undamped(spindle: Spindle) -> Spindle:
    """Neither bearings nor supports nor rotor damp."""
    seats = tuple(replace(s, radial_damping=0.0, axial_damping=0.0) for s in spindle.seats)
    supports = tuple(replace(s, damping={}) for s in spindle.supports)
    return replace(spindle, seats=seats, supports=supports, rotor_damping=())


def with_sleeve(spindle: Spindle, name: str, **changes: Any) -> Spindle:
    """One sleeve with some of its fields replaced."""
    sleeves = tuple(replace(s, **changes) if s.name == name else s for s in spindle.sleeves)
    return replace(spindle, sleeves=sleeves)


def with_springs(spindle: Spindle, stiffness: float) -> Spindle:
    """All preload springs with another stiffness [N/m], stops away."""
    sleeves = tuple(
        replace(s, spring=replace(s.spring, stiffness=stiffness), stop_travel=math.inf)
        for s in spindle.sleeves
    )
    return replace(spindle, sleeves=sleeves)


def standard(spindle: Spindle) -> dict[str, float]:
    """The condition that asks for standard elements of 1/50 of the shaft."""
    return {"element_length": (spindle.shaft.end - spindle.shaft.start) / ELEMENTS_OVER_LENGTH}


def scene(
    spindle: Spindle,
    rpm: Sequence[float],
    max_frequency: float = 4000.0,
    ports: tuple[float, ...] = (),
    **changes: Any,
) -> Scene:
    """A scene of ``spindle`` at speeds in rpm, in standard elements of 1/50 of the shaft.

    Its mesh then is that of the elements, so that they can be compared freedom by freedom.
    """
    if "accuracy" not in changes:
        changes = standard(spindle) | changes
    return Scene(spindle, conditions(**changes), np.array(rpm) * RPM, max_frequency, ports)


def poles(scene: Scene, row: int) -> NDArray[np.complex128]:
    """Those of all motions at a usable speed, one of each pair, Im ≥ 0 [rad/s]."""
    every = scene.with_motions(("bending", "axial", "torsion"))
    found = np.concatenate([scene.system(k).pole[row] for k in every])
    return found[np.isfinite(found)]


def joined_motions(scene: Scene) -> set[str]:
    """The motions that bending is coupled with, itself included; none where it is alone."""
    (k,) = scene.with_motions(("bending",))
    names = set(scene.name_of(k).split(" and "))
    return names if len(names) > 1 else set()


def system_of(found: Scene, motion: str = "bending") -> FreeMotions:
    """The first subsystem in which a motion takes part."""
    return found.system(found.with_motions((motion,))[0])


def all_poles(found: Scene, row: int = 0) -> np.ndarray:
    """Poles of Im ≥ 0 of all subsystems at one speed [rad/s]."""
    every = [found.system(k).pole[row] for k in range(len(found.subsystems))]
    return np.concatenate([pole[np.isfinite(pole)] for pole in every])


def answers(
    spindle: Spindle, rpm: Sequence[float], analyses: Mapping[str, Spec], **changes: Any
) -> dict[str, Any]:
    """Results by name at speeds in rpm."""
    speeds = tuple(float(n) * RPM for n in rpm)
    found = solve_spindle(spindle, conditions(**changes), speeds, analyses, lambda name: None)
    return found.results


def pairs(*names: str) -> tuple[tuple[Port, Port], ...]:
    """Pairs of ports written ``"Oc2.z/Oc2.y"``, response first."""
    ends = [[Port(*port.split(".")) for port in name.split("/")] for name in names]
    return tuple((response, excitation) for response, excitation in ends)
