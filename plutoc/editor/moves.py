"""The moves of missions through their blocks: the generated flow, with a note at every block.

The trace tells what becomes of missions and trips, and not at which block each is. A plain plan (`-O0`)
flies the very same and calls every block, so a copy of its flow that is made for one run says it.
"""

from __future__ import annotations

import ast
import json
import re
from collections.abc import Collection, Iterator
from pathlib import Path
from typing import Any

FILE = "PLUTO_MOVES"
"""The variable of the environment that names the file in which moves are noted."""
MODULE = "_moves"
_COMMENT = re.compile(r"\s*# (?:\S.* -> )?([A-Za-z_]\w*) = [A-Za-z_]")
_MOST = 50_000

Move = list[Any]
"""Seconds, the mission's name, the block's, the status with which it comes there, and the branch."""

NOTES = f'''"""Notes at which block each mission is."""

import json
import os

_file = open(os.environ["{FILE}"], "w", buffering=1, encoding="utf-8")
_branches = {{}}


def moved(run, status, block):
    """Note that a mission, or one branch of it, has come to a block."""
    known = _branches.setdefault(run.mission.name, {{}})
    branch = known.setdefault(run.key, len(known))
    now = round(run.core.kernel.now, 3)
    _file.write(json.dumps([now, run.mission.name, block, status.value, branch]) + "\\n")
'''


def noting(flow: str, blocks: Collection[str]) -> str:
    """Return a plain flow that notes at every block who comes there.

    At a fork, whose gate is called where the mission forks, it is noted behind: there its branches end.
    """
    tree = ast.parse(flow)
    lines = flow.split("\n")
    for node in ast.walk(tree):
        for name in ("body", "orelse"):
            body = getattr(node, name, None)
            if isinstance(body, list):
                setattr(node, name, list(_noted(body, lines, blocks)))
    last = max(i for i, one in enumerate(tree.body) if isinstance(one, ast.ImportFrom))
    tree.body.insert(last + 1, ast.parse(f"from .{MODULE} import moved").body[0])
    return ast.unparse(ast.fix_missing_locations(tree)) + "\n"


def _noted(body: list[ast.stmt], lines: list[str], blocks: Collection[str]) -> Iterator[ast.stmt]:
    below = None
    for statement in body:
        above = lines[statement.lineno - 2] if hasattr(statement, "lineno") else ""
        found = below or _COMMENT.match(above)
        below = found if _says_where(statement) else None
        if below is not None:
            yield statement
            continue
        if found is None or found[1] not in blocks:
            yield statement
            continue
        note = ast.parse(f"moved(run, status, {found[1]!r})").body[0]
        if " -> " not in found[0]:
            yield from (note, statement)
        elif isinstance(statement, ast.Return) and statement.value is not None:
            target = ast.Name("status", ast.Store())
            yield from (ast.Assign([target], statement.value), note)
            yield ast.Return(ast.Name("status", ast.Load()))
        else:
            yield from (statement, note)


def _says_where(statement: ast.stmt) -> bool:
    """Return whether this says which block the next statement is of."""
    return isinstance(statement, ast.Assign) and ast.unparse(statement.targets[0]) == _WHERE


_WHERE = "run.state.block"


def moves_in(moves: Path, trace: Path) -> tuple[list[Move], bool]:
    """Return what was noted in a run, with the missions' ends; and whether that is not all."""
    found: list[Move] = list(_read(moves))
    for event in _read(trace):
        if event["event"] == "mission.ended":
            found.append([event["t"], event["mission"], "end", event["status"], 0])
    found.sort(key=lambda one: one[0])
    return found[:_MOST], len(found) > _MOST


def _read(path: Path) -> Iterator[Any]:
    if path.is_file():
        with path.open(encoding="utf-8") as file:
            for line in file:
                if line.endswith("\n"):  # it may have been ended in the middle of one
                    yield json.loads(line)
