"""The versions of the seam between an app and this library.

The seam's first number changes when earlier data would be misread, the second when data is added. A library
speaks the newest first number and the one before.
"""

from __future__ import annotations

from . import __version__
from .shared.domain.errors import BadInput

Seam = tuple[int, int]

OLDEST, NEWEST = (2, 0), (3, 3)
"""The range of seams that this library supports."""


def checked(app: str, seam: Seam) -> Seam:
    """Return an app's seam; raise `BadInput` if this library does not speak it."""
    why = problem(app, seam)
    if why is not None:
        raise BadInput(why)
    return seam


def problem(app: str, seam: Seam) -> str | None:
    """Return in one sentence why an app of this seam cannot be flown, and what to install."""
    if OLDEST <= seam <= NEWEST:
        return None
    said = f"{app} speaks seam {written(seam)}, pluto-fleet {__version__} speaks {spoken()}"
    if seam > NEWEST:
        return f'{said}: pip install --upgrade "pluto-fleet>={written(seam)}"'
    return f'{said}: compile {app} anew, or pip install "pluto-fleet<{seam[0] + 2}"'


def is_older(seam: Seam) -> bool:
    """Return whether an app of this seam is flown by the library's copy of the brain (`older.py`)."""
    return seam[0] < NEWEST[0]


def spoken() -> str:
    """Return the seams that this library supports, for a message."""
    return written(NEWEST) if OLDEST == NEWEST else f"{written(OLDEST)} to {written(NEWEST)}"


def written(seam: Seam) -> str:
    """Format a seam: `1.4`."""
    return ".".join(map(str, seam))


def versions(app: str, seam: Seam) -> str:
    """Return the versions of an app, its seam and this library in one line."""
    from importlib.metadata import PackageNotFoundError, version  # slow to import

    try:
        number = version(app.rstrip("_"))
    except PackageNotFoundError:
        number = "(not installed)"
    return f"{app} {number}, seam {written(seam)}, pluto-fleet {__version__}"
