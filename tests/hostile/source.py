"""Errors made on purpose in the physics, one at a time:  python -m tests.hostile.source [--count N]

A sign, a factor, an exponent or an order of terms is changed, and the tests that execute the
function are run, the quickest first, until one fails: those of files named after the module, of its
room, or that name what it defines; then those of any file collected for another mutant. A mutant
that none kills is printed with its line: it needs a test, or a reason why it changes nothing
(``EQUIVALENT``). Tolerances are left alone.
"""

from __future__ import annotations

import argparse
import ast
import random
import re
import sys
import tempfile
from collections.abc import Iterator, Sequence
from itertools import accumulate
from pathlib import Path
from typing import NamedTuple

import pytest

from tests.hostile.covering import ROOT, USUAL, Ran, Tests, function_at

PHYSICS = (
    "bearings/ball/*.py", "bearings/contact/*.py", "bearings/fit/*.py", "bearings/heat/*.py",
    "bearings/kinds/*.py", "bearings/life/*.py", "bearings/catalogue/printed.py",
    "bearings/film.py", "bearings/fits.py", "bearings/lubricant.py", "bearings/ball_guide.py",
    "bearings/materials.py", "rotordyn/equation/*.py", "rotordyn/equation/elements/*.py",
    "rotordyn/numerics/*.py", "rotordyn/preload/*.py", "rotordyn/units.py",
    "rotordyn/analyses/*/tables.py", "rotordyn/analyses/*/result.py",
)  # fmt: skip
SWAPPED = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult}
FILES = 8  # of tests to a mutant, and as many of others
QUICK, SECONDS = 1.0, 5.0  # of processor time in each, at first and at last
TOLERANCE = 1e-5  # below it a number is the size of an error, above it physics
APART = {"hostile", "docs", "cases", "page", "view", "case", "figures", "study"}
EQUIVALENT = {  # path -> change, word of its line, why: of mutants that change no result
    "bearings/ball_guide.py": [("2.0 -> 2.2", "brentq", "a wider bracket of the same zero")],
    "bearings/ball/potential.py": [
        (
            "gap[1] / where(pinched, turning, 1.0) -> gap[1] * where(pinched, turning, 1.0)",
            "rise",
            "the step of an iteration",
        ),
        (
            "c.inner.stiffness ** 2 -> (c.inner.stiffness) ** ((2) * 1.1)",
            "slope",
            "the rounding of a load",
        ),
        (
            "outer * outer - along * along -> outer * outer + along * along",
            "across",
            "where an iteration starts",
        ),
        ("-cos -> cos", "pressed", "where an iteration starts"),
        ("inner + outer -> inner - outer", "beyond", "where an iteration starts"),
        ("3.0 -> 3.3000000000000003", "part", "where an iteration starts"),
        ("energy + slack -> energy - slack", "most", "the rounding of an energy"),
        ("4.0 -> 4.4", "noise", "the rounding of a force"),
        ("4.0 -> 4.4", "slack", "the rounding of an energy"),
    ],
    "bearings/heat/total.py": [("0.5 -> 0.55", "part", "a share of no loss at all")],
    "rotordyn/equation/housing.py": [
        (
            "motion * sign -> motion / sign",
            "under",
            "signs are 1 or -1",
        ),
        (
            "sign[:, None] * matrix * sign -> sign[:, None] * matrix / sign",
            "matrix",
            "signs are 1 or -1",
        ),
        (
            "(mass + mass.T) / 2.0 -> (mass + mass.T) * 2.0",
            "cholesky",
            "four times a matrix is as definite",
        ),
    ],
    "rotordyn/equation/seat.py": [
        (
            "signs[..., :, None] * values * signs[..., None, :] -> "
            "signs[..., :, None] * values / signs[..., None, :]",
            "signs",
            "signs are 1 or -1",
        )
    ],
    "rotordyn/numerics/conservative.py": [
        ("1j -> 1.1j", "_hermitian", "as Hermitian, whatever the factor")
    ],
    "rotordyn/numerics/follow.py": [
        (
            "0.5 -> 0.55",
            "return",
            "which place between two steps is looked at next",
        ),
        ("1e+300 -> 1.1000000000000002e+300", "initial", "larger than any gap, both"),
    ],
    "rotordyn/numerics/continued.py": [
        (
            "1.0 -> 1.1",
            "NEARNESS",
            "a divisor where both poles are nothing",
        ),
    ],
    "rotordyn/preload/friction.py": [
        (
            "self.limit * (1.0 + BEYOND) -> self.limit / (1.0 + BEYOND)",
            "slips",
            "the rounding of a limit",
        ),
    ],
    "rotordyn/equation/restraint.py": [
        (
            "node_matrix(_largest(support)) / scale / scale[:, None] -> "
            "node_matrix(_largest(support)) / scale * scale[:, None]",
            "stiff",
            "rows of another size span the same",
        ),
        (
            "1.0 -> 1.1",
            "length, length",
            "a scale that is taken back",
        ),
    ],
    "rotordyn/preload/balance.py": [
        ("1.0 -> 1.1", "largest", "an equation of nothing alone"),
    ],
    "rotordyn/preload/under_load.py": [
        (
            "x + dx -> x - dx",
            "coordinates",
            "where an iteration starts",
        ),
    ],
    "rotordyn/equation/structure.py": [
        (
            "1.0 -> 1.1",
            "ratio=",
            "the speed of what does not turn",
        ),
        (
            "-housing.under[name] -> housing.under[name]",
            "motions",
            "a housing is felt through its connections alone, its own motion is no result",
        ),
    ],
    "rotordyn/equation/axial_force.py": [
        (
            "middle[:, None] + length[:, None] / 2.0 * xi -> "
            "middle[:, None] - length[:, None] / 2.0 * xi",
            "middle",
            "points and weights of a Gauss rule are the same from either end",
        ),
    ],
    "bearings/lubricant.py": [
        (
            "0.01 -> 0.011000000000000001",
            "step",
            "the step of a difference",
        ),
    ],
    "rotordyn/equation/free_directions.py": [
        (
            "1.0 -> 1.1",
            "scale > 0.0",
            "a divisor of nothing",
        ),
        (
            "1.0 -> 1.1",
            "rows / np",
            "a divisor of nothing",
        ),
        (
            "DEPENDENT ** 2 -> (DEPENDENT) ** ((2) * 1.1)",
            "values",
            "the rounding of nothing, both",
        ),
    ],
    "rotordyn/equation/sleeve.py": [
        (
            "self.fine.weightless ** 2 -> (self.fine.weightless) ** ((2) * 1.1)",
            "mass",
            "a mass that is next to nothing, both",
        ),
    ],
    "rotordyn/preload/history.py": [
        (
            "2.0 -> 2.2",
            "most",
            "how far a table goes that is doubled as needed",
        ),
    ],
    "rotordyn/preload/on_films.py": [
        (
            "growth - films.growth -> growth + films.growth",
            "change",
            "more rounds to one fixed point",
        ),
        ("axial - films.axial -> axial + films.axial", "change", "more rounds to one fixed point"),
    ],
    "rotordyn/preload/play.py": [
        (
            "0.5 -> 0.55",
            "across",
            "which place is tried next",
        ),
        ("a + b -> a - b", "fb != fa", "ends of equal value, which no bracket has"),
    ],
    "rotordyn/preload/stops.py": [
        ("high - low -> high + low", "zero is not None", "one more round to the same zero"),
        (
            "zero + margin -> zero - margin",
            "guess",
            "which samples of a bracket are taken next",
        ),
        (
            "high - low -> high + low",
            "margin",
            "which samples of a bracket are taken next",
        ),
        ("zero - margin -> zero + margin", "guess", "which samples of a bracket are taken next"),
    ],
    "bearings/heat/ellipse.py": [
        (
            "(part * vx).sum(axis=1) - contacts.creep -> (part * vx).sum(axis=1) + contacts.creep",
            "force_x",
            "a contact pushed to the other side is its mirror image",
        ),
        (
            "0.001 * hxx -> 0.001 / hxx",
            "det",
            "how a step is kept from being singular",
        ),
        (
            "size * size -> size / size",
            "cube",
            "the step of an iteration",
        ),
        (
            "0.5 -> 0.55",
            "share",
            "weights are brought to a sum of 1",
        ),
        (
            "np.arange(AROUND) + 0.5 -> np.arange(AROUND) - 0.5",
            "turn",
            "the same places, one step around",
        ),
        (
            "0.001 -> 0.0011",
            "det",
            "how a step is kept from being singular",
        ),
    ],
    "rotordyn/equation/constraint.py": [
        ("0.5 -> 0.55", "first", "which of the large entries of a row gives its sign"),
        (
            "rows * np.sign(rows[np.arange(len(rows)), first])[:, None] -> "
            "rows / np.sign(rows[np.arange(len(rows)), first])[:, None]",
            "sign",
            "signs are 1 or -1",
        ),
    ],
    "rotordyn/numerics/pole_refinement.py": [
        ("0.5 -> 0.55", "half", "how a step that gains nothing is shortened"),
    ],
    "rotordyn/preload/leaving.py": [
        (
            "0.9 -> 0.9900000000000001",
            "zero",
            "which load is tried next",
        ),
    ],
    "rotordyn/preload/equilibrium.py": [
        (
            "0.5 -> 0.55",
            "length",
            "how a step that gains nothing is shortened",
        ),
    ],
    "rotordyn/numerics/pole_count.py": [
        ("0.05 -> 0.05500000000000001", "damped", "where an iteration starts"),
    ],
    "rotordyn/equation/fineness.py": [
        ("2.0 -> 2.2", "low, high", "a wider bracket of the same zero"),
    ],
    "rotordyn/equation/component.py": [
        (
            "1.0 -> 1.1",
            "self.ports), np",
            "loads of any size are answered by the same motions",
        ),
        ("count * len(self.dofs) -> count / len(self.dofs)", "large", "how a matrix is kept"),
    ],
    "rotordyn/numerics/synchronous.py": [
        (
            "np.sqrt(np.abs(stiffness).max()) / order -> np.sqrt(np.abs(stiffness).max()) * order",
            "scale",
            "a scale that is taken back",
        ),
    ],
    "rotordyn/numerics/crossing.py": [
        (
            "0.5 -> 0.55",
            "low, high",
            "a wider bracket of the same zero",
        ),
    ],
    "rotordyn/preload/as_assembled.py": [
        (
            "1.0 -> 1.1",
            "likely",
            "where an iteration starts",
        ),
        (
            "0.05 * largest + 1.0 -> 0.05 * largest - 1.0",
            "likely",
            "where an iteration starts",
        ),
    ],
    "rotordyn/preload/growth.py": [
        (
            "0.9 -> 0.9900000000000001",
            "ring",
            "a free ring expands alike, whatever its thickness",
        ),
        (
            "1.1 -> 1.2100000000000002",
            "ring",
            "a free ring expands alike, whatever its thickness",
        ),
    ],
    "rotordyn/preload/axial_force.py": [
        (
            "1.0 + POINTS -> 1.0 - POINTS",
            "POINTS",
            "points and weights of a Gauss rule are the same from either end",
        ),
    ],
    "bearings/fit/compound.py": [
        (
            "slope + compliance @ p1 -> slope - compliance @ p1",
            "rate",
            "where gaps close no fit lets go",
        ),
    ],
    "rotordyn/equation/shaft.py": [
        (
            "1.0 -> 1.1",
            "return resolved",
            "where a search starts",
        ),
        (
            "1.0 -> 1.1",
            "element, np.clip",
            "what lies beyond an element is rounding",
        ),
    ],
    "bearings/heat/temperature.py": [
        (
            "1.0 -> 1.1",
            "LONGEST",
            "the step of an iteration",
        ),
    ],
    "rotordyn/equation/statics.py": [
        (
            "0.5 -> 0.55",
            "swapaxes",
            "signs of values of a matrix of any scale",
        ),
    ],
    "rotordyn/numerics/correct.py": [
        (
            "2.0 -> 2.2",
            "swapaxes",
            "the start of an iteration to a left vector",
        ),
    ],
    "rotordyn/numerics/modes.py": [
        (
            "1.0 -> 1.1",
            "balances",
            "a scale that is taken back",
        ),
    ],
    "rotordyn/preload/heat_balance.py": [
        (
            "0.5 -> 0.55",
            "damping = ",
            "the step of an iteration",
        ),
    ],
}
ROOMS = {  # tests of a folder, beside those named like the module
    "bearings/ball": ("tests/verification/test_bearing_", "tests/literature/test_bearing_"),
    "bearings/contact": ("tests/literature/test_bearing_hertz", "tests/bearings/test_elliptic"),
    "bearings/fit": ("tests/bearings/test_rings", "tests/literature/test_fits"),
    "bearings/heat": ("tests/bearings/test_heat", "tests/verification/test_heat_balance"),
    "bearings/kinds": ("tests/verification/test_four_point", "tests/bearings"),
    "bearings/life": ("tests/bearings/test_life", "tests/literature/test_life"),
    "bearings": ("tests/bearings",),
    "rotordyn/equation": ("tests/rotordyn/equation", "tests/verification/test_dense_rotor"),
    "rotordyn/analyses/bearing/": ("tests/rotordyn/analyses/bearing/",),
    "rotordyn/numerics": ("tests/rotordyn/numerics", "tests/verification/test_random_rotors"),
    "rotordyn/preload": ("tests/rotordyn/preload", "tests/verification/test_spindle_"),
    "rotordyn/analyses": ("tests/rotordyn/report/test_tables", "tests/rotordyn/report/test_summ"),
}


class Mutant(NamedTuple):
    """A file of the tree, the line that is changed, how, and the whole text after it."""

    path: str
    line: int
    before: str
    after: str
    text: str

    @property
    def changed(self) -> str:
        """The line after the change."""
        return self.text.splitlines()[self.line - 1]


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
    """Operations and numbers within functions, of floating-point numbers as far as one can see;
    not the defaults of arguments, which are no part of the code that is exchanged."""
    small = {"EPS", *_tolerances(tree)}
    for function in ast.walk(tree):
        if isinstance(function, ast.FunctionDef):
            for node in (node for line in function.body for node in ast.walk(line)):
                if isinstance(node, ast.BinOp) and type(node.op) in {*SWAPPED, ast.Pow}:
                    sides = {each.id for each in (node.left, node.right) if type(each) is ast.Name}
                    if not _whole(node) and not sides & small:
                        yield node
                elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
                    if not isinstance(node.operand, ast.Constant):
                        yield node
                elif isinstance(node, ast.Constant) and _is_large(node.value):
                    yield node


def _is_large(value: object) -> bool:
    return type(value) in (float, complex) and abs(value) > TOLERANCE  # type: ignore[arg-type]


def _tolerances(tree: ast.AST) -> Iterator[str]:
    """Names of constants of a module that are."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Assign) and isinstance(node.value, ast.Constant):
            value = node.value.value
            if type(value) is float and value <= TOLERANCE:
                yield from (each.id for each in node.targets if isinstance(each, ast.Name))


def _whole(node: ast.BinOp) -> bool:
    """Counting, indexing and joining of text or lists are no physics."""
    sides = (node.left, node.right)
    kinds = (ast.List, ast.Tuple, ast.JoinedStr)
    return any(
        isinstance(each, kinds) or (isinstance(each, ast.Constant) and not _is_large(each.value))
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
        return repr(node.value * 1.1)  # type: ignore[operator]
    if isinstance(node, ast.UnaryOp):
        return ast.unparse(node.operand)
    assert isinstance(node, ast.BinOp)
    if isinstance(node.op, ast.Pow):
        return f"({ast.unparse(node.left)}) ** (({ast.unparse(node.right)}) * 1.1)"
    node.op = SWAPPED[type(node.op)]()
    return ast.unparse(node)


def reason(mutant: Mutant) -> str:
    """Why the mutant changes no result, empty where it does."""
    line = mutant.changed
    change = f"{mutant.before} -> {mutant.after}"
    known = EQUIVALENT.get(mutant.path, [])
    return next((why for same, word, why in known if same == change and word in line), "")


def related(path: str, line: str = "") -> list[str]:
    """Test files for a module: those named after it, those of its room, those that name it or what
    it defines, then the two that most often use the long names of a ``line``."""
    module = path.removesuffix(".py").replace("/", ".")
    tree = ast.parse((ROOT / path).read_text(encoding="utf-8"))
    names = [
        node.name
        for node in tree.body
        if isinstance(node, ast.FunctionDef | ast.ClassDef) and not node.name.startswith("_")
    ]
    parts = [part for part in module.split(".")[1:] if part not in ("tables", "result")]
    words = re.compile(rf"{re.escape(module)}\b|\b({'|'.join([*names, parts[-1]])})\b")
    room = next((tests for place, tests in ROOMS.items() if path.startswith(place)), ())
    long = re.compile(rf"\b({'|'.join(re.findall(r'[a-z_]{10,}', line)) or '-'})\b")
    scored, using = [], []
    for test in sorted((ROOT / "tests").rglob("test_*.py")):
        name = str(test.relative_to(ROOT))
        if not APART & {*test.relative_to(ROOT).parts}:
            named = 100 * (parts[-1] in test.stem) + 20 * any(part in test.stem for part in parts)
            near = any(name.startswith(place) for place in room)
            text = test.read_text(encoding="utf-8")
            score = named + 3 * len(words.findall(text))
            if used := len(long.findall(text)):
                using.append((-used, name))
            if score or near:
                scored.append((-score, not near, name))
    of_room = [name for _, apart, name in sorted(scored) if not apart][: FILES // 2]
    others = [name for score, _, name in sorted(scored) if score and name not in of_room]
    chosen = of_room + others[: FILES - len(of_room)]
    return chosen + [name for _, name in sorted(using) if name not in chosen][:2]


def killed(mutant: Mutant, tests: Tests, files: Sequence[str]) -> tuple[str, int]:
    """The first test that fails, empty where none does; how many tests execute the place.

    The quick ones of related files are tried first, then those of other ``files`` that reach the
    place soonest, then the slow ones of both.
    """
    function = f"{mutant.path}:{function_at(mutant.text, mutant.line)}"
    near = related(mutant.path, mutant.changed)
    reached = {file: tests.reaching(file, function) for file in dict.fromkeys([*near, *files])}
    far = [file for file in files if file not in near and reached[file]]
    far.sort(key=lambda file: reached[file][0].seconds)
    tried: set[str] = set()
    for chosen, seconds in (
        (near, QUICK),
        (far[:FILES], QUICK),
        (near, SECONDS),
        (far[:FILES], SECONDS),
    ):
        ran = [each for file in chosen for each in _in_time(reached[file], seconds)]
        left = [each for each in ran if each.name not in tried]
        tried |= {each.name for each in left}
        if left and (by := tests.failing(left, mutant.path, mutant.text)):
            return by, len(tried)
    return "", len(tried)


def _in_time(tests: list[Ran], seconds: float) -> list[Ran]:
    """The quickest, as many as time allows, at least one."""
    spent = accumulate(each.seconds for each in tests)
    return [each for each, till in zip(tests, spent, strict=True) if till <= seconds] or tests[:1]


class Trial:
    """Plugin of pytest: instead of the tests, mutants are tried on them."""

    def __init__(self, made: list[Mutant], files: list[str], known: Path, verbose: bool) -> None:
        self.made, self.files, self.known, self.verbose = made, files, known, verbose

    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        """A line for each that survives."""
        tests = Tests(session, self.known)
        tried = dead = same = 0
        for mutant in self.made:
            if why := reason(mutant):
                same += 1
                print(f"changes nothing, {why}: {mutant.path}:{mutant.line}", flush=True)  # noqa: T201
                continue
            by, reached = killed(mutant, tests, self.files)
            tried, dead = tried + 1, dead + bool(by)
            if self.verbose or not by:
                what = f"{mutant.path}:{mutant.line}: {mutant.before} -> {mutant.after}"
                how = f"killed by {by}" if by else f"SURVIVES {reached} tests"
                print(f"{how}: {what}", flush=True)  # noqa: T201
        print(f"{tried} mutants, {dead} killed; {same} that change nothing")  # noqa: T201
        return True


def main() -> int:
    """Try them, a line for each that survives."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--only", default="", help="a word of the paths of mutants to try")
    parser.add_argument("--verbose", action="store_true")
    parser.add_argument(
        "--folder", help="where what is known of tests is kept for another run of the same tree"
    )
    asked = parser.parse_args()
    sys.modules["numba"] = None  # type: ignore[assignment]
    made = [each for each in mutants(asked.count, asked.seed) if asked.only in each.path]
    files = sorted({file for each in made for file in related(each.path, each.changed)})
    with tempfile.TemporaryDirectory() as place:
        known = Path(asked.folder or place).resolve()
        known.mkdir(exist_ok=True)
        trial = Trial(made, files, known, asked.verbose)
        return int(pytest.main([*files, *USUAL], plugins=[trial]))


if __name__ == "__main__":
    sys.exit(main())
