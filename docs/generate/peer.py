"""Comparison of computing times with ROSS (``python -m benchmarks.peer``) as tables."""

from __future__ import annotations

from typing import Any

from benchmarks.peer import machine
from docs.generate.marked import table

Measured = dict[str, Any]
# Work -> target of the ratio of times, isotropic and general; its name on the page.
TARGETS = {
    "campbell": (300.0, 60.0),
    "one response": (4000.0, 800.0),
    "all responses": (4000.0, 800.0),
    "map of one response": (5000.0, 5000.0),
}
NAMES = {
    "campbell": f"Campbell diagram, {len(machine.SPEEDS)} speeds, {machine.MODES} modes",
    "one response": "FRF, 2000 frequencies, one output",
    "all responses": "FRF, 2000 frequencies, every lateral motion of every node",
    "map of one response": f"FRF map, {len(machine.MAP_SPEEDS)} speeds × 2000 frequencies, "
    "one output",
}
FEWER_ERRORS = {"map of one response": "one response"}


def peer_parts(found: Measured) -> dict[str, str]:
    """The parts of the page on the comparison."""
    return {
        "peer-versions": _versions(found),
        "peer-times": _times(found),
        "peer-errors": _errors(found),
        "peer-starts": _starts(found),
    }


def _versions(found: Measured) -> str:
    ours, theirs = (_named(side) for side in (found, found["peer"]))
    busy = "" if found["busy"] is None else f" Load average at the start: {found['busy']:.1f}."
    return f"With rotordyn: {ours}. With ROSS: {theirs}.{busy}"


def _named(side: Measured) -> str:
    libraries = ", ".join(f"{name} {version}" for name, version in side["libraries"].items())
    return f"{libraries}, Python {side['python']}"


def peer_seconds(theirs: Measured, kind: str, work: str) -> float:
    """Seconds of a whole work of the peer, from the time of one speed or one frequency."""
    line = next(own for own in theirs["works"] if own["kind"] == kind)
    if work == "campbell":
        return float(line["per_speed"] * len(machine.SPEEDS))
    points = len(machine.FREQUENCIES) * (
        len(machine.MAP_SPEEDS) if work == "map of one response" else 1
    )
    return float(line["per_frequency"] * points)


def _times(found: Measured) -> str:
    head = (
        "work",
        "bearings",
        "threads:",
        "setting",
        "rotordyn [s]:",
        "ROSS [s]:",
        "ratio:",
        "target:",
    )
    rows = [
        (NAMES[line["work"]], line["kind"], number, line["setting"], *_compared(line, both))
        for number, both in found["threads"].items()
        for line in both["ours"]
    ]
    order = {name: place for place, name in enumerate(NAMES.values())}
    rows.sort(key=lambda row: (order[row[0]], machine.KINDS.index(row[1]), row[2]))
    return table((*head, ""), rows)


def _compared(line: Measured, both: Measured) -> tuple[str, ...]:
    theirs = peer_seconds(both["theirs"], line["kind"], line["work"])
    target = TARGETS[line["work"]][machine.KINDS.index(line["kind"])]
    ratio = theirs / line["seconds"]
    verdict = "met" if ratio >= target else f"**missed by a factor of {target / ratio:.3g}**"
    times = (f"{line['seconds']:.3g}", f"{theirs:.3g}")
    return (*times, f"{ratio:.0f} ×", f"{target:.0f} ×", verdict)


def _errors(found: Measured) -> str:
    head = (
        "work",
        "bearings",
        "computed by",
        "true error:",
        "largest error:",
        "against a dense solution:",
    )
    rows = [
        (NAMES[work], kind, _side(side), *_error(own[work]))
        for work in NAMES
        if work not in FEWER_ERRORS
        for kind, sides in found["errors"].items()
        for side, own in sides.items()
        if work in own
    ]
    return table(head, rows)


def _side(name: str) -> str:
    return "ROSS" if name == "peer" else f"rotordyn, {name}"


def _error(own: Measured) -> tuple[str, str, str]:
    largest = own.get("worst", own["true"])
    return f"{own['true']:.1e}", f"{largest:.1e}", f"{own['discrete']:.1e}"


def _starts(found: Measured) -> str:
    starts, theirs = dict(found["starts"]), found["threads"]["1"]["theirs"]
    rows = [(name, f"{starts[name]:.3g}") for name in starts if name.startswith("import")]
    for line in theirs["works"]:
        kind = line["kind"]
        whole = starts["import ross"] + line["build"] + peer_seconds(theirs, kind, "campbell")
        what = f"Campbell diagram from the start of Python, {kind}"
        rows.append((f"{what}: rotordyn", f"{starts[f'Campbell, {kind}']:.3g}"))
        rows.append((f"{what}: ROSS", f"{whole:.3g}"))
    first = theirs["works"][0]
    rows += [
        ("ROSS: Campbell diagram at rest alone, isotropic", f"{theirs['at_rest']:.3g}"),
        ("ROSS: FRF at one speed, per frequency", f"{first['per_frequency']:.3g}"),
        (
            "ROSS: FRF with rotation at the frequency of the force, per frequency",
            f"{first['synchronous']:.3g}",
        ),
    ]
    return table(("process or call", "time [s]:"), rows)
