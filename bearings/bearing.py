"""Base class of every ball bearing, and the contract that a new kind fulfils.

A kind is one frozen dataclass derived from ``BallBearing``, in a file of its own in
``bearings/kinds``, and its lines in ``bearings/kinds/__init__.py``. It keeps this contract:

1. **Fields.** Data of a maker's drawing besides the common fields, declared with ``measured``:
   quantity, range, meaning and default are on the field. Python, files, JSON Schema and key
   reference read them from there. A common field is declared again where its default differs.
2. **Grooves.** ``grooves`` gives the places of the groove centres (``bearings.grooves.Grooves``):
   one or two grooves a ring, the free contact angle, and where displacement is zero. Everything
   else about the physics follows from it: no other file depends on the kind.
3. **Faults.** ``_faults`` yields a sentence, with its remedy, for data that contradict one another.
4. **Loads it cannot carry.** ``refusal(load, free)`` is a sentence where a load given on a free
   component cannot be carried by this kind at all: by default a thrust against 5.
5. **Directions.** ``both_ways``: it takes thrust in both directions, otherwise towards +x alone.
6. **What it is ground to.** ``ground`` names the datum that stays where groove radii scatter, if it
   is not among the fields that are given, such as the play behind a free contact angle.

For that, every kind has:

7. **Equilibrium** from a displacement, a load or any mix of both (``equilibrium``), batched.
8. **State** as plain data (``bearings.ring.state.BearingState``): loads, displacements, per-ball
   results by contact in the order of ``contact_names``, and by race.
9. **Tangent** ∂load/∂displacement of the state.
10. **Drawing**: ``contact_lines``, angles of the lines through a ball that carry, and the radii of
   the raceways.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import KW_ONLY, dataclass, fields
from itertools import chain
from typing import TYPE_CHECKING, ClassVar

from bearings.arguments import finite
from bearings.errors import InvalidBearing, shown
from bearings.flexible_rings.describe import FlexibleRings
from bearings.flexible_rings.outline import outline
from bearings.grooves import STEEP, WIDEST, Grooves
from bearings.materials import STEEL, Material
from bearings.measure import Measure, measured, refusals

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from bearings.arrays import Array, Flags
    from bearings.ring.state import BearingState


BALL_DIAMETER = Measure("length", "diameter of a ball", 1e-4, 0.2, unit="mm")
PITCH_DIAMETER = Measure("length", "diameter of the circle of ball centres", 1e-3, 10.0, unit="mm")
BALLS = Measure("count", "number of balls", 3, 500)
CONFORMITY = Measure("number", "groove radius over ball diameter", 0.5, 0.7, open_low=True)
MATERIAL = Measure("material", "material, with its thermal expansion", kind=Material)
ROUNDING = 1e-9  # of a load: less is a thrust of zero
THINNEST = 0.1  # wall of a ring over the diameter of the ball
SHOULDER = Measure("length", "diameter at which the groove of the ring ends", 1e-3, 10.0, unit="mm")


def ring_limits(pitch_diameter: float, ball_diameter: float, angle: float) -> tuple[float, float]:
    """Largest bore and least outside diameter of rings whose walls are a tenth of the ball's
    diameter where it touches them at contact ``angle`` [rad]; thin-section rings have a quarter."""
    reach = ball_diameter * (math.cos(angle) + 2.0 * THINNEST)
    return pitch_diameter - reach, pitch_diameter + reach


@dataclass(frozen=True, slots=True)
class BallBearing:
    """A single-row ball bearing of any kind; see the contract above.

    Parameters
    ----------
    ball_diameter, pitch_diameter : D, dm [m]
    balls : number of balls, at least 3
    inner_conformity, outer_conformity : groove radius over ball diameter, above 0.5
    ball_material, ring_material : elastic constants and density
    inner_shoulder_diameter, outer_shoulder_diameter : where the grooves end [m], None if unknown
    rings : ``FlexibleRings`` that deform under their balls; None: rigid

    Raises
    ------
    InvalidBearing : data out of range, or impossible together
    """

    both_ways: ClassVar[bool] = False

    ball_diameter: float = measured(BALL_DIAMETER)
    pitch_diameter: float = measured(PITCH_DIAMETER)
    balls: int = measured(BALLS)
    _: KW_ONLY
    inner_conformity: float = measured(CONFORMITY, 0.52)
    outer_conformity: float = measured(CONFORMITY, 0.52)
    ball_material: Material = measured(MATERIAL, STEEL)
    ring_material: Material = measured(MATERIAL, STEEL)
    inner_shoulder_diameter: float | None = measured(SHOULDER, None)
    outer_shoulder_diameter: float | None = measured(SHOULDER, None)
    rings: FlexibleRings | None = None

    def __post_init__(self) -> None:
        faults = refusals(self), self._overlaps(), self._faults(), self._shoulder_faults()
        for fault in chain(*faults):
            raise InvalidBearing(fault)
        self._check_rings()

    @classmethod
    def measures(cls) -> dict[str, Measure]:
        """``Measure`` of every field, by name."""
        return {f.name: f.metadata["measure"] for f in fields(cls) if "measure" in f.metadata}

    def _overlaps(self) -> Iterator[str]:
        circle = self.pitch_diameter * math.sin(math.pi / self.balls)
        if self.ball_diameter >= circle:
            yield (
                f"{self.balls} balls of {self.ball_diameter * 1e3:g} mm overlap on a pitch circle "
                f"of {self.pitch_diameter * 1e3:g} mm"
            )

    def _shoulder_faults(self) -> Iterator[str]:
        """Yield a sentence for a shoulder not between groove bottom and circle of ball centres."""
        if self.inner_shoulder_diameter is None and self.outer_shoulder_diameter is None:
            return
        bottoms = self.grooves.bottoms
        for ring, bottom in zip(("inner", "outer"), bottoms, strict=True):
            given = getattr(self, f"{ring}_shoulder_diameter")
            low, high = sorted((bottom, float(self.pitch_diameter)))
            if given is not None and not low < given < high:
                yield (
                    f"{ring}_shoulder_diameter {given * 1e3:g} mm must lie between the bottom of "
                    f"the groove and the pitch circle: allowed inside {low * 1e3:.5g} mm to "
                    f"{high * 1e3:.5g} mm"
                )

    def _check_rings(self) -> None:
        """Raise InvalidBearing for rings that do not fit the grooves."""
        if self.rings is None:
            return
        if not isinstance(self.rings, FlexibleRings):
            raise InvalidBearing(f"rings must be FlexibleRings or None, got {shown(self.rings)}")
        grooves = self.grooves
        for ring, inner in ((self.rings.inner, True), (self.rings.outer, False)):
            if ring is not None:
                outline(grooves, ring, inner=inner)

    def _faults(self) -> Iterator[str]:
        """Yield sentences about data that contradict one another (contract 3)."""
        yield from ()

    def drawn(self, name: str, value: float | None = None) -> str:
        """Format a field with its value, or with another ``value``, in the unit of drawings."""
        if str(name) not in self.measures():
            raise InvalidBearing(f"no field {shown(name)}: there are {', '.join(self.measures())}")
        value = getattr(self, name) if value is None else value
        if not finite(value):
            raise InvalidBearing(f"{name} must be a finite number, got {shown(value)}")
        return f"{name} {self.measures()[name].drawn(value)}"

    def _exactly_one(self, names: Sequence[str], beside: str = "") -> Iterator[str]:
        """Yield a sentence unless exactly one of several data that fix one another is given."""
        given = [name for name in names if getattr(self, name) is not None]
        if len(given) != 1:
            listing = "; ".join(self.drawn(name) + self._meaning(name) for name in given) or "none"
            rule = f"give exactly one of {', '.join(names)}, since each fixes the others"
            yield f"{rule}{beside}: got {listing}"

    def _meaning(self, name: str) -> str:
        """Consequence of one of these data for the others, as text; empty by default."""
        return ""

    @property
    def grooves(self) -> Grooves:
        """Places of the groove centres, free contact angle, zero of displacement (contract 2)."""
        raise NotImplementedError

    def refusal(self, load: Sequence[float], free: Sequence[bool]) -> str:
        """Why this kind cannot carry ``load`` (5,) on ``free`` (5,) DOF, or empty (contract 4)."""
        if self.both_ways or not free[0] or load[0] >= -ROUNDING * max(map(abs, load)):
            return ""
        return (
            f"the bearing carries axial load towards +x only: got {load[0]:g} N, allowed: 0 N or "
            "more, since its rings have one shoulder each; turn the bearing round, or take a kind "
            "that takes thrust in both directions"
        )

    @property
    def ground(self) -> dict[str, float | None]:
        """Fields by which rings are ground, in place of those given as None (contract 6)."""
        return {}

    def check_load(self, loads: Array, free: Flags) -> None:
        """Raise InvalidBearing for loads (s, 5) given where ``free`` (5,) by contract 4."""
        if type(self).refusal is BallBearing.refusal:  # few of many loads can be refused
            loads = loads[loads[:, 0] < 0.0] if free[0] and not self.both_ways else loads[:0]
        for load in loads:
            if why := self.refusal(load.tolist(), free.tolist()):
                raise InvalidBearing(why)

    @property
    def estimated(self) -> str:
        """Estimated internal data with their spread, as text; empty where all data are given.

        See ``bearings.estimate``.
        """
        return ""

    @property
    def doubt(self) -> str:
        """Warning about an implausible catalogue value; empty if none."""
        return ""

    @property
    def free_distance(self) -> float:
        """BD, between the centres of an inner and an outer groove that just touch a ball [m]."""
        return (self.inner_conformity + self.outer_conformity - 1.0) * self.ball_diameter

    @property
    def contact_names(self) -> tuple[str, ...]:
        """Names of the contacts of a ball, in the order of all per-contact results."""
        return self.grooves.contacts

    @property
    def free_angle(self) -> float:
        """Contact angle of the unloaded bearing at rest, pushed axially until balls touch [rad]."""
        return self.grooves.free_angle

    @property
    def contact_lines(self) -> tuple[float, ...]:
        """Angles from the radial direction of the lines along which a ball can carry load [rad].

        Positive in the direction of the thrust that loads them, as in a drawing of the section.
        """
        angle = self.free_angle
        return (angle, -angle) if self.both_ways and angle > 0.0 else (angle,)

    @property
    def inner_raceway_radius(self) -> float:
        """Radius of the ball's contact on the inner race, (dm − D cos α)/2 [m]."""
        return 0.5 * (self.pitch_diameter - self.ball_diameter * math.cos(self.free_angle))

    @property
    def outer_raceway_radius(self) -> float:
        """Radius of the ball's contact on the outer race, (dm + D cos α)/2 [m]."""
        return 0.5 * (self.pitch_diameter + self.ball_diameter * math.cos(self.free_angle))

    @property
    def ring_limits(self) -> tuple[float, float]:
        """Largest bore and least outside diameter that leave both rings a wall at the balls [m]."""
        return ring_limits(self.pitch_diameter, self.ball_diameter, self.free_angle)

    @property
    def largest_static_growth(self) -> float:
        """Static growth that reduces the contact angle to zero [m], counted from touching.

        Infinite for kinds whose displacement is counted from the centred position.
        """
        grooves = self.grooves
        if not grooves.touching:
            return math.inf
        return grooves.free_distance * (1.0 - math.cos(grooves.free_angle))

    @property
    def smallest_static_growth(self) -> float:
        """Static growth below which the contact angle would exceed its largest valid value [m]."""
        grooves = self.grooves
        least = WIDEST - 1.0 if grooves.touching and grooves.free_angle > STEEP else WIDEST
        return float(least * grooves.free_distance - grooves.radial_gap)

    def equilibrium(  # noqa: PLR0913 - all of it describes one question
        self,
        *,
        load: ArrayLike | None = None,
        displacement: ArrayLike | None = None,
        speed: ArrayLike = 0.0,
        static_growth: ArrayLike = 0.0,
        growth: ArrayLike | None = None,
        kinematics: str = "hybrid",
        moment_sharing: str = "equal",
        friction: float | None = None,
        dynamics: str = "resultant",
        start: BearingState | None = None,
        compiled: bool | None = None,
    ) -> BearingState:
        """Return the physical state under a load or a displacement of the inner ring, or a mix.

        Parameters
        ----------
        load, displacement : shape (…, 5): (Fx, Fy, Fz, My, Mz) [N, N·m] or (δx, δy, δz, θy, θz)
            [m, rad]; zero displacement is zero load at rest. With both, exactly one of each pair is
            given and the other is None or NaN, in the same way for every state
        speed : of the inner ring, shape (…) [rad/s]
        static_growth : Δu0, radial growth of the inner groove centre at rest, shape (…) [m]
        growth : Δu, total growth at ``speed``, static part included; None = ``static_growth``
        kinematics, moment_sharing, friction, dynamics : as in ``bearings.Law``
        start : a nearby state of the same batch shape; it speeds up the solution, decides where two
            states exist (lightly loaded four-point bearings, docs/theory/four_point.md), and is not
            used with kinematics that have two branches ("inner", "geometric")
        compiled : solve state by state with compiled functions; None: where that pays, with the
            time for loading or compiling them

        Returns
        -------
        BearingState with leading shape (…), the broadcast of all arguments

        Raises
        ------
        InvalidBearing : over- or under-determined, shapes, non-finite numbers, unknown names, a
            load that this kind cannot carry
        NoEquilibrium : a single state (no leading dimensions) does not exist; batches carry an
            ``outcome`` per state instead
        """
        from bearings.ball.law import Law
        from bearings.ring.condition import refusal
        from bearings.ring.operation import operation
        from bearings.ring.request import solved
        from bearings.ring.state import BearingState

        if start is not None and not isinstance(start, BearingState):
            raise InvalidBearing(f"start must be a state of this bearing, got {shown(start)}")
        if not (compiled is None or isinstance(compiled, bool)):
            raise InvalidBearing(f"compiled must be True, False or None, got {shown(compiled)}")
        points = operation(
            self.grooves,
            Law(kinematics, moment_sharing, friction, dynamics),
            load=load,
            displacement=displacement,
            speed=speed,
            static_growth=static_growth,
            growth=growth,
        )
        self.check_load(points.load, points.free)
        state = solved(points, start, compiled)
        if points.shape == () and state.outcome:
            raise refusal(state)
        return state
