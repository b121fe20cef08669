"""Compiles an app in memory, without files and without Black, and runs it on the runtime in place."""

from __future__ import annotations

import builtins
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from importlib import import_module
from importlib.abc import InspectLoader
from types import CodeType, ModuleType, SimpleNamespace

from pluto_fleet.shared.domain.app import App
from plutoc.emit.flow_file import flow_file
from plutoc.emit.model_file import model_file
from plutoc.graph.model import Graph
from plutoc.plan.model import Plan
from tests.equivalence.patience import Patience
from tests.kit.graphs import others

PACKAGE = "equivalent"
BLOCKS = "_runtime.blocks."

Siblings = Mapping[str, SimpleNamespace | ModuleType]


@dataclass(frozen=True, slots=True, kw_only=True)
class Package:
    """A package in memory: what a plan becomes, but for the hooks."""

    graph: Graph
    model: ModuleType
    flow: CodeType

    def app(self, hooks: SimpleNamespace, *, patient: bool = False) -> App:
        """Return the app with these hooks; who is patient lets it do as much at once as it likes."""
        siblings: Siblings = {"hooks": hooks, "model": self.model}
        patience = None if patient else Patience()
        app = _module("flow", self.flow, siblings, patience).APP
        assert isinstance(app, App)
        return app


def packaged(plan: Plan) -> Package:
    """Return the package of a plan."""
    graph = plan.checked.graph
    return Package(
        graph=graph,
        model=_model(model_file(graph)),
        flow=compile(flow_file(plan), "flow.py", "exec"),
    )


@lru_cache(maxsize=500)
def _model(text: str) -> ModuleType:
    """Return the classes of an app: few apps differ in them."""
    name = f"{PACKAGE}.model"
    sys.modules[name] = ModuleType(name)  # dataclasses look their module up
    return _module("model", compile(text, "model.py", "exec"), {})


def _module(
    name: str,
    code: CodeType,
    siblings: Siblings,
    patience: Patience | None = None,
) -> ModuleType:
    def found(target: str, wanted: Sequence[str]) -> object:
        if not target:
            return SimpleNamespace(**{one: siblings[one] for one in wanted})
        if target in siblings:
            return siblings[target]
        return _of_the_runtime(target, wanted, patience)

    return in_memory(f"{PACKAGE}.{name}", code, found)


def in_memory(
    name: str, code: CodeType, found: Callable[[str, Sequence[str]], object]
) -> ModuleType:
    """Run a module; what it imports from its own package is what is `found` there."""

    def importing(
        target: str,
        globals_: Mapping[str, object] | None = None,
        locals_: Mapping[str, object] | None = None,
        wanted: Sequence[str] = (),
        level: int = 0,
    ) -> object:
        if level == 0:
            return builtins.__import__(target, globals_, locals_, wanted, level)
        return found(target, wanted)

    module = ModuleType(name)
    module.__package__ = name.rpartition(".")[0]
    vars(module)["__builtins__"] = {**vars(builtins), "__import__": importing}
    InMemory(code).exec_module(module)
    return module


class InMemory(InspectLoader):
    """Runs a module that was compiled already."""

    def __init__(self, code: CodeType) -> None:
        self.code = code

    def get_source(self, fullname: str) -> None:
        return None

    def get_code(self, fullname: str) -> CodeType:
        return self.code


_OTHER_STEPS = {"trip_monitor_relief": "plutoc_blocks.trip_monitor.relief"}
"""Where a step is that its block has besides."""


def _of_the_runtime(target: str, wanted: Sequence[str], patience: Patience | None) -> object:
    """Return what a generated module imports from `_runtime`, from where it is at home."""
    if target.startswith(f"{BLOCKS}{others.PACKAGE}."):
        home = others.__name__
    elif target.startswith(BLOCKS):
        home = _OTHER_STEPS.get(name := target.removeprefix(BLOCKS), f"plutoc_blocks.{name}.step")
    else:
        home = f"plutoc_runtime{target.removeprefix('_runtime')}"
    module = import_module(home)
    found: dict[str, object] = {}
    for one in wanted:
        if not hasattr(module, one):
            import_module(f"{home}.{one}")
        given = getattr(module, one)
        found[one] = patience.counted(given) if patience and target.startswith(BLOCKS) else given
    return SimpleNamespace(**found)
