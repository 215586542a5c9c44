"""Life of a bearing, its static safety, and the frequencies of its defects.

Ratings of a bearing from its grooves (ISO 281, ISO 76), lives from the ball loads of a state
(ISO/TS 16281), their modification by the lubricant, spectra and sets.
"""

from __future__ import annotations

from bearings.life.equivalent import (
    basic_life,
    dynamic_load,
    equivalent_static,
    pair_rating,
)
from bearings.life.modified import (
    HIGHEST_KAPPA,
    HOTTEST,
    LOWEST_KAPPA,
    fatigue_load_limit,
    life_factor,
    mean_life,
    reference_viscosity,
    reliability_factor,
    set_life,
    temperature_factor,
    viscosity_ratio,
)
from bearings.life.passing import Frequencies, frequencies, nominal_frequencies
from bearings.life.rating import dynamic_rating, geometry_factor, static_rating
from bearings.life.reference import (
    ReferenceLife,
    ball_ratings,
    life_of,
    reference_life,
    static_safety,
)

__all__ = [
    "HIGHEST_KAPPA",
    "HOTTEST",
    "LOWEST_KAPPA",
    "Frequencies",
    "ReferenceLife",
    "ball_ratings",
    "basic_life",
    "dynamic_load",
    "dynamic_rating",
    "equivalent_static",
    "fatigue_load_limit",
    "frequencies",
    "geometry_factor",
    "life_factor",
    "life_of",
    "mean_life",
    "nominal_frequencies",
    "pair_rating",
    "reference_life",
    "reference_viscosity",
    "reliability_factor",
    "set_life",
    "static_rating",
    "static_safety",
    "temperature_factor",
    "viscosity_ratio",
]
