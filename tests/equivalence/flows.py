"""Compiles an app in memory, without files and without Black, and runs it on the runtime in place."""

from __future__ import annotations

import builtins
import sys
from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from importlib import import_module
from importlib.abc import InspectLoader
from types import ModuleType, SimpleNamespace

from plutoc.emit.flow_file import flow_file
from plutoc.emit.model_file import model_file
from plutoc.plan.model import Plan
from plutoc_runtime.app import App

PACKAGE = "equivalent"
BLOCKS = "_runtime.blocks."

Overrides = Mapping[str, Callable[..., object]]
"""Functions that a flow gets in place of those that it imports, by their names."""
NOTHING: Overrides = {}
Siblings = Mapping[str, SimpleNamespace | ModuleType]


def app_of(plan: Plan, hooks: SimpleNamespace, overrides: Overrides = NOTHING) -> App:
    """Return the app that a plan becomes, with these hooks."""
    model = _model(model_file(plan.checked.graph))
    names: Siblings = {"hooks": hooks, "model": model}
    app = _module("flow", flow_file(plan), names, overrides).APP
    assert isinstance(app, App)
    return app


@lru_cache(maxsize=500)
def _model(text: str) -> ModuleType:
    """Return the classes of an app: few apps differ in them."""
    name = f"{PACKAGE}.model"
    sys.modules[name] = ModuleType(name)  # dataclasses look their module up
    return _module("model", text, {}, NOTHING)


def _module(name: str, text: str, siblings: Siblings, overrides: Overrides) -> ModuleType:
    def importing(
        target: str,
        globals_: Mapping[str, object] | None = None,
        locals_: Mapping[str, object] | None = None,
        wanted: Sequence[str] = (),
        level: int = 0,
    ) -> object:
        if level == 0:
            return builtins.__import__(target, globals_, locals_, wanted, level)
        if not target:
            return SimpleNamespace(**{one: siblings[one] for one in wanted})
        if target in siblings:
            return siblings[target]
        return _of_the_runtime(target, wanted, overrides)

    module = ModuleType(f"{PACKAGE}.{name}")
    module.__package__ = PACKAGE
    vars(module)["__builtins__"] = {**vars(builtins), "__import__": importing}
    _InMemory(text).exec_module(module)
    return module


class _InMemory(InspectLoader):
    """Runs a module's text."""

    def __init__(self, text: str) -> None:
        self.text = text

    def get_source(self, fullname: str) -> str:
        return self.text


def _of_the_runtime(target: str, wanted: Sequence[str], overrides: Overrides) -> object:
    """Return what a generated module imports from `_runtime`, from where it is at home."""
    if target.startswith(BLOCKS):
        home = f"plutoc_blocks.{target.removeprefix(BLOCKS)}.step"
    else:
        home = f"plutoc_runtime{target.removeprefix('_runtime')}"
    module = import_module(home)
    found: dict[str, object] = {}
    for one in wanted:
        if not hasattr(module, one):
            import_module(f"{home}.{one}")
        found[one] = overrides.get(one, getattr(module, one))
    return SimpleNamespace(**found)
