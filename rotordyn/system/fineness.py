"""How fine a model has to be: what is asked of it, and how far its parts must then reach."""

from __future__ import annotations

import math
from dataclasses import dataclass

from rotordyn.machine.support import Sleeve

USUAL = 1e-4  # relative error of a frequency that a designer does not notice
CUTOFF = 2.5  # free-free modes kept, over the highest frequency asked, at the usual accuracy
STANDARD_CUTOFF = 4.0  # the same with standard elements, whose own error is to stand alone
WEIGHTLESS = 30.0  # frequency of what has no mass, over the highest asked, at the usual accuracy
SHARE = 0.03  # of the accuracy, that a gyroscopic force without its answer may cost
FINER = 1.5  # cut-off of a finer model over that of the one before
TINY = 1e-300  # keeps the division by a speed next to none from overflow


@dataclass(frozen=True, slots=True)
class Fineness:
    """How good a model must be: relative ``accuracy`` of every frequency up to ``frequency`` [Hz].

    ``spin`` [rad/s]: highest speed. ``accuracy`` None: standard elements between the nodes of the
    mesh, whatever they give. ``finer``: steps beyond that; each is one degree more in every element,
    or half the length of standard ones, and a cut-off ``FINER`` times as high.
    """

    frequency: float
    spin: float = 0.0
    accuracy: float | None = None
    finer: int = 0

    @property
    def band(self) -> float:
        """The highest frequency asked for [rad/s]."""
        return 2.0 * math.pi * self.frequency

    @property
    def cutoff(self) -> float:
        """Up to which free-free modes are kept [rad/s]: the error by those left out falls with its
        fourth power."""
        factor = STANDARD_CUTOFF if self.accuracy is None else CUTOFF * self._finer**0.25
        return FINER**self.finer * factor * self.band

    @property
    def weightless(self) -> float:
        """The frequency lent to what has no mass [rad/s], far above the band: the error by that
        falls with its square."""
        return 2.0 * math.pi * WEIGHTLESS * (self._finer**0.5 * self.frequency)

    @property
    def gyroscopic(self) -> float:
        """Energy f K⁻¹ f [s²] from which gyroscopic forces f are answered, with standard elements
        all of them: without its answer Ω s f of a mode of unit mass moves its pole s by
        Ω² f K⁻¹ f / 2 of itself."""
        allowed = 0.0 if self.accuracy is None else 2.0 * SHARE * USUAL / self._finer
        return allowed / self.spin**2 if self.spin**2 > TINY * allowed else math.inf

    @property
    def _finer(self) -> float:
        """How many times as accurate as usual, at least once."""
        return 1.0 if self.accuracy is None else max(1.0, USUAL / self.accuracy)


def sleeve_mass(sleeve: Sleeve, held: float, fineness: Fineness) -> float:
    """Its mass, or where it has none what lifts its own frequency far above the band [kg].

    ``held``: the stiffness that holds it [N/m].
    """
    return sleeve.mass if sleeve.mass > 0.0 else held / fineness.weightless**2
