"""Computing time and accuracy of one bearing (``python -m benchmarks.bearing``) as tables."""

from __future__ import annotations

from typing import Any

from docs.generate.marked import table

Found = dict[str, Any]


def bearing_parts(found: Found) -> dict[str, str]:
    """The parts of the page on single bearings."""
    return {
        "bearing": _speed(found),
        "bearing-first": _first(found),
        "bearing-methods": _methods(found["methods"]),
        "bearing-tolerance": _tolerance(found["tolerance"]),
        "bearing-path-steps": _path_steps(found["path_steps"]),
        "bearing-hertz": _hertz(found["hertz"]),
    }


def _speed(found: Found) -> str:
    head = (
        "task",
        "way",
        "µs per state:",
        "µs per ball:",
        "target",
        "error of load or displacement:",
        "error of K:",
    )
    rows = [
        (
            line["task"],
            line["way"],
            _time(line["state"]),
            _time(line["ball"]),
            _verdict(line),
            f"{line['error']:.0e}",
            "–" if line["error_k"] is None else f"{line['error_k']:.0e}",
        )
        for line in found["speed"]
    ]
    lost = found["lost_from_unloaded"]
    missed = (
        "Number of the 25 balls that `fsolve` does not solve correctly from the unloaded geometry: "
        f"{lost}."
    )
    return f"{table(head, rows)}\n\n{missed}"


def _time(value: float) -> str:
    return f"{value:.3g}" if value < 1000.0 else f"{value:.0f}"


def _verdict(line: Found) -> str:
    """Comparison with the target, if there is one."""
    if line["target"] is None:
        return "–"
    value, limit = line[line["per"]], line["target"]
    missed = f"**missed by {100.0 * (value / limit - 1.0):.0f} %**"
    return f"{limit:g} µs a {line['per']}: {'met' if value <= limit else missed}"


def _first(found: Found) -> str:
    rows = [
        (
            line["what"],
            f"{1e3 * line['imported']:.0f}",
            f"{1e3 * line['first']:.0f}",
            f"{1e3 * line['second']:.2g}",
        )
        for line in found["first_call"]
    ]
    head = ("first call of a process", "import [ms]:", "first call [ms]:", "second call [ms]:")
    busy = "" if found["busy"] is None else f"\n\nLoad average at the start: {found['busy']:.1f}."
    return table(head, rows) + busy


def _methods(lines: list[Found]) -> str:
    head = (
        "method",
        "task",
        "K",
        "published [%]:",
        "one, numpy [%]:",
        "one, compiled [%]:",
        "batch, numpy [%]:",
        "one, numpy [µs]:",
        "one, compiled [µs]:",
        "batch, numpy [µs a state]:",
        "error of K:",
    )
    sorts, first = ("one", "compiled", "batch"), lines[0]
    rows = [
        (
            str(line["number"]),
            "load → displacement" if line["by_load"] else "displacement → load",
            line["stiffness"],
            f"{100.0 * line['published']:.0f}",
            *(f"{100.0 * line[sort] / first[sort]:.0f}" for sort in sorts),
            *(_time(line[sort]) for sort in sorts),
            f"{line['k_apart']:.0e}" if line["k_apart"] else "0",
        )
        for line in lines
    ]
    return table(head, rows)


def _tolerance(lines: list[Found]) -> str:
    head = ("start", "tolerance:", "µs per state:", "error of d:", "error of K:")
    rows = [
        (
            line["start"],
            f"{line['tolerance']:.0e}",
            _time(line["state"]),
            f"{line['error']:.0e}",
            f"{line['error_k']:.0e}",
        )
        for line in lines
    ]
    return table(head, rows)


def _path_steps(found: Found) -> str:
    head = (
        "setting",
        "value:",
        "µs per state:",
        "refused, although a state exists:",
        "another root:",
        "found, although none exists:",
        "of these with hybrid or outer kinematics:",
    )
    rows = [
        (
            line["varied"],
            _length(line["value"]),
            _time(line["state"]),
            *(str(line[word]) for word in ("refused", "other", "spurious", "smooth")),
        )
        for line in found["lines"]
    ]
    certain = f"{found['certain']} of them certain, of which {found['exist']} exist."
    count = f"{found['states']} states, {certain}"
    return f"{table(head, rows)}\n\n{count}"


def _length(value: float) -> str:
    return f"{value:.3g}" if value >= 1e-3 else f"{value:.0e}"


def _hertz(lines: list[Found]) -> str:
    conformities = list(lines[0]["k"])
    head = (
        "contact",
        "µs:",
        *(f"k, f = {f}:" for f in conformities),
        "load, VEX 70:",
        "K, VEX 70:",
        "load, 218:",
        "K, 218:",
    )
    rows = [
        (
            line["way"],
            _time(line["contact"]),
            *(_error(line["k"][f]) for f in conformities),
            *(
                _error(v)
                for pair in zip(line["load"], line["stiffness"], strict=True)
                for v in pair
            ),
        )
        for line in lines
    ]
    return table(head, rows)


def _error(value: float) -> str:
    """A relative error; below 10⁻¹⁵ it is rounding."""
    return "<1e-15" if value < 1e-15 else f"{value:.0e}"
