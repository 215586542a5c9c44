"""A case file: which machine, how modelled, at which speeds, which questions."""

from __future__ import annotations

from typing import Any

from pydantic import ConfigDict, Field

from rotordyn.case.schema.analyses import AnalysesEntry
from rotordyn.case.schema.base import Entry
from rotordyn.case.schema.conditions import ConditionsEntry
from rotordyn.case.schema.reference import ReferenceEntry
from rotordyn.case.schema.sweep import Speeds
from rotordyn.case.schema.values import Name, Text


class VariantEntry(Entry):
    """What one variant replaces (machine, title) or adds (overrides, conditions, references)."""

    title: Text = ""
    spindle: Any = None
    tool: Any = None
    bearing: Any = None
    override: dict[str, Any] = Field(default_factory=dict)
    conditions: ConditionsEntry = ConditionsEntry()
    references: list[ReferenceEntry] = []


class CaseEntry(Entry):
    """The case itself; the machine it names is read apart (``spindle``, ``tool``, ``bearing``)."""

    model_config = ConfigDict(
        json_schema_extra={
            "oneOf": [{"required": ["spindle"]}, {"required": ["bearing"]}],
            "dependentRequired": {"tool": ["spindle"]},
        }
    )

    title: Text = ""
    note: Text = ""
    spindle: Any = None
    tool: Any = None
    bearing: Any = None
    override: dict[str, Any] = Field(default_factory=dict)
    conditions: ConditionsEntry = ConditionsEntry()
    speeds: Speeds
    analyses: AnalysesEntry
    references: list[ReferenceEntry] = []
    compare: dict[Name, VariantEntry] = {}
