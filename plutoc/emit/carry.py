"""`compile --carry fleet`: the library inside the package, for sites that forbid a second distribution."""

from __future__ import annotations

from collections.abc import Mapping
from importlib.util import find_spec
from pathlib import Path

LIBRARY = "pluto_fleet"
FOLDER = "_fleet"
BRAIN = f"{LIBRARY}/_brain"
"""Where a library that was built has its copy of the brain; one that is worked on has none."""


class NoLibrary(Exception):
    """There is no library that could be carried. The message says what to install."""


def carried_library() -> Mapping[str, str]:
    """Return the library's files, by their path inside the package; it is read and not imported."""
    found = _files(LIBRARY, f"{FOLDER}/{LIBRARY}")
    if f"{FOLDER}/{BRAIN}/__init__.py" not in found:
        found.update(_files("plutoc_runtime", f"{FOLDER}/{BRAIN}"))
    return dict(sorted(found.items()))


def _files(package: str, into: str) -> dict[str, str]:
    spec = find_spec(package)
    if spec is None or spec.origin is None:
        raise NoLibrary(f"{package} is not installed here: pip install pluto-fleet")
    home = Path(spec.origin).parent
    return {
        f"{into}/{path.relative_to(home).as_posix()}": path.read_text("utf-8")
        for path in sorted(home.rglob("*"))
        if path.is_file() and "__pycache__" not in path.parts
    }
