"""The file of `--plot`: its name, the drawing library, and how it is written."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

from ..shared.domain.errors import BadInput
from .written import written

if TYPE_CHECKING:
    from types import ModuleType

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
