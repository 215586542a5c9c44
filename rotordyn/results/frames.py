"""Results seen from another frame than the fixed one."""

from __future__ import annotations


def turning(result: object) -> bool:
    """True where frequencies are those seen from the frame that turns with the shaft."""
    return bool(getattr(result, "turning_frame", False))
