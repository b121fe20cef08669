"""A package has what its app needs: no module of the brain besides."""

from __future__ import annotations

import re

import pytest

from plutoc.compile import compile_source
from plutoc.emit.package import Package
from plutoc.source import Source
from tests.paths import EXAMPLES

ALWAYS = ("MissionCreator", "DroneAllocator", "TripLauncher")


def package_of(text: str) -> Package:
    """Return the package of a source."""
    compiled = compile_source(
        Source("app.pluto", text), source_name="app.pluto", find_hooks=lambda _: None
    )
    return compiled.package


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
