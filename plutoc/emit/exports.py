"""What a generated package offers to the code of its developer."""

from __future__ import annotations

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
