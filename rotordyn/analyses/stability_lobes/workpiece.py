"""Material of a workpiece, with its cutting coefficients."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from rotordyn.description import Description
from rotordyn.quantity import Items, Key, Quantity

CuttingCoefficient = Annotated[float, Quantity("pressure", above="0 Pa", at_most="100 GPa")]
RadialCoefficient = Annotated[float, Quantity("pressure", at_least="0 Pa", at_most="100 GPa")]


@dataclass(frozen=True, slots=True)
class Coefficients(Description):
    """Cutting coefficients given by one source."""

    tangential: Annotated[CuttingCoefficient, "tangential cutting coefficient Ktc"]
    radial: Annotated[RadialCoefficient, "radial cutting coefficient Krc"]
    source: Annotated[str, "where it comes from"] = ""


@dataclass(frozen=True, slots=True)
class Workpiece(Description):
    """Cutting coefficients of one material by several sources, which differ by up to a factor 2."""

    name: Annotated[str, Key(default=""), "name of the material in reports"]
    coefficients: Annotated[
        tuple[Coefficients, ...], Items(), "cutting coefficients, one entry for each source"
    ]

    @property
    def pairs(self) -> tuple[tuple[float, float], ...]:
        """Tangential and radial coefficient [Pa] of every source; first the pair of the median
        tangential one, of two the higher."""
        others = sorted((source.tangential, source.radial) for source in self.coefficients)
        median = others.pop(len(others) // 2)
        return (median, *others)
