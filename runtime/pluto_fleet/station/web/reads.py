"""The handlers of requests that change nothing."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from ...shared.domain.errors import BadInput
from ..wire_app import AppData
from .http import Reply, json_reply, said, text_reply
from .served import Asked

TOML = "application/toml"
MISSIONS_FILE = "missions.toml"

DESCRIPTION = Path(__file__).parent.parent / "openapi.json"
"""The description of this interface, which is made from the table of addresses."""


async def app(asked: Asked) -> Reply:
    """Answer with app and fleet, and with the role of who asks."""
    data: AppData = {**asked.station.described, "role": asked.role}
    return json_reply(200, data)


async def plan(asked: Asked) -> Reply:
    """Answer with the plan, once all its problems are known."""
    await asked.station.plan.examined()
    return json_reply(200, asked.station.plan.data())


async def plan_file(asked: Asked) -> Reply:
    """Answer with the plan as a missions file."""
    try:
        return text_reply(asked.station.plan.export_toml(), MISSIONS_FILE, TOML)
    except BadInput as error:
        return said(409, str(error))


async def description(_: Asked) -> Reply:
    """Answer with the description of this interface."""
    return Reply(status=200, body=_description())


@cache
def _description() -> bytes:
    return DESCRIPTION.read_bytes()
