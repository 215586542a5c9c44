"""What every entry of a file has in common."""

from __future__ import annotations

import re

from pydantic import BaseModel, ConfigDict


class Entry(BaseModel):
    """A mapping in a file: its keys are the fields, and no others."""

    model_config = ConfigDict(
        extra="forbid", frozen=True, hide_input_in_errors=True, defer_build=True
    )


def title(entry: type[Entry]) -> str:
    """``SleeveEntry`` -> ``sleeve``."""
    words = re.sub(r"(?<!^)(?=[A-Z])", " ", entry.__name__.removesuffix("Entry"))
    return words.lower()


def form(value: object) -> str:
    """Tag of a value that may be written in more than one form, by its YAML kind."""
    if isinstance(value, str):
        return "<word>"
    return "<list>" if isinstance(value, list | tuple) else "<mapping>"
