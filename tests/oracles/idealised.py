"""Materials beyond any real one, for limits in which a closed form holds: massless, rigid."""

from __future__ import annotations

from bearings.materials import Material


def idealised(
    name: str,
    young_modulus: float,
    poisson_ratio: float,
    density: float,
    thermal_expansion: float | None = None,
) -> Material:
    """A material whose values are not checked."""
    made = object.__new__(Material)
    for key, value in {
        "name": name,
        "young_modulus": young_modulus,
        "poisson_ratio": poisson_ratio,
        "density": density,
        "thermal_expansion": thermal_expansion,
    }.items():
        object.__setattr__(made, key, value)
    return made


def times(material: Material, *, young_modulus: float = 1.0, density: float = 1.0) -> Material:
    """A material with constants larger by these factors, unchecked."""
    return idealised(
        material.name,
        young_modulus * material.young_modulus,
        material.poisson_ratio,
        density * material.density,
        material.thermal_expansion,
    )
