"""Where an app and this library meet: which seams are spoken, and whose brain it is.

The seam's first number changes when what was would be misread; the second when more is said. A library
speaks the newest first number and the one before.
"""

from __future__ import annotations

import sys
from importlib.metadata import PackageNotFoundError, version

from . import __version__
from .older import provide
from .scaffolding import bind

Seam = tuple[int, int]

OLDEST, NEWEST = (1, 0), (2, 0)
"""What this library speaks, and all between."""

_met: Seam | None = None


def meet(app: str, brain: str, seam: Seam) -> bool:
    """Take an app's brain as this process's; False: they do not speak alike, and it was said why."""
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
    """Return the seams that this library speaks, as a person reads them."""
    return written(NEWEST) if OLDEST == NEWEST else f"{written(OLDEST)} to {written(NEWEST)}"


def written(seam: Seam) -> str:
    """Return a seam as it is written: `1.4`."""
    return ".".join(map(str, seam))


def versions(app: str) -> str:
    """Return in one line which app this is, which seam it speaks, and by which library it flies."""
    try:
        number = version(app.rstrip("_"))
    except PackageNotFoundError:
        number = "(not installed)"
    return f"{app} {number}, seam {met()}, pluto-fleet {__version__}"


def met() -> str | None:
    """Return the seam that this process's app speaks; None where it has met none."""
    return None if _met is None else written(_met)
