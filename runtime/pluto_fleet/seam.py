"""The versions of the seam between an app and this library.

The seam's first number changes when earlier data would be misread, the second when data is added. A library
speaks the newest first number and the one before.
"""

from __future__ import annotations

import sys
from importlib.metadata import PackageNotFoundError, version

from . import __version__
from .older import provide
from .scaffolding import bind

Seam = tuple[int, int]

OLDEST, NEWEST = (2, 0), (3, 0)
"""The range of seams that this library supports."""

_met: Seam | None = None


def meet(app: str, brain: str, seam: Seam) -> bool:
    """Use an app's brain in this process; return False, after a message, if the seams do not match."""
    global _met
    why = problem(app, seam)
    if why is not None:
        print(why, file=sys.stderr)
        return False
    bind(brain, carries=seam[0] == NEWEST[0])
    if seam[0] < NEWEST[0]:
        provide(brain)
    _met = seam
    return True


def problem(app: str, seam: Seam) -> str | None:
    """Return in one sentence why an app of this seam cannot be flown, and what to install."""
    if OLDEST <= seam <= NEWEST:
        return None
    said = f"{app} speaks seam {written(seam)}, pluto-fleet {__version__} speaks {spoken()}"
    if seam > NEWEST:
        return f'{said}: pip install --upgrade "pluto-fleet>={written(seam)}"'
    return f'{said}: compile {app} anew, or pip install "pluto-fleet<{seam[0] + 2}"'


def spoken() -> str:
    """Return the seams that this library supports, for a message."""
    return written(NEWEST) if OLDEST == NEWEST else f"{written(OLDEST)} to {written(NEWEST)}"


def written(seam: Seam) -> str:
    """Format a seam: `1.4`."""
    return ".".join(map(str, seam))


def versions(app: str) -> str:
    """Return the versions of the app, its seam and this library in one line."""
    try:
        number = version(app.rstrip("_"))
    except PackageNotFoundError:
        number = "(not installed)"
    return f"{app} {number}, seam {met()}, pluto-fleet {__version__}"


def met() -> str | None:
    """Return the seam of this process's app; None: there is no app."""
    return None if _met is None else written(_met)
