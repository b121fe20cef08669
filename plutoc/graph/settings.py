"""`version` and `requires`: what an app's package says of itself, and which libraries its hooks import."""

from __future__ import annotations

import re
from collections.abc import Iterator

from packaging.requirements import Requirement
from packaging.version import Version

from plutoc.diagnostic import Diagnostic
from plutoc.graph import setting_errors as errors
from plutoc.graph.model import Library
from plutoc.source import Source
from plutoc.syntax.tree import File, RequiresDecl, Text, VersionDecl

_BETWEEN = re.compile(r"[^0-9A-Za-z+!]+")
_NUMBERS = re.compile(r"[0-9]+(?:\.[0-9]+)*")


FLEET = "pluto-fleet"
"""What flies an app: the extras of its package require it, in the version that fits."""
_SAME = re.compile(r"[-_.]+")
_SWAPPED = re.compile(r"=([<>])")
_SINGLE = re.compile(r"(?<![<>=!~])=(?!=)")
_ANY_LAST = re.compile(r"\.[xX*](?![\w.])")
_NO_COMMA = re.compile(r"(?<=[\w*])\s*(?=(?:[<>]|[=!~]=))")
_NO_SIGN = re.compile(r"([A-Za-z][\w.-]*?)[ \t@:^]+v?([0-9]\S*)")


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
            found.append(errors.no_version(file.source, written, _version_meant(written.value)))
        else:
            numbers.append(Text(value=normal, span=written.span))
    return numbers[0] if numbers else None


def _normal(text: str) -> str | None:
    try:
        return str(Version(text))
    except ValueError:  # an `InvalidVersion`, or more digits than Python reads
        return None


def _version_meant(text: str) -> str | None:
    """Return the version that was probably meant: `2024.1.15` by `2024-01-15`, `1.2` by `1.2.x`."""
    numbers = _NUMBERS.search(text)
    tries = [_BETWEEN.sub(".", text).strip("."), numbers[0] if numbers else ""]
    return next(filter(None, map(_normal, tries)), None)


def libraries(file: File, found: list[Diagnostic]) -> tuple[Library, ...]:
    """Return what an app requires. What cannot be read is left out: the error is told."""
    source = file.source
    declared = [each for each in file.app.statements if isinstance(each, RequiresDecl)]
    for again in declared[1:]:
        found.append(errors.second_setting(source, "requires", again.span, declared[0].span))
    required = [_required(source, file.app.name.text, each, found) for each in declared]
    return required[0] if required else ()


def _required(
    source: Source, app: str, declared: RequiresDecl, found: list[Diagnostic]
) -> tuple[Library, ...]:
    """Return what one statement requires."""
    firsts: dict[tuple[str, str], tuple[Requirement, Text]] = {}
    required = []
    for text in declared.libraries:
        requirement = _read(text.value)
        if requirement is None:
            several = _several(text.value)
            found.append(errors.no_requirement(source, text, several, _meant(text.value)))
            continue
        name = _same_name(requirement.name)
        if name in (_same_name(app), FLEET):
            found.append(errors.own_requirement(source, text, app, is_fleet=name == FLEET))
            continue
        # Under other conditions it may well be required once more, in another version.
        key = (name, str(requirement.marker or ""))
        if key in firsts:
            found.append(_twice(source, text, requirement, *firsts[key]))
        firsts.setdefault(key, (requirement, text))
        required.append(
            Library(
                name=name,
                requirement=" ".join(text.value.split()),
                direct=requirement.url is not None,
                span=text.span,
            )
        )
    return tuple(required)


def _same_name(name: str) -> str:
    """Return a name as installers compare it. An app's package cannot end with `_`."""
    return _SAME.sub("-", name.lower()).rstrip("-")


def _read(text: str) -> Requirement | None:
    try:
        requirement = Requirement(text)
    except (ValueError, RecursionError):  # an `InvalidRequirement`, or brackets without end
        return None
    return requirement if _is_found(requirement.url) else None


def _is_found(url: str | None) -> bool:
    """Return whether an address has a scheme, which `packaging` does not ask for: `numpy @ 2.0`."""
    return url is None or ":" in url


def _several(text: str) -> list[str]:
    """Return the libraries that stand in one text, with commas between them."""
    parts = [part.strip() for part in text.split(",")]
    return parts if len(parts) > 1 and all(map(_read, parts)) else []


def _twice(
    source: Source, text: Text, again: Requirement, first: Requirement, first_text: Text
) -> Diagnostic:
    both = None
    if again.url is None and first.url is None and again != first:
        extras = ",".join(sorted(first.extras | again.extras))
        marker = f"; {first.marker}".replace('"', "'") if first.marker else ""
        each = (str(first.specifier), str(again.specifier))
        versions = ",".join(dict.fromkeys(filter(None, each)))
        both = f"{first.name}{f'[{extras}]' if extras else ''}{versions}{marker}"
    return errors.required_twice(source, text, first_text, both, same=again == first)


def _meant(text: str) -> str | None:
    """Return the requirement that was probably meant: `numpy>=2` by `numpy=>2`."""
    return next((each for each in _tries(text.strip()) if _read(each)), None)


def _tries(text: str) -> Iterator[str]:
    yield _SWAPPED.sub(r"\1=", text)
    yield _SINGLE.sub("==", text)
    yield _ANY_LAST.sub("", text) if "==" not in text else _ANY_LAST.sub(".*", text)
    yield _NO_COMMA.sub(",", text).replace(",", "", 1)
    spaced = _NO_SIGN.fullmatch(text)
    if spaced:
        yield f"{spaced[1]}>={spaced[2]}"
    if "://" in text:
        name = re.split(r"[/@#]", text.partition("://")[2].rstrip("/"))
        last = next((part for part in reversed(name) if part.endswith(".git")), "")
        yield f"{last.removesuffix('.git')} @ {text}"
