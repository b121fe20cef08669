"""Putting what was found into a fleet file, of which all else stays as it is."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import tomlkit
from tomlkit.exceptions import TOMLKitError

from ..files.reading import PlanTable, parsed
from ..process.whole_file import write_whole
from ..shared.alone.files import read_motion
from ..shared.domain.errors import BadInput
from .report import in_file

if TYPE_CHECKING:
    from .found import Calibration


def write(what: Calibration, path: Path, text: str) -> Iterator[str]:
    """Put the values into the `[motion]` of a fleet file with this text; yield what has changed.

    Raises `BadInput` if a value may not stand there, or the file cannot be written; then it is as before.
    """
    values = {name: in_file(name, found) for name, found in what.found.items() if name != "charge"}
    changed, after = _changed(path, text, values)
    if after != text:
        _replace(path, after)
    for name, before in changed.items():
        was = "" if before is None else f" (was {before})"
        yield f"{path}: [motion] {name} = {values[name]}{was}"
    if not changed:
        yield f"{path}: nothing has changed"


def _changed(path: Path, text: str, values: dict[str, str]) -> tuple[dict[str, object | None], str]:
    """Return the keys that change, with what they were, and the new text."""
    try:
        document: Any = tomlkit.parse(text)
    except TOMLKitError as error:  # `tomllib` has read it
        raise BadInput(f"{path}: it cannot be changed here: {error}") from None
    if "motion" not in document:
        document["motion"] = tomlkit.table()
    motion = document["motion"]
    changed: dict[str, object | None] = {}
    for name, value in values.items():
        before = motion.get(name)
        if before != value:
            changed[name] = None if before is None else before.unwrap()
            motion[name] = value
    after = tomlkit.dumps(document) if changed else text
    if text.count("\n") == text.count("\r\n") > 0:  # new lines end as all others do
        after = after.replace("\r\n", "\n").replace("\n", "\r\n")
    read = parsed(f"{path}, with what was found", after)
    read_motion(PlanTable(read, read.data))
    read.refuse_if_bad()
    return changed, after


def _replace(path: Path, text: str) -> None:
    """Write the file as a whole, or not at all."""
    file = Path(os.path.realpath(path))
    try:
        write_whole(file, text, mode=file.stat().st_mode & 0o777)
    except OSError as error:
        raise BadInput(f"{path}: it cannot be written: {error.strerror or error}") from None
