"""What several questions share, computed once and only when one of them asks.

A scene belongs to one case. Each stage is solved on first use and timed; stages nobody asked for
never run, and ``skipped`` says which.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.analysis.buckling import Loading
from rotordyn.analysis.display import RPM
from rotordyn.analysis.exact_bending import ExactBending, exact_bending
from rotordyn.analysis.formulation import ROTATING, SOFTENED, told
from rotordyn.analysis.shaft import EXACT
from rotordyn.analysis.specs import Conditions
from rotordyn.analysis.stability import instability
from rotordyn.analysis.stage import Staged, stage
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.machine.inertia import rotor_inertia
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import coupled_motions
from rotordyn.numerics.modes import Modes, modes, residual
from rotordyn.preload.axial_force import AxialForce, axial_force
from rotordyn.preload.growth import released_fits
from rotordyn.preload.network import Law
from rotordyn.preload.state import PreloadState, dynamic_preload
from rotordyn.system.coupled import CoupledSystem, coupled_system
from rotordyn.system.lateral import LateralSystem, lateral_system
from rotordyn.system.lateral_rotor import LateralRotor, lateral_rotor
from rotordyn.system.longitudinal import RodSystem, axial_system, torsion_system
from rotordyn.system.mesh import Mesh, build_mesh

Array = NDArray[np.float64]
GRAVITY = 9.80665  # m/s²


class Scene(Staged):
    """A machine under given conditions at given speeds [rad/s], ascending.

    ``max_frequency`` [Hz]: highest frequency any question asks for; ``ports``: stations [m] where
    forces act or responses are read besides the bearings.
    """

    def __init__(
        self,
        spindle: Spindle,
        conditions: Conditions,
        speed: Array,
        max_frequency: float = 4000.0,
        ports: tuple[float, ...] = (),
    ) -> None:
        super().__init__()
        self.spindle = spindle
        self.conditions = conditions
        self.speed = speed
        self.max_frequency = max_frequency
        self.ports = ports

    @property
    def tolerances(self) -> dict[str, float]:
        """Residuals reached by the stages that were solved."""
        reached = {}
        if "preload" in self.solved:
            state = self.preload
            reached["preload: unbalanced axial force over largest force"] = float(
                np.nanmax(state.net.error[state.usable], initial=0.0)
            )
        for motion in ("bending", "coupled"):
            if f"{motion}_modes" in self.solved:
                found: Modes = self.solved[f"{motion}_modes"]
                reached[f"{motion} modes: residual of the eigenpairs"] = residual(
                    found, found.stiffness, found.damping
                )
        return reached

    @property
    def warnings(self) -> tuple[str, ...]:
        """What a designer should know about the model and about the machine at these speeds."""
        found = [value for value in self.solved.values() if isinstance(value, Modes)]
        fits = (
            f"bearing {name}: the fit of its inner ring lets go at "
            f"{speed * RPM.factor:.0f} rpm; raise its interference"
            for name, speed in released_fits(self.spindle, float(self.bearing_speed.max()))
        )
        grown = instability(found, self.speed[self.usable]) if found else ()
        return (*told(self.conditions.formulation), *fits, *grown)

    @property
    def law(self) -> Law:
        """Hypotheses of the ball model."""
        return Law(self.conditions.kinematics, self.conditions.moment_sharing)

    @property
    def rigid(self) -> bool:
        """True where the rotor does not bend."""
        return self.conditions.rotor == "rigid"

    @property
    def bearing_speed(self) -> Array:
        """Speeds at which bearings are solved: only rest where their state at rest serves all."""
        return np.zeros(1) if self.conditions.bearings == "static" else self.speed

    @property
    def bearing_row(self) -> NDArray[np.intp]:
        """For every speed of the case, its row among ``bearing_speed``."""
        if self.conditions.bearings == "static":
            return np.zeros(len(self.speed), dtype=np.intp)
        return np.arange(len(self.speed))

    @property
    def gravity(self) -> float:
        """Acceleration of gravity along the axis, towards +x [m/s²]."""
        return {"": 0.0, "+x": GRAVITY, "-x": -GRAVITY}[self.conditions.gravity]

    @property
    def axial_force(self) -> float:
        """External force and weight along the axis [N]."""
        return self.conditions.axial_force + self.gravity * rotor_inertia(self.spindle).mass

    @property
    def outcome(self) -> tuple[str, ...]:
        """Per speed: empty, or why it has no physical solution."""
        words: tuple[str, ...] = ("",) * len(self.bearing_speed)
        if self.spindle.seats:
            words = self.preload.outcome
        words = tuple(word or more for word, more in zip(words, self.buckling, strict=True))
        return tuple(words[row] for row in self.bearing_row)

    def require_solution(self) -> None:
        """Go on only where some speed has a solution.

        Raises
        ------
        NoSolution : none has
        """
        if all(self.outcome):
            raise NoSolution(f"no speed of the case has a physical solution: {self.outcome[0]}")

    @property
    def usable(self) -> NDArray[np.intp]:
        """Rows of the speeds with a solution; NoSolution where there is none."""
        self.require_solution()
        return np.flatnonzero([word == "" for word in self.outcome])

    def scattered(self, values: NDArray[Any]) -> NDArray[Any]:
        """Values at the usable speeds (first axis) over all speeds, NaN elsewhere."""
        if len(values) == len(self.speed):
            return values
        whole = np.full((len(self.speed), *values.shape[1:]), np.nan, dtype=values.dtype)
        whole[self.usable] = values
        return whole

    @stage
    def mesh(self) -> Mesh:
        """Nodes and elements of the shaft."""
        return build_mesh(self.spindle, self.conditions.element_length)

    @stage
    def preload(self) -> PreloadState:
        """Dynamic preload state at ``bearing_speed``."""
        return dynamic_preload(self.spindle, self.bearing_speed, self.law, self.axial_force)

    @stage
    def shaft_force(self) -> AxialForce:
        """Axial force in the shaft at ``bearing_speed``."""
        return self._along(self._seat_load)

    @stage
    def buckling(self) -> tuple[str, ...]:
        """Per speed of ``bearing_speed``: empty, or that the shaft buckles."""
        seats = self.spindle.seats
        tangents = self.preload.seat_stiffness() if seats else _no_seats(self.bearing_speed, 5, 5)
        return self.buckled(self._seat_load, tangents, self.bearing_speed)

    def buckled(self, seat_load: Array, seat_stiffness: Array, speed: Array) -> tuple[str, ...]:
        """Per state with other loads (states, seats) and tangents of the bearings: as above."""
        if not self.conditions.axial_stiffening:
            return ("",) * len(speed)
        loading = Loading(
            self.spindle,
            lambda: self.mesh,
            seat_load,
            seat_stiffness,
            self.conditions.axial_force,
            self.gravity,
            self.rigid,
        )
        return loading.outcomes(speed)

    def bending_force(self, seat_load: Array | None = None) -> Array | None:
        """Axial force that acts on bending (states, elements) [N]; None where it shall not.

        At ``bearing_speed``, or under other axial loads of the bearings (states, seats).
        """
        if not self.conditions.axial_stiffening:
            return None
        along = self.shaft_force if seat_load is None else self._along(seat_load)
        return along.bending(self.mesh.middle)

    def _along(self, seat_load: Array) -> AxialForce:
        return axial_force(self.spindle, seat_load, self.conditions.axial_force, self.gravity)

    @property
    def _seat_load(self) -> Array:
        return self.preload.seat_load() if self.spindle.seats else _no_seats(self.bearing_speed)

    @stage
    def rotor(self) -> LateralRotor:
        """The rotor's bending in a few coordinates."""
        ports = tuple(self.mesh.node_of(x) for x in self.ports)
        return lateral_rotor(self.spindle, self.mesh, self.max_frequency, ports, rigid=self.rigid)

    @stage
    def tangents(self) -> Array:
        """Bearing tangents in their own frames at ``bearing_speed`` (…, seats, 5, 5)."""
        return self.preload.seat_stiffness(self.conditions.tangent)

    @property
    def seat_stiffness(self) -> Array:
        """Bearing tangents in their own frames at the usable speeds (usable, seats, 5, 5)."""
        if not self.spindle.seats:
            return _no_seats(self.speed, 5, 5)
        return self.tangents[self.bearing_row[self.usable]]

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
        return modes(self.bending.stiffness, self.bending.damping)

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
        """Axial motion of shaft and sleeves."""
        stops = np.zeros((len(self.usable), len(self.spindle.sleeves)), dtype=bool)
        if self.spindle.seats:
            stops = self.preload.net.held[self.bearing_row[self.usable], 1:]
        return axial_system(
            self.spindle,
            self.mesh,
            self.max_frequency,
            tuple(self.mesh.node_of(x) for x in self.ports),
            self.seat_stiffness[..., 0, 0],
            stops,
            rigid=self.rigid,
        )

    @stage
    def axial_modes(self) -> Modes:
        """All eigenvalues of the axial system."""
        return modes(self.axial.stiffness, self.axial.damping)

    @stage
    def torsion(self) -> RodSystem:
        """Torsion of the shaft."""
        return torsion_system(
            self.spindle,
            self.mesh,
            self.max_frequency,
            tuple(self.mesh.node_of(x) for x in self.ports),
            1,
            rigid=self.rigid,
        )

    @stage
    def torsion_modes(self) -> Modes:
        """All eigenvalues of the torsion system, the same at every speed."""
        return modes(self.torsion.stiffness, self.torsion.damping)

    @property
    def coupled_motions(self) -> frozenset[str]:
        """Those of bending, axial motion and torsion that supports couple to another one."""
        return coupled_motions(self.spindle.supports)

    @stage
    def coupled(self) -> CoupledSystem:
        """The motions that supports couple, in one system.

        Raises
        ------
        InvalidInput : bending is among them and written in the turning frame
        """
        if self.conditions.formulation == ROTATING and "bending" in self.coupled_motions:
            raise InvalidInput(
                "the rotating formulation cannot describe supports that couple bending with "
                "another motion: use the inertial one"
            )
        own: dict[str, Callable[[], LateralSystem | RodSystem]] = {
            "bending": lambda: self.bending.in_planes,
            "axial": lambda: self.axial,
            "torsion": lambda: self.torsion,
        }
        parts = {name: part() for name, part in own.items() if name in self.coupled_motions}
        return coupled_system(self.spindle, self.mesh, parts)

    @stage
    def coupled_modes(self) -> Modes:
        """All eigenvalues of the coupled system."""
        return modes(self.coupled.stiffness, self.coupled.damping)

    def vibration(self, motion: str) -> tuple[LateralSystem | RodSystem | CoupledSystem, Modes]:
        """The system that ``motion`` is part of, and its modes."""
        name = "coupled" if motion in self.coupled_motions else motion
        return getattr(self, name), getattr(self, f"{name}_modes")


def _no_seats(speed: Array, *rest: int) -> Array:
    """Values of no bearing at every speed (speeds, 0, …)."""
    return np.zeros((len(speed), 0, *rest))
