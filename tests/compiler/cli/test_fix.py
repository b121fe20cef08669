"""`plutoc check --fix`: what becomes of the file, and each fix that there is."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest

from plutoc.cli.fix import mended
from plutoc.compile import analyse
from plutoc.diagnostic import Diagnostic, Fix, Rejected, Severity, error
from plutoc.edits import applied
from plutoc.source import Source, Span
from tests.compiler.cli.conftest import APP
from tests.kit.command import plutoc
from tests.test_cases import FOLDERS, diagnostics_of, read

SPARE = APP.replace("when COMPLETED", "when COMPLETED, COMPLETED").replace(
    "can take_photo", "can measure, measure, take_photo"
)


def test_line_ends_marks_and_permissions_stay(app: Path) -> None:
    """Only what is mended changes; a new line ends as the others do."""
    text = "\ufeff" + SPARE.removeprefix("pluto 1\n")
    app.write_bytes(text.replace("\n", "\r\n").encode())
    app.chmod(0o640)
    assert plutoc("check", app, "--fix").code == 0
    wanted = APP.replace("can take_photo", "can measure, take_photo").replace("\n", "\r\n")
    data = app.read_bytes().decode()
    assert data.startswith("\ufeff")
    assert data.removeprefix("\ufeff").split() == wanted.split()
    assert data.count("\n") == data.count("\r\n")
    assert app.stat().st_mode & 0o777 == 0o640


def test_a_fix_that_brings_an_error_is_not_made() -> None:
    """It was not as certain as it said."""
    source = Source("a.pluto", "good")

    def findings(source: Source) -> tuple[Diagnostic, ...]:
        if source.text == "good":
            fix = Fix(span=Span(0, 4), text="bad")
            return (replace(error("P2052", "m", source, Span(0, 4)), fix=fix),)
        return (error("P2009", "m", source, Span(0, 3)),)

    done = mended(source, findings)
    assert (done.source, done.fixed) == (source, ())
    assert [d.code for d in done.left] == ["P2052"]


def test_fixes_that_undo_each_other_come_to_an_end() -> None:
    """They would never be done."""

    def findings(source: Source) -> tuple[Diagnostic, ...]:
        fix = Fix(span=Span(0, 1), text="b" if source.text == "a" else "a")
        return (replace(error("P2052", "m", source, Span(0, 1)), fix=fix),)

    assert len(mended(Source("a.pluto", "a"), findings).fixed) == 10


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
def test_each_fix_mends_what_it_is_for_and_breaks_nothing(folder: Path) -> None:
    """One finding fewer, none more; of a warning, what passes along each edge stays the same."""
    source, hooks = _sources(folder)
    every = _found(folder)
    for found in every:
        if found.fix is None:
            continue
        mended = Source(found.source.path, applied(found.source, [found.fix]))
        after, and_hooks = (source, mended) if found.source == hooks else (mended, hooks)
        before, left = _facts(every), _facts(diagnostics_of(after, and_hooks))
        before.subtract([(found.code, found.message)])
        assert before <= left
        more = [code for code, _ in left - before]
        if found.severity is Severity.WARNING:
            assert not more
            assert _carried(after) == _carried(source)
        # of an error: only what could not be looked at before
        assert all(code[:2] > found.code[:2] for code in more)


def _sources(folder: Path) -> tuple[Source, Source | None]:
    source = read(folder / "app.pluto")
    assert source is not None
    return source, read(folder / "hooks.py")


@cache
def _found(folder: Path) -> tuple[Diagnostic, ...]:
    return diagnostics_of(*_sources(folder))


def _facts(found: tuple[Diagnostic, ...]) -> Counter[tuple[str, str]]:
    return Counter((d.code, d.message) for d in found)


def _carried(source: Source) -> dict[tuple[str, str], list[str]] | None:
    """What passes along each edge, of those along which anything does."""
    try:
        checked, _ = analyse(source)
    except Rejected:
        return None
    return {
        (edge.source, edge.target): sorted(status.value for status in statuses)
        for edge, statuses in checked.carries.items()
        if statuses
    }


def test_there_are_fixes() -> None:
    """The cases have some of each kind."""
    every = (found for folder in FOLDERS for found in _found(folder))
    codes = {found.code for found in every if found.fix}
    assert {"P0009", "P0016", "P1025", "P1035", "P2052", "P2053"} <= codes
