"""The extras of this library: what each is for, and which packages it brings."""

from __future__ import annotations

from collections.abc import Iterator
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec

EXTRAS = {
    "areas": ("shapely",),
    "crazyflie": ("cflib",),
    "mavlink": ("mavsdk", "pymavlink"),
    "plot": ("matplotlib",),
    "station": ("mcap", "pillow", "starlette", "uvicorn", "websockets"),
}
"""The packages that each extra brings; a module of the same name is in each, but for these:"""

_MODULES = {"pillow": "PIL"}


def has(extra: str) -> bool:
    """Return whether all that an extra brings can be imported; imports nothing."""
    return all(find_spec(_MODULES.get(name, name)) is not None for name in EXTRAS[extra])


def installed() -> str:
    """Return which extras are installed, in one line: `plot (matplotlib 3.8); not installed: …`."""
    there = [f"{extra} ({', '.join(_versions(extra))})" for extra in EXTRAS if has(extra)]
    lacking = [extra for extra in EXTRAS if not has(extra)]
    missing = [f"not installed: {', '.join(lacking)}"] if lacking else []
    return "; ".join(([", ".join(there)] if there else []) + missing)


def _versions(extra: str) -> Iterator[str]:
    for name in EXTRAS[extra]:
        try:
            yield f"{name} {version(name)}"
        except PackageNotFoundError:  # it is on the path, and no installer has put it there
            yield name
