"""The HTML page of every case, and an index:  python -m docs.site.reports [-o DIR] [--runs DIR]"""

from __future__ import annotations

import argparse
import sys
from html import escape
from pathlib import Path

import rotordyn
from docs.generate.places import ROOT
from docs.site.runs import case_run

EXTRA = "extra"  # of the pages laid out: what Sphinx copies as it is
REPORTS = "reports"
_INDEX = """<!doctype html>
<html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>rotordyn: all cases</title>
<h1>rotordyn: all cases</h1>
<ul>
{items}
</ul>
</html>
"""


def write_case_report(run: Path, folder: Path, name: str) -> Path:
    """The page of the results in ``run`` as ``name.html`` in ``folder``."""
    folder.mkdir(parents=True, exist_ok=True)
    return rotordyn.write_report(run, folder / f"{name}.html")


def main() -> int:
    """Run the changed cases, write all pages."""
    parser = argparse.ArgumentParser(prog="python -m docs.site.reports", description=__doc__)
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "out" / REPORTS)
    parser.add_argument("--runs", type=Path, default=ROOT / "out" / "gallery")
    asked = parser.parse_args()
    items = []
    for path in sorted((ROOT / "cases").glob("*.yaml")):
        case = rotordyn.load(path)
        page = write_case_report(case_run(case, asked.runs.resolve()), asked.output, path.stem)
        items.append(f'<li><a href="{page.name}">{escape(case.title)}</a></li>')
    index = asked.output / "index.html"
    index.write_text(_INDEX.format(items="\n".join(items)), encoding="utf-8")
    sys.stdout.write(f"{index}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
