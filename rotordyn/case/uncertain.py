"""What of a case is not known for certain: hypotheses to choose from, numbers with tolerances."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any

from rotordyn.description import Description, Faults
from rotordyn.quantity import Whole

AS_USUAL = "as usual"
ALL = "all"
LEAST_SAMPLES, MOST_SAMPLES = 20, 100_000


class Worded:
    """Marks what files may also write as the words ``as usual``."""


@dataclass(frozen=True, slots=True)
class Uncertain(Description):
    """What of a case is uncertain: ``rotordyn run --interval`` says what comes of it.

    Paths are dotted, as ``vary`` takes them; ``*`` moves every item together. A tolerance is a
    text: ``± 5 %`` of the value, ``± 2 um``, ``+3/-2 deg``, ``24..28 deg``, ``factor 2``, or words,
    ``least..most``.
    """

    as_usual: Annotated[
        bool,
        "the usual uncertainties of such a machine, in addition to those given "
        "([list](howto/intervals.md#as-usual))",
    ] = False
    hypotheses: Annotated[
        Mapping[str, tuple[Any, ...] | str],
        "condition such as `kinematics`, or dotted path, to its possible values, or `all`",
    ] = field(default_factory=dict)
    tolerances: Annotated[
        Mapping[str, str],
        "dotted path to a tolerance: `± 5 %`, `+3/-2 deg`, `24..28 deg`, `factor 2`",
    ] = field(default_factory=dict)
    samples: Annotated[
        Annotated[int, Whole(LEAST_SAMPLES, MOST_SAMPLES)] | None,
        "machines drawn at random within the tolerances (Latin hypercube), instead of a few runs",
    ] = None
    seed: Annotated[int, Whole(0, 2**31 - 1), "random seed of the samples"] = 0
    sensitivities: Annotated[
        Mapping[str, str | None],
        "dotted path to the range over which its influence is computed, as a tolerance, or nothing",
    ] = field(default_factory=dict)

    def _faults(self) -> Faults:
        if not (self.as_usual or self.hypotheses or self.tolerances or self.sensitivities):
            yield (), "nothing is uncertain: give hypotheses, tolerances, or `as usual`"
        if self.samples is not None and not (self.tolerances or self.as_usual):
            yield ("samples",), "no tolerances to sample: given {given}"
