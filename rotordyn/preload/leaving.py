"""Where the lightest ball of a bearing leaves its race as a load grows.

The approach of a ball is the 2/3 power of its load, by which a race springs; the one of the
lightest ball falls almost evenly, and is taken to go on as it did at up to three loads before.

Theory: docs/theory/loads.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

HERTZ = 2.0 / 3.0
KNOWN = 3  # loads that a parabola takes
NEARER = 24  # loads that are tried, at most
CLOSE = 1e-3  # of the load at which a ball leaves: from there the parabola is right to far less
REAL = 1e-12
STRAIGHT = 1e-9  # of the approach: a bend that is less is rounding, of which a root would be made


@dataclass(frozen=True, slots=True)
class Leaving:
    """What is known of a ball that leaves.

    ``load``, whatever it counts, and ``approach`` of the lightest ball there while it is pressed,
    ascending; ``lost``: a load at which one has left; ``least``: load of a ball [N] that counts;
    ``ball``: the lightest one.
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
        """From the ``lightest`` ball at every load before the one at which it is ``lost``."""
        approach = tuple(q**HERTZ for q in lightest[-KNOWN:])
        return cls(tuple(load[-KNOWN:]), approach, lost, least, ball)

    @property
    def zero(self) -> float:
        """Load at which the approach comes to zero, as far as it is known.

        On the straight line or parabola of the approaches; ``lost`` where nothing nearer is known.
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
        """Load to look at next, most of the way to where the approach comes to zero."""
        zero = self.zero
        return self.load[-1] + (0.9 if zero < self.lost else 0.5) * (zero - self.load[-1])

    @property
    def found(self) -> bool:
        """The approach is known so close to its zero that no further load need be tried."""
        return self.lost - self.load[-1] <= 1e-3 * CLOSE * self.lost or (
            len(self.load) == KNOWN
            and self.zero < self.lost
            and self.zero - self.load[-1] <= CLOSE * self.zero
        )

    def after(self, load: float, lightest: float, ball: int) -> Leaving:
        """With the ``lightest`` ball at a further load."""
        if not lightest > self.least:
            return replace(self, lost=load)
        return replace(
            self,
            load=(*self.load, load)[-KNOWN:],
            approach=(*self.approach, lightest**HERTZ)[-KNOWN:],
            ball=ball,
        )
