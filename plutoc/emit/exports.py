"""What a generated package offers to the code of its developer."""

from __future__ import annotations

from plutoc.graph.model import Graph

EXPORTS = {
    "ActionFailed": "._runtime.domain.errors",
    "Category": "._runtime.domain.model",
    "Context": "._runtime.hooks.context",
    "Drone": "._runtime.domain.model",
    "Item": "._runtime.domain.model",
    "LiveDrone": "._runtime.hooks.live_drone",
    "Mission": ".model",
    "Photo": "._runtime.domain.model",
    "Point": "._runtime.domain.model",
    "Result": ".model",
    "Results": ".model",
    "Status": "._runtime.domain.status",
    "Trip": ".model",
    "Verdict": "._runtime.flow.verdict",
}
"""The types that hooks are written with, and where they are."""

_FOR_HOOKS = ("Context", "LiveDrone", "Verdict")


def exports_of(graph: Graph, *, former: bool) -> dict[str, str]:
    """Return what a package offers: without a hook, and without one left over, less is carried."""
    if graph.hooks or graph.actions or former:
        return EXPORTS
    return {name: home for name, home in EXPORTS.items() if name not in _FOR_HOOKS}
