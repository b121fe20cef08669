"""What a generated package offers to the code of its developer."""

from __future__ import annotations

EXPORTS = {
    "ActionFailed": "._runtime.errors",
    "Category": "._runtime.model",
    "Context": "._runtime.context",
    "Drone": "._runtime.model",
    "Item": "._runtime.model",
    "LiveDrone": "._runtime.handle",
    "Mission": ".model",
    "Photo": "._runtime.model",
    "Point": "._runtime.model",
    "Result": ".model",
    "Results": ".model",
    "Status": "._runtime.status",
    "Trip": ".model",
    "Verdict": "._runtime.verdict",
}
"""The types that hooks are written with, and where they are."""
