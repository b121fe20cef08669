"""A reader of the checks' advice who does just what it says, and thinks of nothing else."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise, product

from plutoc.diagnostic import Diagnostic

_WRITTEN = r"`([^`]+)`"
_STOP = re.compile(r"\w+|\[[\w, ]+\]")


def followed(text: str, found: Diagnostic) -> str:
    """Return a graph's text with the advice followed, an arrow a line; the same if it asks for nothing."""
    advice = (found.help or "").partition("\nthe shortest way")[0]
    lines = [one for line in text.splitlines() for one in _single(line.strip())]
    # what follows "or" is another way
    advice = re.split(r"; or, |; a limit is", advice)[0]
    for name, kind in re.findall(r"`(\w+) = (\w+)`", advice):
        lines.insert(0, f"{name} = {kind}")
    if past := re.match(rf"{_WRITTEN} leads past", advice):
        lines = _without(lines, past[1])
    elif advice.startswith("remove the arrow"):
        lines = _without(lines, re.findall(_WRITTEN, found.message)[0])
    elif re.search(r"remove it|` instead$", advice):
        lines = _without(lines, found.source.quote(found.span))
    for old in re.findall(rf"instead of {_WRITTEN}", advice):
        lines = _without(lines, old)
    for sources, gate in re.findall(rf"lead the other arrows of (.*?) from {_WRITTEN}", advice):
        for source in re.findall(_WRITTEN, sources):
            lines = [re.sub(rf"^{source} -> ", f"{gate} -> ", line) for line in lines]
    for target, instead in re.findall(rf"every arrow to {_WRITTEN} to {_WRITTEN}", advice):
        lines = [re.sub(rf" -> {target}\b", f" -> {instead}", line) for line in lines]
    for written in re.findall(rf"(?:write|add) {_WRITTEN}", advice):
        lines += [line for line in _single(written) if line not in lines]
    return "\n".join(dict.fromkeys(lines))


def _single(flow: str) -> Iterator[str]:
    """Yield the arrows of a flow, the guard with the last of them; what is no flow, as it is."""
    if " -> " not in flow:
        yield flow
        return
    stops, _, guard = re.sub(r" (when|otherwise)", r"#\1", flow).partition("#")
    names = [re.findall(r"\w+", stop) for stop in _STOP.findall(stops)]
    for i, (sources, targets) in enumerate(pairwise(names), 2):
        for source, target in product(sources, targets):
            yield f"{source} -> {target}{f' {guard}' if guard and i == len(names) else ''}"


def _without(lines: list[str], flow: str) -> list[str]:
    gone = [line.partition(" when")[0] for line in _single(flow)]
    return [line for line in lines if re.split(r" when| otherwise", line)[0] not in gone]
