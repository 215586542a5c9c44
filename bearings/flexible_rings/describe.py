"""Description of the rings of a bearing, and of the shaft and housing that back them (SI)."""

from __future__ import annotations

from dataclasses import dataclass, fields
from itertools import pairwise
from typing import NamedTuple

from bearings.arguments import finite
from bearings.errors import InvalidBearing, shown
from bearings.materials import STEEL, Material

ENDS = ("free", "clamped")
TOUCHING = 1e-3  # of the width: rings with a smaller gap touch
LENGTHS = ("width", "seat_diameter", "backing_diameter", "backing_length", "shoulder_diameter")


class Neighbour(NamedTuple):
    """Another ring of the same shape on the same shaft or in the same housing, its balls equally
    loaded; ``distance`` of the middles [m], towards +x of the bearing; ``mirrored``: its bearing
    takes thrust in the other direction."""

    distance: float
    mirrored: bool = False


@dataclass(frozen=True, slots=True)
class ElasticRing:
    """One ring, and the shaft or housing it sits on as one body with it.

    Parameters
    ----------
    width : of the ring [m]
    seat_diameter : bore of an inner ring, outside of an outer ring [m]
    backing_diameter : bore of the shaft under an inner ring (0: solid), outside of the housing
        around an outer ring [m]
    backing_length : of the piece of shaft or housing, the ring at its middle [m]; None: its
        diameter beyond the ring on either side, a length along which the deformation decays. With
        neighbours it reaches as far beyond the outermost of them
    ends : "free": the groove moves relative to the mean motion of the backing under the ring,
        which is the motion of the axis in a beam model; "clamped": the far ends of the backing
        are fixed, and grooves move relative to these
    shoulder_diameter : where the groove ends, on both sides [m]; None: that of the bearing,
        else at 60°, or 20° beyond the free contact angle if that is more
    backing_material : isotropic; the ring is of the ring material of its bearing, as its contacts
    neighbours : rings that deform the same backing

    Raises
    ------
    InvalidBearing : a number that is not finite or out of range, an unknown word, neighbours that
        overlap
    """

    width: float
    seat_diameter: float
    backing_diameter: float
    backing_length: float | None = None
    ends: str = "free"
    shoulder_diameter: float | None = None
    backing_material: Material = STEEL
    neighbours: tuple[Neighbour, ...] = ()

    def __post_init__(self) -> None:
        for name in LENGTHS:
            value = getattr(self, name)
            if value is None and type(self).__dataclass_fields__[name].default is None:
                continue
            low = 0.0 if name == "backing_diameter" else 1e-4
            if not (finite(value) and low <= value <= 10.0):
                rule = f"a length from {low:g} m to 10 m"
                raise InvalidBearing(f"{name} of a ring must be {rule}, got {shown(value)}")
        if self.ends not in ENDS:
            raise InvalidBearing(f"ends must be one of {', '.join(ENDS)}, got {shown(self.ends)}")
        material: object = self.backing_material
        if not isinstance(material, Material):
            raise InvalidBearing(
                f"backing_material must be a bearings.Material, got {shown(material)}"
            )
        if self.backing_diameter == self.seat_diameter:
            raise InvalidBearing(
                "backing_diameter equals that of the seat: no material is left between them"
            )
        if self.length < self.width:
            raise InvalidBearing(
                f"backing_length must be at least the width of the ring, {self.width * 1e3:g} mm, "
                f"got {self.length * 1e3:g} mm"
            )
        self._check_neighbours()

    def _check_neighbours(self) -> None:
        given: tuple[object, ...] = self.neighbours
        for item in given:
            if not (isinstance(item, Neighbour) and finite(item.distance)):
                raise InvalidBearing(
                    f"neighbours of a ring must be Neighbour(distance, mirrored), got {shown(item)}"
                )
        row = sorted(self.places)
        if any(b - a < (1.0 - TOUCHING) * self.width for a, b in pairwise(row)):
            raise InvalidBearing(
                f"rings {self.width * 1e3:g} mm wide would overlap: neighbours must be at least "
                f"that far apart, got {shown([item.distance for item in self.neighbours])} m"
            )

    @property
    def places(self) -> tuple[float, ...]:
        """Middles of the rings on this backing along the axis [m], first that of this ring, 0."""
        return 0.0, *(neighbour.distance for neighbour in self.neighbours)

    @property
    def length(self) -> float:
        """Length of the piece of shaft or housing [m]."""
        if self.backing_length is not None:
            return self.backing_length
        return self.width + 2.0 * max(self.seat_diameter, self.backing_diameter)


@dataclass(frozen=True, slots=True)
class FlexibleRings:
    """Which rings of a bearing deform under the loads of its balls; None: rigid.

    Raises
    ------
    InvalidBearing : something that is no ``ElasticRing``; none at all
    """

    inner: ElasticRing | None = None
    outer: ElasticRing | None = None

    def __post_init__(self) -> None:
        for item in fields(self):
            ring = getattr(self, item.name)
            if not (ring is None or isinstance(ring, ElasticRing)):
                raise InvalidBearing(f"{item.name} must be an ElasticRing, got {shown(ring)}")
        if self.inner is None and self.outer is None:
            raise InvalidBearing("flexible rings without a ring: give inner, outer or both")
