"""Commands of the command line, their arguments and options."""

from __future__ import annotations

import argparse
from typing import Any

import rotordyn
from rotordyn.cli import reading, solving, studies

CASE = "case file (YAML), or the name of a case that comes with rotordyn"
FILE = "case (default), spindle, tool, bearing, material, study, optimum or identification"
EXIT_CODES = """exit codes: 0 done; 2 bad input, or more than a run may take; 3 no speed of the case
has a physical solution (with --strict: one has not); 130 interrupted; 1 a bug of rotordyn"""
NO_FIGURES = "write numbers and tables alone"
QUIET = "print nothing but errors"
REPORT = "also write report.html, a page to share"


def parser() -> argparse.ArgumentParser:
    """Build the parser of all commands; its result has the function to call as ``command``."""
    whole = argparse.ArgumentParser(
        prog="rotordyn",
        description="Dynamics of high-speed machining spindles.",
        epilog=EXIT_CODES,
    )
    whole.add_argument("--version", action="version", version=f"rotordyn {rotordyn.__version__}")
    commands = whole.add_subparsers(title="commands", required=True, metavar="COMMAND")
    _add_run(commands)
    _add_studies(commands)
    _add_report(commands)
    _add_reading(commands)
    return whole


def _add_run(commands: Any) -> None:
    run = commands.add_parser("run", help="solve a case and write its results", epilog=EXIT_CODES)
    run.add_argument("case", metavar="CASE", help=CASE)
    run.add_argument("-o", "--output", metavar="DIR", help="results folder (out/<case name>)")
    run.add_argument("--only", metavar="NAME,…", help="only these analyses of the case")
    run.add_argument("--variant", metavar="NAME", help="only this variant of a case that compares")
    run.add_argument("--no-figures", action="store_true", help=NO_FIGURES)
    run.add_argument(
        "--format", metavar="NAME,…", help="of figures: png (300 dpi, as without this), pdf, svg"
    )
    run.add_argument(
        "--explain",
        action="store_true",
        help="also print what was solved, reused or skipped, why",
    )
    run.add_argument(
        "--interval",
        action="store_true",
        help="also the range of every result over the uncertain values of the case",
    )
    run.add_argument("--report", action="store_true", help=REPORT)
    run.add_argument(
        "--longest", type=float, metavar="S", help="seconds that it may take by estimate (600)"
    )
    run.add_argument("--yes", action="store_true", help="whatever time and memory it needs")
    run.add_argument("--quiet", action="store_true", help=QUIET)
    run.add_argument(
        "--strict", action="store_true", help="exit with 3 if any speed has no physical solution"
    )
    run.set_defaults(command=solving.run)


def _add_studies(commands: Any) -> None:
    sweep = _study(commands, "sweep", "solve a case at many points of its varied values")
    sweep.add_argument("study", metavar="STUDY", help="study file (YAML)")
    sweep.add_argument(
        "--cluster", metavar="ADDRESS", help="of a dask scheduler whose workers solve instead"
    )
    sweep.add_argument("--yes", action="store_true", help="even if it takes more than an hour")
    sweep.set_defaults(command=studies.sweep)
    best = _study(commands, "optimise", "find the best design within given choices and limits")
    best.add_argument("optimum", metavar="OPTIMUM", help="file of goals and limits (YAML)")
    best.set_defaults(command=studies.optimise)
    found = _study(commands, "identify", "identify values of a case from measurements")
    found.add_argument("study", metavar="STUDY", help="file of unknowns and measurements (YAML)")
    found.add_argument("--report", action="store_true", help=REPORT)
    found.set_defaults(command=studies.identify)


def _study(commands: Any, name: str, does: str) -> argparse.ArgumentParser:
    """Add a command that solves many machines."""
    study: argparse.ArgumentParser = commands.add_parser(name, help=does, epilog=EXIT_CODES)
    study.add_argument("-o", "--output", metavar="DIR", help="its folder (out/<file name>)")
    study.add_argument("--workers", type=int, metavar="N", help="processes (one a processor)")
    study.add_argument("--no-figures", action="store_true", help=NO_FIGURES)
    study.add_argument("--quiet", action="store_true", help=QUIET)
    return study


def _add_report(commands: Any) -> None:
    report = commands.add_parser("report", help="write a results folder as one HTML page")
    report.add_argument(
        "folder", metavar="DIR", help="results folder of run, sweep, optimise or identify"
    )
    report.add_argument("-o", "--output", metavar="FILE", help="the page (DIR/report.html)")
    report.set_defaults(command=solving.report)


def _add_reading(commands: Any) -> None:
    check = commands.add_parser("check", help="read and validate a case, compute nothing")
    check.add_argument("case", metavar="CASE", help=CASE)
    check.set_defaults(command=reading.check)
    new = commands.add_parser("new", help="write a commented case and spindle file to start from")
    new.add_argument("name", metavar="NAME", help="writes NAME.yaml and NAME_spindle.yaml here")
    new.set_defaults(command=reading.new)
    cases = commands.add_parser("cases", help="list the cases that come with rotordyn")
    cases.set_defaults(command=reading.cases)
    models = commands.add_parser("models", help="list the models of the library, with sources")
    models.add_argument("kind", metavar="KIND", nargs="?", help="bearings, materials, spindles …")
    models.set_defaults(command=reading.models)
    schema = commands.add_parser("schema", help="print the JSON Schema of a file, for editors")
    schema.add_argument("file", metavar="FILE", nargs="?", default="case", help=FILE)
    schema.set_defaults(command=reading.schema)
