"""The static state of the machine at every speed, and which speeds have a solution."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from bearings.ball.law import Law
from rotordyn.arrays import Array, Flags, Indices
from rotordyn.description import unchecked
from rotordyn.equation.mesh import Mesh, build_mesh
from rotordyn.errors import NoSolution
from rotordyn.machine.history import Past
from rotordyn.machine.inertia import rotor_inertia
from rotordyn.machine.sleeve import Sleeve, Spring
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.temperatures import Temperatures
from rotordyn.preload.axial_force import AxialForce, PointForces, axial_force
from rotordyn.preload.friction import operating_state, with_friction
from rotordyn.preload.passed_speeds import evenly_spaced
from rotordyn.preload.state import PreloadState
from rotordyn.preload.together import at_temperatures
from rotordyn.scene.across import across, with_stations
from rotordyn.scene.buckling import Loading
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.spec import acts_across
from rotordyn.scene.stage import Clock, Memo, Staged, stage, stage_of

if TYPE_CHECKING:
    from rotordyn.equation.statics import StaticRotor
    from rotordyn.preload.heat_balance import Flow, HeatBalance

ANY_SPRING, LOCKED = (Spring(preload=1.0, stiffness=k) for k in (1e6, math.inf))


class Statics(Staged):
    """A machine under given conditions at given speeds [rad/s], ascending, without vibration."""

    rotor: stage  # terms of the machine (``Scene``)

    def __init__(
        self,
        spindle: Spindle,
        conditions: Conditions,
        speed: Array,
        memo: Memo | None = None,
        clock: Clock | None = None,
    ) -> None:
        super().__init__(memo, clock)
        self.spindle = with_stations(spindle, (load.at for load in conditions.loads))
        self.conditions = conditions
        self.speed = speed

    @property
    def grounded(self) -> Spindle:
        """The spindle's shaft alone: its axial state does not depend on further rotors."""
        return self.spindle.grounded

    @property
    def law(self) -> Law:
        """Hypotheses of the ball model."""
        return self.conditions.law

    @property
    def rigid(self) -> bool:
        """True where the shaft does not bend, stretch or twist."""
        return self.conditions.rotor == "rigid"

    @property
    def bearing_speed(self) -> Array:
        """Speeds [rad/s] of solved bearing states; zero alone where the state at rest serves all.

        Zero is repeated for every speed where supports depend on the speed.
        """
        if self.conditions.bearings != "static":
            return self.speed
        follow = any(support.speeds for support in self.spindle.supports)
        return np.zeros_like(self.speed) if follow else np.zeros(1)

    @property
    def state_speed(self) -> Array:
        """Speed [rad/s] of every state at ``bearing_speed``; 0 where one serves all speeds."""
        return self.speed if len(self.bearing_speed) == len(self.speed) else np.zeros(1)

    @property
    def bearing_row(self) -> Indices:
        """For every speed of the case, its row among ``bearing_speed``."""
        rows = np.arange(len(self.speed))
        return rows if len(self.bearing_speed) == len(rows) else np.zeros_like(rows)

    @property
    def gravity(self) -> float:
        """Acceleration of gravity along the axis, towards +x [m/s²]."""
        return self.conditions.pull[0]

    @property
    def axial_force(self) -> float:
        """Total axial force on the shaft towards +x [N]: conditions, their loads, weight."""
        return self.conditions.total_axial_force + self.past.weight

    @property
    def past(self) -> Past:
        """Load history from assembly on, and the weight along the axis, which acts throughout."""
        weight = self.gravity * rotor_inertia(self.grounded).mass if self.gravity else 0.0
        return Past(self.conditions.history, weight)

    @property
    def loaded(self) -> bool:
        """Whether something acts across the axis on the state of the bearings."""
        return acts_across(self.spindle, self.conditions)

    @cached_property
    def outcome(self) -> tuple[str, ...]:
        """Per speed: empty, or why it has no physical solution."""
        texts: tuple[str, ...] = ("",) * len(self.bearing_speed)
        if self.spindle.seats:
            texts = self.preload.outcome
        if self._by_heat_flow:
            pairs = zip(self.heat_balance.outcome, texts, strict=True)
            texts = tuple(thermal or text for thermal, text in pairs)
        texts = tuple(text or buckled for text, buckled in zip(texts, self.buckling, strict=True))
        return tuple(texts[row] for row in self.bearing_row)

    def solved_only(self, values: Array) -> Array:
        """Expand ``values`` (bearing speeds, …) to all speeds of the case; NaN without a
        solution."""
        expanded = values[self.bearing_row].astype(float)
        expanded[np.array(self.outcome, dtype=str) != ""] = np.nan
        return expanded

    def require_solution(self) -> None:
        """Check that some speed has a solution.

        Raises
        ------
        NoSolution : none has
        """
        if all(self.outcome):
            raise NoSolution(f"no speed of the case has a usable state: {self.outcome[0]}")

    @property
    def usable(self) -> Indices:
        """Rows of the speeds with a solution; NoSolution where there is none."""
        self.require_solution()
        return np.flatnonzero([reason == "" for reason in self.outcome])

    def scattered(self, values: NDArray[Any]) -> NDArray[Any]:
        """Expand values at usable speeds (first axis) to all; NaN elsewhere, False for flags."""
        if len(values) == len(self.speed):
            return values
        missing: Any = complex(np.nan, np.nan) if np.iscomplexobj(values) else np.nan
        missing = False if values.dtype == bool else missing
        expanded = np.full((len(self.speed), *values.shape[1:]), missing, dtype=values.dtype)
        expanded[self.usable] = values
        return expanded

    @cached_property
    def bodies(self) -> Spindle:
        """The machine as shafts and housings depend on it: sleeves with a standard spring and no
        stop, no texts."""
        with unchecked():  # the machine is checked already
            sleeves = tuple(
                replace(sleeve, spring=_standard_spring(sleeve), stop_travel=math.inf)
                for sleeve in self.spindle.sleeves
            )
            return replace(self.spindle, sleeves=sleeves, title="", note="", references=())

    @stage_of(lambda self: (self.bodies, self.conditions.element_length))
    def mesh(self) -> Mesh:
        """Nodes and elements of the shaft."""
        return build_mesh(self.spindle, self.conditions.element_length)

    @stage_of(lambda self: self._axial_inputs)
    def preload(self) -> PreloadState:
        """Dynamic preload state at ``bearing_speed``, under all static loads."""
        if not self.loaded:
            return self.unloaded
        from rotordyn.preload.under_load import under_load

        return under_load(self.unloaded, *self.static_rotor)

    @stage_of(lambda self: self.seated)
    def unloaded(self) -> PreloadState:
        """Preload state at ``bearing_speed`` without loads across the axis, shared by all tools."""
        acting = self.axial_force, self.temperatures, self.past
        inputs = self.seated if self.memo.ahead else ()
        for known_inputs, state in self.memo.ahead:
            if known_inputs == inputs:
                return with_friction(replace(state, past=self.past))
        args = self.grounded, self.bearing_speed, self.law, *acting
        if (oil := self.conditions.films) is None:
            return operating_state(*args)
        from rotordyn.preload.on_films import on_films

        return on_films(lambda films: operating_state(*args, films), oil.oil, oil.temperature)

    @property
    def alone(self) -> bool:
        """Whether its state without loads across the axis is solved without other machines."""
        conditions = self.conditions
        iterated = conditions.heat_flow or conditions.films
        return not self.spindle.seats or bool(iterated)

    @property
    def temperatures(self) -> Temperatures | None:
        """Prescribed temperatures, or those of the heat balance."""
        by_heat_flow = self._by_heat_flow
        return self.heat_balance.temperatures if by_heat_flow else self.conditions.temperatures

    @property
    def _by_heat_flow(self) -> bool:
        """Whether temperatures follow from heat, at every speed that has a balance."""
        given, flow = self.conditions.temperatures, self.conditions.heat_flow
        return given is None and flow is not None and bool(self.spindle.seats)

    @property
    def has_temperatures(self) -> Flags:
        """Bearing speeds (speeds,) at which temperatures are known: those without a heat balance
        have none."""
        if not self._by_heat_flow:
            return np.ones(len(self.bearing_speed), dtype=bool)
        return np.array(self.heat_balance.outcome, dtype=str) == ""

    @cached_property
    def heat_balance(self) -> HeatBalance:
        """Temperatures at ``bearing_speed`` where the conditions have a heat flow."""
        return self.shared("heat balance", self._axial_inputs, self._solve_heat_balance)

    def _solve_heat_balance(self) -> HeatBalance:
        from rotordyn.preload.heat_balance import heat_balance

        heat_flow = self.conditions.heat_flow
        assert heat_flow is not None

        wanted, start = self.bearing_speed.tolist(), None
        on_the_way: list[float] = []
        if self.spindle.rubs:
            top = max(*wanted, *self.past.speeds)
            on_the_way += [*self.past.speeds, *evenly_spaced(self.grounded, top)]
        speed = np.unique([*wanted, *on_the_way])
        if self.spindle.rubs:
            start = self._without_friction(speed, heat_flow.flow)

        balance = heat_balance(self.preload_at(speed), speed, self.grounded, heat_flow.flow, start)
        texts = dict(zip(speed.tolist(), balance.outcome, strict=True))

        def outcome(goal: float) -> str:
            highest = max(goal, *self.past.speeds)
            passed = (texts[at] for at in on_the_way if at <= highest)
            failed = next((text for text in passed if text), "")
            return texts[goal] or (failed and f"on the way there, {failed}")

        return balance._replace(outcome=tuple(map(outcome, wanted)))

    def _without_friction(self, speed: Array, flow: Flow) -> Array:
        """Return the temperatures in balance without friction (speeds, bearings, 3) [°C], close to
        those with it, whose states take far longer; those without heat where there is no
        balance."""
        from rotordyn.preload.heat_balance import cold, heat_balance

        with unchecked():
            sleeves = tuple(replace(sleeve, friction=0.0) for sleeve in self.grounded.sleeves)
            smooth = replace(self.grounded, sleeves=sleeves)
        balance = heat_balance(self.preload_at(speed, smooth), speed, smooth, flow)
        failed = np.array(balance.outcome, dtype=str) != ""
        return np.where(failed[:, None, None], cold(flow), balance.values)

    def preload_at(
        self, speed: Array, spindle: Spindle | None = None
    ) -> Callable[[Temperatures], PreloadState]:
        """Return the preload state without loads across the axis at ``speed`` [rad/s], of another
        ``spindle`` if given, as a function of temperatures; each call starts from the state of the
        last one."""
        acting = spindle or self.grounded, speed, self.law, self.axial_force
        last: PreloadState | None = None

        def solve(temperatures: Temperatures) -> PreloadState:
            nonlocal last
            if last is None or last.rubs.any():
                last = operating_state(*acting, temperatures, self.past)
            else:
                last = at_temperatures(last, temperatures)
            return last

        return solve

    @cached_property
    def static_rotor(self) -> tuple[StaticRotor, float]:
        """The rotor under its static loads across the axis, and their size [N]."""
        from rotordyn.equation.statics import loaded_rotor

        structure, speed, force = self.rotor, self.state_speed, None
        if self.conditions.axial_stiffening:
            along = self.along(self.grounded, self.unloaded.seat_load())
            force = np.nan_to_num(along.bending(self.mesh.middle))
        loads = across(self.spindle, self.conditions)
        length = self.spindle.shaft.end - self.spindle.shaft.start
        per_newton, size = loads.per_newton(length, rotor_inertia(self.grounded).mass)
        return loaded_rotor(structure, speed, per_newton, force), size

    @stage_of(lambda self: (*self._axial_inputs, self.conditions.tension))
    def shaft_force(self) -> AxialForce:
        """Axial force in the shaft at ``bearing_speed``."""
        return self.along(self.grounded, self._seat_load)

    @stage_of(lambda self: (*self._axial_inputs, self.conditions))
    def buckling(self) -> tuple[str, ...]:
        """Message per speed of ``bearing_speed``: empty, or that the shaft buckles."""
        seats = self.spindle.seats
        tangents = self.preload.seat_stiffness() if seats else _no_seats(self.bearing_speed, 5, 5)
        return self.buckled(self._seat_load, tangents, self.state_speed)

    def buckled(self, seat_load: Array, seat_stiffness: Array, speed: Array) -> tuple[str, ...]:
        """Return messages as ``buckling``, for other bearing loads (states, seats) and tangents."""
        if not self.conditions.axial_stiffening:
            return ("",) * len(speed)
        return Loading(self, speed, seat_load, seat_stiffness).outcomes()

    def bending_force(self, seat_load: Array | None = None) -> Array | None:
        """Return the axial force on bending (states, elements) [N]; None without axial stiffening.

        It is that at ``bearing_speed``, or under other axial loads of the bearings (states, seats).
        """
        if not self.conditions.axial_stiffening:
            return None
        along = self.shaft_force if seat_load is None else self.along(self.grounded, seat_load)
        return along.bending(self.mesh.middle)

    def along(self, spindle: Spindle, seat_load: Array, share: float = 1.0) -> AxialForce:
        """Return the axial force in the shaft under bearing loads (states, seats) and all forces of
        the conditions, each times ``share``."""
        acting, gravity = self.conditions, share * self.gravity
        force, tension = share * acting.axial_force, share * acting.tension
        points = tuple((x, share * push) for x, push in self._point_forces)
        return axial_force(spindle, share * seat_load, force, gravity, tension, points)

    @property
    def _point_forces(self) -> PointForces:
        """Stations and axial forces of the loads."""
        place = self.spindle.place
        return tuple((place(load.at).x, load.Fx) for load in self.conditions.loads if load.Fx)

    @property
    def _axial_inputs(self) -> tuple[Any, ...]:
        """All inputs of the preload state."""
        conditions = self.conditions
        forces = self.axial_force, conditions.axial_force, self.gravity, conditions.temperatures
        heat = conditions.heat_flow, conditions.films
        speeds = self.bearing_speed.tobytes(), self.state_speed.tobytes()
        acting = conditions.history, self._point_forces, *speeds
        inputs = (self.spindle, self.law, *forces, heat, *acting)
        return (*inputs, *self._lateral_inputs) if self.loaded else inputs

    @property
    def seated(self) -> tuple[Any, ...]:
        """Inputs of the preload state without loads across the axis: of the shaft the sections that
        reach behind the foremost of seats, supports along the axis and reference of the
        shortening."""
        part, shaft = self.grounded, self.spindle.shaft
        reference = getattr(part.shortening, "reference", math.inf)
        axial_supports = (support.x for support in part.supports if support.along)
        front = min((*(seat.x for seat in part.seats), *axial_supports, reference))
        behind = tuple(
            (round(left, 9), section)  # stations add up from the tip of the tool
            for left, section in zip(shaft.boundaries, shaft.sections, strict=False)
            if left + section.length > front
        )
        machine = self.law, part.seats, part.sleeves, part.supports, part.shortening, behind
        conditions = self.conditions
        thermal = conditions.temperatures, conditions.heat_flow, conditions.films
        acting = self.axial_force, self.past, *thermal
        return (*machine, *acting, self.bearing_speed.tobytes())

    @property
    def _lateral_inputs(self) -> tuple[Any, ...]:
        """Further inputs of the state under loads across the axis."""
        raise NotImplementedError

    @property
    def _seat_load(self) -> Array:
        return self.preload.seat_load() if self.spindle.seats else _no_seats(self.bearing_speed)

    @stage_of(lambda self: (*self._axial_inputs, self.conditions.tangent))
    def tangents(self) -> Array:
        """Tangents at ``bearing_speed`` in the frames of the bearings (…, seats, 5, 5)."""
        return self.preload.seat_stiffness(self.conditions.tangent)

    @property
    def seat_stiffness(self) -> Array:
        """Tangents at the usable speeds in the frames of the bearings (usable, seats, 5, 5)."""
        if not self.spindle.seats:
            return _no_seats(self.speed, 5, 5)
        return self.tangents[self.bearing_row[self.usable]]


def _standard_spring(sleeve: Sleeve) -> Spring:
    """Return a standard spring of the same kind: the sleeve slides, or is locked."""
    return LOCKED if math.isinf(sleeve.spring.stiffness) else ANY_SPRING


def _no_seats(speed: Array, *rest: int) -> Array:
    """Return an array (speeds, 0, …), for a machine without bearings."""
    return np.zeros((len(speed), 0, *rest))
