"""Closed approximation of a radially loaded ball bearing at high speed, after Debongnie (1992).

Balls feel their centrifugal force and touch both races in the middle plane; the load of a ball is
a power of its approach, and an integral around the ring replaces the sum over balls. Theory,
corrections and limits: ``docs/theory/debongnie.md``. Equation numbers are those of the report.
"""

from bearings.debongnie.ball import (
    HIGHEST,
    LOWEST,
    PowerLaw,
    deflection,
    fitted_power_law,
    load,
    power_law,
)
from bearings.debongnie.equivalent import LIFE, equivalent_factors, race_weights
from bearings.debongnie.ring import VARIANTS, Approximation, RadialRing, approximate
from bearings.debongnie.zone import Distribution, distribution, peak

__all__ = [
    "HIGHEST",
    "LIFE",
    "LOWEST",
    "VARIANTS",
    "Approximation",
    "Distribution",
    "PowerLaw",
    "RadialRing",
    "approximate",
    "deflection",
    "distribution",
    "equivalent_factors",
    "fitted_power_law",
    "load",
    "peak",
    "power_law",
    "race_weights",
]
