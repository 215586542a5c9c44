"""Results of the analyses: frozen arrays that know their dimensions and units, nothing else.

Every field is declared with its dimensions and unit (``result``). A value that does not exist is
NaN only where an ``outcome`` of the same speed, an ``absence``, or the label of the same mode says
why.
"""

from __future__ import annotations

from rotordyn.analysis.results.bearings import (
    ControlResult,
    PreloadResult,
)
from rotordyn.analysis.results.modes import (
    OVERDAMPED,
    ROUNDING,
    CampbellResult,
    TurningCampbellResult,
    is_overdamped,
)
from rotordyn.analysis.results.responses import (
    FrequencyResponse,
    FrfResult,
    InertanceResult,
    MobilityResult,
    TurningFrfResult,
    UnbalanceResult,
)
from rotordyn.analysis.results.single_bearing import (
    BearingMapResult,
    MomentMapResult,
    RadialMapResult,
)
from rotordyn.analysis.results.statics import (
    SectionForcesResult,
    StiffnessResult,
)

Result = (
    PreloadResult
    | CampbellResult
    | FrequencyResponse
    | StiffnessResult
    | SectionForcesResult
    | UnbalanceResult
    | BearingMapResult
    | ControlResult
)

__all__ = [
    "OVERDAMPED",
    "ROUNDING",
    "BearingMapResult",
    "CampbellResult",
    "ControlResult",
    "FrequencyResponse",
    "FrfResult",
    "InertanceResult",
    "MobilityResult",
    "MomentMapResult",
    "PreloadResult",
    "RadialMapResult",
    "Result",
    "SectionForcesResult",
    "StiffnessResult",
    "TurningCampbellResult",
    "TurningFrfResult",
    "UnbalanceResult",
    "is_overdamped",
    "turning",
]


def turning(result: object) -> bool:
    """True where frequencies are those seen from the frame that turns with the shaft."""
    return isinstance(result, TurningCampbellResult | TurningFrfResult)
