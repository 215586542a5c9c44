"""Variants of a case: the same file with some entries replaced, or with one of several tools."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from rotordyn.case.faults import Faults
from rotordyn.case.node import Node, merged, overlaid
from rotordyn.case.override import apply
from rotordyn.case.varied import IN_FILES, from_top, turn_of

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


def from_the_top(root: Node, faults: Faults) -> Node:
    """Write the paths of overrides from the top of the case, and make those changes that concern
    neither its machine nor its tool."""
    tree = root.copy()
    for holder in (tree, *tree.entries("compare").values()):
        override = holder.entries("override")
        for path in sorted(override, key=turn_of):
            value, whole = override.pop(path), from_top(path, "spindle" in root.value, IN_FILES)
            if whole in override:
                given = whole.partition(".")
                why = f"given twice: '{given[2]}', with and without '{given[0]}.' before it"
                faults.at_key(value, why)
            override[whole] = value
    _settle(tree, faults)
    return tree


def _settle(tree: Node, faults: Faults) -> None:
    """Make the changes of overrides that concern neither machine nor tool."""
    override = tree.entries("override")
    for path in [*override]:
        if not path.startswith(("spindle.", "bearing.", "tool.")):
            apply({path: override.pop(path)}, tree, faults)


def overrides(root: Node, faults: Faults) -> dict[str, dict[str, Node]]:
    """Changes by their path within spindle, bearing and tool."""
    within: dict[str, dict[str, Node]] = {"spindle": {}, "bearing": {}, "tool": {}}
    for path, value in root.entries("override").items():
        part, _, rest = path.partition(".")
        within[part][rest] = value
        if root.child(part) is None and (root.child("spindle") or root.child("bearing")):
            faults.at_key(value, f"leads into the {part}, and this case has none: leave it out")
    return within


def variant_trees(root: Node, faults: Faults) -> dict[str, Node]:
    """Tree of each variant in ``compare`` of the case in ``root``, by name.

    Machine and title are replaced; overrides are merged path by path, conditions key by key at any
    depth; references are added. Every node keeps its place in the file.
    """
    trees = root.entries("compare").items()
    return {name: _changed(root, changes, faults) for name, changes in trees}


def _changed(root: Node, changes: Node, faults: Faults) -> Node:
    tree = root.copy()
    for key in ("compare", "title"):
        tree.value.pop(key, None)
    for key, value in changes.entries().items():
        if key == "conditions":
            tree.value[key] = overlaid(tree.child(key), value)
        else:
            tree.value[key] = merged(tree.child(key), value) if key in _MERGED else value
    _settle(tree, faults)
    return tree
