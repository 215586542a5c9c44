"""What several questions share, computed once and only when one of them asks.

A scene belongs to one case. Each stage is solved on first use and timed; stages nobody asked for
never run, and ``skipped`` says which.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from rotordyn.analysis.display import RPM
from rotordyn.analysis.exact_bending import ExactBending, exact_bending
from rotordyn.analysis.formulation import ROTATING, SOFTENED, told
from rotordyn.analysis.hysteretic import Hysteretic
from rotordyn.analysis.shaft import EXACT
from rotordyn.analysis.specs import Conditions
from rotordyn.analysis.stability import instability
from rotordyn.analysis.stage import stage
from rotordyn.analysis.statics import Statics
from rotordyn.errors import InvalidInput
from rotordyn.machine.housing import housed_motions
from rotordyn.machine.rotor import Place
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import Sleeve, Spring, coupled_motions
from rotordyn.numerics.modes import Modes, modes, residual
from rotordyn.preload.growth import released_fits
from rotordyn.system.coupled import CoupledSystem, coupled_system
from rotordyn.system.fineness import Fineness
from rotordyn.system.hysteresis import Signs
from rotordyn.system.lateral import LateralSystem, lateral_system
from rotordyn.system.lateral_rotor import LateralRotor, lateral_rotor
from rotordyn.system.longitudinal import RodSystem, axial_system, torsion_system

Array = NDArray[np.float64]
ANY_SPRING = Spring(preload=1.0, stiffness=1.0)
System = LateralSystem | RodSystem | CoupledSystem


class Scene(Statics):
    """A machine under given conditions at given speeds [rad/s], ascending, with its vibrations.

    ``max_frequency`` [Hz]: highest frequency any question asks for; ``ports``: places, or stations
    [m] on the shaft, where forces act or responses are read besides the bearings. ``taken``: stages
    solved by another.
    """

    def __init__(
        self,
        spindle: Spindle,
        conditions: Conditions,
        speed: Array,
        max_frequency: float = 4000.0,
        ports: tuple[float | Place, ...] = (),
    ) -> None:
        super().__init__(spindle, conditions, speed)
        self.max_frequency = max_frequency
        self.ports = ports
        self.taken: set[str] = set()
        self._hysteretic: dict[str, Hysteretic] = {}
        self._nodes: dict[str | float | Place, int] = {}

    def beyond(self, factor: float) -> Scene:
        """The same machine with as many more vibrations as ``factor`` times the band would ask."""
        more = Scene(
            self.spindle, self.conditions, self.speed, factor * self.max_frequency, self.ports
        )
        still = {name for kind in Statics.__mro__ for name in vars(kind)}
        more.solved.update({n: value for n, value in self.solved.items() if n in still})
        return more

    def seen_from(self, ports: tuple[Place, ...]) -> Scene:
        """The same machine, its motion meant to be good at fewer places; this one if it is known
        already."""
        if "rotor" in self.solved:
            return self
        own = Scene(self.spindle, self.conditions, self.speed, self.max_frequency, ports)
        own.solved.update(self.solved)
        return own

    def adopt(self, other: Scene) -> None:
        """Take over what another scene has solved from the same inputs."""
        for name, inputs in _INPUTS.items():
            if name in other.solved and name not in self.solved and inputs(self) == inputs(other):
                self.solved[name] = other.solved[name]
                self.taken.add(name)

    def at(self, speed: Array) -> Scene:
        """The same machine and coordinates at other speeds [rad/s], ascending."""
        other = Scene(self.spindle, self.conditions, speed, self.max_frequency, self.ports)
        same = ("mesh", "rotor", "torsion", "torsion_modes")
        other.solved.update({name: self.solved[name] for name in same if name in self.solved})
        return other

    @property
    def tolerances(self) -> dict[str, float]:
        """Residuals reached: of the axial balance, and of the eigenpairs of bending."""
        reached = {}
        if "preload" in self.solved:
            state = self.preload
            reached["preload: unbalanced axial force over largest force"] = float(
                np.nanmax(state.net.error[state.usable], initial=0.0)
            )
        for motion in ("bending", "coupled"):
            if f"{motion}_modes" in self.solved:
                found: Modes = self.solved[f"{motion}_modes"]
                lossy = self._hysteretic.get(motion)
                reached[f"{motion} modes: residual of the eigenpairs"] = (
                    lossy.residual if lossy else residual(found, found.stiffness, found.damping)
                )
        return reached

    @property
    def notes(self) -> tuple[str, ...]:
        """What was chosen that changes how the results read."""
        return told(self.conditions.formulation)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What a designer should know about the machine at these speeds."""
        found = [value for value in self.solved.values() if isinstance(value, Modes)]
        fits = (
            f"bearing {name}: the fit of its inner ring lets go at "
            f"{speed * RPM.factor:.0f} rpm; raise its interference"
            for name, speed in released_fits(self.spindle, float(self.bearing_speed.max()))
        )
        grown = instability(found, self.speed[self.usable]) if found else ()
        pressed = self.preload.small_shims() if "preload" in self.solved else ()
        return (*fits, *pressed, *grown)

    @property
    def fineness(self) -> Fineness:
        """What is asked of the elements; standard ones where their length is given."""
        given = self.conditions.element_length is not None
        accuracy = None if given else self.conditions.accuracy
        return Fineness(self.max_frequency, float(np.abs(self.speed).max()), accuracy)

    @property
    def resolved_frequency(self) -> float:
        """Highest bending frequency that the elements carry within the accuracy [Hz]."""
        return math.inf if self.bends_exactly else self.rotor.resolved

    @property
    def _port_nodes(self) -> tuple[int, ...]:
        return tuple(self.node(at) for at in self.ports)

    def node(self, at: str | float | Place) -> int:
        """The node of a named point, of a station on the shaft or of a place, among those of all
        rotors."""
        if at not in self._nodes:
            self._nodes[at] = self.mesh.node_at(*self.spindle.place(at))
        return self._nodes[at]

    @stage
    def rotor(self) -> LateralRotor:
        """The rotor's bending in a few coordinates."""
        ports = self._port_nodes
        return lateral_rotor(self.spindle, self.mesh, self.fineness, ports, rigid=self.rigid)

    @stage
    def bending(self) -> LateralSystem:
        """Rotor on its supports at the usable speeds."""
        force = self.bending_force()
        return lateral_system(
            self.spindle,
            self.rotor,
            self.speed[self.usable],
            self.seat_stiffness,
            None if force is None else force[self.bearing_row[self.usable]],
            softened=self.conditions.formulation == SOFTENED,
            turning=self.conditions.formulation == ROTATING,
        )

    @stage
    def bending_modes(self) -> Modes:
        """All eigenvalues of the bending system."""
        return self._free_motions("bending", self.bending)

    @stage
    def exact(self) -> ExactBending:
        """The shaft without elements at the usable speeds."""
        return exact_bending(self)

    @property
    def bends_exactly(self) -> bool:
        """True where modes and receptances of bending are those of the exact shaft."""
        return self.conditions.shaft == EXACT

    @stage
    def axial(self) -> RodSystem:
        """Axial motion of shaft and sleeves: without bearings the same at every speed."""
        stops = np.zeros((1, len(self.spindle.sleeves)), dtype=bool)
        if self.spindle.seats:
            stops = self.preload.net.held[self.bearing_row[self.usable], 1:]
        return axial_system(
            self.spindle,
            self.mesh,
            self.fineness,
            self._port_nodes,
            self.seat_stiffness[: len(stops), :, 0, 0],
            stops,
            rigid=self.rigid,
        )

    @stage
    def axial_modes(self) -> Modes:
        """All eigenvalues of the axial system."""
        return self._free_motions("axial", self.axial)

    @stage
    def torsion(self) -> RodSystem:
        """Torsion of the shaft."""
        return torsion_system(
            self.spindle,
            self.mesh,
            self.fineness,
            self._port_nodes,
            1,
            rigid=self.rigid,
        )

    @stage
    def torsion_modes(self) -> Modes:
        """All eigenvalues of the torsion system, the same at every speed."""
        return self._free_motions("torsion", self.torsion)

    @cached_property
    def coupled_motions(self) -> frozenset[str]:
        """Those of bending, axial motion and torsion that supports or housings couple."""
        return coupled_motions(self.spindle.supports) | housed_motions(self.spindle.housings)

    @stage
    def coupled(self) -> CoupledSystem:
        """The motions that supports or housings couple, in one system.

        Raises
        ------
        InvalidInput : bending is among them and written in the turning frame
        """
        if self.conditions.formulation == ROTATING and "bending" in self.coupled_motions:
            raise InvalidInput(
                "the rotating formulation cannot describe supports that couple bending with "
                "another motion, nor housings: use the inertial one"
            )
        own: dict[str, Callable[[], LateralSystem | RodSystem]] = {
            "bending": lambda: self.bending.in_planes,
            "axial": lambda: self.axial,
            "torsion": lambda: self.torsion,
        }
        parts = {name: part() for name, part in own.items() if name in self.coupled_motions}
        speed = self.speed[self.usable]
        return coupled_system(self.spindle, self.mesh, parts, self.seat_stiffness, speed)

    @stage
    def coupled_modes(self) -> Modes:
        """All eigenvalues of the coupled system."""
        return self._free_motions("coupled", self.coupled)

    def vibration(self, motion: str) -> tuple[System, Modes]:
        """The system that ``motion`` is part of, and its modes."""
        name = self._name(motion)
        return getattr(self, name), getattr(self, f"{name}_modes")

    def answering(self, motion: str, signs: Signs) -> tuple[System, Modes]:
        """The same for motions of some signs, where loss factors depend on these."""
        lossy = self.hysteretic(motion)
        return lossy.answering(signs) if lossy else self.vibration(motion)

    def receptance(
        self, motion: str, omega: Array, responses: Array, excitations: Array
    ) -> NDArray[np.complex128]:
        """Receptance at i·``omega`` (f,) of paired rows (pairs, n) of the system that ``motion`` is
        part of: (speeds or 1, pairs, f)."""
        found = self.hysteretic(motion) or self.vibration(motion)[1]
        return found.receptance(omega, responses, excitations)

    def hysteretic(self, motion: str) -> Hysteretic | None:
        """The system that ``motion`` is part of, by signs; None without loss factors."""
        return self._by_signs(self._name(motion))

    def _by_signs(self, name: str) -> Hysteretic | None:
        system: System = getattr(self, name)
        if system.hysteresis is None:
            return None
        if name not in self._hysteretic:
            turning = not isinstance(system, RodSystem)
            speed = self.speed[self.usable] if turning else np.zeros(len(system.stiffness))
            self._hysteretic[name] = Hysteretic(system, system.hysteresis, speed)
        return self._hysteretic[name]

    def _name(self, motion: str) -> str:
        return "coupled" if motion in self.coupled_motions else motion

    def _free_motions(self, name: str, system: System) -> Modes:
        """Modes of a system; with loss factors, each with those of its own frequency."""
        lossy = self._by_signs(name)
        return lossy.free_motions() if lossy else modes(system.stiffness, system.damping)


def _elements(scene: Scene) -> tuple[object, ...]:
    """Everything that the free rotor in its coordinates follows from; its springs are no part."""
    body = replace(scene.spindle, sleeves=tuple(_unsprung(s) for s in scene.spindle.sleeves))
    asked = (scene.conditions.element_length, scene.fineness, scene.ports, scene.rigid)
    return (replace(body, title="", note="", references=()), *asked)


def _unsprung(sleeve: Sleeve) -> Sleeve:
    return replace(sleeve, spring=ANY_SPRING, stop_travel=math.inf)


def _axial_balance(scene: Scene) -> tuple[object, ...]:
    """Everything that the preload state follows from."""
    speeds = tuple(scene.bearing_speed.tolist())
    return (scene.spindle, scene.law, scene.axial_force, speeds)


_INPUTS: dict[str, Callable[[Scene], tuple[object, ...]]] = {
    "mesh": _elements,
    "preload": _axial_balance,
    "rotor": _elements,
    "torsion": _elements,
    "torsion_modes": _elements,
}
