"""The last measurement (``benchmarks/results.json``) as tables, with targets."""

from __future__ import annotations

import json
from typing import Any

from docs.generate.bearing_times import bearing_parts
from docs.generate.intervals import interval_parts
from docs.generate.marked import table
from docs.generate.peer import peer_parts
from docs.generate.places import MEASURED
from docs.generate.random_bearings import (
    plain_newton,
    random_bearings,
    random_friction,
    random_kinds,
    random_paths,
)
from docs.generate.scaling import scaling_parts
from docs.generate.sweeps import sweep_parts

Measured = dict[str, Any]
# Name of a process measured -> target of its wall time [s].
WALL_TARGETS = {
    "run, the first ever": 5.0,
    "run": 3.5,
    "run --no-figures": 1.5,
    "check": 0.35,
    "--help": 0.06,
}
SOLVE_TARGET, MEMORY_TARGET, STUDY_TARGET, IMPORT_TARGET = 0.5, 350.0, 25.0, 0.02
PAGE_TARGETS = 0.6, 8.0, 2.0  # s, MB, s


def measured() -> Measured:
    """The last measurement."""
    found: Measured = json.loads(MEASURED.read_text(encoding="utf-8"))
    return found


def targets(found: Measured) -> str:
    """Times of a user's commands, each with its target."""
    walls = {p["name"]: p for p in found["processes"]}
    rows = [_timed("all solve stages together", found["solve"], SOLVE_TARGET)]
    rows += [_timed(_command(n), walls[n]["wall"], t) for n, t in WALL_TARGETS.items()]
    bare = walls["import rotordyn"]["wall"] - walls["an empty Python"]["wall"]
    rows.append(_timed("`import rotordyn`, over an empty Python", bare, IMPORT_TARGET))
    peak = found["memory"]["tree"] or walls["run"]["memory"]
    rows.append(("peak memory of the run", f"{peak:.0f} MB", *_verdict(peak, MEMORY_TARGET, "MB")))
    if found.get("install"):
        taken = found["install"]
        size = f"{taken['seconds']:.0f} s, {taken['megabytes']:.0f} MB"
        rows.append(("installing from nothing (`scripts/environment run`)", size, "–", "stated"))
    return table(("quantity", "measured:", "target:", ""), rows)


def benchmark_parts(found: Measured) -> dict[str, str]:
    """The parts of the page on times."""
    return {
        "machine": f"Measured on {machine(found)}.",
        "targets": targets(found),
        "processes": _processes(found),
        "stages": _stages(found),
        **bearing_parts(found["bearing"]),
        "frf": _frf(found),
        "page": _page(found),
        "study": _study(found),
        "optima": _optima(found),
        "precision": _precision(found),
        **sweep_parts(found["sweeps"]),
        "precision-time": _marching(found),
        "precision-rings": _ring_bodies(found),
        **scaling_parts(found["scaling"]),
        **peer_parts(found["peer"]),
        **interval_parts(found["intervals"]),
        "random": _random(found),
        "random-dense": _random_dense(found),
        "random-bearings": random_bearings(found["random_bearings"]),
        "random-friction": random_friction(found["random_bearings"]),
        "random-kinds": random_kinds(found["random_kinds"]),
        "random-paths": random_paths(found["random_bearings"]),
        "plain-newton": plain_newton(found["random_bearings"]["balls"]),
    }


def machine(found: Measured) -> str:
    """The machine in one phrase."""
    m = found["machine"]
    libraries = ", ".join(f"{name} {version}" for name, version in m["libraries"].items())
    busy = "" if m["busy"] is None else f" (load average {m['busy']:.1f} at the start)"
    return f"{m['processors']} processors{busy}, {m['system']}, Python {m['python']}, {libraries}"


def _command(name: str) -> str:
    command, comma, when = name.partition(", ")
    return f"`rotordyn {command}`{comma}{when}"


def _timed(what: str, value: float, target: float) -> tuple[str, ...]:
    return (what, f"{value:.3g} s", *_verdict(value, target, "s"))


def _verdict(value: float, target: float, unit: str) -> tuple[str, str]:
    missed = f"**missed by {100.0 * (value / target - 1.0):.0f} %**"
    return f"{target:g} {unit}", "met" if value <= target else missed


def _processes(found: Measured) -> str:
    rows = [
        (
            p["name"],
            *(f"{p[key]:.3f}" for key in ("wall", "fastest", "cpu")),
            f"{p['memory']:.0f}",
            str(p["runs"]),
        )
        for p in found["processes"]
    ]
    head = ("process", "wall [s]:", "fastest:", "CPU [s]:", "largest process [MB]:", "runs:")
    return table(head, rows)


def _stages(found: Measured) -> str:
    rows = [(name, f"{1e3 * seconds:.1f}") for name, seconds in found["stages"].items()]
    return table(("stage", "time [ms]:"), rows)


def _frf(found: Measured) -> str:
    f = found["frf"]
    rows = [
        ("speeds × frequencies × pairs", f"{f['speeds']} × {f['frequencies']} × {f['pairs']}"),
        ("eigenvalues, once per speed", f"{f['modes']:.0f} µs per speed"),
        ("map", f"{f['point']:.3f} µs per speed and frequency, {f['pairs']} pairs together"),
        (
            "error against a direct solution of the same matrices",
            f"{f['error']:.0e} of the largest receptance",
        ),
    ]
    return table(("", "FRF map"), rows)


def _page(found: Measured) -> str:
    kept = found["report"]
    seconds, megabytes, shown, drawn = (
        kept[key] for key in ("seconds", "megabytes", "shown", "drawn")
    )
    slowest, largest, longest = PAGE_TARGETS
    rows = [
        ("CPU time of writing it", f"{seconds:.2f} s", *_verdict(seconds, slowest, "s")),
        ("size", f"{megabytes:.1f} MB", *_verdict(megabytes, largest, "MB")),
        ("time to open it from disk", f"{shown:.2f} s", *_verdict(shown, longest, "s")),
        ("time until its first charts are drawn", f"{drawn:.2f} s", "", ""),
    ]
    return table(("page of the flagship", "measured:", "target:", ""), rows)


def _marching(found: Measured) -> str:
    rows = [
        (f"{r['steps']:.3g}", f"{r['error']:.0e}", f"{r['seconds']:.2f}") for r in found["marching"]
    ]
    return table(("steps in a period of max_frequency:", "true error:", "time [s]:"), rows)


def _ring_bodies(found: Measured) -> str:
    measured = found["ring_bodies"]
    rows = [
        (f"{r['step']:g}", f"{r['harmonics']}", f"{r['error']:.0e}", f"{r['seconds']:.2f}")
        for r in measured["bodies"]
    ]
    head = ("elements along the groove [°]:", "harmonics:", "error:", "time of a ring [s]:")
    return table(head, rows)


def _precision(found: Measured) -> str:
    """Time and error of each setting of the elements."""
    head = (
        "machine",
        "elements",
        "requested:",
        "unknowns kept:",
        "true error:",
        "reported error:",
        "time [ms]:",
    )
    lines = [
        (
            r["machine"],
            r["elements"],
            r["setting"],
            str(r["unknowns"]),
            f"{r['error']:.1e}",
            f"{r['reported']:.1e}",
            f"{1e3 * r['seconds']:.0f}",
        )
        for r in found["precision"]
    ]
    return table(head, lines)


def _random(found: Measured) -> str:
    """Results of random rotors."""
    head = (
        "sections",
        "requested accuracy:",
        "rotors:",
        "frequencies:",
        "missing or spurious:",
        "beyond the accuracy:",
        "largest error:",
        "reported within a factor of 3:",
    )
    lines = [
        (
            sort,
            f"{r['accuracy']:.0e}",
            str(r["rotors"]),
            str(r["frequencies"]),
            str(r["missing"]),
            str(r["beyond"]),
            f"{r['worst']:.1e}",
            f"{r['within_3']} of {r['judged']}",
        )
        for sort, key in (("cylinders", "random_rotors"), ("cones", "conical_rotors"))
        for r in found[key]
    ]
    return table(head, lines)


def _study(found: Measured) -> str:
    """Computing time of many variants of one machine."""
    head = ("variants:", "speeds each:", "processes:", "total time [s]:", "target:", "")
    s = found["study"]
    words = (f"{s['seconds']:.3g}", *_verdict(s["seconds"], STUDY_TARGET, "s"))
    text = table(head, [(str(s["count"]), str(s["speeds"]), str(s["processes"]), *words)])
    lost = s["unsolved"]
    each = f"{1e3 * s['variant']:.3g} ms"
    after = f"Of these {lost} have no solution; a variant takes {each}."
    if b := s.get("beside"):
        after += (
            f" This is the time of {b['revision']}; alternating with it, a later version took "
            f"{b['ratio']:.3g} of its time ({b['least']:.3g} to {b['most']:.3g} in {b['pairs']} "
            "pairs of runs)."
        )
    return f"{text}\n\n{after}"


def _optima(found: Measured) -> str:
    """Difference of optima from the best of a grid."""
    every = found["optima"]["problems"]
    none = sum(each["none feasible"] for each in every)
    trials = [each["trials"] for each in every]
    rows = [
        ("problems, of these without a machine within the limits", f"{len(every)}, {none}"),
        ("trials per problem", f"{min(trials)} to {max(trials)}"),
        ("machines of a grid, at most", f"{max(each['grid'] for each in every)}"),
        ("worse than the best of the grid, at most", f"{100.0 * found['optima']['worst']:.2g} %"),
        (
            "better than the best of the grid, at most",
            f"{-100.0 * min(each['behind'] for each in every):.2g} %",
        ),
    ]
    return table(("random design problems", "result:"), rows)


def _random_dense(found: Measured) -> str:
    """Results of random rotors on damped anisotropic supports."""
    head = (
        "rotors with",
        "rotors:",
        "set aside:",
        "most sections:",
        "modes:",
        "missing:",
        "spurious:",
        "largest difference:",
        "reported within a factor of 3:",
        "warnings of libraries:",
    )
    names = ("rotors", "blurred", "most_sections", "modes", "missing", "spurious")
    sorts = {
        "the same elements": "dense_rotors",
        "cones": "tapered_rotors",
        "joints": "jointed_rotors",
        "a further rotor": "coaxial_rotors",
    }
    lines = []
    for sort, key in sorts.items():
        r = found[key]
        judged = f"{r['within_3']} of {r['judged']}" if sort != "the same elements" else "–"
        cells = [str(r[name]) for name in names]
        lines.append((sort, *cells, f"{r['worst']:.1e}", judged, str(r["warnings"])))
    return table(head, lines)
