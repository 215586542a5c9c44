"""Stable depth of cut over speed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.results.declaration import Absence, coordinate, quantity
from rotordyn.results.display import MEGAPASCAL, MILLIMETRE, Shown
from rotordyn.results.kinds import Array, Words

REMOVAL = Shown("cm³/min", 60e6)


STABLE = Absence("where no depth is unstable", beside="loss")
ANY_DEPTH = Absence("where no depth is unstable", by=("cutting_speed",))


@dataclass(frozen=True)
class StabilityLobesResult:
    """Limits at ``cutting_speed``, each with the receptance of the machine at that speed; infinite
    where no depth is unstable.

    ``waves``: periods of the chatter from one tooth to the next, over the longest pitch.
    ``at_rest``: what the receptance of the machine at rest gives instead; ``even``: what as many
    evenly spaced teeth give, NaN where the teeth are evenly spaced; ``measured``: that of the
    tool on the measured spindle, NaN where none was. ``least``, ``most``:
    over the intervals of the case and all sources of the cutting coefficients. ``source``: those of
    a workpiece, that of the limits first; none where the case gives coefficients itself.
    ``pocket``: maxima of the depth over speed, the deepest first. ``error``: largest change of a
    limit at some speeds by a model of twice the frequencies, over the limit.
    """

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    outcome: Words = quantity("speed", unit="", label="outcome")
    cutting_speed: Array = coordinate("cutting_speed", unit="rad/s", label="speed of the cutter")
    cutting_outcome: Words = quantity("cutting_speed", unit="", label="outcome")
    depth: Array = quantity(
        "cutting_speed",
        unit="m",
        label="stable depth of cut",
        printed=MILLIMETRE,
        infinite=(Absence("where no depth is unstable", beside="loss"),),
    )
    chatter: Array = quantity(
        "cutting_speed", unit="Hz", label="chatter frequency", absent=(STABLE,)
    )
    waves: Array = quantity(
        "cutting_speed", unit="1", label="waves from tooth to tooth", absent=(STABLE,)
    )
    loss: Words = quantity("cutting_speed", unit="", label="loss of stability")
    mode_frequency: Array = quantity(
        "cutting_speed",
        unit="Hz",
        label="nearest mode",
        absent=(Absence("without a chatter frequency", beside="chatter"),),
    )
    mode_damping: Array = quantity(
        "cutting_speed",
        unit="1",
        label="its damping ratio",
        absent=(Absence("without a chatter frequency", beside="chatter"),),
    )
    removal: Array = quantity(
        "cutting_speed",
        unit="m³/s",
        label="removal rate at the limit",
        printed=REMOVAL,
        infinite=(Absence("where no depth is unstable", beside="loss"),),
    )
    at_rest: Array = quantity(
        "cutting_speed",
        unit="m",
        label="stable depth of cut by the receptance at rest",
        printed=MILLIMETRE,
        infinite=(ANY_DEPTH,),
    )
    even: Array = quantity(
        "cutting_speed",
        unit="m",
        label="stable depth of cut of evenly spaced teeth",
        printed=MILLIMETRE,
        absent=(Absence("where the teeth are evenly spaced"),),
        infinite=(ANY_DEPTH,),
    )
    measured: Array = quantity(
        "cutting_speed",
        unit="m",
        label="stable depth of cut on the measured spindle",
        printed=MILLIMETRE,
        absent=(Absence("without a measured spindle"),),
        infinite=(ANY_DEPTH,),
    )
    least: Array = quantity(
        "cutting_speed",
        unit="m",
        label="least limit of the band",
        printed=MILLIMETRE,
        infinite=(ANY_DEPTH,),
    )
    most: Array = quantity(
        "cutting_speed",
        unit="m",
        label="largest limit of the band",
        printed=MILLIMETRE,
        infinite=(ANY_DEPTH,),
    )
    workpiece: str = quantity(unit="", label="material of the workpiece")
    source: NDArray[np.int_] = coordinate("source", unit="", label="source of the coefficients")
    tangential: Array = quantity(
        "source", unit="Pa", label="tangential cutting coefficient", printed=MEGAPASCAL
    )
    radial: Array = quantity(
        "source", unit="Pa", label="radial cutting coefficient", printed=MEGAPASCAL
    )
    pocket: NDArray[np.int_] = coordinate("pocket", unit="", label="pocket")
    pocket_speed: Array = quantity("pocket", unit="rad/s", label="speed of the cutter")
    pocket_depth: Array = quantity(
        "pocket", unit="m", label="stable depth of cut", printed=MILLIMETRE
    )
    pocket_removal: Array = quantity(
        "pocket", unit="m³/s", label="removal rate at the limit", printed=REMOVAL
    )
    pocket_from: Array = quantity("pocket", unit="rad/s", label="speed from which 80 % of it hold")
    pocket_to: Array = quantity("pocket", unit="rad/s", label="speed to which 80 % of it hold")
    modelled: float = quantity(unit="Hz", label="frequency up to which the machine is modelled")
    error: float = quantity(unit="1", label="change of a limit by a finer model")
    error_asked: float = quantity(unit="1", label="largest change asked for")


def banded(result: StabilityLobesResult) -> bool:
    """Whether the case asks for a band, by intervals or by several sources."""
    return not np.allclose(result.least, result.most, rtol=1e-12, equal_nan=True)
