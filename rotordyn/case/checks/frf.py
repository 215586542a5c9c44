"""Frequency responses of a case: pairs that can be asked, slices that exist."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress

from rotordyn.analyses.frf.spec import ORDERS_TURNED, QUANTITIES
from rotordyn.case.agreement import uncoupled
from rotordyn.case.build.spindle import housing
from rotordyn.case.build.sweep import values
from rotordyn.case.checks.names import exists
from rotordyn.case.faults import Faults
from rotordyn.case.node import Node
from rotordyn.case.schema.analyses import FrfEntry, Place
from rotordyn.case.schema.case import CaseEntry
from rotordyn.case.schema.spindle import SpindleEntry
from rotordyn.errors import InvalidInput
from rotordyn.machine.housing import housed_motions
from rotordyn.machine.support import MOTIONS, LinearSupport, coupled_motions
from rotordyn.scene.formulation import ROTATING, turned

WAY = ("analyses", "frf")
_ALL_MOTIONS = frozenset(MOTIONS.values())


def slices(entry: FrfEntry, case: CaseEntry, root: Node, faults: Faults) -> None:
    """Slices lie within the speeds of the case, and something is asked in a frame that has it."""
    speeds = values(case.speeds)
    for index, speed in enumerate(entry.slices):
        if speeds and (speed < speeds[0] - 1e-6 or speed > speeds[-1] + 1e-6):
            way = (*WAY, "slices", index)
            faults.at(root, way, f"not within the speeds of the case: given '{root.at(*way).raw}'")
    if not any(root.at(*WAY).child(key) for key in ("pairs", "matrix")):
        faults.missing(root, (*WAY, "pairs"), "missing key: it must be given, or matrix")
    if not root.at(*WAY).child("frequencies"):
        if not root.at(*WAY).child("engine_orders"):
            faults.missing(
                root,
                (*WAY, "frequencies"),
                "missing key: it must be given, or engine_orders",
            )
        for key in ("slices", "measured"):
            if root.at(*WAY).child(key):
                faults.at_key(root, (*WAY, key), "needs frequencies, which are not given")
    if case.conditions.formulation == ROTATING and entry.engine_orders:
        faults.at_key(root, (*WAY, "engine_orders"), ORDERS_TURNED)
    if case.conditions.formulation == ROTATING and entry.quantity not in ("", QUANTITIES[0]):
        faults.at(root, (*WAY, "quantity"), f"{turned(entry.quantity)}: given '{entry.quantity}'")


def frf(
    entry: FrfEntry,
    spindle: SpindleEntry,
    points: list[str],
    supports: list[LinearSupport],
    root: Node,
    faults: Faults,
) -> None:
    """Points exist; every pair once, its ends in one motion or in motions that supports couple."""
    for index, pair in enumerate(entry.pairs):
        for key in ("response", "excitation"):
            point = getattr(pair, key).point
            exists(point, points, "point", root, (*WAY, "pairs", index, key), faults)
    for key in ("responses", "excitations") if entry.matrix else ():
        _listed(getattr(entry.matrix, key), key, points, root, faults)
    # a support whose faults are reported already might couple anything
    known = len(supports) == len(spindle.supports)
    coupled = coupled_motions(supports) | _housed(spindle) if known else _ALL_MOTIONS
    seen: set[str] = set()
    for index, pair in enumerate(entry.pairs):
        way = (*WAY, "pairs", index)
        text = f"{pair.response} / {pair.excitation}"
        if text in seen:
            faults.at(root, way, f"repeated: given '{text}'")
        seen.add(text)
        _coupled(pair.response, pair.excitation, coupled, root, way, faults)
    for response, excitation in entry.asked[len(seen) :]:
        _coupled(response, excitation, coupled, root, (*WAY, "matrix"), faults)


def _housed(spindle: SpindleEntry) -> frozenset[str]:
    """The motions of the housings that are without fault."""
    found = []
    for entry in spindle.housings:
        with suppress(InvalidInput):
            found.append(housing(entry))
    return housed_motions(found)


def _listed(
    places: Sequence[Place], key: str, points: list[str], root: Node, faults: Faults
) -> None:
    """Places of a matrix exist, each once."""
    for index, place in enumerate(places):
        way = (*WAY, "matrix", key, index)
        exists(place.point, points, "point", root, way, faults)
        if place.point and place in places[:index]:
            faults.at(root, way, f"repeated: given '{place}'")


def _coupled(
    response: Place,
    excitation: Place,
    coupled: frozenset[str],
    root: Node,
    way: tuple[object, ...],
    faults: Faults,
) -> None:
    if motions := uncoupled(response.direction, excitation.direction, coupled):
        one, other = motions
        faults.at(
            root,
            way,
            f"nothing couples {one} and {other}: given '{response} / {excitation}'; allowed: both "
            "ends in one of x; thx; y, z, thy, thz, or a support that couples them",
        )
