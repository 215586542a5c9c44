"""Conditions against the machine: a frame its supports allow, forces that something carries."""

from __future__ import annotations

from collections.abc import Sequence

from rotordyn.case.agreement import moved_along
from rotordyn.case.build.sweep import values
from rotordyn.case.faults import Faults
from rotordyn.case.node import Node
from rotordyn.case.schema.case import CaseEntry
from rotordyn.case.schema.conditions import ConditionsEntry
from rotordyn.case.schema.spindle import SpindleEntry
from rotordyn.machine.support import LinearSupport, coupled_motions, entry_name
from rotordyn.scene.formulation import ROTATING


def conditions(
    entry: ConditionsEntry,
    supports: Sequence[LinearSupport],
    spindle: SpindleEntry,
    root: Node,
    faults: Faults,
) -> None:
    """The turning frame needs even supports, an axial force something that holds the shaft."""
    if entry.formulation == ROTATING:
        for support in supports:
            _even(support, root, faults)
    held = any(s.along or "x" in s.rigid for s in supports)
    if spindle.bearings or held:
        return
    for key, acts in (("axial_force", entry.axial_force), ("gravity", entry.gravity != "none")):
        if acts:
            given = root.at("conditions", key).raw
            faults.at(
                root,
                ("conditions", key),
                f"nothing holds the shaft along its axis: given '{given}'; allowed: with bearings, "
                "or with a support that has the stiffness xx or is rigid in x; tension needs none",
            )


def _even(support: LinearSupport, root: Node, faults: Faults) -> None:
    """Bearings under axial load are even; supports are where their matrices say so."""
    import numpy as np

    from rotordyn.equation.support import answers_alike, support_matrices

    way = ("conditions", "formulation")
    if "bending" in coupled_motions([support]):
        faults.at(
            root,
            way,
            f"support '{support.name}' couples bending with another motion, which a turning frame "
            "cannot describe: given 'rotating'; allowed: inertial",
        )
        return
    uneven = next((p for p in ("yz", ("thy", "thz")) if len({*p} & {*support.rigid}) == 1), None)
    if uneven is not None:
        faults.at(
            root,
            way,
            f"support '{support.name}' holds only one of {' and '.join(uneven)} rigidly, which a "
            "turning frame cannot describe: given 'rotating'; allowed: inertial",
        )
    speeds = np.array(support.speeds or (0.0,))
    for name in ("stiffness", "damping"):
        if not answers_alike(support_matrices(support, name, speeds)):
            faults.at(
                root,
                way,
                f"the {name} of support '{support.name}' differs between directions about the "
                "axis, which a turning frame cannot describe: given 'rotating'; allowed: inertial",
            )


def sideways(
    entry: CaseEntry, supports: Sequence[LinearSupport], root: Node, faults: Faults
) -> None:
    """Bearings are solved under axial load alone: what moves along x must not push aside."""
    own = entry.conditions
    weighed = own.gravity != "none"
    if not moved_along(values(entry.speeds), own.bearings, own.axial_force, weighed):
        return
    for held in supports:
        if held.sideways:
            names = ", ".join(entry_name(*ends) for ends in held.sideways)
            faults.at_key(
                root,
                ("spindle",),
                f"support '{held.name}' pushes the shaft aside as its preload state moves it along "
                f"the axis ({names}): bearings are solved under axial load alone; leave these "
                "entries out, or set bearings: static without axial force and weight",
            )
