"""A mistake of ours: every face of the compiler tells it, and where it happened to those who ask."""

from __future__ import annotations

import os


def traceback_of(error: BaseException) -> str:
    """Return the traceback of a mistake of ours; empty unless PLUTO_DEBUG=1 asks for it."""
    if os.environ.get("PLUTO_DEBUG") != "1":
        return ""
    import traceback  # which no other run needs

    return "".join(traceback.format_exception(error)).rstrip()
