"""Which compiler this is: what changes whenever it, or what it works with, is another one."""

from __future__ import annotations

import sys

from plutoc import __version__
from plutoc.installed import digest, facts_of_package, facts_of_release

TYPE_CHECKING = False  # `typing` itself is slow to import
if TYPE_CHECKING:
    from collections.abc import Callable

OURS = ("plutoc", "plutoc_grammar", "plutoc_runtime", "plutoc_blocks")
"""Packages of which every file counts: a checkout is another compiler after each change in it."""
TOOLS = ("black", "jinja2")
"""Packages of which the release counts."""


def identity(facts_of: Callable[[str], list[str]] = facts_of_package) -> bytes:
    """Return the identity of this compiler, of the Python that it runs on, and where that looks."""
    facts = [__version__, sys.version, sys.executable, str(sys.flags.optimize), *sys.path]
    for name in OURS:
        facts += facts_of(name)
    for name in TOOLS:
        facts += facts_of_release(name)
    return digest(facts)
