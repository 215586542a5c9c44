"""Errors made on purpose in the physics, one at a time:  python -m tests.hostile.source [--count N]

A sign, a factor, an exponent or an order of terms is changed in a copy of the tree, and the test
files that name the module, or something it defines, are run until one fails. A mutant that none
kills is printed with its line: it needs a test, or a reason why it changes nothing.
"""

from __future__ import annotations

import argparse
import ast
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[2]
PHYSICS = (
    "bearings/ball/*.py", "bearings/contact/*.py", "bearings/fit/*.py", "bearings/heat/*.py",
    "bearings/kinds/*.py", "bearings/life/*.py", "bearings/catalogue/printed.py",
    "bearings/film.py", "bearings/fits.py", "bearings/lubricant.py", "bearings/ball_guide.py",
    "bearings/materials.py", "rotordyn/equation/*.py", "rotordyn/equation/elements/*.py",
    "rotordyn/numerics/*.py", "rotordyn/preload/*.py", "rotordyn/units.py",
    "rotordyn/analyses/*/tables.py", "rotordyn/analyses/*/result.py",
)  # fmt: skip
SWAPPED = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult}
FILES, SECONDS = 4, 45  # of tests to a mutant; of each run
UNDECIDED = "?"


class Mutant(NamedTuple):
    """A file of the tree, the line that is changed, how, and the whole text after it."""

    path: str
    line: int
    before: str
    after: str
    text: str


def mutants(count: int, seed: int = 0) -> list[Mutant]:
    """So many of all that can be made, at most a few of a file."""
    chance = random.Random(seed)
    paths = sorted(path for pattern in PHYSICS for path in ROOT.glob(pattern))
    made = [each for path in paths for each in _some(path, chance)]
    return chance.sample(made, min(count, len(made)))


def _some(path: Path, chance: random.Random) -> list[Mutant]:
    text = path.read_text(encoding="utf-8")
    places = sum(1 for _ in _places(ast.parse(text)))
    chosen = chance.sample(range(places), min(places, 4))
    return [made for place in chosen if (made := _made(path, text, place)) is not None]


def _places(tree: ast.AST) -> Iterator[ast.expr]:
    """Operations and numbers within functions, of floating-point numbers as far as one can see."""
    for function in ast.walk(tree):
        if isinstance(function, ast.FunctionDef):
            for node in ast.walk(function):
                if isinstance(node, ast.BinOp) and type(node.op) in {*SWAPPED, ast.Pow}:
                    if not _whole(node):
                        yield node
                elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
                    if not isinstance(node.operand, ast.Constant):
                        yield node
                elif isinstance(node, ast.Constant) and type(node.value) is float and node.value:
                    yield node


def _whole(node: ast.BinOp) -> bool:
    """Counting, indexing and joining of text or lists are no physics."""
    sides = (node.left, node.right)
    kinds = (ast.List, ast.Tuple, ast.JoinedStr)
    return any(
        isinstance(each, kinds)
        or (isinstance(each, ast.Constant) and type(each.value) in (int, str))
        for each in sides
    ) and not isinstance(node.op, ast.Pow)


def _made(path: Path, text: str, place: int) -> Mutant | None:
    node = [*_places(ast.parse(text))][place]
    if node.lineno != node.end_lineno:
        return None
    lines = text.splitlines(keepends=True)
    line = lines[node.lineno - 1].encode()
    before = ast.unparse(node)
    after = _changed(node)
    start, end = node.col_offset, node.end_col_offset
    lines[node.lineno - 1] = (line[:start] + b"(" + after.encode() + b")" + line[end:]).decode()
    return Mutant(str(path.relative_to(ROOT)), node.lineno, before, after, "".join(lines))


def _changed(node: ast.expr) -> str:
    if isinstance(node, ast.Constant):
        return repr(float(node.value) * 1.1)  # type: ignore[arg-type]
    if isinstance(node, ast.UnaryOp):
        return ast.unparse(node.operand)
    assert isinstance(node, ast.BinOp)
    if isinstance(node.op, ast.Pow):
        return f"({ast.unparse(node.left)}) ** (({ast.unparse(node.right)}) * 1.1)"
    node.op = SWAPPED[type(node.op)]()
    return ast.unparse(node)


def related(path: str) -> list[str]:
    """Test files that name a module or what it defines, those that do so most often first."""
    module = path.removesuffix(".py").replace("/", ".")
    tree = ast.parse((ROOT / path).read_text(encoding="utf-8"))
    names = [
        node.name
        for node in tree.body
        if isinstance(node, ast.FunctionDef | ast.ClassDef) and not node.name.startswith("_")
    ]
    parts = [part for part in module.split(".")[1:] if part not in ("tables", "result")]
    words = re.compile(rf"{re.escape(module)}\b|\b({'|'.join([*names, *parts])})\b")
    scored = []
    for test in sorted((ROOT / "tests").rglob("test_*.py")):
        if not {"hostile", "docs", "cases", "page"} & {*test.relative_to(ROOT).parts}:
            text = test.read_text(encoding="utf-8")
            near = test.relative_to(ROOT).parts[1] == module.split(".", maxsplit=1)[0]
            score = len(words.findall(text)) * (3 if near else 1) + 20 * (parts[-1] in test.stem)
            scored.append((-score, str(test.relative_to(ROOT))))
    return [name for score, name in sorted(scored) if score < 0][:FILES]


def killed(mutant: Mutant, tree: Path) -> str:
    """The first test that fails; empty where none does, ``UNDECIDED`` where they take long."""
    target = tree / mutant.path
    whole = target.read_text(encoding="utf-8")
    target.write_text(mutant.text, encoding="utf-8")
    try:
        words = [
            sys.executable,
            "-m",
            "pytest",
            "-q",
            "-x",
            "--no-header",
            "-p",
            "no:cacheprovider",
        ]
        done = subprocess.run(
            [*words, *related(mutant.path)],
            cwd=tree,
            env={**os.environ, "PYTHONPATH": str(tree), "OMP_NUM_THREADS": "1"},
            capture_output=True,
            text=True,
            timeout=SECONDS,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return UNDECIDED
    finally:
        target.write_text(whole, encoding="utf-8")
    found = re.findall(r"^(?:FAILED|ERROR) (\S+)", done.stdout, re.MULTILINE)
    return found[0] if found else ("a crash" if done.returncode not in (0, 5) else "")


def main() -> None:
    """Try them, a line for each that survives."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--verbose", action="store_true")
    asked = parser.parse_args()
    tried = dead = late = 0
    with tempfile.TemporaryDirectory() as place:
        tree = Path(place) / "tree"
        kept = shutil.ignore_patterns(".git", ".venv", "__pycache__", "out", ".*cache")
        shutil.copytree(ROOT, tree, ignore=kept)
        for mutant in mutants(asked.count, asked.seed):
            by = killed(mutant, tree)
            tried, dead, late = tried + 1, dead + (len(by) > 1), late + (by == UNDECIDED)
            if asked.verbose or len(by) < 2:
                what = f"{mutant.path}:{mutant.line}: {mutant.before} -> {mutant.after}"
                how = f"killed by {by}" if len(by) > 1 else by or "SURVIVES"
                print(f"{how}: {what}", flush=True)  # noqa: T201
        print(f"{tried} mutants, {dead} killed, {late} undecided")  # noqa: T201


if __name__ == "__main__":
    main()
