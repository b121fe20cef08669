"""What a MissionEvaluator does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plutoc_runtime.flow.asking import ask
from plutoc_runtime.flow.judgement import apply
from plutoc_runtime.hooks.context import results_for

if TYPE_CHECKING:
    from plutoc_runtime.domain.status import Status
    from plutoc_runtime.flow.run import Run
    from plutoc_runtime.hooks.calls import Hook


async def evaluate_mission(
    run: Run[Any], status: Status, *, hook: Hook, evaluator: str | None, own: str | None = None
) -> Status:
    """Ask the mission's evaluator, and do as its verdict says; `own` is what `hook` is called."""
    chosen = run.core.app.evaluators[evaluator] if evaluator and evaluator != own else hook
    run.state.evaluated = len(run.core.results.results)
    results = results_for(run.core.results, run.mission)
    return apply(run, chosen, await ask(run, chosen, run.mission, results))
