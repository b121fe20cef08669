"""`hooks.py`: written once, with a stub for each hook; the user's from then on."""

from __future__ import annotations

from collections.abc import Iterable
from textwrap import wrap

from plutoc.check.model import Checked
from plutoc.emit.model_file import all_fields
from plutoc.emit.python import (
    LINE_LENGTH,
    PYTHON,
    Import,
    builtins_alias,
    import_lines,
    names,
    python_result,
    shadows,
)
from plutoc.emit.render import formatted, render
from plutoc.emit.stubs import Stub, in_order, stubs
from plutoc.graph.model import Graph
from plutoc_runtime.domain.fields import Entity

MISSION_OFFERS = (
    "`name`, `status`, `reason`, `trips` (still to do, in order), `completed_trips`, `current` "
    "(the trip that flies now, or flies next), `round`, `attempts`"
)
TRIP_OFFERS = (
    "`name`, `status`, `reason`, `action`, `parameters`, `source`, `target`, `item`, `drone`, "
    "`attempt`, `start_time`, `end_time`, `elapsed`, `ended`"
)


def hooks_file(checked: Checked) -> str:
    """Return the text of `hooks.py`."""
    graph, found = checked.graph, stubs(checked)
    return formatted(
        render(
            "hooks.py",
            app=graph.name,
            imports=import_lines(_imports(graph, found)),
            offers=[
                *_offers("mission", MISSION_OFFERS, graph, Entity.MISSION),
                *_offers("trip", TRIP_OFFERS, graph, Entity.TRIP),
            ],
            stubs=found,
        )
    )


def stub(checked: Checked, name: str) -> str:
    """Return the stub of one hook, as it stands in `hooks.py`."""
    found = [one for one in stubs(checked) if one.name == name]
    return formatted(render("stubs.py", stubs=found)).strip() + "\n"


def _offers(what: str, basics: str, graph: Graph, entity: Entity) -> list[str]:
    own = [f", `{field.name}`" for field in all_fields(graph) if field.on is entity]
    return wrap(
        f"A {what} offers {basics}{''.join(own)}.",
        LINE_LENGTH,
        break_long_words=False,
        break_on_hyphens=False,
    )


def _imports(graph: Graph, found: Iterable[Stub]) -> list[Import]:
    used = [name for one in found for name in one.uses]
    imports = [*names(".", *(name for name in used if name != "Sequence"))]
    if "Sequence" in used:
        imports += names("collections.abc", "Sequence")
    taken = set(in_order(graph))
    parameters = [p for action in graph.actions for p in action.parameters]
    parameters += [p for hook in graph.hooks for p in hook.parameters]
    types = [PYTHON[parameter.type] for parameter in parameters]
    types += [python_result(a.returns) if a.returns else "object" for a in graph.actions]
    if shadows(taken, types):
        alias = builtins_alias(taken)
        imports.append(Import(module="builtins", alias=None if alias == "builtins" else alias))
    return imports
