"""The entry points of the library, called by an app's brain with its command line."""

from __future__ import annotations

TYPE_CHECKING = False  # `typing` itself is slow to import
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from plutoc_runtime.domain.app import App

    from .seam import Seam


def start(name: str, load: Callable[[], App], *, brain: str, seam: Seam) -> int:
    """Run the command that an app's program was called with, and return its exit code.

    `brain` is the name of the app's embedded runtime package, `seam` its seam.
    """
    from .seam import meet

    if not meet(name, brain, seam):
        return 2
    from .cli import start as begin

    return begin(name, load)


def main(app: App, argv: Sequence[str] | None = None, *, brain: str, seam: Seam) -> int:
    """Run one command of an app that is loaded, and return its exit code."""
    from .seam import NEWEST, meet

    if not meet(app.name, brain, seam):
        return 2
    if seam[0] < NEWEST[0]:
        from .older import loaded_again

        app = loaded_again(brain)
    from .cli import main as run

    return run(app, argv)
