"""Results in a frame other than the fixed one."""

from __future__ import annotations


def turning(result: object) -> bool:
    """Whether frequencies are those in the frame that rotates with the shaft."""
    return bool(getattr(result, "turning_frame", False))
