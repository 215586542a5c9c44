"""The site builds from nothing without a warning, and what it shows is there."""

from __future__ import annotations

import subprocess
import sys
from html.parser import HTMLParser
from inspect import ismodule
from pathlib import Path
from urllib.parse import unquote, urlsplit

import pytest
from PIL import Image

from docs.site.runs import locked

pytestmark = pytest.mark.long

ROOT = Path(__file__).resolve().parents[2]
CASES = sorted((ROOT / "cases").glob("*.yaml"))
EXAMPLES = sorted((ROOT / "docs" / "examples").glob("*.py"))


class Page(HTMLParser):
    """What a page refers to, what can be referred to in it, and its visible text."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.links: list[str] = []
        self.pictures: list[str] = []
        self.places: set[str] = set()
        self.text = ""
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        found = {name: value for name, value in attrs if value}
        self.places |= {found[name] for name in ("id", "name") if name in found}
        if tag == "a" and "href" in found:
            self.links.append(found["href"])
        if tag == "img" and "src" in found:
            self.pictures.append(found["src"])

    def handle_data(self, data: str) -> None:
        self.text += data


@pytest.fixture(scope="module")
def site(shared: Path, runs: Path) -> Path:
    """The site, built once in a run of the tests; a warning of Sphinx fails the build.

    As a draft: all is run and drawn, with few dots; their size in print has its own test
    (``figures/test_catalogue``).
    """
    folder = shared / "site"
    with locked(folder):
        if not folder.exists():
            done = build("-o", str(folder), "--draft", str(runs))
            assert done.returncode == 0, done.stdout + done.stderr
            assert not done.stderr, done.stderr
    return folder


def build(*options: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "docs.site", *options]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)


@pytest.fixture(scope="module")
def pages(site: Path) -> dict[Path, Page]:
    return {path: Page(path) for path in site.rglob("*.html")}


def test_links_and_pictures_lead_somewhere(site: Path, pages: dict[Path, Page]) -> None:
    broken = []
    for path, page in pages.items():
        for target in (*page.links, *page.pictures):
            url = urlsplit(target)
            if url.scheme in {"http", "https", "data"}:
                continue
            there = (path.parent / unquote(url.path)).resolve() if url.path else path
            known = pages[there].places if there in pages else set()
            if not there.exists() or (url.fragment and unquote(url.fragment) not in known | {""}):
                broken.append(f"{path.relative_to(site)}: {target}")
    assert broken == []


@pytest.mark.parametrize("case", CASES, ids=lambda path: path.stem)
def test_case_has_a_page_with_pictures(case: Path, site: Path, pages: dict[Path, Page]) -> None:
    page = pages[site / "cases" / f"{case.stem}.html"]
    assert page.pictures
    lines = case.read_text(encoding="utf-8").splitlines()
    assert [line for line in lines if line.strip() not in page.text] == []
    assert f"{case.stem}: " in page.text  # the summary begins so
    index = pages[site / "cases" / "README.html"]
    assert f"{case.stem}.html" in index.links
    assert any(case.stem in picture for picture in index.pictures)


def test_figures_of_a_draft_have_few_dots(site: Path, runs: Path) -> None:
    (picture,) = (runs / "vex70_control").glob("*.png")
    with Image.open(picture) as drawn:
        assert drawn.width == int(168.0 / 25.4 * 60.0)


def test_examples_have_pages_with_pictures(site: Path, pages: dict[Path, Page]) -> None:
    for script in EXAMPLES:
        page = pages[site / "docs" / "examples" / f"{script.stem}.html"]
        assert page.pictures, script.stem
        assert script.read_text(encoding="utf-8").splitlines()[-1] in page.text


def test_every_document_is_a_page(site: Path, pages: dict[Path, Page]) -> None:
    documents = {p.relative_to(ROOT).with_suffix(".html") for p in (ROOT / "docs").rglob("*.md")}
    there = {path.relative_to(site) for path in pages}
    assert documents - there == {Path("docs/README.html")}
    assert Path("index.html") in there


def test_interface_shows_every_public_name(site: Path, pages: dict[Path, Page]) -> None:
    import bearings
    import rotordyn

    places = {place for page in pages.values() for place in page.places}
    for package in (bearings, rotordyn):
        offered = [name for name in package.__all__ if not name.startswith("_")]
        names = [name for name in offered if not ismodule(getattr(package, name))]
        assert [n for n in names if f"{package.__name__}.{n}" not in places] == []


def test_formulas_are_set(site: Path) -> None:
    theory = (site / "docs" / "theory" / "ball.html").read_text(encoding="utf-8")
    assert theory.count("<math") >= 8
    assert "$$" not in theory


def test_no_page_knows_the_machine_it_was_made_on(site: Path, pages: dict[Path, Page]) -> None:
    for path in (*pages, *site.rglob("*.js")):
        held = path.read_text(encoding="utf-8")
        assert str(ROOT) not in held, path
        assert str(site.parent) not in held, path


def test_a_folder_of_others_is_refused(tmp_path: Path) -> None:
    (tmp_path / "kept").write_text("mine", encoding="utf-8")
    done = build("-o", str(tmp_path))
    assert done.returncode == 2
    assert "is not a site" in done.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["kept"]
