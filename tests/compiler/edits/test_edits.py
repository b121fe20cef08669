"""A small edit of a source is a small difference of its package: a person reads it in a pull request."""

from __future__ import annotations

import re
from collections.abc import Iterator
from difflib import unified_diff

import pytest

from plutoc.compile import analyse, compile_source
from plutoc.hooks.add import with_stubs
from plutoc.source import Source
from tests.paths import ROOT

EXAMPLE = ROOT / "examples/alfalfa"
ALFALFA = (EXAMPLE / "app.pluto").read_text(encoding="utf-8")
HOOKS = (EXAMPLE / "hooks.py").read_text(encoding="utf-8")
SHORTER = (ROOT / "tests/cases/alfalfa/app.pluto").read_text(encoding="utf-8")
"""The same app with its clock outside of every loop: another arrow to it makes a second one."""
MOST = 70
"""Lines of nine edits together, added and removed; the lock and copied modules' text aside."""


def nine(text: str) -> Iterator[tuple[str, str, str]]:
    """Yield nine edits of an app like alfalfa: what each does, the source before and after."""

    def edit(name: str, *replacements: tuple[str, str]) -> tuple[str, str, str]:
        after = text
        for old, new in replacements:
            assert after.count(old) == 1, f"{old!r} stands {after.count(old)} times in the source"
            after = after.replace(old, new)
        return name, text, after

    gate = "  first = GateFIFO\n"
    # what comments say stays
    yield "rename a block", text, re.sub(r"(?m)^([^#\n]*)\bjudge\b", r"\1assess", text)
    yield edit(
        "add a third branch to a fork",
        (gate, f"  gap = GapMonitor(default: 2 min)\n{gate}"),
        ("[watch, timer]", "[watch, timer, gap]"),
    )
    yield edit("change a parameter", ("max_attempts: 3", "max_attempts: 5"))
    inserted = edit(
        "insert a block in a chain",
        (gate, f"{gate}  rest = Clock\n"),
        ("  retry -> allocate when STANDBY\n", "  retry -> rest -> allocate\n"),
    )
    yield inserted
    yield "remove it", inserted[2], text
    yield edit("retarget an edge", ("  retry -> allocate when", "  retry -> wait when"))
    evaluator = "  evaluator find_blooms\n"
    yield edit("add a hook", (evaluator, f"{evaluator}  evaluator find_pests\n"))
    tried = "  retry -> allocate when STANDBY"
    yield edit("change a guard", (tried, f"{tried}, FAILED"))
    yield edit("add a comment at the top", ("pluto 1\n", "pluto 1\n# The field behind the barn.\n"))


def files(text: str) -> dict[str, str]:
    """Return the files of a package whose developer has stubs in hooks.py for new hooks."""
    source = Source("app.pluto", text)
    written = with_stubs(analyse(source)[0], Source("hooks.py", HOOKS))
    package = compile_source(
        source, source_name="app.pluto", find_hooks=lambda _: Source("hooks.py", written)
    ).package
    return {**package.owned, f"src/{package.name}/hooks.py": written}


def changes(before: str, after: str) -> Iterator[str]:
    """Yield the lines that went and came, and the modules of the runtime that joined or left."""
    old, new = files(before), files(after)
    data = {
        "pluto.lock",
        *(path for path in new if path.endswith("/graph.json")),
    }  # folded in reviews
    for path in sorted({*old, *new} - data):
        one, other = old.get(path), new.get(path)
        if "/_runtime/" not in path:
            compared = unified_diff((one or "").splitlines(), (other or "").splitlines(), n=0)
            yield from (line for line in list(compared)[2:] if not line.startswith("@"))
        elif one != other:
            assert one is None or other is None, f"{path} is not copied byte for byte"
            yield path


@pytest.mark.parametrize("text", [ALFALFA, SHORTER], ids=["example", "shorter"])
def test_nine_edits_change_few_lines(text: str) -> None:
    """Those of hooks.py count too, and a module that joins or leaves is a line."""
    found = {name: list(changes(before, after)) for name, before, after in nine(text)}
    assert len(found) == 9
    assert sum(map(len, found.values())) <= MOST, found
    assert found["add a comment at the top"] == []
