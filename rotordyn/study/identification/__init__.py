"""Numbers of a case sought so that the machine shows what was measured, and how sure they are.

``measurement`` the contract of a measurement, ``along_axis``, ``responses``, ``measured_modes`` and
``numbers`` its kinds, ``paired_modes`` modes of responses beside those of a machine, ``kinds`` what
files say of them, ``unknown`` what is sought, ``trial`` a machine with trial values, ``weighing``
differences without tare and drift, ``problem`` predictions and derivatives, ``search`` the best
values, ``models`` hypotheses and phases, ``searches`` those of all models, kept on disk,
``certainty`` how sure values are, ``profile`` the same without straight lines, ``criterion`` when a
model suffices, ``prediction`` what it would show, ``identification`` what all that comes to,
``solve`` the call that joins these.
"""

from rotordyn.study.identification.along_axis import AxialCurve, AxialStiffness, NoLoad
from rotordyn.study.identification.identification import Identification
from rotordyn.study.identification.measured_modes import Modes
from rotordyn.study.identification.models import Phase
from rotordyn.study.identification.numbers import Numbers
from rotordyn.study.identification.prediction import Predicted
from rotordyn.study.identification.responses import Responses
from rotordyn.study.identification.solve import identify
from rotordyn.study.identification.stop_met import StopMet
from rotordyn.study.identification.unknown import Unknown

__all__ = [
    "AxialCurve",
    "AxialStiffness",
    "Identification",
    "Modes",
    "NoLoad",
    "Numbers",
    "Phase",
    "Predicted",
    "Responses",
    "StopMet",
    "Unknown",
    "identify",
]
