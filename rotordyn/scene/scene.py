"""A machine under given conditions at given speeds, with what its analyses share.

Every stage is a pure function of the machine, solved on first use and kept in one memo by what it
depends on; nothing else writes into it.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from functools import cached_property, partial
from typing import Any, cast

import numpy as np

from rotordyn.allowance import require_matrices
from rotordyn.arrays import Array, Flags, Indices
from rotordyn.equation.assemble import assemble, subsystems
from rotordyn.equation.component import Component
from rotordyn.equation.dofs import position
from rotordyn.equation.fineness import Fineness
from rotordyn.equation.free_motion import FreeMotions, free_motions, without_poles
from rotordyn.equation.linear import Linear, name_of
from rotordyn.equation.seat import in_spindle_frame
from rotordyn.equation.statics import stands
from rotordyn.equation.structure import Structure
from rotordyn.equation.term import State
from rotordyn.errors import NoSolution
from rotordyn.machine.rotor import Place
from rotordyn.machine.spindle import Spindle
from rotordyn.results.display import RPM
from rotordyn.scene.checks import Checks
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.formulation import ROTATING, SOFTENED, frame_notes
from rotordyn.scene.stage import Clock, Memo, stage, stage_of
from rotordyn.scene.statics import Statics
from rotordyn.scene.warnings import (
    arc_notes,
    friction_notes,
    joint_notes,
    machine_warnings,
    ring_notes,
)

MEETING = 1e-6  # rad/s, of the speed at which a stop is met
BESIDE = 1e-3  # rad/s below it the stop is open
BEYOND = 2.0  # of the highest frequency: modes above it are followed a little farther


class Scene(Statics):
    """A machine at given speeds [rad/s], ascending, with its vibrations.

    ``max_frequency`` [Hz]: highest frequency any analysis asks for; ``ports``: places, or stations
    [m] on the shaft, where forces act or responses are read besides the bearings. ``finer``: steps
    by which elements and reduction are finer than the accuracy requires. ``checks``: whether errors
    are estimated with a finer model.
    ``top_speed`` [rad/s]: speed up to which elements are sized; ``coarse``: the model of lower
    degree, in a refined one.
    """

    def __init__(
        self,
        spindle: Spindle,
        conditions: Conditions,
        speed: Array,
        max_frequency: float = 4000.0,
        ports: tuple[float | Place, ...] = (),
        finer: int = 0,
        memo: Memo | None = None,
        clock: Clock | None = None,
        checks: Checks | None = None,
    ) -> None:
        super().__init__(spindle, conditions, speed, memo, clock)
        self.checks = checks or Checks()
        self.max_frequency, self.ports, self.finer = max_frequency, ports, finer
        self.top_speed = float(np.abs(speed).max(initial=0.0))
        self.case_speeds, self.whirl = len(speed), 1.0
        self.coarse: Structure | None = None
        self.systems: dict[int, FreeMotions] = {}
        self._at_rows: dict[tuple[int, bytes], FreeMotions] = {}

    def at(self, speed: Array) -> Scene:
        """Return the same machine and coordinates at other speeds [rad/s], ascending."""
        return self._like(speed, self.finer)

    def whirling(self, multiple: float) -> Scene:
        """Return the same machine with squeeze films whose journals whirl at a ``multiple`` of the
        speed of the spindle."""
        if multiple == self.whirl or not any(film.stiff for film in self.spindle.dampers):
            return self
        other = self.at(self.speed)
        other.whirl = multiple
        return other

    def under(self, conditions: Conditions) -> Scene:
        """Return the same machine at the same speeds under other conditions."""
        same = (self.speed, self.max_frequency, self.ports, self.finer)
        other = Scene(self.spindle, conditions, *same, self.memo, self.clock, self.checks)
        other.top_speed = self.top_speed
        return other

    @cached_property
    def refined(self) -> Scene:
        """This machine with a finer model.

        Raises
        ------
        NoSolution : one of both models has a state at a speed where the other has none
        """
        finer = self._like(self.speed, self.finer + 1)
        finer.coarse = None if self.conditions.element_length is not None else self.rotor
        for speed, coarse, fine in zip(self.speed, self.outcome, finer.outcome, strict=True):
            if bool(coarse) != bool(fine):
                raise NoSolution(
                    f"whether the machine has a state at {speed * RPM.factor:.6g} rpm depends on "
                    f"the refinement of its model ({coarse or fine}): leave that speed out, or "
                    "support the machine more stiffly"
                )
        return finer

    def _like(self, speed: Array, finer: int) -> Scene:
        same = (self.spindle, self.conditions, speed, self.max_frequency, self.ports)
        other = Scene(*same, finer, self.memo, self.clock, self.checks)
        # a model serves other speeds, but is as fine as the highest speed of the case requires
        other.top_speed, other.bodies = self.top_speed, self.bodies
        other.coarse, other.case_speeds = self.coarse, self.case_speeds
        other.whirl = self.whirl
        return other

    @property
    def fineness(self) -> Fineness:
        """Required fineness of elements and reduction; standard elements where a length is given.

        A rotating frame observes whirl of frequency ω + Ω at the frequency ω.
        """
        fixed_length = self.conditions.element_length is not None
        accuracy = None if fixed_length else self.conditions.accuracy
        turning = self.top_speed if self.conditions.formulation == ROTATING else 0.0
        highest = self.max_frequency + turning / (2.0 * math.pi)
        return Fineness(highest, self.top_speed, accuracy, self.finer)

    @property
    def tolerances(self) -> dict[str, float]:
        """Residuals reached: of the axial balance, and of the eigenpairs."""
        reached = {}
        if "preload" in self.solved:
            state = self.preload
            reached["preload: unbalanced axial force over largest force"] = float(
                np.nanmax(state.net.error[state.usable], initial=0.0)
            )
        for k, motions in self.systems.items():
            if "bending" in motions.linear.kinds:
                name = self.name_of(k)
                reached[f"{name} modes: residual of the eigenpairs"] = motions.residual
        return reached

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes on choices of the case without which results are misread."""
        flow = self.conditions.heat_flow
        frame = frame_notes(self.conditions.formulation)
        flows = () if flow is None else (flow.note,)
        joints = joint_notes(self.spindle, rigid=self.rigid)
        return (*frame, *joints, *friction_notes(self), *ring_notes(self), *arc_notes(self), *flows)

    @property
    def warnings(self) -> tuple[str, ...]:
        """Warnings about the machine at these speeds."""
        return tuple(machine_warnings(self))

    @stage_of(
        lambda self: (
            self.bodies,
            self.conditions.element_length,
            self.fineness,
            self.ports,
            self.rigid,
            self._pressed,
            self._softened,
            self.loaded and self.conditions.loads,
        ),
        lambda self, shared: shared.on_springs_of(self.spindle),
    )
    def rotor(self) -> Structure:
        """Terms of the machine and its components, each reduced on first use."""
        acting = [load.at for load in self.conditions.loads] if self.loaded else []
        places = [self.spindle.place(at) for at in (*self.ports, *acting)]
        return Structure(
            self.spindle,
            self.mesh,
            self.fineness,
            places,
            rigid=self.rigid,
            pressed=self._pressed,
            softened=self._softened,
            coarse=self.coarse,
        )

    @property
    def _pressed(self) -> bool:
        conditions = self.conditions
        return conditions.axial_stiffening and bool(conditions.tension or conditions.axial_force)

    @property
    def _softened(self) -> bool:
        return self.conditions.formulation == SOFTENED

    @cached_property
    def stop_speeds(self) -> Array:
        """Lowest speed at which each sleeve rests on its stop (sleeves,) [rad/s], NaN where none
        does. The stop closes there on the run-up, or opens on the run-down."""
        balanced = self.conditions.heat_flow or self.conditions.films
        if not (self.loaded or balanced or self.preload.rubs.any()):
            return self.preload.stop_speeds()
        stopped = self.preload.stopped
        return np.array([self._stop_speed(k, stopped[:, k]) for k in range(stopped.shape[1])])

    def _stop_speed(self, sleeve: int, stopped: Flags) -> float:
        """Solve for the lowest speed of a sleeve on its stop, NaN where none, under loads across
        the axis, friction, films or temperatures that follow from the state."""
        from scipy.optimize import brentq

        first = np.flatnonzero(stopped)
        if not first.size:
            return math.nan
        gaps = self.preload.stop_gaps()[:, sleeve]
        high = float(self.bearing_speed[first[0]])
        low = float(self.bearing_speed[first[0] - 1]) if first[0] else 0.0
        gap_at = {high: float(gaps[first[0]])}
        if first[0]:
            gap_at[low] = float(gaps[first[0] - 1])

        def gap(speed: float) -> float:
            if speed in gap_at:
                return gap_at[speed]
            return float(self.at(np.array([speed])).preload.stop_gaps()[0, sleeve])

        if low >= high or gap(low) <= 0.0:
            return low
        while True:
            root = cast(float, brentq(gap, low, high, xtol=MEETING))
            # on the way back the gap touches zero before it opens: where friction takes over
            if root - BESIDE <= low or gap(root - BESIDE) > 0.0:
                return root
            high = root - BESIDE

    @property
    def _lateral_inputs(self) -> tuple[Any, ...]:
        return self.conditions, self.fineness, self.ports

    @cached_property
    def state(self) -> State:
        """Speeds, tangents and blocked sleeves at the usable speeds: sleeves at stops, and those
        that dry friction holds against infinitesimal motions."""
        rubbing = np.array([sleeve.friction > 0.0 for sleeve in self.spindle.sleeves], dtype=bool)
        tangents = in_spindle_frame(self.spindle.seats, self.seat_stiffness)
        stops = self.stopped | rubbing
        return State(self.speed[self.usable], tangents, stops, whirl=self.whirl)

    @property
    def stopped(self) -> Flags:
        """Sleeves at their stops at the usable speeds (usable, sleeves)."""
        if not self.spindle.seats:
            return np.zeros((len(self.usable), len(self.spindle.sleeves)), dtype=bool)
        return self.preload.stopped[self.bearing_row[self.usable]]

    @cached_property
    def force(self) -> Array | None:
        """Axial force that acts on bending at the usable speeds (usable, elements) [N]."""
        force = self.bending_force()
        return None if force is None else force[self.bearing_row[self.usable]]

    @cached_property
    def statically_unstable(self) -> Flags:
        """Usable speeds (usable,) at which negative stiffness of supports makes the static
        equilibrium unstable."""
        if not any(support.has_negative_stiffness for support in self.spindle.supports):
            return np.zeros(len(self.usable), dtype=bool)
        return ~stands(self.rotor, self.state._replace(standing=True), self.force)

    @stage
    def subsystems(self) -> list[tuple[Component, ...]]:
        """Groups of coupled components."""
        drawbar = self.conditions.axial_stiffening
        return subsystems(self.rotor, self.state, drawbar=drawbar)

    def linear(self, k: int, rows: Indices | None = None) -> Linear:
        """Return the equation of motion of a subsystem at the usable speeds, or at some ``rows`` of
        them."""
        chosen: Any = slice(None) if rows is None else rows
        speed, tangents, stops = (values[chosen] for values in self.state[:3])
        state = self.state._replace(speed=speed, tangents=tangents, stops=stops)
        force = None if self.force is None else self.force[chosen]
        parts, softened = self.subsystems[k], self._softened
        size = sum(component.size for component in parts)
        require_matrices(f"{self.name_of(k)} system", len(state.speed), size, self.case_speeds)
        solve = partial(assemble, self.rotor, parts, state, force, softened=softened)
        return self.timed(f"{self.name_of(k)} system", solve)

    def system(self, k: int) -> FreeMotions:
        """Return a subsystem with its modes of free vibration, solved once."""
        if k not in self.systems:
            self.systems[k] = self.system_at(k)
        return self.systems[k]

    def system_at(self, k: int, rows: Indices | None = None, *, few: bool = False) -> FreeMotions:
        """Return a subsystem with its modes of free vibration at some ``rows`` of the usable
        speeds; ``few``: for receptances at few frequencies, which do not always need modes."""
        if k in self.systems and rows is not None:
            return self.systems[k].at(rows)
        all_rows = rows is None or len(rows) == len(self.usable)
        key = k, b"" if all_rows or rows is None else rows.tobytes()
        if key not in self._at_rows:
            linear, name = self.linear(k, rows), f"{self.name_of(k)} modes"
            if few and (motions := self.timed(name, partial(without_poles, linear))):
                return motions
            solve = partial(free_motions, linear, self._ceiling)
            self._at_rows[key] = self.timed(name, solve)
        return self._at_rows[key]

    @property
    def _ceiling(self) -> float:
        """Largest |λ| [rad/s] of modes with hysteretic loss: all modes shown, and all whirl that
        the loss of a faster shaft drives."""
        return BEYOND * max(self.fineness.band, float(np.abs(self.speed).max(initial=0.0)))

    def name_of(self, k: int) -> str:
        """Return the motions of a subsystem: "bending", "bending and axial" …."""
        return name_of(self.subsystems[k])

    def with_motions(self, motions: Iterable[str]) -> list[int]:
        """Return the subsystems in which any of "bending", "axial" and "torsion" takes part."""
        wanted = set(motions)
        return [
            k
            for k, parts in enumerate(self.subsystems)
            if wanted & {line.kind for component in parts for line in component.lines}
        ]

    def owner(self, at: str | float | Place, direction: str) -> int:
        """Return the subsystem in which a point moves in a direction."""
        rotor, x = self.spindle.place(at)
        component = self.rotor.owner[self.rotor.node(rotor, x)[position(direction)]]
        return self._subsystem_of[int(component)]

    @cached_property
    def _subsystem_of(self) -> dict[int, int]:
        """Subsystem of every component, by the index of the component."""
        components = self.rotor.components
        return {components.index(c): k for k, parts in enumerate(self.subsystems) for c in parts}
