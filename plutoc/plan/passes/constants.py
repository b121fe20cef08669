"""Omit arguments that equal the default of the block's function.

Before:                                         After:
    create = MissionCreator                         create = MissionCreator
    allocate = DroneAllocator                       allocate = DroneAllocator
    plan app                                        plan app
      call create                                     call create
      call allocate                                   call allocate
      ...                                             ...
                                                    left out: allocate_within of allocate

The call in the generated code says what the source says, and no more.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from plutoc.block import Param
from plutoc.graph.model import Node
from plutoc.plan.model import Plan


def constants(plan: Plan) -> Plan:
    """Omit arguments with default values."""
    left_out = tuple(
        (node.name, name) for node in plan.checked.graph.nodes for name in _left_out(node)
    )
    return replace(plan, left_out=left_out)


def _left_out(node: Node) -> Iterator[str]:
    functions = [one for one in (node.step, node.limit) if one is not None]
    defaults = [getattr(one, "__kwdefaults__", None) or {} for one in functions]
    values = dict(node.values)
    for param in node.block.params:
        if isinstance(param, Param):
            value = values.get(param.name)
            if all(_same(value, known, param.name) for known in defaults):
                yield param.name


def _same(value: object, defaults: dict[str, object], name: str) -> bool:
    # 1, 1.0 and True are equal, and not the same
    known = defaults.get(name, ...)
    return type(known) is type(value) and known == value
