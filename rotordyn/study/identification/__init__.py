"""Identification: values of a case with which it reproduces measurements, and their uncertainty.

``measurement`` is the contract of a measurement; ``along_axis``, ``responses``, ``measured_modes``,
``stop_reached`` and ``numbers`` are its kinds, ``kinds`` makes them from files; ``paired_modes``
pairs measured modes with computed ones. ``unknown`` is what is sought, ``trial`` a machine with
trial values, ``weighing`` weighs differences without tare and drift, ``problem`` has predictions
and derivatives, ``search`` fits the unknowns, ``models`` holds hypotheses and phases, ``searches``
runs the searches of all models and keeps them on disk. ``certainty`` has linear intervals,
``profile`` those by profile likelihood, ``criterion`` decides whether a model suffices,
``prediction`` computes numbers of the identified machine, ``identification`` is the result,
``solve`` the call.
"""

from rotordyn.study.identification.along_axis import AxialCurve, AxialStiffness, NoLoad
from rotordyn.study.identification.identification import Identification
from rotordyn.study.identification.measured_modes import Modes
from rotordyn.study.identification.models import Phase
from rotordyn.study.identification.numbers import Numbers
from rotordyn.study.identification.prediction import Predicted
from rotordyn.study.identification.responses import Responses
from rotordyn.study.identification.solve import identify
from rotordyn.study.identification.stop_reached import StopReached
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
    "StopReached",
    "Unknown",
    "identify",
]
