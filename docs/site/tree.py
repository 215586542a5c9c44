"""The pages in one folder, laid out like the repository so that every relative link holds."""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterable
from pathlib import Path

from docs.generate.places import DOCS, README, ROOT
from docs.site.api import write_api
from docs.site.gallery import grid, show_all

THEORY, CASES = "docs/theory/README", "cases/README"


def _in(folder: str, names: str) -> tuple[str, ...]:
    return tuple((Path("docs") / folder / name).as_posix() for name in names.split())


# The order of the pages; one of ``docs`` itself that is not named goes to the last group.
GROUPS = {
    "Tutorial": _in("tutorial", "first_run own_spindle campbell"),
    "How to": _in(
        "howto",
        "bearing_data preload compare studies optimum report measured_frf measured_spindle "
        "rotor_from_responses life stability_lobes over_time rotors hypotheses intervals "
        "identification editor",
    ),
    "Reference": (
        *_in("reference", "keys command results results_object python"),
        *("api/index", CASES, "models/README"),
    ),
    "Explanation": (
        THEORY,
        *_in("", "conventions formulations accuracy mfw2310 limits stress security benchmarks"),
    ),
    "Project": ("docs/house", "CONTRIBUTING", "CHANGELOG"),
}


def lay_out(tree: Path, runs: Path) -> None:
    """Write all pages into ``tree``, after running the new entries of the gallery."""
    copy_documents(tree)
    shutil.copy(README, tree / "index.md")
    cases, examples = show_all(tree, runs)
    _append(tree, CASES, "## Gallery", grid(cases, tree), contents(e.page for e in cases))
    if examples:
        pages = contents(e.page for e in examples)
        _append(tree, CASES, "## From Python", grid(examples, tree), pages)
    write_api(tree / "api")
    _append(tree, THEORY, contents(_chapters(tree)))
    _append(tree, "index", *_groups(tree))


def copy_documents(tree: Path) -> None:
    """Every document and figure of the repository; the README is the front page."""
    for folder in (DOCS, ROOT / "cases", ROOT / "models"):
        shutil.copytree(folder, tree / folder.name, ignore=_all_but_documents)
    (tree / "docs" / "README.md").unlink()
    for path in ROOT.glob("*.md"):
        if path != README:
            shutil.copy(path, tree)


def _all_but_documents(folder: str, names: list[str]) -> list[str]:
    kept = (".md", ".png")
    files = (name for name in names if (Path(folder) / name).is_file())
    return [*(name for name in files if not name.endswith(kept)), "__pycache__"]


def contents(pages: Iterable[str], caption: str = "") -> str:
    """A table of contents; without caption it shows only beside the page."""
    options = f":caption: {caption}\n:maxdepth: 1" if caption else ":hidden:"
    return "\n".join(["```{toctree}", options, "", *(f"/{page}" for page in pages), "```"])


def _chapters(tree: Path) -> list[str]:
    """Pages of the theory, in the order in which its first page links them."""
    folder = (tree / THEORY).parent
    first = (folder / "README.md").read_text(encoding="utf-8")
    linked = re.findall(r"^\d+\. \[.+?\]\((\w+)\.md\)", first, re.M)
    others = sorted(path.stem for path in folder.glob("*.md") if path.stem != "README")
    return [f"docs/theory/{name}" for name in dict.fromkeys([*linked, *others])]


def _groups(tree: Path) -> list[str]:
    """Tables of contents of the front page, with the existing pages of each group."""
    existing = {page: (tree / f"{page}.md").exists() for group in GROUPS.values() for page in group}
    existing["api/index"] = True
    loose = sorted(
        page
        for path in [*tree.glob("*.md"), *(tree / "docs").glob("*.md")]
        if (page := path.relative_to(tree).with_suffix("").as_posix()) not in {*existing, "index"}
    )
    groups = {caption: [p for p in pages if existing[p]] for caption, pages in GROUPS.items()}
    groups["Project"] += loose
    return [contents(pages, caption) for caption, pages in groups.items()]


def _append(tree: Path, page: str, *parts: str) -> None:
    with (tree / f"{page}.md").open("a", encoding="utf-8") as file:
        file.write("\n" + "\n\n".join(parts) + "\n")
