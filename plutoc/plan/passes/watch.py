"""Replace a fork of blocks that only wait for the trip's end by one wait with all limits.

Before:                                     After:
    call launch                                 call launch
    join launch -> first                        watch launch -> [watch, timer] -> first
      branch _watch: launch -> watch -> first
        call watch
        end
      branch _timer: launch -> timer -> first
        call timer
        end

A block with a limit fails the trip itself, so all of them see the same end at the same instant,
and whichever gate closes the fork lets that status through. Two tasks, a fork and a gate become a
single wait. A block that waits alone is the same wait without limits of others.

A fork stays that has anything else in a branch; but of branches side by side that only wait, the first
waits for all of them, and no clone goes into the others. Blocks of other packages are fused too, if they say
what their limit is, or have none and ask for nothing that a wait could not give them; and so are
gates that ask for nothing.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import chain

from plutoc.block import Gate
from plutoc.graph.model import Node
from plutoc.plan.model import Body, Branch, Call, End, Join, Plan, Step, Watch
from plutoc.plan.rewrite import rewritten


def watch(plan: Plan) -> Plan:
    """Merge concurrent waits for the end of a trip."""
    return rewritten(plan, _fused)


def _fused(step: Step, _: Step) -> Body:
    match step:
        case Call(node=node) if _only_waits(node):
            return (Watch(instead=step, watchers=(node,)),)
        case Join(gate=gate, branches=branches) if _only_closes(gate):
            found = [_watchers(branch, gate) for branch in branches]
            watchers = tuple(chain.from_iterable(some for some in found if some))
            if watchers and all(some is not None for some in found):
                return (Watch(instead=step, watchers=watchers),)
            return (replace(step, branches=_together(branches, found)),)
    return (step,)


def _together(
    branches: tuple[Branch, ...], found: list[tuple[Node, ...] | None]
) -> tuple[Branch, ...]:
    """Merge the waits of concurrent branches that only wait into the first one."""
    made: list[Branch] = []
    first: int | None = None
    for number, (branch, watchers) in enumerate(zip(branches, found, strict=True)):
        if not watchers:
            first = None
        elif first is None:
            first = number
        else:
            wait, end = made[first].body
            assert isinstance(wait, Watch)
            both = replace(wait, watchers=wait.watchers + watchers)
            made[first] = replace(made[first], body=(both, end))
            branch = replace(branch, idle=True)
        made.append(branch)
    return tuple(made)


def _watchers(branch: Branch, gate: Node) -> tuple[Node, ...] | None:
    """Return the blocks of a branch that only waits, or None."""
    match branch.body:
        case (Watch(watchers=watchers), End()):
            return watchers
        case (End(),) if gate.block.gate is Gate.ALL:
            # it brings RUNNING, and of different statuses the gate passes on the worst
            return ()
        case _:
            return None


def _only_waits(node: Node) -> bool:
    """Whether a block only waits, with a limit that can be evaluated separately."""
    block = node.block
    if not block.watches:
        return False
    return node.limit is not None or not (block.limits or node.asks or block.named)


def _only_closes(gate: Node) -> bool:
    """Whether a gate only passes a status on."""
    same = all(gate.emitted(status) == {status} for status in gate.block.accepts)
    return same and not gate.asks
