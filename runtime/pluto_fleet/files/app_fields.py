"""The fields that exist because the app's graph has a block that needs them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.fields import Entity, FieldType

from . import errors, values

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App

    from .table import Table

ELSEWHERE = {
    Entity.MISSION: ("safe_time", "repeat", "evaluator", "at", "every"),
    Entity.TRIP: ("delay", "priority", "gap"),
}
"""Fields that other apps have: whoever writes one here needs to hear why this app has not."""


def read_fields(table: Table, app: App, entity: Entity, basic: Sequence[str]) -> dict[str, Any]:
    """Return the fields beyond the basic ones that the file gives, and tell unknown keys."""
    fields = [field for field in app.fields if field.on is entity]
    keys = [*basic, *(field.name for field in fields)]
    for key in table.data:
        if key not in keys:
            table.problem(_unknown(key, keys, entity), key)
    given: dict[str, Any] = {}
    for field in fields:
        value = table.read(field.name, values.field_reader(field.type))
        if value is None:
            continue
        given[field.name] = value
        if field.type is FieldType.EVALUATOR and value not in app.evaluators:
            table.problem(_unknown_evaluator(str(value), list(app.evaluators)), field.name)
    return given


def _unknown(key: str, keys: Sequence[str], entity: Entity) -> str:
    if key in ELSEWHERE[entity]:
        return errors.no_such_field(key, entity.value, keys)
    return errors.unknown_key(key, keys, f"a {entity.value} of this app")


def _unknown_evaluator(name: str, evaluators: Sequence[str]) -> str:
    if not evaluators:
        return errors.no_evaluators()
    return errors.unknown_name("evaluator", name, evaluators, "this app has")
