"""`testing.py`, and the tests of the hooks: written once, a test for each; the user's from then on."""

from __future__ import annotations

from dataclasses import dataclass

from plutoc.block import HookKind
from plutoc.check.model import Checked
from plutoc.emit import reactions
from plutoc.emit.model_file import values_of
from plutoc.emit.python import Import, call, import_lines, items, literal, names, status_tuple
from plutoc.emit.render import formatted, render
from plutoc.emit.stubs import arriving_at, in_order
from plutoc.emit.test_file import able
from plutoc.graph.model import Action, AppField, Graph, Hook, Parameter
from plutoc_runtime.domain.actions import BUILT_IN, MEASURE
from plutoc_runtime.domain.fields import Entity
from plutoc_runtime.domain.quantities import Type
from plutoc_runtime.domain.status import Status

_SAMPLES = {Type.INT: "1", Type.BOOL: "True", Type.TEXT: '"text"', Type.PERCENT: "0.5"}
"""What a test gives for a parameter without a default; for all other types, 1.0."""

_VALUES = {
    MEASURE: ", 20.0",
    "take_photo": ", Photo(position=mission.current.target, width=2.0, height=1.5)",
}
"""What an evaluator's mission has brought."""

_BROUGHT_TO = {
    Status.RUNNING: ["kit.launch(mission)"],
    Status.STANDBY: ["mission.trips.append(kit.trip())", "kit.complete(mission)"],
    Status.COMPLETED: ["kit.complete(mission)"],
    Status.FAILED: ['kit.fail(mission, "its drone fell down")'],
    Status.UNEXECUTED: [],
}
"""How a mission comes to stand as a modifier finds it; the first that can be is taken."""

_TYPES = {
    "kit": "Kit",
    "drone": "Drone",
    "mission": "Mission",
    "trip": "Trip",
    "context": "KitContext",
}
"""The fixtures of conftest.py."""


@dataclass(frozen=True, slots=True, kw_only=True)
class HookTest:
    """The test of one hook."""

    name: str
    fixtures: tuple[str, ...]
    doc: str
    lines: list[str]
    uses: tuple[str, ...] = ()
    """The types of the package that its lines name."""

    @property
    def parameters(self) -> str:
        """Its fixtures, as its signature has them."""
        return ", ".join(f"{name}: {_TYPES[name]}" for name in self.fixtures)


def testing_file(graph: Graph) -> str:
    """Return the text of `testing.py`, not yet formatted."""
    given = ["APP", *(f"{on.value}={needed}" for on in Entity if (needed := _needed(graph, on)))]
    typed = bool(values_of(graph))
    return render(
        "testing.py", app=graph.name, given=", ".join(given), typed=typed, events=graph.reacts
    )


def _needed(graph: Graph, on: Entity) -> str:
    """Return a value for each field that must be filled in, by name; nothing, where there is none."""
    fields = [one for one in graph.fields if one.on is on and one.default is None]
    given = (f"{literal(one.name)}: {_sample(one)}" for one in fields)
    return items(given, "{}") if fields else ""


def fixtures_file(graph: Graph) -> str:
    """Return the text of `tests/conftest.py`."""
    return formatted(render("conftest.py", app=graph.name))


def hooks_test(checked: Checked, for_all: frozenset[str] = frozenset()) -> str:
    """Return the text of `tests/test_hooks.py`; `for_all`: policies that choose for all that wait."""
    graph = checked.graph
    made = {action.name: _action(action, graph) for action in graph.actions}
    made |= {hook.name: _hook(hook, checked) for hook in graph.hooks}
    made |= {hook.name: _for_all(hook) for hook in graph.hooks if hook.name in for_all}
    tests = [made[name] for name in in_order(graph)]
    modifiers = [hook.name for hook in graph.hooks if hook.kind is HookKind.MODIFIER]
    return formatted(
        render(
            "test_hooks.py",
            app=graph.name,
            action="".join(action.name for action in graph.actions[:1]),
            modifier="".join(modifiers[:1]),
            imports=import_lines(_imports(graph.name, tests)),
            tests=tests,
        )
    )


def _imports(app: str, tests: list[HookTest]) -> list[Import]:
    fixtures = {_TYPES[fixture] for test in tests for fixture in test.fixtures}
    uses = {name for test in tests for name in test.uses}
    of_kit = {name for name in fixtures if name.startswith("Kit")}
    own = sorted((fixtures | uses) - of_kit)
    return [*names(app, *own, "hooks"), *names(f"{app}.testing", *sorted(of_kit))]


def _action(action: Action, graph: Graph) -> HookTest:
    category = able(graph, action.name)
    other = category is not None and category is not graph.categories[0]
    drone = f"kit.drone({literal(category.name)})" if category and other else ""
    needed = [one for one in action.parameters if one.default is None]
    given = items((f"{literal(one.name)}: {_sample(one)}" for one in needed), "{}")
    trip = [literal(action.name), *([f"parameters={given}"] if needed else [])]
    return HookTest(
        name=action.name,
        fixtures=(
            "kit",
            *(() if drone else ("drone",)),
            *(("trip",) if action.along else ()),
            "context",
        ),
        doc="It is done, or says why it cannot be.",
        lines=[
            *([f"drone = {drone}"] if drone else []),
            *([] if action.along else [f"trip = {call('kit.trip', trip)}"]),
            "try:",
            f"    {_called(action, 'drone', 'trip', 'context')}",
            "except ActionFailed as failed:",
            "    assert str(failed)",
        ],
        uses=("ActionFailed",),
    )


def _hook(hook: Hook, checked: Checked) -> HookTest:
    match hook.kind:
        case HookKind.EVALUATOR:
            return _evaluator(hook, checked.graph)
        case HookKind.CREATOR:
            return _creator(hook, checked.graph)
        case HookKind.POLICY:
            return HookTest(
                name=hook.name,
                fixtures=("kit", "trip", "drone"),
                doc="It chooses one of the drones, or none.",
                lines=[
                    f"chosen = {_called(hook, 'trip', '[drone]')}",
                    "assert chosen in (drone, None)",
                ],
            )
        case _:
            return _modifier(hook, checked)


def _for_all(hook: Hook) -> HookTest:
    made = "Waiting(mission=mission, trip=mission.current, drones=[drone])"
    return HookTest(
        name=hook.name,
        fixtures=("kit", "mission", "drone"),
        doc="It gives the drone to the trip that waits, or lets it wait.",
        lines=[
            f"waiting = [{made}]",
            f"assignment = {_called(hook, 'waiting', '[drone]', '0.0')}",
            "assert assignment is not None",
        ],
        uses=("Waiting",),
    )


def _creator(hook: Hook, graph: Graph) -> HookTest:
    named = {name: event for event, name in reactions.class_names(graph).items()}
    made = reactions.taken_by(graph, hook)[0]
    event = next((one for one in graph.events if one.name == named.get(made)), None)
    blocks = {node.name for node in graph.nodes if node.hook is hook}
    sources = (edge.source for edge in graph.edges if edge.target in blocks)
    source = next(sources, "late")
    fields = [one for one in event.fields if one.default is None] if event else []
    given = [f"name={literal(source)}", 'id="1"', "time=0.0"]
    given += [f"{one.name}={_sample(one)}" for one in fields]
    return HookTest(
        name=hook.name,
        fixtures=("kit", "context"),
        doc="It makes a mission of an event, or none.",
        lines=[
            f"event = {call(made, given)}",
            f"made = {_called(hook, 'event', 'context')}",
            "assert made is None or made.trips",
        ],
        uses=(made,),
    )


def _evaluator(hook: Hook, graph: Graph) -> HookTest:
    own = (action.name for action in graph.actions if not action.along)
    flown = next((name for name in (*BUILT_IN, *own) if able(graph, name)), "")
    value = _VALUES.get(flown, "")
    return HookTest(
        name=hook.name,
        fixtures=("kit", "mission"),
        doc="It judges a mission whose trip is done.",
        lines=[
            f"kit.complete(mission{value})",
            f"verdict = {_called(hook, 'mission', 'kit.results(mission)')}",
            "assert isinstance(verdict, Verdict)",
        ],
        uses=("Verdict", *(("Photo",) if "Photo" in value else ())),
    )


def _modifier(hook: Hook, checked: Checked) -> HookTest:
    found = arriving_at(hook, checked)
    stands = next(status for status in _BROUGHT_TO if status in found)
    lines = [*_BROUGHT_TO[stands]]
    if not hook.emits:
        lines += ["before = mission.status", _called(hook, "mission", "context")]
        return HookTest(
            name=hook.name,
            fixtures=("kit", "mission", "context"),
            doc="The mission's status stays.",
            lines=[*lines, "assert mission.status is before"],
        )
    declared = status_tuple(hook.emits)
    if stands is Status.RUNNING:
        started = _called(hook, "mission", "context", by="start")
        lines += [f"call = {started}", "kit.complete(mission)"]
        lines += [f"assert call.finish() in {declared}"]
    else:
        lines += [f"status = {_called(hook, 'mission', 'context')}", f"assert status in {declared}"]
    return HookTest(
        name=hook.name,
        fixtures=("kit", "mission", "context"),
        doc="It says with which status the mission goes on.",
        lines=lines,
        uses=("Status",),
    )


def _called(hook: Action | Hook, *given: str, by: str = "call") -> str:
    own = (f"{one.name}={_sample(one)}" for one in hook.parameters)
    return call(f"kit.{by}", [f"hooks.{hook.name}", *given, *own])


def _sample(parameter: Parameter | AppField) -> str:
    if parameter.default is not None:
        return literal(parameter.default)
    return _SAMPLES.get(parameter.type, "1.0")
