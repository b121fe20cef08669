"""A package has what its app needs: no field, no block, no module, no column besides."""

from __future__ import annotations

import ast
import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pluto_fleet.shared.domain.fields import Entity
from plutoc.compile import compile_source
from plutoc.emit.package import Package
from plutoc.source import Source
from plutoc_blocks import BLOCKS
from tests.paths import EXAMPLES

KINDS = {block.name: block for block in BLOCKS}
OPTIONAL = {
    "wait": "Clock",
    "timer": "TimerMonitor",
    "gap": "GapMonitor",
    "retry": "PriorityManager",
    "judge": "MissionEvaluator",
    "again": "MissionRepeater",
}
ALWAYS = ("MissionCreator", "DroneAllocator", "TripLauncher")


def package_of(text: str) -> Package:
    """Return the package of a source."""
    compiled = compile_source(
        Source("app.pluto", text), source_name="app.pluto", find_hooks=lambda _: None
    )
    return compiled.package


def app_of(name: str, has: frozenset[str]) -> str:
    """Return an app with these blocks beside those that every app has."""
    limits = [one for one in ("timer", "gap") if one in has]
    last = "first" if limits else "watch"
    wait = "wait -> " if "wait" in has else ""
    watch = f"[{', '.join(['watch', *limits])}] -> first" if limits else "watch"
    lines = [
        *(["evaluator content"] if "judge" in has else []),
        "create = MissionCreator",
        "allocate = DroneAllocator",
        "launch = TripLauncher",
        "watch = TripMonitor",
        *(["first = GateFIFO"] if limits else []),
        *(
            f"{one} = {kind}{'(hook: content)' if one == 'judge' else ''}"
            for one, kind in OPTIONAL.items()
            if one in has
        ),
        f"start -> create -> {wait}allocate -> launch -> {watch}",
        f"{last} -> allocate when STANDBY",
        *_when_failed(last, has),
        *_when_completed(last, has),
    ]
    body = "".join(f"  {line}\n" for line in lines)
    return f"pluto 1\napp {name} {{\n{body}}}\n"


def _when_failed(last: str, has: frozenset[str]) -> list[str]:
    if "retry" not in has:
        return [f"{last} -> end when FAILED"]
    return [
        f"{last} -> retry when FAILED",
        "retry -> allocate when STANDBY",
        "retry -> end when FAILED",
    ]


def _when_completed(last: str, has: frozenset[str]) -> list[str]:
    lines = []
    for block in ("judge", "again"):
        if block in has:
            lines += [f"{last} -> {block} when COMPLETED", f"{block} -> allocate when STANDBY"]
            last = block
    if "judge" in has:
        lines.append("judge -> end when FAILED")
    return [*lines, f"{last} -> end when COMPLETED"]


def attributes(model: str, name: str) -> list[str]:
    """Return the fields that a class of `model.py` adds."""
    (found,) = (
        node
        for node in ast.parse(model).body
        if isinstance(node, ast.ClassDef) and node.name == name
    )
    return [
        node.target.id
        for node in found.body
        if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name)
    ]


@settings(max_examples=6)
@given(st.frozensets(st.sampled_from(sorted(OPTIONAL))))
def test_fields_are_those_that_a_block_needs(has: frozenset[str]) -> None:
    """In the classes, in the README and for the missions file; and only used blocks are carried."""
    package = package_of(app_of("some", has))
    used = [KINDS[kind] for one, kind in OPTIONAL.items() if one in has]
    needed = {(field.on, field.name) for block in used for field in block.needs}
    model, readme = package.owned["src/some/model.py"], package.owned["README.md"]
    found = [(Entity.MISSION, name) for name in attributes(model, "Mission")]
    found += [(Entity.TRIP, name) for name in attributes(model, "Trip")]
    assert len(found) == len(needed)
    assert set(found) == needed
    every = {(field.on, field.name) for block in BLOCKS for field in block.needs}
    for entity, name in every:
        there = (entity, name) in needed
        assert (f"\n| `{name}` | {entity.value} |" in readme) is there
        assert (f'Field(name="{name}", on=Entity.{entity.name},' in model) is there
    carried = {path.removeprefix("src/some/_runtime/blocks/") for path in package.owned}
    for one, kind in OPTIONAL.items():
        assert (f"{KINDS[kind].step.__module__.split('.')[1]}.py" in carried) is (one in has)


ONLY_WITH = {
    "flow.judgement": "MissionEvaluator",
    "flow.modification": "MissionModifier",
}
"""Modules of the runtime that a kind of block alone needs."""
OF_HOOKS = {"hooks.calls", "hooks.context", "alone.testing", "time.virtual"}
"""What calls the app's own code, and what that is given."""
OF_STRANGERS = ("flow.declared",)
"""What holds blocks of other packages to what they declare: no example has one."""


@pytest.mark.parametrize("example", sorted(path.name for path in EXAMPLES.iterdir()))
def test_modules_that_nothing_needs_stay_behind(example: str) -> None:
    """A module that some app carries is carried by those that need it, and by no other."""
    text = (EXAMPLES / example / "app.pluto").read_text(encoding="utf-8")
    carried = carried_by(text)
    for module, kind in ONLY_WITH.items():
        assert (module in carried) == (kind in text)
    hooks = set(re.findall(r"^ *(action|evaluator|modifier|policy) ", text, re.MULTILINE))
    assert carried & OF_HOOKS == (OF_HOOKS if hooks else set())
    assert ("flow.asking" in carried) == bool(hooks - {"policy"})
    assert not carried & set(OF_STRANGERS)
    chosen = re.search(r"policy: (\w+)", text)
    assert carried & POLICIES == NEEDED.get(chosen[1] if chosen else "least_makespan", OWN)


NEEDED = {
    "batch_optimal": {"fleet.assignment", "fleet.batch", "fleet.batch_optimal"},
    "earliest_deadline": {"fleet.batch", "fleet.durations", "fleet.earliest_deadline"},
    "least_makespan": {"fleet.batch", "fleet.durations", "fleet.least_makespan"},
    **{name: set[str]() for name in ("first", "least_used", "nearest")},
}
"""The modules of each policy of ours, beside `fleet.policies`."""
OWN = {"fleet.batch", "fleet.own_batch", "fleet.own_policy"}
"""That of a policy that is a hook of the app's own."""
POLICIES = OWN.union(*NEEDED.values())


def carried_by(text: str) -> set[str]:
    """Return the modules of the runtime that an app carries, its blocks' steps aside."""
    paths = [path.partition("/_runtime/")[2] for path in package_of(text).owned]
    names = {path.removesuffix(".py").replace("/", ".") for path in paths if path.endswith(".py")}
    return {name for name in names if not name.startswith("blocks.") and "__init__" not in name}
