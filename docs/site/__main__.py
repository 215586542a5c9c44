"""``python -m docs.site [-o DIR] [--runs DIR | --draft DIR]``: see ``scripts/site``."""

from __future__ import annotations

import argparse
import shutil
import sys
import tempfile
from pathlib import Path

from docs.generate.places import ROOT
from docs.site.reports import EXTRA
from docs.site.tree import lay_out
from rotordyn.figures import style

OURS = ".buildinfo"  # Sphinx leaves it in what it has built
DRAFT = 60  # dots per inch


def main() -> int:
    """Run the cases of the gallery, lay out the pages, build them; any warning is an error."""
    parser = argparse.ArgumentParser(prog="scripts/site", description=__doc__)
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "out" / "site")
    parser.add_argument("--runs", type=Path, default=ROOT / "out" / "gallery")
    parser.add_argument("--draft", type=Path, help="figures of low resolution, of runs kept here")
    asked = parser.parse_args()
    output = asked.output.resolve()
    if output.exists() and any(output.iterdir()) and not (output / OURS).exists():
        parser.error(f"{asked.output} holds something that is not a site; name another folder")
    if asked.draft:
        style.DPI = DRAFT
    with tempfile.TemporaryDirectory() as made:
        tree = Path(made) / "pages"
        lay_out(tree, (asked.draft or asked.runs).resolve())
        return _build(tree, Path(made) / "built", output)


def _build(tree: Path, built: Path, output: Path) -> int:
    """Sphinx from ``tree`` into ``built``, which then takes the place of ``output``."""
    from sphinx.cmd.build import build_main

    options = ["-q", "-W", "--keep-going", "-n", "-b", "html", "-c", str(Path(__file__).parent)]
    options += ["-D", f"html_extra_path={tree / EXTRA}"]
    code = build_main([*options, "-d", str(built.parent / "doctrees"), str(tree), str(built)])
    if code == 0:
        shutil.rmtree(output, ignore_errors=True)
        shutil.copytree(built, output)
        sys.stdout.write(f"{output / 'index.html'}\n")
    return code


if __name__ == "__main__":
    sys.exit(main())
