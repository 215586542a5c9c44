"""Load at which the lightest ball of a bearing leaves its race.

The approach of ball and race is proportional to the 2/3 power of their load; that of the lightest
ball falls almost linearly and is extrapolated from up to three loads.

Theory: docs/theory/loads.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

HERTZ = 2.0 / 3.0  # exponent of the approach over the load
KNOWN = 3  # loads, through which a parabola passes
NEARER = 24  # loads tried, at most
CLOSE = 1e-3  # of the load at which a ball leaves: from there the parabola errs by far less
REAL = 1e-12  # imaginary part that rounding gives a real root
STRAIGHT = 1e-9  # of the approach: less curvature is rounding, which would give a false root


@dataclass(frozen=True, slots=True)
class Leaving:
    """Iterate of the load at which a ball leaves.

    ``load``, in any unit, and ``approach`` of the lightest ball there while it is loaded,
    ascending; ``lost``: a load at which one has left; ``least``: load of a ball [N] that counts;
    ``ball``: index of the lightest one.
    """

    load: tuple[float, ...]
    approach: tuple[float, ...]
    lost: float
    least: float
    ball: int

    @classmethod
    def between(
        cls, load: Sequence[float], lightest: Sequence[float], lost: float, least: float, ball: int
    ) -> Leaving:
        """Return the iterate from the ``lightest`` ball load at every load before ``lost``."""
        approach = tuple(q**HERTZ for q in lightest[-KNOWN:])
        return cls(tuple(load[-KNOWN:]), approach, lost, least, ball)

    @property
    def zero(self) -> float:
        """Load at which the approach vanishes, extrapolated.

        By a straight line or parabola through the approaches; ``lost`` where it has no zero before.
        """
        if len(self.load) < 2:
            return self.lost
        curve = np.polynomial.Polynomial.fit(self.load, self.approach, len(self.load) - 1)
        straight = curve.trim(STRAIGHT * np.abs(curve.coef).max())
        zeros = np.asarray(straight.roots())
        zeros = zeros.real[np.abs(zeros.imag) < REAL]
        inside = zeros[(self.load[-1] <= zeros) & (zeros <= self.lost)]
        return float(inside.min(initial=self.lost))

    @property
    def trial(self) -> float:
        """Load to solve next, most of the distance to the zero of the approach."""
        zero = self.zero
        return self.load[-1] + (0.9 if zero < self.lost else 0.5) * (zero - self.load[-1])

    @property
    def found(self) -> bool:
        """True if the approach is known so close to its zero that no further load need be tried."""
        return self.lost - self.load[-1] <= 1e-3 * CLOSE * self.lost or (
            len(self.load) == KNOWN
            and self.zero < self.lost
            and self.zero - self.load[-1] <= CLOSE * self.zero
        )

    def after(self, load: float, lightest: float, ball: int) -> Leaving:
        """Return the iterate with the ``lightest`` ball load at a further ``load``."""
        if not lightest > self.least:
            return replace(self, lost=load)
        return replace(
            self,
            load=(*self.load, load)[-KNOWN:],
            approach=(*self.approach, lightest**HERTZ)[-KNOWN:],
            ball=ball,
        )
