"""A page for every case and every example: its input and the results of its run."""

from __future__ import annotations

import os
import shutil
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import yaml

import rotordyn
from docs.generate.places import DOCS, ROOT
from docs.site.reports import EXTRA, REPORTS, write_case_report
from docs.site.runs import case_run, example_run
from rotordyn.case.library import models_root
from rotordyn.figures import style

CASES = ROOT / "cases"
EXAMPLES = DOCS / "examples"
# The thumbnail of a page: the first picture that exists.
FACES = (
    "shapes_3d_24000rpm_1",
    "damping",
    "campbell_overlay",
    "stiffness",
    "campbell",
    "bearing",
    "section_forces",
    "unbalance",
)
THUMBNAIL = (640, 480)


@dataclass(frozen=True, slots=True)
class Exhibit:
    """One page of the gallery: its name in the tree, its title, its pictures."""

    page: str
    title: str
    pictures: tuple[Path, ...]

    @property
    def face(self) -> Path:
        """Its thumbnail: the first of ``FACES`` that exists."""
        by_name = {picture.stem: picture for picture in self.pictures}
        return next((by_name[name] for name in FACES if name in by_name), self.pictures[0])


def show_all(tree: Path, runs: Path) -> tuple[list[Exhibit], list[Exhibit]]:
    """Run, or find, all cases and examples and write their pages into ``tree``."""
    cases, scripts = sorted(CASES.glob("*.yaml")), sorted(EXAMPLES.glob("*.py"))
    with ProcessPoolExecutor(os.cpu_count(), initializer=_dots, initargs=(style.DPI,)) as pool:
        shown = pool.map(partial(_case, tree=tree, runs=runs), cases)
        tried = pool.map(partial(_example, tree=tree, runs=runs), scripts)
        return list(shown), list(tried)


def _dots(per_inch: float) -> None:
    """A process draws with the resolution of its parent."""
    style.DPI = per_inch


def grid(exhibits: list[Exhibit], tree: Path) -> str:
    """Thumbnails that lead to the pages."""
    lines = [_thumbnail(exhibit, tree) for exhibit in exhibits]
    return "\n\n".join(["::::{container} gallery", *lines, "::::"])


def _thumbnail(exhibit: Exhibit, tree: Path) -> str:
    from PIL import Image

    small = tree / "thumbnails" / f"{exhibit.page.replace('/', '_')}.png"
    small.parent.mkdir(exist_ok=True)
    with Image.open(exhibit.face) as full:
        full.thumbnail(THUMBNAIL)
        full.convert("RGB").quantize(128).save(small)
    return f"[![](/thumbnails/{small.name}) {exhibit.title}](/{exhibit.page}.md)"


def _case(path: Path, tree: Path, runs: Path) -> Exhibit:
    case = rotordyn.load(path)
    folder = case_run(case, runs)
    note = yaml.safe_load(path.read_text(encoding="utf-8")).get("note", "")
    page = f"cases/{path.stem}"
    pictures = _copied(folder, tree / page)
    shutil.copy(path, tree / page)
    write_case_report(folder, tree / EXTRA / REPORTS, path.stem)
    text = (
        f"# {case.title}\n\n{note}\n\n"
        f'<p><a href="../{REPORTS}/{path.stem}.html">All results on one page</a></p>\n\n'
        f"`scripts/run cases/{path.name}`, which reads {_models(case.files, path)}:\n\n"
        f"{_included(path, 'yaml')}\n\n"
        f"## Summary\n\n{_quoted((folder / 'summary.txt').read_text(encoding='utf-8'))}\n\n"
        f"## Figures\n\n{_figures(pictures, path.stem)}\n"
    )
    (tree / f"{page}.md").write_text(text, encoding="utf-8")
    return Exhibit(page, case.title, pictures)


def _example(script: Path, tree: Path, runs: Path) -> Exhibit:
    folder = example_run(script, runs)
    page = f"docs/examples/{script.stem}"
    pictures = _copied(folder, tree / page)
    said = _docstring(script)
    title, _, rest = said.partition("\n")
    printed = (folder / "printed.txt").read_text(encoding="utf-8")
    shutil.copy(script, tree / page)
    text = (
        f"# {title.rstrip('.')}\n\n{rest.strip()}\n\n{_included(script, 'python')}\n\n"
        + (f"It prints\n\n{_quoted(printed)}\n\n" if printed.strip() else "")
        + f"{_figures(pictures, script.stem)}\n"
    )
    (tree / f"{page}.md").write_text(text, encoding="utf-8")
    return Exhibit(page, title.rstrip("."), pictures)


def _docstring(script: Path) -> str:
    import ast

    said = ast.get_docstring(ast.parse(script.read_text(encoding="utf-8")))
    return said or script.stem.replace("_", " ")


def _copied(folder: Path, target: Path) -> tuple[Path, ...]:
    """Copies of the pictures of a run, the machine first."""
    target.mkdir(parents=True, exist_ok=True)
    found = sorted(folder.glob("*.png"), key=lambda p: (p.stem != "machine", p.name))
    if not found:
        raise RuntimeError(f"{folder.name} has drawn nothing")
    return tuple(Path(shutil.copy(picture, target)) for picture in found)


def _models(files: tuple[Path, ...], case: Path) -> str:
    """Links to the models that a case reads."""
    root = models_root()
    read = [path.relative_to(root) for path in files if path.is_relative_to(root)]
    links = [f"[{path}](../models/{path})" for path in read]
    return ", ".join(links) or "no other file"


def _figures(pictures: tuple[Path, ...], folder: str) -> str:
    return "\n\n".join(
        f"```{{figure}} {folder}/{p.name}\n:alt: {_name(p)}\n\n{_name(p)}\n```" for p in pictures
    )


def _name(picture: Path) -> str:
    return picture.stem.replace("_", " ")


def _included(path: Path, language: str) -> str:
    return f"```{{literalinclude}} {path.stem}/{path.name}\n:language: {language}\n```"


def _quoted(text: str) -> str:
    return f"````text\n{text.rstrip()}\n````"
