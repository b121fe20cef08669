"""Comparing the warnings of the checks."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

from plutoc.diagnostic import Diagnostic
from plutoc.diff.both import Both, Side
from plutoc.diff.messages import blocks as messages
from plutoc.diff.model import Change, Importance
from plutoc.diff.roles import awaited
from plutoc_runtime.domain.status import Status

_HELD, _UNMENDED, _UNBOUNDED = "P2054", "P2055", "P2056"
_NAME = re.compile(r"`(\w+)`")


def warned(both: Both, told: Sequence[Change]) -> Iterator[Change]:
    """Compare what the checks warn of: of each code, as many as there are more or fewer now.

    That nothing puts a failed trip back needs no saying where the way of failures was `told`.
    """
    failures = any(Status.FAILED in change.statuses for change in told)
    before = _by_code(both.old.version.warnings)
    after = _by_code(both.new.version.warnings)
    for code in sorted({*before, *after}):
        if code == _UNMENDED and failures:
            continue
        was, now = before.get(code, []), after.get(code, [])
        known = {_called(one, both.old.names) for one in was}
        still = {one.message for one in now}
        if code == _HELD:  # each block has its own: they are told one by one
            was = [one for one in was if _called(one, both.old.names) not in still]
            now = [one for one in now if one.message not in known]
            come, gone = now, was
        else:
            come = [one for one in now if one.message not in known] or now
            come = come[: max(len(now) - len(was), 0)]
            gone = [one for one in was if _called(one, both.old.names) not in still] or was
            gone = gone[: max(len(was) - len(now), 0)]
        yield from (_change(both.new, one, is_new=True) for one in come)
        yield from (_change(both.old, one, is_new=False) for one in gone)


def _change(side: Side, warning: Diagnostic, *, is_new: bool) -> Change:
    node = next((n for n in side.graph.nodes if n.name_span == warning.span), None)
    if warning.code == _HELD and node:
        wait = awaited(node) or f"wait at `{node.name}`"
        return messages.held(wait, node, is_new=is_new)
    return messages.warning_of_one(warning, _importance(warning), node, is_new=is_new)


def _importance(warning: Diagnostic) -> Importance:
    """What becomes of failures is more than a matter of form."""
    failures = warning.code in (_UNMENDED, _UNBOUNDED)
    return Importance.SAFETY if failures else Importance.FORM


def _by_code(warnings: Sequence[Diagnostic]) -> dict[str, list[Diagnostic]]:
    found: dict[str, list[Diagnostic]] = {}
    for warning in warnings:
        found.setdefault(warning.code, []).append(warning)
    return found


def _called(warning: Diagnostic, names: Mapping[str, str]) -> str:
    """Return a warning's sentence with blocks as the new app calls them."""
    return _NAME.sub(lambda match: f"`{names.get(match[1], match[1])}`", warning.message)
