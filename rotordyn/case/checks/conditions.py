"""Conditions against the machine: a frame its supports allow, a force that something carries."""

from __future__ import annotations

from rotordyn.analysis.formulation import ROTATING
from rotordyn.case.faults import Faults
from rotordyn.case.node import Node
from rotordyn.case.schema.case import ConditionsEntry
from rotordyn.case.schema.spindle import SpindleEntry
from rotordyn.case.schema.support import ENTRIES, SupportEntry


def conditions(entry: ConditionsEntry, spindle: SpindleEntry, root: Node, faults: Faults) -> None:
    """The turning frame needs even supports, an axial force something that holds the shaft."""
    if entry.formulation == ROTATING:
        for support in spindle.supports:
            _even(support, root, faults)
    if not spindle.bearings and not any(s.stiffness.xx for s in spindle.supports):
        for key, acts in (("axial_force", entry.axial_force), ("gravity", entry.gravity != "none")):
            if acts:
                faults.at(
                    root,
                    ("conditions", key),
                    "nothing holds the shaft along its axis: given "
                    f"'{root.at('conditions', key).raw}'; allowed: with bearings, or with a "
                    "support that has the stiffness xx",
                )


def _even(support: SupportEntry, root: Node, faults: Faults) -> None:
    """Bearings under axial load are even; supports are where their matrices say so."""
    from rotordyn.elements.support import answers_alike, node_matrix

    for name in ("stiffness", "damping"):
        given = {pair: getattr(getattr(support, name), key) for key, pair in ENTRIES.items()}
        known = {pair: value for pair, value in given.items() if value is not None}
        if not answers_alike(node_matrix(known)):
            faults.at(
                root,
                ("conditions", "formulation"),
                f"the {name} of support '{support.name}' differs between directions about the "
                "axis, which a turning frame cannot describe: given 'rotating'; allowed: inertial",
            )
