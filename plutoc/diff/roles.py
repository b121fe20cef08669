"""The role of a block in messages, derived from its properties."""

from __future__ import annotations

from enum import Enum

from plutoc.block import Block
from plutoc.graph.model import Node
from plutoc_runtime.domain.fields import Entity, FieldType


class Role(Enum):
    """The first that fits a block."""

    CREATES = "makes missions"
    RETRIES = "puts failed trips back"
    SKIPS = "leaves failed trips out"
    ALLOCATES = "gives a mission a drone"
    HOLDS = "lets a mission wait"
    LAUNCHES = "starts a trip"
    INTERRUPTS = "breaks flights off"
    LIMITS = "fails trips that take too long"
    WATCHES = "waits for the end of a trip"
    EVALUATES = "judges missions"
    REPEATS = "begins another round"
    GATE = "closes a fork"
    CALLS = "calls a hook"
    OTHER = "anything else"


def role(node: Node) -> Role:
    """Return what a block does."""
    block = node.block
    found = (
        (block.creates, Role.CREATES),
        (block.retries, Role.RETRIES),
        (block.skips, Role.SKIPS),
        (block.allocates, Role.ALLOCATES),
        (block.holds, Role.HOLDS),
        (block.launches, Role.LAUNCHES),
        (block.interrupts, Role.INTERRUPTS),
        (block.limits, Role.LIMITS),
        (block.watches, Role.WATCHES),
        (block.evaluates, Role.EVALUATES),
        (block.repeats, Role.REPEATS),
        (block.gate is not None, Role.GATE),
        (node.hook is not None, Role.CALLS),
    )
    return next((one for is_one, one in found if is_one), Role.OTHER)


def decides(node: Node) -> bool:
    """Return whether a mission can leave a block with another status than it came with."""
    if node.block.emits_by_hook and node.hook and node.hook.emits:
        return True
    return any(out != {status} for status, out in node.block.transitions.items())


def awaited(node: Node) -> str | None:
    """Return what a block that holds missions waits for, if a field says it: `delay`."""
    times = [f for f in node.block.needs if f.type is FieldType.TIME]
    own = [f for f in times if f.on is Entity.TRIP] or times
    return own[0].label.lower() if own else None


def limited(block: Block) -> str:
    """Return what a block bounds that limits flights: `safe time`."""
    times = [field for field in block.needs if field.type is FieldType.TIME]
    return times[0].label.lower() if times else f"time (`{block.name}`)"
