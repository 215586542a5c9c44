"""The reference of the Python interface: its public names, read from the packages."""

from __future__ import annotations

import dataclasses
import importlib
import inspect
import pkgutil
import re
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any

from docs.site.docstrings import plain
from rotordyn.results.declaration import declared

# Page -> (title, modules in the order in which they are searched). A name is shown where it is
# found first; ``package.*`` stands for the modules of a package without ``__all__``,
# ``package.*.name`` for the modules of that name in its subpackages.
PAGES = {
    "rotordyn": ("rotordyn", ("rotordyn", "rotordyn.errors")),
    "bearings": (
        "bearings",
        (
            "bearings",
            "bearings.ring.state",
            "bearings.fit.compound",
            "bearings.debongnie",
        ),
    ),
    "machine": ("Machines", ("rotordyn.machine", "rotordyn.machine.*")),
    "analyses": ("Analyses", ("rotordyn.analyses",)),
    "results": ("Results", ("rotordyn.analyses.*.result",)),
}
INTRODUCTION = """Python interface
================

The public names of the packages. All values are in SI units. Descriptions and results are frozen;
``rotordyn.vary`` returns a changed copy.
"""
Shown = dict[int, tuple[str, Any]]  # id of an object -> where it is shown, the object


def write_api(folder: Path) -> None:
    """One page per part of the interface, and the page that lists them."""
    folder.mkdir()
    seen: Shown = {}
    found = {page: [_found(m, seen) for m in _modules(names)] for page, (_, names) in PAGES.items()}
    classes = {o.__name__: path for path, o in seen.values() if inspect.isclass(o)}
    for page, (title, _) in PAGES.items():
        lines = [line for module, things in found[page] for line in _part(module, things, classes)]
        text = "\n".join([title, "=" * len(title), "", *lines])
        (folder / f"{page}.rst").write_text(text, encoding="utf-8")
    listed = "\n".join(f"   {page}" for page in PAGES)
    text = f"{INTRODUCTION}\n.. toctree::\n   :maxdepth: 1\n\n{listed}\n"
    (folder / "index.rst").write_text(text, encoding="utf-8")


def _modules(names: tuple[str, ...]) -> Iterator[ModuleType]:
    for name in names:
        package, star, rest = name.partition(".*")
        module = importlib.import_module(package)
        if not star:
            yield module
        elif rest or not hasattr(module, "__all__"):
            for found in pkgutil.iter_modules(module.__path__, f"{package}."):
                if found.ispkg or not rest:
                    yield importlib.import_module(found.name + rest)


def _found(module: ModuleType, seen: Shown) -> tuple[ModuleType, Shown]:
    """Names of a module that no other module has shown, with the classes its functions return."""
    fresh: Shown = {}
    for name, thing in list(_public(module)):
        for path, item in ((f"{module.__name__}.{name}", thing), *_returned(thing)):
            if id(item) not in seen:
                seen[id(item)] = fresh[id(item)] = (path, item)
    return module, fresh


def _public(module: ModuleType) -> Iterator[tuple[str, Any]]:
    """The names in ``__all__`` of a module, or else its classes and functions."""
    listed = getattr(module, "__all__", None)
    for name in vars(module) if listed is None else listed:
        thing = getattr(module, name)
        own = getattr(thing, "__module__", None) == module.__name__
        is_code = inspect.isclass(thing) or inspect.isfunction(thing)
        offered = listed is not None and not inspect.ismodule(thing)
        if not name.startswith("_") and (offered or (own and is_code)):
            yield name, thing


def _returned(thing: Any) -> Iterator[tuple[str, Any]]:
    """Classes of the same module that a function returns."""
    if inspect.isfunction(thing):
        module = sys.modules[thing.__module__]
        for name in re.findall(r"[A-Z]\w+", str(thing.__annotations__.get("return", ""))):
            found = getattr(module, name, None)
            if inspect.isclass(found) and found.__module__ == module.__name__:
                yield f"{module.__name__}.{name}", found


def _part(module: ModuleType, things: Shown, classes: dict[str, str]) -> Iterator[str]:
    """Docstring of a module, then its names."""
    if not things:
        return
    yield from (module.__name__, "-" * len(module.__name__), "")
    yield from (f".. automodule:: {module.__name__}", "   :no-index:", "")
    for path, thing in things.values():
        yield from _entry(path, thing, classes)


def _entry(path: str, thing: Any, classes: dict[str, str]) -> Iterator[str]:
    if inspect.isclass(thing) and dataclasses.is_dataclass(thing):
        quantities = declared(thing)
        yield from (f".. autoclass:: {path}()", "   :members:", "")
        yield from _quantities(thing) if quantities else _fields(thing, classes)
        yield ""
    elif inspect.isclass(thing):
        kind = "exception" if issubclass(thing, BaseException) else "class"
        yield from (f".. auto{kind}:: {path}", "   :members:", "")
    elif inspect.isfunction(thing):
        yield from (f".. autofunction:: {path}", "")
    else:
        module, _, name = path.rpartition(".")
        yield from (f".. py:data:: {name}", f"   :module: {module}", f"   :value: {thing!r}", "")


def _quantities(result: type) -> Iterator[str]:
    """Table of the declared fields of a result."""
    rows = [
        (f"``{name}``", ", ".join(meta["dims"]), meta["unit"] or "–", meta["label"])
        for name, meta in ((n, field.metadata) for n, field in declared(result).items())
    ]
    yield from _table(("field", "dimensions", "unit", "meaning"), rows)


def _fields(description: type, classes: dict[str, str]) -> Iterator[str]:
    """Table of the fields of a description: types as in the source."""
    rows = [
        (f"``{field.name}``", _typed(str(field.type), classes), _default(field))
        for field in dataclasses.fields(description)
        if field.init
    ]
    yield from _table(("field", "type", "default"), rows)


def _typed(annotation: str, classes: dict[str, str]) -> str:
    """A type with links to the classes that the reference shows."""
    words = re.split(r"(\w+)", annotation)
    linked = (
        f":py:class:`{word} <{classes[word]}>`" if word in classes else plain(word)
        for word in words
        if word
    )
    return "\\ ".join(linked)


def _default(field: dataclasses.Field[Any]) -> str:
    if field.default is not dataclasses.MISSING:
        return f"``{field.default!r}``"
    if field.default_factory is not dataclasses.MISSING:
        return f"``{field.default_factory()!r}``"
    return "required"


def _table(head: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> Iterator[str]:
    if not rows:
        return
    yield from ("   .. list-table::", "      :header-rows: 1", "")
    for row in (head, *rows):
        for k, cell in enumerate(row):
            yield f"      {'*' if k == 0 else ' '} - {cell}"
