"""The entry points of the library, called by an app's brain with its command line."""

from __future__ import annotations

TYPE_CHECKING = False  # `typing` itself is slow to import
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from .seam import Seam


def start(name: str, load: Callable[[], object], *, brain: str, seam: Seam) -> int:
    """Run the command that an app's program was called with, and return its exit code.

    `brain` is the name of the app's embedded runtime package, `seam` its seam.
    """
    if not _meet(name, brain, seam):
        return 2
    from .cli import start as begin

    return begin(name, load, brain.rpartition(".")[0], seam)


def main(app: object, argv: Sequence[str] | None = None, *, brain: str, seam: Seam) -> int:
    """Run one command of an app that is loaded, and return its exit code."""
    if not _meet(str(getattr(app, "name", "")), brain, seam):
        return 2
    from .cli import main as run
    from .seam import is_older

    if is_older(seam):
        from .older import loaded_again

        app = loaded_again(brain)
    return run(app, argv)


def _meet(name: str, brain: str, seam: Seam) -> bool:
    """Return whether this library can fly an app, and say why it cannot; lend its brain to an older one."""
    from .seam import is_older, problem
    from .shared import output

    why = problem(name, seam)
    if why is not None:
        output.tell(why)
        return False
    if is_older(seam):
        from .older import provide

        provide(brain)
    return True
