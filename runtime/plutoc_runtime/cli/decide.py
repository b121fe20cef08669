"""`decide`: what only a person can know."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..errors import BadInput

if TYPE_CHECKING:
    from ..app import App
    from .options import Options


def decide(app: App, options: Options) -> int:
    """Settle what a mission waits for, in the running app or in its journal."""
    raise BadInput(f"{app.name}: {options.the_journal}: nothing can be decided yet")
