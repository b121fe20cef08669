"""`resume`: goes on after a stop or a crash."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..errors import BadInput

if TYPE_CHECKING:
    from ..app import App
    from .options import Options


def resume(app: App, options: Options) -> int:
    """Go on with the missions of a journal."""
    raise BadInput(f"{app.name}: {options.journal}: cannot be resumed yet")
