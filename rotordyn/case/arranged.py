"""Values that follow from a bearing set in a file: thrusts, and the preload of a class."""

from __future__ import annotations

from dataclasses import replace

from rotordyn import units
from rotordyn.case.faults import Faults
from rotordyn.case.node import Node
from rotordyn.machine.bearing_set import CLASSES, fitting

WORDS = {"+": "+x", "-": "-x"}
SIGNS = {word: sign for sign, word in WORDS.items()}


def arrange(tree: Node, faults: Faults) -> None:
    """Set missing thrusts of the bearings of a set by its designation, and the force of its preload
    class.

    If the designation does not fit the bearings, that is the fault, not the missing thrusts.
    """
    if tree.child("arrangement") is None:
        return
    given = tree.value["arrangement"]
    name, names = given.child("set"), [each.value for each in given.listed("bearings")]
    seats = {seat.name: seat for seat in tree.listed("bearings") if seat.entries()}
    members = [seats[each] for each in names if isinstance(each, str) and each in seats]
    if name is not None:
        _thrusts(name, members)
    _sleeves(tree, given, faults)
    if members:
        _class(given, members, faults)


def _sleeves(tree: Node, given: Node, faults: Faults) -> None:
    """Report a sleeve with the name of the one that the set creates, which would replace it."""
    called = given.child("name")
    word = "set" if called is None else called.value
    for sleeve in tree.listed("sleeves"):
        name = sleeve.child("name")
        if name is not None and name.value == word and given.child("preload") is not None:
            faults.at(
                name,
                f"the arrangement defines the sleeve {units.shown(word)}: give the values of this "
                "sleeve in the preload of the arrangement, or rename one of the two",
            )


def _thrusts(name: Node, seats: list[Node]) -> None:
    """Set missing thrusts by the designation, in the orientation of those that are given."""
    given = [seat.child("thrust") for seat in seats]
    signs = fitting(name.value, [SIGNS.get(str(g.value), "?") if g else "" for g in given])
    for seat, before, sign in zip(seats, given, signs, strict=True):
        if before is None:
            seat.value["thrust"] = replace(name, value=WORDS[sign], shared=True)


def _class(given: Node, seats: list[Node], faults: Faults) -> None:
    """Replace a preload class by the force that the model of the bearings lists for it."""
    preload = given.entries("preload")
    if "class" not in preload:
        return
    asked = preload["class"]
    printed = [printed_preloads(seat) for seat in seats]
    why = _unclear(asked, seats, printed)
    if not why and "class_force" in preload:
        why = "a class gives a class_force: given both; leave one of the two out"
    if why:
        faults.at(asked, why)
        del preload["class"]
        preload["class_force"] = replace(asked, value="1 N")  # its fault is reported
    else:
        preload["class_force"] = replace(printed[0][asked.value], key=asked.key)


def _unclear(asked: Node, seats: list[Node], printed: list[dict[str, Node]]) -> str:
    """Reason why the class defines no force; empty if it does."""
    for seat, known in zip(seats, printed, strict=True):
        if asked.value not in [*known]:
            allowed = ", ".join(known) or (
                "none, its model prints no preloads: give class_force: FORCE instead"
            )
            return (
                f"bearing {seat.name} has no such class of preload: given "
                f"{units.shown(asked.plain())}; allowed: {allowed}"
            )
    forces = dict.fromkeys(str(known[asked.value].value) for known in printed)
    if len(forces) == 1:
        return ""
    return (
        f"the bearings of the set have other forces of this class: {', '.join(forces)}; give a "
        "class_force instead"
    )


def printed_preloads(seat: Node) -> dict[str, Node]:
    """Preload forces that the model of a bearing lists, by class."""
    own = seat.child("model", "preloads") is not None
    forces = seat.listed("model", *(() if own else ("estimate",)), "preloads")
    return dict(zip(CLASSES, forces, strict=False))
