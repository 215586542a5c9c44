"""Variants of a case: the same file with some entries replaced, or with one of several tools."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from rotordyn.case.expand import Reader, leads_into
from rotordyn.case.faults import Faults
from rotordyn.case.keys import COMMON, bearing_class, kinds_with
from rotordyn.case.node import Node, merged, overlaid
from rotordyn.case.override import apply
from rotordyn.case.paths import IN_FILES, from_top, no_root, order_of
from rotordyn.case.reading import spread
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.tool import Tool

_MERGED = ("override", "references")
SHARED = ("speeds", "analyses")  # of the case, with all variants


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
    """Write the paths of overrides from the top of the case."""
    tree = root.copy()
    for holder in (tree, *tree.entries("compare").values()):
        override = holder.entries("override")
        from_case = {path: from_top(path, "spindle" in root.value, IN_FILES) for path in override}
        for path, whole in sorted(from_case.items(), key=lambda each: order_of(each[1].split("."))):
            value = override.pop(path)
            if whole != path and (why := _no_root(path.partition(".")[0], root)):
                faults.at_key(value, why)
                continue
            if holder is not tree and whole.partition(".")[0] in SHARED:
                faults.at_key(value, "variants share the speeds and analyses of the case")
            if whole in override:
                given = whole.partition(".")
                why = f"given twice: '{given[2]}', with and without '{given[0]}.' before it"
                faults.at_key(value, why)
            override[whole] = value
    return tree


def _no_root(step: str, root: Node) -> str:
    if "spindle" in root.value:
        return no_root(step, Spindle)
    return "" if kinds_with(step) else no_root(step, bearing_class(None))


def of_machine(root: Node, reader: Reader) -> dict[str, Node]:
    """Changes of overrides by their path within the machine; all others are made in ``root``.

    Those within the tool are kept, as variants may have another one.
    """
    override, within = root.entries("override"), {}
    machine = "spindle" if root.child("spindle") else "bearing"
    for path in [*override]:
        room, dot, rest = path.partition(".")
        change = override[path] if room == "tool" else override.pop(path)
        if dot and room == machine:
            override[path] = within[rest] = change
        elif dot and room == "references" and machine == "spindle" and not root.child(room):
            within[path] = change  # the case has none of its own
        elif dot and room in ("spindle", "bearing", "tool") and root.child(room) is None:
            reader.faults.at_key(change, f"leads into the {room}, and this case has none")
        elif path == "tool" and change.value is None:
            root.value.pop("tool", None)
        else:
            if room == "tool" and leads_into(rest, [each.fills for each in COMMON[Tool]]):
                tool = root.value["tool"] = reader.opened(room, root.at(room))
                spread(Tool, tool)
            apply({path: change}, root, reader.faults, reader.opened)
    return within


def variant_trees(root: Node) -> dict[str, Node]:
    """Tree of each variant in ``compare`` of the case in ``root``, by name.

    Machine and title are replaced; overrides are merged path by path, conditions key by key at any
    depth; references are added. Every node keeps its place in the file.
    """
    return {name: _changed(root, changes) for name, changes in root.entries("compare").items()}


def with_whole_conditions(root: Node) -> Node:
    """The case in ``root`` with the conditions of each variant laid over its own, by which alone
    they may be incomplete."""
    compare, base = root.child("compare"), root.child("conditions")
    if compare is None or base is None or not isinstance(compare.value, dict):
        return root
    variants = dict(compare.value)
    for name, variant in variants.items():
        if (more := variant.child("conditions")) is not None:
            laid = {**variant.value, "conditions": overlaid(base, more)}
            variants[name] = replace(variant, value=laid)
    whole = replace(compare, value=variants)
    return replace(root, value={**root.value, "compare": whole})


def _changed(root: Node, changes: Node) -> Node:
    tree = root.copy()
    for key in ("compare", "title"):
        tree.value.pop(key, None)
    for key, value in changes.entries().items():
        if key == "conditions":
            tree.value[key] = overlaid(tree.child(key), value)
        else:
            tree.value[key] = merged(tree.child(key), value) if key in _MERGED else value
    return tree
