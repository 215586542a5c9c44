"""Random rotors identified from synthetic noisy responses, as measured last."""

from __future__ import annotations

from typing import Any

from docs.generate.marked import table


def synthetic_rotors(found: dict[str, Any]) -> str:
    """The table of the page of theory."""
    rotors, speeds = found["rotors"], found["speeds"]
    rows = [
        (f"frequencies at speeds not measured, {found['frequencies']}: largest error",
         f"{100.0 * found['worst']:.2g} %"),
        ("as above, median of the rotors", f"{100.0 * found['median worst']:.2g} %"),
        ("diameters, median error", f"{100.0 * found['diameter off']:.2g} %"),
        ("damping, median error", f"{100.0 * found['damping off']:.2g} %"),
        ("values within their 95 % interval", f"{100.0 * found['inside']:.0f} %"),
        ("correct model rejected", f"{found['refused']} of {rotors}"),
        ("joint missing in the model, detected", f"{found['joint detected']} of {rotors}"),
        ("sections merged in the model, detected", f"{found['section detected']} of {rotors}"),
        ("fit with one mode too few, detected", f"{found['fewer detected']} of {speeds} speeds"),
        ("fit with one mode too many, detected", f"{found['more detected']} of {speeds} speeds"),
        ("machines solved, median", f"{found['machines']:.0f}"),
        ("time of fit and search, median", f"{found['seconds']:.2g} s"),
    ]  # fmt: skip
    return table(("quantity", "result"), rows)
