"""`version`: which version of the app its package says it is."""

from __future__ import annotations

import re

from plutoc.diagnostic import Diagnostic
from plutoc.graph import setting_errors as errors
from plutoc.syntax.tree import File, Text, VersionDecl

_BETWEEN = re.compile(r"[^0-9A-Za-z+!]+")
_NUMBERS = re.compile(r"[0-9]+(?:\.[0-9]+)*")


def version(file: File, found: list[Diagnostic]) -> Text | None:
    """Return the version that an app names, as PEP 440 writes it; None: it names none."""
    declared = [each for each in file.app.statements if isinstance(each, VersionDecl)]
    for again in declared[1:]:
        found.append(errors.second_setting(file.source, "version", again.span, declared[0].span))
    numbers: list[Text] = []
    for each in declared:
        written = each.version
        normal = _normal(written.value)
        if normal is None:
            found.append(errors.no_version(file.source, written, _meant(written.value)))
        else:
            numbers.append(Text(value=normal, span=written.span))
    return numbers[0] if numbers else None


def _normal(text: str) -> str | None:
    from packaging.version import Version  # slow to import, and most apps name none

    try:
        return str(Version(text))
    except ValueError:  # an `InvalidVersion`, or more digits than Python reads
        return None


def _meant(text: str) -> str | None:
    """Return the version that was probably meant: `2024.1.15` by `2024-01-15`, `1.2` by `1.2.x`."""
    numbers = _NUMBERS.search(text)
    tries = [_BETWEEN.sub(".", text).strip("."), numbers[0] if numbers else ""]
    return next(filter(None, map(_normal, tries)), None)
