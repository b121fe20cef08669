"""The seam between an app and this library: one number, which both must have."""

from __future__ import annotations

from . import __version__
from .shared.domain.app import SEAM, library_for
from .shared.domain.errors import BadInput


def check(app: str, seam: int) -> None:
    """Raise `BadInput` if this library does not speak an app's seam."""
    why = problem(app, seam)
    if why is not None:
        raise BadInput(why)


def problem(app: str, seam: int) -> str | None:
    """Return in one sentence why an app of this seam cannot be flown, and what to do; None: it can."""
    if seam == SEAM:
        return None
    return (
        f"{app} speaks seam {seam}, pluto-fleet {__version__} speaks seam {SEAM}:"
        f' compile {app} again, or pip install "pluto-fleet{library_for(seam)}"'
    )


def versions(app: str, seam: int) -> str:
    """Return the versions of an app, its seam and this library in one line."""
    from importlib.metadata import PackageNotFoundError, version  # slow to import

    try:
        number = version(app.rstrip("_"))
    except PackageNotFoundError:
        number = "(not installed)"
    return f"{app} {number}, seam {seam}, pluto-fleet {__version__}"
