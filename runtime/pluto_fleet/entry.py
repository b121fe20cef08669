"""The entry points of the library, called by an app's brain with its command line."""

from __future__ import annotations

TYPE_CHECKING = False  # `typing` itself is slow to import
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence


def start(name: str, load: Callable[[], object], *, brain: str, seam: int) -> int:
    """Run the command that an app's program was called with, and return its exit code.

    `brain` is the name of the app's embedded runtime package, `seam` its seam.
    """
    if not _fits(name, seam):
        return 2
    from .cli import start as begin

    return begin(name, load, brain.rpartition(".")[0], seam)


def main(app: object, argv: Sequence[str] | None = None, *, brain: str, seam: int) -> int:
    """Run one command of an app that is loaded, and return its exit code."""
    if not _fits(str(getattr(app, "name", "")), seam):
        return 2
    from .cli import main as run

    return run(app, argv)


def _fits(name: str, seam: int) -> bool:
    """Return whether this library can fly an app, and say why it cannot."""
    from .seam import problem
    from .shared import output

    why = problem(name, seam)
    if why is not None:
        output.tell(why)
    return why is None
