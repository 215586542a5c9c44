"""Hypotheses about the balls of a bearing: kinematics, moment sharing, friction, dynamics."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, NamedTuple

from bearings.arguments import finite
from bearings.errors import InvalidBearing, shown

# The numbers of hypotheses and sharings in compiled code are their places here.
KINEMATICS = ("hybrid", "outer", "inner", "geometric")
MOMENT_SHARING = ("equal", "outer", "inner", "hybrid")
DYNAMICS = ("resultant", "frozen", "centrifugal", "gyroscopic")


class LawNumbers(NamedTuple):
    """Hypotheses about a ball, as numbers.

    Indices in ``KINEMATICS`` and ``MOMENT_SHARING``, of a batch of states (s, 1);
    ``friction``: μ, 0 for no limit. ``dynamics`` acts through the blend of the balance.
    """

    kinematics: Any
    sharing: Any
    friction: float


@dataclass(frozen=True, slots=True)
class Law:
    """Kinematic hypothesis, sharing of the gyroscopic moment, limit of friction.

    Parameters
    ----------
    kinematics : "hybrid", "outer", "inner" or "geometric"
    moment_sharing : "equal", "outer", "inner" or "hybrid"
    friction : coefficient μ that limits the moment a race can hold, λ Mg ≤ μ D Q; None: no limit
    dynamics : "resultant": Fc and Mg follow the resultant load on each race; "frozen": Fc at the
        free contact angle and no Mg; "centrifugal", "gyroscopic": as "resultant" with Fc alone, or
        Mg alone, to see what either does

    Raises
    ------
    InvalidBearing : a name or number that is none of these
    """

    kinematics: str = "hybrid"
    moment_sharing: str = "equal"
    friction: float | None = None
    dynamics: str = "resultant"

    def __post_init__(self) -> None:
        check_name("kinematics", self.kinematics, KINEMATICS)
        check_name("moment_sharing", self.moment_sharing, MOMENT_SHARING)
        check_name("dynamics", self.dynamics, DYNAMICS)
        mu: object = self.friction
        if mu is None:
            return
        if not (finite(mu) and 1e-6 <= mu <= 1e6):
            raise InvalidBearing(
                f"friction must be a number from 1e-6 to 1e6 or None, got {shown(mu)}"
            )

    @property
    def numbers(self) -> LawNumbers:
        """The hypotheses as plain numbers, for the balance of a ball."""
        return LawNumbers(
            kinematics=KINEMATICS.index(self.kinematics),
            sharing=MOMENT_SHARING.index(self.moment_sharing),
            friction=float(self.friction or 0.0),
        )

    @property
    def one_branch(self) -> bool:
        """Whether a neighbouring state may be a start: contacts open and close without a jump.

        Inner control and the geometric hypothesis end their loaded branch with a jump. With the
        others only balls of four-point bearings under light load have two states.
        """
        return self.kinematics in ("hybrid", "outer") or self.dynamics == "frozen"

    def take(self, index: Iterable[Any]) -> Law:
        """Select states of a batch by index; all of them share this law."""
        return self


def check_name(what: str, name: object, known: Iterable[str]) -> None:
    """Raise InvalidBearing for a name that is not among ``known``, with the nearest one."""
    if isinstance(name, str) and name in known:
        return
    close = difflib.get_close_matches(str(name), known, n=1)
    hint = f" (did you mean {close[0]!r}?)" if close else ""
    raise InvalidBearing(f"{what} must be one of {', '.join(known)}, got {shown(name)}{hint}")


STANDARD = Law()
