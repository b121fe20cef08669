"""`flow.py`: the flow of a mission, and the app's description."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, replace

from plutoc.block import IN_GRAPH, HookKind
from plutoc.check.model import Checked
from plutoc.emit import reactions
from plutoc.emit.callables import carried_functions, imports_of, names_of
from plutoc.emit.embed import OURS
from plutoc.emit.model_file import fields_of
from plutoc.emit.python import Import, call, import_lines, items, literal, names, python_result
from plutoc.emit.render import render
from plutoc.emit.statements import Scope, asked_for, body_lines, bound
from plutoc.emit.written import parameter
from plutoc.graph.hooks import PHOTO
from plutoc.graph.model import Action, Graph, Hook, Node, Shown
from plutoc.plan.bodies import branches, nodes, steps
from plutoc.plan.model import Arrived, Body, Plan
from plutoc_runtime.domain.fields import Entity, Field
from plutoc_runtime.domain.quantities import QUANTITIES
from plutoc_runtime.domain.status import Status


@dataclass(frozen=True, slots=True, kw_only=True)
class Function:
    """A branch of a fork."""

    name: str
    path: str
    lines: list[str]


def flow_file(plan: Plan) -> str:
    """Return the text of `flow.py`, not yet formatted."""
    graph = plan.checked.graph
    scope = Scope(
        names=names_of(carried_functions(plan)),
        fields={field.name: field for field in fields_of(graph)},
        left_out=frozenset(plan.left_out),
        mission="mission",
        declared=declared_of(plan.checked),
        place="at" if _asked_in_loops(plan.body) else "run.at",
    )
    in_branch = replace(scope, mission="run.mission", notes=False)
    lines = list(body_lines(plan.body, scope))
    functions = [
        Function(name=one.name, path=one.path, lines=list(body_lines(one.body, in_branch)))
        for one in branches(plan.body)
    ]
    app_arguments = _app(plan)
    start = _start(plan.body, scope)
    of_functions = (line for function in functions for line in function.lines)
    written = "\n".join([start, *lines, *app_arguments, *of_functions])
    return render(
        "flow.py",
        app=graph.name,
        imports=import_lines([*_imports(graph, written), *imports_of(scope.names)]),
        start=start,
        lines=lines,
        branches=functions,
        app_arguments=app_arguments,
    )


def _start(body: Body, scope: Scope) -> str:
    fields = (field for node in nodes(body) for field in asked_for(node, scope))
    found = {"mission": "run.mission"} if _of_mission(fields) else {}
    found["status"] = "run.status"
    if scope.place == "at":
        found["at"] = "run.at"
    return f"{', '.join(found)} = {', '.join(found.values())}"


def _of_mission(fields: Iterable[Field]) -> bool:
    return any(field.on is Entity.MISSION for field in fields)


def _asked_in_loops(body: Body) -> bool:
    """Whether the place of interruption is asked for inside a loop."""
    return any(isinstance(step, Arrived) for step in steps(body))


def _imports(graph: Graph, written: str) -> list[Import]:
    imports = [
        *names("._runtime.domain.actions", "BUILT_IN"),
        *names("._runtime.domain.app", "App"),
        *names("._runtime.flow.run", "Run"),
        *names("._runtime.domain.status", "Status", *_statuses(written)),
        *names(".model", "CATEGORIES", "FIELDS", "Mission", "Trip"),
    ]
    if "hooks." in written:
        imports += names(".", "hooks")
    if "declared(" in written:
        imports += names("._runtime.flow.run", "declared")
    if "partial(" in written:
        imports += names("functools", "partial")
    if graph.reacts or graph.along or graph.follows:
        imports += reactions.parts_imports(graph, written)
    if any(not action.along for action in graph.actions):
        imports += names("._runtime.flow.own_action", "OwnAction")
    if any(action.returns == PHOTO for action in graph.actions):
        imports += names("._runtime.domain.model", "Photo")
    if any(action.parameters for action in graph.actions):
        imports += [
            *names("._runtime.domain.actions", "Parameter"),
            *names("._runtime.domain.quantities", "Type"),
        ]
    return imports


def _statuses(written: str) -> list[str]:
    """Return the statuses that are named in some lines of Python, outside of texts and comments."""
    words = frozenset(_WORD.findall(_TEXT.sub("", written)))
    return [status.name for status in IN_GRAPH if status.name in words]


_TEXT = re.compile(r"""'(?:\\.|[^'\\\n])*'|"(?:\\.|[^"\\\n])*"|#.*""")
_WORD = re.compile(r"\b[A-Z]+\b")


def _app(plan: Plan) -> list[str]:
    """Return the arguments of the `App`."""
    graph, entries = plan.checked.graph, plan.checked.entries
    own = "".join(_entry(action) for action in graph.actions if not action.along)
    if graph.follows:
        own = f'        "follow": FOLLOW,\n{own}'
    evaluators = [hook for hook in graph.hooks if hook.kind is HookKind.EVALUATOR]
    arguments = [
        f"name={literal(graph.name)}",
        f"title={literal(graph.title)}",
        "flow=flow",
        "mission=Mission",
        "trip=Trip",
        "fields=FIELDS",
        "categories=CATEGORIES",
        f"actions={{\n        **BUILT_IN,\n{own}    }}" if own else "actions=BUILT_IN",
    ]
    if evaluators:
        functions = "".join(f"{literal(hook.name)}: {_evaluator(hook)}," for hook in evaluators)
        arguments.append(f"evaluators={{{functions}}}")  # a line each
    if graph.results:
        arguments.append(f"results=(\n{''.join(map(_shown, graph.results))}    )")
    resumes = [name for name in entries if not graph.node[name].block.creates]
    if resumes:
        names = "".join(f"{literal(name)}," for name in resumes)
        arguments.append(f"resumes=({names})")
    if graph.reacts or graph.along or graph.follows:
        along = "".join(f"{_action(one)}," for one in graph.actions if one.along)
        arguments.append(reactions.parts(graph, along))
    return arguments


def _shown(one: Shown) -> str:
    """Return what is said of an action's results below the declaration that it comes from."""
    kind = {"type": one.type.value} if one.type in QUANTITIES else {}
    facts = {"action": one.action, "as": one.way, **kind, **dict(one.given)}
    said = ", ".join(f"{literal(name)}: {literal(value)}" for name, value in facts.items())
    comment = f"        # {one.declaration}\n" if one.declaration else ""
    return f"{comment}        {{{said}}},\n"


def _evaluator(hook: Hook) -> str:
    """Return an evaluator as missions choose it: with its defaults."""
    given = ((one.name, one.default) for one in hook.parameters if one.default is not None)
    return bound(f"hooks.{hook.name}", given)


def _entry(action: Action) -> str:
    """Return an action of the app's own below the declaration that it comes from."""
    lines = (f"# {action.declaration}", f"{literal(action.name)}: {_action(action)},")
    return "".join(f"        {line}\n" for line in lines)


def _action(action: Action) -> str:
    arguments = [f"name={literal(action.name)}"]
    if action.parameters:
        arguments.append(f"parameters={items(map(parameter, action.parameters))}")
    arguments += [f"repeat={literal(action.repeat)}", f"hook=hooks.{action.name}"]
    if action.takes is not None:
        arguments.append(f"takes={literal(action.takes)}")
    if action.returns is not None:
        arguments.append(f"returns={python_result(action.returns)}")
    return call("AlongAction" if action.along else "OwnAction", arguments)


def declared_of(checked: Checked) -> Mapping[str, str]:
    """Return the statuses that blocks of other packages may give where they are called.

    Checks, plan and code rest on them, so it is asked for where they fly. Our own blocks are held to
    their declarations by our tests.
    """
    return {
        node.name: _given(node, checked) for node in checked.graph.nodes if node.package != OURS
    }


def _given(node: Node, checked: Checked) -> str:
    if node.block.gate is not None:  # each of its branches brings a status
        return _statuses_of(checked.leaves.get(node.name, ()))
    taken = checked.arrives.get(node.name, ())
    ways = {s.name: _statuses_of(node.emitted(s)) for s in IN_GRAPH if s in taken}
    if len(set(ways.values())) == 1:
        return next(iter(ways.values()))
    return f"{{{', '.join(f'{name}: {given}' for name, given in ways.items())}}}[status]"


def _statuses_of(statuses: Collection[Status]) -> str:
    return items(status.name for status in IN_GRAPH if status in statuses)
