"""Reads the nodes of a file as descriptions of the machine and of the analyses.

The annotations of a description define what each of its keys takes; nothing else does. Every fault
is reported with its line. A faulty value is replaced by NaN, an empty text or None, with which no
comparison is true, so that the rules between the other values are still checked: a description read
from a file with faults serves for that alone.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, get_args, get_origin

from bearings.bearing import BallBearing
from rotordyn import units
from rotordyn.case.deeper import deeper, leads, nested
from rotordyn.case.document import TIGHT
from rotordyn.case.faults import Faults
from rotordyn.case.keys import COMMON, keys_of, kinds_with
from rotordyn.case.leaf import is_kind, leaf, limit_of, unknown, wanted
from rotordyn.case.node import UNKNOWN, Node, Read, matching
from rotordyn.description import Description, Path, filled, unchecked
from rotordyn.field import REQUIRED, Field, Refused, bare, found_in, members, metadata, optional
from rotordyn.quantity import Choice, Items, Quantity, Words, suggestion

if TYPE_CHECKING:
    from rotordyn.case.expand import Reader

_LISTED = 24
# Keys of earlier versions, by the entry that held them: what a case does without them.
RETIRED: dict[tuple[str, str], str] = {
    ("conditions", "shaft"): (
        "`shaft` is no longer a key: the shaft is modelled by finite elements, refined until the "
        "required accuracy is reached; leave it out, and give accuracy: 1e-8 instead of exact"
    ),
    ("frf", "method"): (
        "`method` is no longer a key: responses are those of the reduced model, with an estimate "
        "of its error; leave it out"
    ),
}
Form = Callable[["Reading", Any, Node, tuple[type, ...]], Any]


@dataclass(frozen=True, slots=True)
class Reading:
    """Reader of nodes: ``files`` reads the files of a case; ``forms`` has functions for values with
    a notation of their own, by the type of the value or of a mark in its annotation; ``leaf`` reads
    single values.
    """

    files: Reader
    forms: Mapping[type, Form]
    leaf: Callable[[Any, Any], Any] = leaf

    @property
    def faults(self) -> Faults:
        """Faults of all files."""
        return self.files.faults

    def value(self, annotation: Any, node: Node) -> Any:
        """Read ``node`` as the value of a field with this annotation."""
        if node.value is UNKNOWN:
            return unknown(annotation)
        if isinstance(node.value, Read):
            return node.value.value
        if node.value is None and optional(annotation):
            return None
        if form := self._form(annotation):
            return form(self, annotation, node, ())
        forms = members(annotation)
        if len(forms) > 1:
            return self._one_of(annotation, forms, node)
        return self._one(forms[0], node)

    def _one(self, annotation: Any, node: Node) -> Any:
        """Read a node whose annotation has one form only, None aside."""
        if form := self._form(annotation):
            return form(self, annotation, node, ())
        inner = bare(annotation)
        if is_kind(inner):
            return self.description(inner, node)
        if get_origin(inner) is tuple:
            return self.items(annotation, node)
        if get_origin(inner) is Mapping:
            return self._entries(inner, node)
        try:
            return self.leaf(annotation, node.value)
        except Refused as refusal:
            self.faults.at(node, refusal.why)
            return unknown(annotation)

    def _form(self, annotation: Any) -> Form | None:
        inner = bare(annotation)
        kinds = [type(beside) for beside in metadata(annotation)]
        kinds += list(inner.__mro__) if isinstance(inner, type) else []
        return next((self.forms[kind] for kind in kinds if kind in self.forms), None)

    def wrong_shape(self, annotation: Any, node: Node, allowed: str) -> Any:
        """Report a value of the wrong shape."""
        message = f"wrong shape: given {units.shown(node.plain())}; allowed: {allowed}"
        if isinstance(node.value, str) and (tight := TIGHT.match(node.value)):
            message += f" (put a space after the colon of '{tight[1]}:')"
        self.faults.at(node, message)
        return unknown(annotation)

    def _one_of(self, annotation: Any, forms: tuple[Any, ...], node: Node) -> Any:
        """Read a node as one of several forms, chosen by what is written."""
        if isinstance(node.value, dict):
            kinds = [bare(form) for form in forms if is_kind(bare(form))]
            if len(kinds) > 1:
                chosen = max(kinds, key=lambda kind: _likeness(kind, node))
                others = tuple(kind for kind in kinds if kind is not chosen)
                if form := self._form(chosen):
                    return form(self, chosen, node, others)
                return self.description(chosen, node, others)
            fitting = [f for f in forms if is_kind(bare(f)) or get_origin(bare(f)) is Mapping]
        elif isinstance(node.value, list):
            fitting = [form for form in forms if get_origin(bare(form)) is tuple]
        else:
            single = [form for form in forms if _is_leaf(bare(form))]
            if single:
                return self._one_leaf(annotation, single, node)
            fitting = []
        if fitting:
            return self.value(fitting[0], node)
        return self.wrong_shape(annotation, node, ", or ".join(map(wanted, forms)))

    def _one_leaf(self, annotation: Any, forms: list[Any], node: Node) -> Any:
        refusals = {}
        for form in forms:
            try:
                return self.leaf(form, node.value)
            except Refused as refusal:
                refusals[limit_of(form)] = refusal.why
        number = isinstance(node.value, str) and node.value[:1] in "+-.0123456789" and node.value
        for kind in (Quantity,) if number else (Choice, Words):
            for limit, why in refusals.items():
                if isinstance(limit, kind):
                    self.faults.at(node, why)
                    return unknown(annotation)
        wanted_words = ", or ".join(map(wanted, forms))
        given = units.shown(node.value)
        self.faults.at(node, f"wrong kind of value: given {given}; allowed: {wanted_words}")
        return unknown(annotation)

    def items(self, annotation: Any, node: Node) -> Any:
        """Read a list as a tuple."""
        if not isinstance(node.value, list):
            return self.wrong_shape(annotation, node, "a list")
        inner = get_args(bare(annotation))
        items = tuple(self.value(inner[0], item) for item in node.value)
        limit = found_in(annotation, Items)
        if limit and (why := limit.refusal(items, "" if items else "an empty list")):
            self.faults.at(node, why)
            return unknown(annotation)
        return items

    def _entries(self, annotation: Any, node: Node) -> Any:
        if not isinstance(node.value, dict):
            return self.wrong_shape(annotation, node, "a mapping (key: value)")
        key, entry = get_args(annotation)
        entries = {}
        for name, child in node.value.items():
            try:
                entries[leaf(key, name)] = self.value(entry, child)
            except Refused as refusal:
                self.faults.at_key(child, refusal.why)
        return entries

    def description(
        self, kind: type, node: Node, others: tuple[type, ...] = (), **given: Any
    ) -> Any:
        """Read a mapping as a description; ``others``: alternative descriptions, for messages.

        ``given``: values of fields that are not keys.
        """
        if not isinstance(node.value, dict):
            return self.wrong_shape(kind, node, _mapping(kind))
        before = self.faults.count
        values = self.fields(kind, node, others) | given
        return self.made(kind, values, node, whole=self.faults.count == before)

    def made(self, kind: type, values: Mapping[str, Any], node: Node, *, whole: bool = True) -> Any:
        """Build a description from values and check its rules.

        ``whole``: no value is faulty, so that rules about the description as a whole apply.
        """
        with unchecked():
            made: Any = kind(**values)
            for path, sentence in made._faults() if isinstance(made, Description) else ():
                if path or whole:
                    self.at(node, path, sentence)
        return made

    def fields(
        self,
        kind: type,
        node: Node,
        others: tuple[type, ...] = (),
        annotations: Mapping[str, Any] = {},
    ) -> dict[str, Any]:
        """Read the fields of a description, by name.

        ``annotations``: replace those of some fields, where they depend on other values.
        """
        keys = keys_of(kind)
        self._unknown_keys(kind, keys, node, others)
        spread(kind, node)
        values = {}
        for field in keys:
            if _is_common(kind, field):
                continue
            annotation = annotations.get(field.name, field.annotation)
            values[field.name] = self._field(replace(field, annotation=annotation), node, others)
        values.pop("", None)
        if "own" in values:
            values["own"] = tuple(k for k, child in node.entries().items() if not child.shared)
        return values

    def given(self, kind: type, node: Node) -> dict[str, Any]:
        """Read only those keys of a description that a mapping gives."""
        if not isinstance(node.value, dict):
            self.wrong_shape(kind, node, "a mapping (key: value)")
            return {}
        keys = keys_of(kind)
        self._unknown_keys(kind, keys, node, ())
        children = [(field, node.child(*field.keys)) for field in keys if field.keys]
        return {
            ".".join(field.keys): self.value(field.annotation, child)
            for field, child in children
            if child is not None
        }

    def _field(self, field: Field, node: Node, others: tuple[type, ...]) -> Any:
        child = node.child(*field.keys)
        if not field.keys:
            return unknown(field.annotation) if field.default is REQUIRED else field.default
        if child is not None:
            return self.value(field.annotation, child)
        if field.default is not REQUIRED:
            return field.default
        sentence = field.missing
        if others and sentence == "it must be given":
            instead = [f.keys[0] for kind in others for f in keys_of(kind) if _distinct(f, node)]
            sentence += "".join(f", or {key}" for key in instead[:1])
        self.faults.missing(node.at(*field.keys[:-1]), field.keys[-1], f"missing key: {sentence}")
        return unknown(field.annotation)

    def at(self, node: Node, path: Path, sentence: str) -> None:
        """Report a fault of the value at ``path``, or of its absence."""
        message = filled(sentence, path, lambda way: _written(node, way))
        entry = node.child(*path)
        if path and entry is not None:
            entry = entry.named or entry  # a file as a whole has no key to put right
        if (
            message.startswith("missing key")
            and entry is not None
            and self.faults.is_reported(entry)
        ):
            return  # its value is faulty and reported already
        if entry is None and message.startswith("missing key"):
            self.faults.missing(node.at(*path[:-1]), path[-1], message)
        elif entry is not None and entry.key and isinstance(entry.value, dict | list):
            self.faults.at_key(entry, message)
        else:
            self.faults.at(entry or node.at(*path), message)

    def _unknown_keys(
        self, kind: type, keys: tuple[Field, ...], node: Node, others: tuple[type, ...]
    ) -> None:
        ways = [field.keys for field in keys if field.keys]
        for place, name, child in [*_within(node, ways)]:
            if inside := _next(ways, (*place, name)):
                self.wrong_shape(None, child, f"a mapping (key: value) with {', '.join(inside)}")
                continue
            known = _next(ways, place)
            alternatives = [f for other in others for f in keys_of(other) if f.keys[:1] == (name,)]
            if issubclass(kind, BallBearing):
                self._key_of_bearing(node, name, known)
            elif "." in name and leads(kind, (*place, *name.split("."))):
                words = f"keys are nested: write {nested(name)}"
                self.faults.at_key(child, f"unknown key: given {units.shown(name)}; {words}")
            elif alternatives and not place:
                alternative = next(f.keys[0] for f in keys if _distinct(f, node, others))
                *above, last = node.path.split(".")  # an item is called by its list
                noun = (above or [last])[-1].rstrip("s")
                self.faults.at_key(
                    child, f"given beside {alternative}: a {noun} has only one of the two"
                )
            else:
                holder = place[-1] if place else node.path.rpartition(".")[2]
                within = "" if place else deeper(kind, name)
                self.faults.at_key(child, unknown_key(name, known, holder, within))

    def _key_of_bearing(self, node: Node, name: str, known: list[str]) -> None:
        """Report a key of another kind of bearing than the file, or an override, says."""
        sentence, kinds, kind = unknown_key(name, known), kinds_with(name), node.child("kind")
        key = node.at(name)
        if kinds and kind is None:
            sentence += f"; is 'kind: {kinds[0]}' missing?"
        elif kinds and kind is not None and key.file == node.file != kind.file:
            sentence += f"; the model gives it: add {name}: null to the override"
            self.faults.at(kind, sentence)
            return
        self.faults.at_key(key, sentence)


def unknown_key(given: str, allowed: list[str], holder: str = "", within: str = "") -> str:
    """Sentence on an unknown key; on one of earlier versions, why it was removed.

    ``within``: path of such a key at a deeper level, if there is one."""
    if sentence := RETIRED.get((holder, given)):
        return sentence
    listed = ", ".join(allowed[:_LISTED]) + (", …" if len(allowed) > _LISTED else "")
    hint = f" (did you mean {within}?)" if within else suggestion(given, allowed)
    return f"unknown key: given {units.shown(given)}; allowed: {listed or 'no keys'}{hint}"


def _within(
    node: Node, ways: list[tuple[str, ...]], place: tuple[str, ...] = ()
) -> Iterator[tuple[tuple[str, ...], str, Node]]:
    """Yield unknown keys, and keys on the path to a field that hold no mapping: path of the
    enclosing mapping, key, node."""
    for name, child in node.value.items():
        way = (*place, name)
        if way in ways:
            continue
        if _next(ways, way) and isinstance(child.value, dict):
            yield from _within(child, ways, way)
        elif child.value is not UNKNOWN and not (child.value is None and _next(ways, way)):
            yield place, name, child


def _next(ways: list[tuple[str, ...]], place: tuple[str, ...]) -> list[str]:
    """Known keys of the mapping at ``place``."""
    inside = (way[len(place)] for way in ways if way[: len(place)] == place and way != place)
    return list(dict.fromkeys(inside))


def spread(kind: type, node: Node) -> None:
    """Copy a value given once for all items of a list to those items that have none themselves."""
    for common in COMMON.get(kind, ()):
        source = node.child(*common.keys)
        if source is None and _reported(node, common.keys):
            source = replace(node, value=UNKNOWN)
        if source is None:
            continue
        for holder in matching(node, common.fills[:-1]):
            if common.fills[-1] not in holder.value:
                holder.value[common.fills[-1]] = replace(source.copy(), shared=True)


def _reported(node: Node, path: Path) -> bool:
    """Whether a value along ``path`` is faulty and reported already."""
    return any(
        entry is not None and entry.value is UNKNOWN
        for entry in (node.child(*path[:end]) for end in range(1, len(path)))
    )


def _is_common(kind: type, field: Field) -> bool:
    """Whether a key gives a common value, which is read with the items that share it."""
    keys = [common.keys for common in COMMON.get(kind, ())]
    return not field.name and any(field.keys[: len(way)] == way for way in keys)


def _mapping(kind: type) -> str:
    """Text on the mapping of a description, with its required keys."""
    needed = [".".join(field.keys) for field in keys_of(kind) if field.default is REQUIRED]
    return "a mapping (key: value)" + f" with {', '.join(needed)}" * bool(needed)


def _written(node: Node, path: Path) -> str:
    entry = node.child(*path)
    return "nothing" if entry is None else units.shown(entry.raw or entry.plain())


def _distinct(field: Field, node: Node, others: tuple[type, ...] = ()) -> bool:
    """Whether a field is required and distinguishes its description from the ``others``."""
    if not field.keys or field.default is not REQUIRED:
        return False
    other_keys = {f.keys for other in others for f in keys_of(other)}
    return field.keys not in other_keys and (bool(others) == (node.child(*field.keys) is not None))


def _is_leaf(inner: Any) -> bool:
    return inner in (float, int, str, bool)


def _likeness(kind: type, node: Node) -> tuple[int, int, int]:
    """Score of how well the keys of a mapping match those of a description."""
    keys = {field.keys[0]: field for field in keys_of(kind) if field.keys}
    known = [keys[name] for name in node.value if name in keys]
    fitting = [f for f in known if _fits(f.annotation, node.value[f.keys[0]])]
    return len(fitting), sum(not field.name for field in known), len(known)


def _fits(annotation: Any, node: Node) -> bool:
    single = not isinstance(node.value, dict | list)
    return any(_is_leaf(bare(form)) == single for form in members(annotation))
