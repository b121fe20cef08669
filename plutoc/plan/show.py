"""A plan as text, for people and for tests: a step a line, what is inside it indented."""

from __future__ import annotations

from plutoc.plan.model import (
    Arm,
    Arrived,
    Body,
    Branch,
    Break,
    Call,
    Continue,
    Dispatch,
    End,
    Goto,
    Join,
    Loop,
    Plan,
    Step,
    Switch,
    Watch,
)


def show(plan: Plan) -> str:
    """Return a plan as text."""
    lines = [f"plan {plan.checked.graph.name}", *_inside(plan.body)]
    if plan.left_out:
        lines.append(
            f"left out: {', '.join(f'{param} of {block}' for block, param in plan.left_out)}"
        )
    return "\n".join(lines) + "\n"


def _inside(body: Body) -> list[str]:
    return [f"  {line}" for step in body for line in _step(step)]


def _step(step: Step) -> list[str]:
    match step:
        case Call():
            return [f"call {step.node.name}"]
        case Join():
            lines = [line for branch in step.branches for line in _branch(branch)]
            return [f"join {step.fork.name} -> {step.gate.name}", *lines]
        case Watch():
            return [f"watch {_watched(step)}"]
        case Switch():
            head = "switch" if step.decided else "switch, asking all"
            head = "enter" if step.enters else head
            return [head, *(line for arm in step.arms for line in _arm(arm))]
        case Loop():
            return [f"loop {step.head}", *_inside(step.body)]
        case Arrived():
            return ["arrived"]
        case Continue():
            return ["continue"]
        case Break():
            return ["break"]
        case End():
            return ["end"]
        case Goto():
            return [f"goto {step.label}"]
        case Dispatch():
            lines = []
            for case in step.cases:
                lines += [f"  case {case.label}", *(f"  {line}" for line in _inside(case.body))]
            begun = ", ".join((step.start, *step.entries))
            return [f"dispatch from {begun}", *lines]


def _watched(watch: Watch) -> str:
    names = ", ".join(node.name for node in watch.watchers)
    match watch.instead:
        case Join(fork=fork, gate=gate):
            return f"{fork.name} -> [{names}] -> {gate.name}"
        case Call():
            return names


def _branch(branch: Branch) -> list[str]:
    if branch.idle:
        return [f"  no branch for {branch.path}"]
    inside = (f"  {line}" for line in _inside(branch.body))
    return [f"  branch {branch.name}: {branch.path}", *inside]


def _arm(arm: Arm) -> list[str]:
    places = ("begin" if place is None else place for place in arm.places)
    names = ", ".join((*(status.value for status in arm.statuses), *places))
    match arm.body:
        case ():
            rest = ["go on"]
        case (Continue() | Break() | End() | Goto() as jump,):
            rest = _step(jump)
        case body:
            return [f"  {names} -> {arm.to}:", *(f"  {line}" for line in _inside(body))]
    return [f"  {names} -> {arm.to}: {rest[0]}"]
