"""The variants of a case: the same file with some of its entries replaced, or with one of several
tools each."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from rotordyn.case.faults import Faults
from rotordyn.case.node import Node, merged, overlaid

_MERGED = ("override", "references")


def tools_compared(root: Node, faults: Faults) -> Node:
    """The case in ``root`` with a variant for each of its ``tools`` in place of these."""
    tools = root.child("tools")
    if tools is None:
        return root
    held = {key: value for key, value in root.value.items() if key != "tools"}
    for key in ("tool", "compare"):
        if key in held:
            faults.at_key(root.at(key), "given beside tools, which are compared: leave one out")
            return replace(root, value=held)
    if not isinstance(tools.value, list) or not tools.value:
        faults.at(tools, "not a list of tools: allowed: names or paths, at least one")
        return replace(root, value=held)
    variants: dict[str, Node] = {}
    for number, item in enumerate(tools.value, start=1):
        name = Path(item.value).stem if isinstance(item.value, str) else f"tool {number}"
        if name in variants:
            faults.at(item, f"tool given twice: '{name}'")
        variants[name] = replace(item, value={"tool": item})
    held["tool"], held["compare"] = tools.value[0], replace(tools, value=variants)
    return replace(root, value=held)


def unprefixed(root: Node, faults: Faults) -> Node:
    """The case in ``root``, the paths of its overrides without ``spindle.`` (``bearing.``) before
    them: files may write either."""
    tree = root.copy()
    machine = "spindle" if root.child("spindle") is not None else "bearing"
    for holder in (tree, *tree.entries("compare").values()):
        _cut(holder, machine, faults)
    return tree


def _cut(holder: Node, machine: str, faults: Faults) -> None:
    override = holder.child("override")
    if override is None or not isinstance(override.value, dict):
        return
    short: dict[str, Node] = {}
    for path, value in override.value.items():
        name = path.removeprefix(f"{machine}.") if isinstance(path, str) else path
        if name in short:
            faults.at_key(value, f"given twice: '{name}', with and without '{machine}.' before it")
        short[name] = value
    override.value = short


def variant_trees(root: Node) -> dict[str, Node]:
    """By name, the tree that each entry of ``compare`` makes of the case in ``root``.

    Machine and title are replaced; overrides are merged path by path, conditions key by key at any
    depth; references are added. Every node keeps its place in the file.
    """
    return {name: _changed(root, changes) for name, changes in root.entries("compare").items()}


def _changed(root: Node, changes: Node) -> Node:
    tree = root.copy()
    del tree.value["compare"]
    for key, value in changes.entries().items():
        if key == "conditions":
            tree.value[key] = overlaid(tree.child(key), value)
        else:
            tree.value[key] = merged(tree.child(key), value) if key in _MERGED else value
    return tree
