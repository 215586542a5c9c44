"""What a case asks: one frozen Spec per analysis, and the conditions all of them share (SI)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Annotated

from bearings.ball.law import KINEMATICS, MOMENT_SHARING, Law
from rotordyn.analysis.bearing_specs import BearingMapSpec, ControlSpec, Tangent
from rotordyn.analysis.formulation import FORMULATIONS, INERTIAL
from rotordyn.analysis.loads import (
    BalanceGrade,
    EccentricSpan,
    LineLoad,
    PointLoad,
    TwistLimit,
    Unbalance,
)
from rotordyn.description import Description, ascending, doubled
from rotordyn.machine.support import Freedom
from rotordyn.quantity import (
    Accuracy,
    Amplitude,
    Choice,
    EngineOrder,
    Force,
    Frequency,
    Friction,
    Length,
    LightLoad,
    Name,
    PointName,
    Speed,
    Travel,
    Whole,
)

VARIANTS = ("nonlinear", "full", "diagonal", "constant_preload")
BEARINGS = ("dynamic", "static")
ROTOR = ("flexible", "rigid")
GRAVITY = ("none", "+x", "-x")
WEIGHT = ("none", "+x", "-x", "+y", "-y", "+z", "-z")
MESH_FILES = ("vtu", "vtk", "xdmf", "glb", "stl", "ply", "obj", "off")
MOST_TEETH = MOST_STEPS = 1000
QUANTITIES = ("receptance", "mobility", "inertance")


@dataclass(frozen=True, slots=True)
class Conditions(Description):
    """How the machine is modelled.

    ``kinematics``, ``moment_sharing``, ``friction`` (infinite: no limit): as in
    ``bearings.ball.law``, together ``law``. ``tangent``: of ``TANGENTS``, the
    stiffness of the bearings of a spindle wherever they act as linear springs. ``bearings``:
    ``"dynamic"`` (speed acts on the bearings) or ``"static"`` (their state at rest serves every
    speed). ``rotor``: ``"flexible"`` or ``"rigid"``. ``axial_force`` [N] on the front end of the
    shaft (of the tool) towards +x; ``tension`` [N] pulls at both of its ends; ``gravity``: of
    ``GRAVITY``, the way the weight of a vertical spindle points. ``accuracy``: relative error
    allowed of every frequency up to the highest asked for; the elements follow.
    ``element_length`` [m]: standard elements no longer than that instead, whatever their error.
    ``formulation``: of ``formulation.FORMULATIONS``, how bending is written.
    ``axial_stiffening``: the axial force in the shaft acts on its bending.
    """

    kinematics: Annotated[str, Choice(KINEMATICS)] = "hybrid"
    moment_sharing: Annotated[str, Choice(MOMENT_SHARING)] = "equal"
    friction: Friction = math.inf
    tangent: Tangent = "complete"
    bearings: Annotated[str, Choice(BEARINGS)] = "dynamic"
    rotor: Annotated[str, Choice(ROTOR)] = "flexible"
    axial_force: Force = 0.0
    tension: Force = 0.0
    gravity: Annotated[str, Choice(GRAVITY)] = "none"
    accuracy: Accuracy = 1e-4
    element_length: Length | None = None
    formulation: Annotated[str, Choice(FORMULATIONS)] = INERTIAL
    axial_stiffening: bool = True

    @property
    def law(self) -> Law:
        """What is assumed of the balls."""
        friction = None if math.isinf(self.friction) else self.friction
        return Law(self.kinematics, self.moment_sharing, friction)


@dataclass(frozen=True, slots=True)
class PreloadSpec(Description):
    """The dynamic preload state at every speed of the case."""


@dataclass(frozen=True, slots=True)
class ShapesInSpaceSpec(Description):
    """Mode shapes in space: how they are drawn, and the files of meshes that other programs read.

    ``amplitude``: largest displacement drawn, over the length of the shaft; ``animation``: one
    period of each mode as a GIF; ``files``: of ``MESH_FILES``.
    """

    amplitude: Amplitude = 0.06
    animation: bool = False
    files: tuple[Annotated[str, Choice(MESH_FILES)], ...] = ()

    def _faults(self) -> Iterator[str]:
        for name in doubled(self.files):
            yield f"files: repeated: given '{name}'"


@dataclass(frozen=True, slots=True)
class CampbellSpec(Description):
    """Damped eigenfrequencies up to ``max_frequency`` [Hz] over speed.

    ``teeth``: numbers of cutter teeth whose tooth-passing line is of interest; ``shapes``: keep the
    mode shapes at the first and the last speed; ``shapes_3d``: see them in space;
    ``engine_orders``: multiples of the speed, whole or not, whose critical speeds are solved for.
    """

    max_frequency: Frequency = 4000.0
    teeth: tuple[Annotated[int, Whole(1, MOST_TEETH)], ...] = ()
    shapes: bool = True
    shapes_3d: ShapesInSpaceSpec | None = None
    engine_orders: tuple[EngineOrder, ...] = (1.0,)

    def _faults(self) -> Iterator[str]:
        yield from ascending("teeth", self.teeth)
        yield from ascending("engine_orders", self.engine_orders)
        if self.shapes_3d is not None and not self.shapes:
            yield "shapes_3d needs the shapes: given shapes False; allowed: True"


@dataclass(frozen=True, slots=True)
class Port(Description):
    """A point of the machine (of a further rotor: ``rotor.point``) and one of its directions."""

    point: PointName
    direction: Freedom

    def __str__(self) -> str:
        return f"{self.point}.{self.direction}"


NO_RESPONSE = "no response: given zero at every frequency; allowed: at least one other value"


@dataclass(frozen=True, slots=True)
class MeasuredResponse(Description):
    """A measured frequency response in SI: ``quantity`` over ``frequency`` [Hz], in two parts.

    ``speed`` [rad/s] at which it was measured.
    """

    name: Name
    response: Port
    excitation: Port
    frequency: tuple[Frequency, ...]
    real: tuple[float, ...]
    imaginary: tuple[float, ...]
    speed: Speed = 0.0
    quantity: Annotated[str, Choice(QUANTITIES)] = QUANTITIES[0]

    @property
    def pair(self) -> str:
        """As in results."""
        return f"{self.response} / {self.excitation}"

    def _faults(self) -> Iterator[str]:
        counts = [len(self.frequency), len(self.real), len(self.imaginary)]
        if len(set(counts)) > 1 or counts[0] < 2:
            yield (
                "frequency, real and imaginary: at least two values, as many in each: given "
                f"{', '.join(map(str, counts))}"
            )
        yield from ascending("frequency", self.frequency)
        if not any((*self.real, *self.imaginary)):
            yield NO_RESPONSE


@dataclass(frozen=True, slots=True)
class FrfSpec(Description):
    """Responses between ``pairs`` (response, excitation) at every speed and frequency [Hz].

    ``quantity``: of ``QUANTITIES``: displacement, velocity or acceleration over force. ``measured``
    is laid over what is computed.
    ``slices``: speeds [rad/s] at which curves are drawn and UFF58 records written (nearest speed
    of the case); none given = the lowest and the highest.
    """

    frequencies: tuple[Frequency, ...]
    pairs: tuple[tuple[Port, Port], ...]
    slices: tuple[Speed, ...] = ()
    quantity: Annotated[str, Choice(QUANTITIES)] = QUANTITIES[0]
    measured: tuple[MeasuredResponse, ...] = ()

    def _faults(self) -> Iterator[str]:
        if not self.frequencies or not self.pairs:
            yield f"no {'pairs' if self.frequencies else 'frequencies'}: at least one is needed"
        yield from ascending("frequencies", self.frequencies)
        yield from ascending("slices", self.slices)
        for name in doubled(f"{response} / {excitation}" for response, excitation in self.pairs):
            yield f"pairs: repeated: given '{name}'"
        known = {f"{response} / {excitation}" for response, excitation in self.pairs}
        for one in self.measured:
            if one.pair not in known:
                yield f"measured {one.name}: not a pair of the case: given '{one.pair}'"
        for name in doubled(one.name for one in self.measured):
            yield f"measured: name given twice: '{name}'"


@dataclass(frozen=True, slots=True)
class StiffnessSpec(Description):
    """Quasi-static radial stiffness at ``point``: deflection under 0 … ``max_force`` [N].

    ``steps``: load steps; ``variants``: of ``VARIANTS``; ``second_stop``: other stop travels [m] by
    sleeve, computed as one more (nonlinear) variant when given.
    """

    point: Name
    max_force: LightLoad = 500.0
    steps: Annotated[int, Whole(1, MOST_STEPS)] = 10
    variants: tuple[Annotated[str, Choice(VARIANTS)], ...] = VARIANTS
    second_stop: Mapping[Name, Travel] = field(default_factory=dict)

    def _faults(self) -> Iterator[str]:
        if not self.variants and not self.second_stop:
            yield "no variants: at least one is needed"
        for name in doubled(self.variants):
            yield f"variants: repeated: given '{name}'"


@dataclass(frozen=True, slots=True)
class SectionForcesSpec(Description):
    """Section forces, deflection and stress of the shaft at rest under static loads.

    ``gravity``: of ``WEIGHT``, the way the weight of the rotor points. Loads add to what the
    preload state puts on the shaft along its axis.
    """

    loads: tuple[PointLoad, ...] = ()
    line_loads: tuple[LineLoad, ...] = ()
    unbalances: tuple[Unbalance, ...] = ()
    gravity: Annotated[str, Choice(WEIGHT)] = "none"
    twist_limits: tuple[TwistLimit, ...] = ()

    def _faults(self) -> Iterator[str]:
        for name in doubled(each.called for each in self.twist_limits):
            yield f"twist_limits: repeated: given '{name}'"

    @property
    def places(self) -> tuple[str | float, ...]:
        """Points and stations at which something acts or is asked for."""
        own = [load.at for load in self.loads] + [load.at for load in self.unbalances]
        own += [at for span in self.line_loads for at in (span.start, span.to)]
        own += [at for span in self.twist_limits for at in (span.start, span.to)]
        return tuple(own)


@dataclass(frozen=True, slots=True)
class UnbalanceSpec(Description):
    """Steady response to unbalance at every speed of the case.

    All of ``unbalances``, ``spans`` and ``grade`` act together; motion is given at ``points``.
    """

    points: tuple[PointName, ...]
    unbalances: tuple[Unbalance, ...] = ()
    spans: tuple[EccentricSpan, ...] = ()
    grade: BalanceGrade | None = None

    def _faults(self) -> Iterator[str]:
        if not self.points:
            yield "no points: at least one is needed"
        for name in doubled(self.points):
            yield f"points: repeated: given '{name}'"
        if not (self.unbalances or self.spans or self.grade):
            yield "no unbalance: give unbalances, spans or grade"

    @property
    def places(self) -> tuple[str | float, ...]:
        """Points and stations at which something acts or is asked for."""
        return (*self.points, *self.acting)

    @property
    def acting(self) -> tuple[str | float, ...]:
        """Points and stations at which unbalance acts; both ends of a span."""
        own = [each.at for each in self.unbalances]
        own += [at for span in self.spans for at in (span.start, span.to)]
        return (*own, *(self.grade.planes if self.grade else ()))


Spec = (
    PreloadSpec
    | CampbellSpec
    | FrfSpec
    | StiffnessSpec
    | SectionForcesSpec
    | UnbalanceSpec
    | BearingMapSpec
    | ControlSpec
)
