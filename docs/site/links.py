"""Links of a document to files of the repository: to its page, or to a page that shows the file."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator
from html import escape
from pathlib import Path
from typing import Any

from docutils import nodes
from sphinx import addnodes
from sphinx.transforms.post_transforms import SphinxPostTransform

from docs.generate.modules import first_line
from docs.generate.places import ROOT

LANGUAGES = {".py": "python", ".yaml": "yaml", ".cff": "yaml", ".toml": "toml", ".json": "json"}
SHOWN = "source/"

Page = tuple[str, dict[str, str], str]


class FileLinks(SphinxPostTransform):
    """Resolve links to files that are no pages, before a warning about them."""

    default_priority = 8

    def run(self, **_: Any) -> None:
        """Replace every such link of the document."""
        for node in list(self.document.findall(addnodes.pending_xref)):
            if node["reftype"] == "myst" and node["refdomain"] != "doc":
                self._resolve(node)

    def _resolve(self, node: addnodes.pending_xref) -> None:
        path, _, anchor = node["reftarget"].partition("#")
        folder = posixpath.dirname(self.env.docname)
        target = posixpath.normpath(posixpath.join(folder, path))
        if not path or target.startswith("..") or not (ROOT / target).exists():
            return
        link = nodes.reference("", "", *node.children, internal=True)
        link["refuri"] = self._uri(target, anchor)
        node.replace_self(link)

    def _uri(self, target: str, anchor: str) -> str:
        page = self._page(target) or SHOWN + target
        if page.startswith(SHOWN):
            shown_files(self.env).add(target)
        uri: str = self.app.builder.get_relative_uri(self.env.docname, page)
        return f"{uri}#{anchor}" if anchor else uri

    def _page(self, target: str) -> str:
        """The page that shows ``target``: the README, a case, an example, a folder."""
        if target in {"README.md", "docs/README.md"}:
            return "index"
        for page in (posixpath.splitext(target)[0], f"{target}/README"):
            if page in self.env.found_docs:
                return page
        return ""


def shown_files(env: Any) -> set[str]:
    """Paths in the repository that a document links to, collected while pages are written."""
    if not hasattr(env, "rotordyn_files"):
        env.rotordyn_files = set()
    found: set[str] = env.rotordyn_files
    return found


def file_pages(app: Any) -> Iterator[Page]:
    """One page for each of them."""
    for target in sorted(shown_files(app.env)):
        path = ROOT / target
        body = _listing(path) if path.is_dir() else _text(app, path)
        context = {"title": target, "body": f"<h1>{escape(target)}</h1>\n{body}"}
        yield SHOWN + target, context, "page.html"


def _text(app: Any, path: Path) -> str:
    language = LANGUAGES.get(path.suffix, "text")
    text: str = app.builder.highlighter.highlight_block(path.read_text("utf-8"), language)
    return text


def _listing(folder: Path) -> str:
    """The modules of a folder with the first line of their docstrings."""
    rows = ((p.name, first_line(p)) for p in sorted(folder.glob("*.py")))
    lines = (f"<dt><code>{escape(n)}</code></dt><dd>{escape(said)}</dd>" for n, said in rows)
    return f"<dl>{''.join(lines)}</dl>"


def setup(app: Any) -> dict[str, bool]:
    """Resolve links, then make the pages that they link to."""
    app.add_post_transform(FileLinks)
    app.connect("html-collect-pages", file_pages)
    return {"parallel_read_safe": True, "parallel_write_safe": False}
