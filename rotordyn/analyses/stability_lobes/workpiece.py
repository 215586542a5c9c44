"""A material that is cut, with its cutting coefficients."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from rotordyn.description import Description
from rotordyn.quantity import Items, Key, Quantity

CuttingCoefficient = Annotated[float, Quantity("pressure", above="0 Pa", at_most="100 GPa")]
RadialCoefficient = Annotated[float, Quantity("pressure", at_least="0 Pa", at_most="100 GPa")]


@dataclass(frozen=True, slots=True)
class Coefficients(Description):
    """What one source gives."""

    tangential: Annotated[CuttingCoefficient, "tangential cutting coefficient Ktc"]
    radial: Annotated[RadialCoefficient, "radial cutting coefficient Krc"]
    source: Annotated[str, "where it comes from"] = ""


@dataclass(frozen=True, slots=True)
class Workpiece(Description):
    """Cutting coefficients of one material by several sources, which differ by up to a factor 2."""

    name: Annotated[str, Key(default=""), "of the material, as reports call it"]
    coefficients: Annotated[tuple[Coefficients, ...], Items(), "of every source"]

    @property
    def pairs(self) -> tuple[tuple[float, float], ...]:
        """Tangential and radial [Pa] of every source; first that of the middle tangential one, the
        higher one of two."""
        every = sorted((one.tangential, one.radial) for one in self.coefficients)
        middle = every.pop(len(every) // 2)
        return (middle, *every)
