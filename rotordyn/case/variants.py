"""Variants of a case: the same file with some entries replaced, or with one of several tools."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from rotordyn.case.faults import Faults
from rotordyn.case.node import Node, merged, overlaid

_MERGED = ("override", "references")


def tools_compared(root: Node, faults: Faults) -> Node:
    """Replace ``tools`` of the case in ``root`` by one variant for each."""
    tools = root.child("tools")
    if tools is None:
        return root
    content = {key: value for key, value in root.value.items() if key != "tools"}
    for key in ("tool", "compare"):
        if key in content:
            faults.at_key(root.at(key), "given beside tools, which are compared: leave one out")
            return replace(root, value=content)
    if not isinstance(tools.value, list) or not tools.value:
        faults.at(tools, "not a list of tools: allowed: names or paths, at least one")
        return replace(root, value=content)
    variants: dict[str, Node] = {}
    for number, item in enumerate(tools.value, start=1):
        name = Path(item.value).stem if isinstance(item.value, str) else f"tool {number}"
        if name in variants:
            faults.at(item, f"tool given twice: '{name}'")
        variants[name] = replace(item, value={"tool": item})
    content["tool"], content["compare"] = tools.value[0], replace(tools, value=variants)
    return replace(root, value=content)


def unprefixed(root: Node, faults: Faults) -> Node:
    """Remove the optional prefix ``spindle.`` (``bearing.``) from the paths of overrides."""
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
    """Tree of each variant in ``compare`` of the case in ``root``, by name.

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
