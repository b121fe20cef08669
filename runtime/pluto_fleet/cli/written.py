"""Files that commands write because their user names them."""

from __future__ import annotations

import os
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

from ..shared.domain.errors import BadInput

if TYPE_CHECKING:
    from types import ModuleType


def refuse_if_there(path: Path | None) -> None:
    """Raise `BadInput` if there is a file of this name: none is replaced."""
    if path is not None and os.path.lexists(path):
        raise BadInput(f"{path}: it is there already, and is not replaced")


def write_new(path: Path, text: str, what: str) -> None:
    """Write a text into a new file."""
    refuse_if_there(path)

    def write() -> None:
        with path.open("x", encoding="utf-8") as file:
            file.write(text)

    written(path, what, write)


def written(path: Path, what: str, write: Callable[[], object]) -> None:
    """Write a file; raise `BadInput` if it cannot be written."""
    try:
        write()
    except (OSError, ValueError) as error:  # ValueError: a NUL in the name
        raise cannot(path, what, error) from None


def cannot(path: Path, what: str, error: Exception) -> BadInput:
    """Return the error that something cannot be written into a file."""
    why = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
    return BadInput(f"{path}: {what} cannot be written: {why}")


KINDS = (".svg", ".png")


def kind_of(path: Path) -> str:
    """Return the image format of a file's name."""
    kind = path.suffix.lower()
    if kind not in KINDS:
        raise BadInput(f"{path}: a plot is an SVG or a PNG: give it a name that ends so")
    return kind[1:]


def drawing() -> ModuleType:
    """Import what draws, or raise `BadInput` with how to install it."""
    try:
        return import_module(".plot", __package__)
    except ImportError as error:
        if (error.name or "").startswith("pluto"):  # a bug
            raise
        raise BadInput(
            "a plot needs matplotlib, the extra `plot` of this package: "
            'pip install "matplotlib>=3.8"'
        ) from None


def write(path: Path, picture: bytes) -> None:
    """Write a picture into its file."""
    written(path, "the plot", lambda: path.write_bytes(picture))
