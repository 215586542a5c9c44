"""The angular-contact ball bearing: what it is, and the door to its equilibrium."""

from __future__ import annotations

import math
from dataclasses import dataclass
from numbers import Real
from typing import TYPE_CHECKING

from bearings.errors import InvalidBearing
from bearings.materials import SILICON_NITRIDE, STEEL, Material

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from bearings.state import BearingState

_CONFORMITIES = ("inner_conformity", "outer_conformity")


@dataclass(frozen=True, slots=True)
class AngularContactBallBearing:
    """A single-row angular-contact ball bearing with rigid rings.

    Parameters
    ----------
    ball_diameter, pitch_diameter : D, dm [m]
    balls : number of balls, at least 3
    contact_angle : free contact angle α [rad]
    inner_conformity, outer_conformity : groove radius over ball diameter, above 0.5
    ball_material, ring_material : elastic constants and density

    Raises
    ------
    InvalidBearing : the geometry is impossible (balls overlap, groove tighter than the ball …)
    """

    ball_diameter: float
    pitch_diameter: float
    balls: int
    contact_angle: float
    inner_conformity: float = 0.52
    outer_conformity: float = 0.52
    ball_material: Material = SILICON_NITRIDE
    ring_material: Material = STEEL

    def __post_init__(self) -> None:
        for material in (self.ball_material, self.ring_material):
            if not isinstance(material, Material):
                raise InvalidBearing(f"materials must be bearings.Material, got {material!r}")
        for fault in self._faults():
            raise InvalidBearing(fault)

    def _faults(self) -> list[str]:
        for key in ("ball_diameter", "pitch_diameter", "balls", "contact_angle", *_CONFORMITIES):
            if not _number(value := getattr(self, key)):
                return [f"{key} must be a finite number, got {value!r}"]
        lengths = (self.ball_diameter, self.pitch_diameter)
        if not all(v > 0.0 for v in lengths):
            return [f"ball and pitch diameter must be positive lengths, got {lengths} m"]
        faults = []
        if not 1e-4 <= self.ball_diameter <= 0.2 or self.pitch_diameter > 10.0:
            faults.append(
                f"a ball of {self.ball_diameter:g} m on a pitch circle of {self.pitch_diameter:g} "
                "m: is the unit right?"
            )
        if self.balls != int(self.balls) or self.balls < 3:
            faults.append(f"balls must be a whole number from 3 up, got {self.balls!r}")
        elif self.ball_diameter >= self.pitch_diameter * math.sin(math.pi / self.balls):
            faults.append(
                f"{self.balls} balls of {self.ball_diameter * 1e3:g} mm overlap on a pitch circle "
                f"of {self.pitch_diameter * 1e3:g} mm"
            )
        if not 0.0 <= self.contact_angle <= math.radians(60.0):
            faults.append(
                f"contact_angle must lie between 0 and 60° (in rad), got {self.contact_angle!r} rad"
            )
        for key in _CONFORMITIES:
            value = getattr(self, key)
            if not 0.5 < value <= 0.7:
                faults.append(f"{key} must lie above 0.5 and at most at 0.7, got {value!r}")
        return faults

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
        start: BearingState | None = None,
        compiled: bool | None = None,
    ) -> BearingState:
        """The physical state under a load or a displacement of the inner ring, or a mix of both.

        Parameters
        ----------
        load, displacement : shape (…, 5): (Fx, Fy, Fz, My, Mz) [N, N·m] or (δx, δy, δz, θy, θz)
            [m, rad]; zero displacement is zero load at rest. With both, exactly one of each pair is
            given and the other is None or NaN, in the same way for every state
        speed : of the inner ring, shape (…) [rad/s]
        static_growth : Δu0, radial growth of the inner groove centre at rest, shape (…) [m]
        growth : Δu, total growth at ``speed``, static part included; None = ``static_growth``
        kinematics : "hybrid", "outer", "inner" or "geometric"
        moment_sharing : "equal", "outer", "inner" or "hybrid"
        friction : coefficient μ that limits the gyroscopic moment a race can hold, λ Mg ≤ μ D Q;
            None lets it hold any
        start : a state of the same batch shape close to the one sought; only speeds the search up,
            and is not used with kinematics that know two branches ("inner", "geometric")
        compiled : solve state by state with compiled functions; None: where that pays, with the
            time for loading or compiling them

        Returns
        -------
        BearingState with leading shape (…), the broadcast of all arguments

        Raises
        ------
        InvalidBearing : over- or under-determined, shapes, non-finite numbers, unknown names
        NoEquilibrium : a single state (no leading dimensions) does not exist; batches carry an
            ``outcome`` per state instead
        """
        from bearings.law import Law
        from bearings.question import question
        from bearings.request import answer
        from bearings.state import BearingState

        if start is not None and not isinstance(start, BearingState):
            raise InvalidBearing(f"start must be a state of this bearing, got {start!r:.80}")
        if not (compiled is None or isinstance(compiled, bool)):
            raise InvalidBearing(f"compiled must be True, False or None, got {compiled!r}")
        law = Law(kinematics, moment_sharing, friction)
        asked = question(load, displacement, speed, static_growth, growth)
        return answer(self, law, asked, start, compiled)


def _number(value: object) -> bool:
    """A finite real number."""
    if isinstance(value, bool) or not isinstance(value, Real):
        return False
    try:
        return math.isfinite(value)
    except OverflowError:
        return False
