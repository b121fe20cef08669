"""One input through the whole compiler, and what must hold of all that comes out."""

from __future__ import annotations

import ast
import re
import tomllib
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from hashlib import sha256
from pathlib import Path, PurePosixPath
from random import Random
from tempfile import TemporaryDirectory

from plutoc.compile import Compiled, check_hooks, compile_source
from plutoc.diagnostic import Diagnostic, Rejected
from plutoc.emit.errors import place_of
from plutoc.emit.lock import NAME as LOCK
from plutoc.emit.lock import read_lock
from plutoc.emit.package import Package
from plutoc.emit.write import compare, write
from plutoc.hooks.add import with_stubs
from plutoc.report import github
from plutoc.report.json import render_line
from plutoc.report.pictures import dot, json, mermaid
from plutoc.report.text import render
from plutoc.source import Source
from tests.fuzz.mutants import changed, spliced
from tests.kit.graphs.usual import grown

WRITTEN_EVERY = 25
"""Every so many-th app that is accepted is written to the disk as well."""

TOP = frozenset({".gitattributes", "LICENSE", "README.md", "pyproject.toml", LOCK, "src", "tests"})

_ODD = ("", "async ", "(", "\n", "Misson", "\0", " -> ", "yield ", "await ", "# coding: cp037\n")

_compiled: set[bytes] = set()
"""Modules that Python has compiled already: those of the runtime are nearly always the same."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """What became of an input."""

    way: str
    """How it was made."""
    codes: tuple[str, ...]
    """Of its errors; none where it was accepted."""
    hooks: tuple[str, ...]
    """Of the errors in a hooks.py that was changed by chance."""


@dataclass(slots=True)
class Tally:
    """What became of the inputs so far: by the way in which they were made, and by what was said of them."""

    made: Counter[str] = field(default_factory=Counter)
    accepted: Counter[str] = field(default_factory=Counter)
    codes: Counter[str] = field(default_factory=Counter)
    hooks: Counter[str] = field(default_factory=Counter)

    def add(self, outcome: Outcome) -> None:
        """Count one; a code once, however often it was given."""
        self.made[outcome.way] += 1
        self.accepted[outcome.way] += not outcome.codes
        self.codes.update(set(outcome.codes))
        self.hooks.update(set(outcome.hooks))

    def lines(self) -> Iterator[str]:
        """Say what was counted."""
        for title in ("made", "accepted", "codes", "hooks"):
            counts: Counter[str] = getattr(self, title)
            yield f"{title} ({counts.total()}): " + ", ".join(
                f"{k} {counts[k]}" for k in sorted(counts)
            )


def source_of(random: Random) -> tuple[str, bytes]:
    """Make an input; say how."""
    way = random.choice(("grown", "grown", "changed", "spliced"))
    if way == "grown":
        return way, grown(random).encode()
    return way, changed(random) if way == "changed" else spliced(random)


def trial(random: Random, *, on_disk: bool = False) -> Outcome:
    """Make an input and compile it; all that is raised, `Rejected` aside, is a bug of ours."""
    way, data = source_of(random)
    try:
        source = Source("fuzz.pluto", data.decode())
    except UnicodeDecodeError:
        return Outcome(way=way, codes=("not UTF-8",), hooks=())
    try:
        compiled = compile_source(source, source_name="fuzz.pluto", find_hooks=lambda _: None)
    except Rejected as rejected:
        check_report(rejected.diagnostics)
        codes = [one.code for one in rejected.diagnostics if one.severity.value == "error"]
        assert codes, "refused without an error"
        return Outcome(way=way, codes=tuple(codes), hooks=())
    check_report(compiled.warnings)
    check_package(compiled.package)
    for picture in (mermaid, dot, json):
        assert picture(compiled.checked).endswith("\n")
    if on_disk:
        check_on_disk(compiled)
    return Outcome(way=way, codes=(), hooks=_hooks(random, compiled))


def check_report(diagnostics: Sequence[Diagnostic]) -> None:
    """Every finding has its place in the source, and every output can show it."""
    for one in diagnostics:
        places = [(one.source, one.span), *((each.source, each.span) for each in one.related)]
        for source, span in places:
            # Where something is missing at the end, its place is one behind the last character.
            assert 0 <= span.start <= span.end <= len(source.text) + 1, one
        assert one.message
        assert "\n" not in render_line(one)
        assert "\n" not in github.render_line(one)
    said = render(diagnostics, colour=False)
    assert all(char == "\n" or char.isprintable() for char in said), said


def check_package(package: Package) -> None:
    """Every file stays in its folder, every module is Python, the record says what is there."""
    files = {**package.owned, **package.once}
    for path, text in files.items():
        parts = PurePosixPath(path).parts
        assert parts[0] in TOP, path
        assert path == "/".join(parts)
        assert not {"..", ".", ""} & set(parts), path
        assert parts[0] != "src" or parts[1] == package.name, path
        data = text.encode()
        if path.endswith(".py") and data not in _compiled:
            compile(data, path, "exec", dont_inherit=True)
            _compiled.add(data)
        elif path.endswith(".toml"):
            tomllib.loads(text)
    recorded = read_lock(files[LOCK].encode())
    assert recorded.app == package.name
    assert dict(recorded.files) == {
        path: {sha256(text.encode()).hexdigest()}
        for path, text in package.owned.items()
        if path != LOCK
    }


def check_on_disk(compiled: Compiled) -> None:
    """What is written is what was made, in one folder and nowhere else."""
    with TemporaryDirectory() as temporary:
        top = Path(temporary)
        package = compiled.package
        folder = top / package.name
        write(compare(package, folder, place_of(compiled.checked.graph)))
        assert [path.name for path in top.iterdir()] == [package.name]
        written = {
            path.relative_to(folder).as_posix(): path.read_bytes()
            for path in folder.rglob("*")
            if path.is_file()
        }
        texts = {**package.owned, **package.once}
        assert written == {path: text.encode() for path, text in texts.items()}
        assert not compare(package, folder, place_of(compiled.checked.graph)).files


def _hooks(random: Random, compiled: Compiled) -> tuple[str, ...]:
    """Take fresh hooks, which have no mistakes, and then the same ones spoilt."""
    path = f"src/{compiled.package.name}/hooks.py"
    text = compiled.package.once[path]
    check_hooks(compiled.checked, Source("hooks.py", text))
    start = text.index('"""', 3)  # what comes before it is a docstring
    words = re.findall(r"\w+|\s+|.", text[start:])
    for _ in range(random.choice((1, 1, 2, 5))):
        at = random.randrange(len(words))
        names = [number for number, word in enumerate(words) if word.isidentifier()]
        if names and random.random() < 0.7:  # what comes out is mostly Python
            at = random.choice(names)
            words[at] = words[random.choice(names)]
        else:
            words[at] = random.choice((*_ODD, *random.choices(words, k=20)))
    hooks = Source("hooks.py", text[:start] + "".join(words))
    added = with_stubs(compiled.checked, hooks)
    try:
        check_hooks(compiled.checked, Source("hooks.py", added))
        ast.parse(added)
        check_hooks(compiled.checked, hooks)
    except Rejected as rejected:
        check_report(rejected.diagnostics)
        return tuple(one.code for one in rejected.diagnostics)
    return ()
