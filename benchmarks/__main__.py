"""All measurements, and the page written from them:  python -m benchmarks [--peer PATH] [--surveys]

About a quarter of an hour on a quiet machine; one after the other, each in a separate process.
"""

from __future__ import annotations

import argparse
import subprocess

from benchmarks.processes import ROOT, python

TIMES = (
    ("benchmarks/main_job.py",),
    ("-m", "benchmarks.report"),
    ("-m", "benchmarks.study"),
    ("-m", "benchmarks.scaling"),
    ("-m", "benchmarks.marching"),
    ("-m", "benchmarks.ring_bodies"),
)
SURVEYS = (("-m", "benchmarks.random_rotors"), ("-m", "benchmarks.random_bearings"))


def main() -> None:
    """Measure as the command line says, then write every document again."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--peer", help="interpreter that has the peer: compare with it, too")
    parser.add_argument(
        "--surveys", action="store_true", help="also random rotors and bearings: an hour more"
    )
    asked = parser.parse_args()
    peer = (("-m", "benchmarks.peer", "--python", asked.peer),) if asked.peer else ()
    for step in (*TIMES, *peer, *(SURVEYS if asked.surveys else ()), ("-m", "docs.generate")):
        subprocess.run(python(*step), cwd=ROOT, check=True)


if __name__ == "__main__":
    main()
