"""Random rotors identified from their own noisy responses, as measured last."""

from __future__ import annotations

from typing import Any

from docs.generate.marked import table


def rotor_twins(found: dict[str, Any]) -> str:
    """The table on the page of theory."""
    rotors, speeds = found["rotors"], found["speeds"]
    rows = [
        (f"frequencies of speeds not measured, {found['frequencies']}: farthest off",
         f"{100.0 * found['worst']:.2g} %"),
        ("the same, median of the rotors", f"{100.0 * found['median worst']:.2g} %"),
        ("diameters, median", f"{100.0 * found['diameter off']:.2g} % off"),
        ("dampings, median", f"{100.0 * found['damping off']:.2g} % off"),
        ("values within their 95 % interval", f"{100.0 * found['inside']:.0f} %"),
        ("right model refused", f"{found['refused']} of {rotors}"),
        ("joint that the model lacks found out", f"{found['joint found out']} of {rotors}"),
        ("section that the model lacks found out", f"{found['section found out']} of {rotors}"),
        ("fit of one mode too few found out", f"{found['fewer found out']} of {speeds} speeds"),
        ("fit of one mode too many found out", f"{found['more found out']} of {speeds} speeds"),
        ("machines solved, median", f"{found['machines']:.0f}"),
        ("time of fit and search, median", f"{found['seconds']:.2g} s"),
    ]  # fmt: skip
    return table(("", "found"), rows)
