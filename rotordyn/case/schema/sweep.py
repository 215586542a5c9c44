"""Speeds and frequencies: a range, or a list."""

from __future__ import annotations

from typing import Annotated

from pydantic import ConfigDict, Discriminator, Field, Tag

from rotordyn.case.schema.base import Entry, form
from rotordyn.case.schema.values import Frequency, Speed, TopSpeed, whole

MAX_STEPS = 100_000
_STEP_OR_COUNT = ConfigDict(
    json_schema_extra={"oneOf": [{"required": ["step"]}, {"required": ["count"]}]}
)
Count = Annotated[int, whole(2, MAX_STEPS)]


class SpeedRange(Entry):
    """Evenly spaced speeds, both ends included, by ``step`` or by ``count``."""

    model_config = _STEP_OR_COUNT

    start: Speed = Field(alias="from")
    to: Speed
    step: TopSpeed | None = None
    count: Count | None = None


class FrequencyRange(Entry):
    """Evenly spaced frequencies, both ends included, by ``step`` or by ``count``."""

    model_config = _STEP_OR_COUNT

    start: Frequency = Field(alias="from")
    to: Frequency
    step: Frequency | None = None
    count: Count | None = None


def _range_or_list(value: object) -> str:
    return "<list>" if form(value) == "<list>" else "<range>"


Speeds = Annotated[
    Annotated[SpeedRange, Tag("<range>")]
    | Annotated[list[Speed], Field(min_length=1, max_length=MAX_STEPS), Tag("<list>")],
    Discriminator(_range_or_list),
]
Frequencies = Annotated[
    Annotated[FrequencyRange, Tag("<range>")]
    | Annotated[list[Frequency], Field(min_length=1, max_length=MAX_STEPS), Tag("<list>")],
    Discriminator(_range_or_list),
]
