"""What the service answers: edits that an operation makes, what is completed, and what is said of a word.

`edits.txt` has a text and an operation as plain data, `complete.txt` a text with an `@` where the cursor stands,
`hooks.txt` the same of a hooks.py with the app that it belongs to, `hover.txt` an app of which each word is asked.
"""

from __future__ import annotations

import json
import random
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from plutoc.diagnostic import Severity
from plutoc.edits import applied
from plutoc.service.answers import Item
from plutoc.service.completion.complete import complete
from plutoc.service.document import Document
from plutoc.service.editing.edit import CannotEdit, edit
from plutoc.service.editing.operations import operation
from plutoc.service.hooks.help import complete as complete_in_hooks
from plutoc.service.reading.hover import hover
from plutoc.source import Source
from tests.compiler.service.test_fields import APP as FIELD
from tests.kit.sections import Section, compare, params
from tests.lsp.holes import FIRST, cuts, mistakes, offered, rank
from tests.paths import EXAMPLES, ROOT

HERE = Path(__file__).parent
MOST = 24
"""The first so many completions are shown."""
PURSUE = (ROOT / "tests/cases/pursue/app.pluto").read_text(encoding="utf-8")
APPS = {"field": FIELD, "pursue": PURSUE} | {
    path.parent.name: path.read_text(encoding="utf-8") for path in EXAMPLES.glob("*/app.pluto")
}


def text_of(case: Section) -> str:
    """Return what stands behind the `|` of a case."""
    lines = [line for line in case.given.splitlines() if line.startswith("|")]
    return "".join(f"{line[2:]}\n" for line in lines)


def shown(text: str) -> str:
    return "\n".join(f"| {line}".rstrip() for line in text.removesuffix("\n").split("\n"))


@pytest.mark.parametrize("case", params(HERE / "edits.txt"))
def test_an_operation_makes_these_edits(case: Section, update: bool) -> None:
    (said,) = (line[2:] for line in case.given.splitlines() if line.startswith("> "))
    document = Document(path="a.pluto", text=text_of(case))
    try:
        edited = edit(document, operation(json.loads(said)))
    except CannotEdit as why:
        compare(case, f"-- refused\n{why}", update)
        return
    now = applied(Source("a.pluto", document.source.text), edited.edits)
    lines = ["-- edited", shown(now), *(f"new: {name}" for name in edited.names), edited.note]
    compare(case, "\n".join(lines), update)


def _items(items: tuple[Item, ...]) -> str:
    lines = [
        each.label if each.insert == each.label else f"{each.label}: {json.dumps(each.insert)}"
        for each in items[:MOST]
    ]
    more = [f"and {len(items) - MOST} more"] if len(items) > MOST else []
    return "\n".join(["-- offered" if lines else "-- nothing", *lines, *more])


@pytest.mark.parametrize("case", params(HERE / "complete.txt"))
def test_what_is_offered_is_legal_and_the_likeliest_comes_first(
    case: Section, update: bool
) -> None:
    at, text = text_of(case).index("@"), text_of(case).replace("@", "")
    items = complete(Document(path="a.pluto", text=text), at)
    compare(case, _items(items), update)
    for item in items:
        now = text[: item.span.start] + item.insert + text[item.span.end :]
        found = Document(path="a.pluto", text=now).of_names
        assert not [each.message for each in found if each.severity is Severity.ERROR], item.insert


@pytest.mark.parametrize("case", params(HERE / "hooks.txt"))
def test_hooks_are_completed_by_the_app_beside_them(case: Section, update: bool) -> None:
    name = case.given.partition("\n")[0].removeprefix("> ")
    code = text_of(case)
    document = Document(path="app.pluto", text=APPS[name])
    items = complete_in_hooks(document, code.replace("@", ""), code.index("@"))
    compare(case, _items(items), update)


@pytest.mark.parametrize("case", params(HERE / "hover.txt"))
def test_each_word_is_explained(case: Section, update: bool) -> None:
    """What is said of several words is shown once."""
    name, *edits = case.given.splitlines()
    text = APPS[name]
    for each in edits:
        old, new = json.loads(each)
        assert old in text
        text = text.replace(old, new)
    compare(case, "\n".join(_explained(text)), update)


def _explained(text: str) -> Iterator[str]:
    document = Document(path="app.pluto", text=text)
    seen: set[str] = set()
    yield "-- said"
    for word in re.finditer(r"->|-?\d[\d.]* ?[%\w/]*|\w+", text):
        found = hover(document, word.start())
        said = found.markdown if found else "nothing"
        if said in seen:
            continue
        seen.add(said)
        line, column = document.source.position(word.start())
        yield f"{line}:{column} {word[0]}"
        lines = said.splitlines()
        kept = lines if len(lines) < 16 else [*lines[:8], "..."]  # of a page, its beginning
        yield from (f"    {each}".rstrip() for each in kept)


def test_what_was_cut_out_is_among_the_first_and_all_that_is_offered_is_legal() -> None:
    """A share of the thousand holes of `python -m tests.lsp`, which wants 95 of 100: of sixty that varies."""
    chosen = random.Random(3).sample(cuts(1000), 60)
    among = 0
    for cut in chosen:
        made = offered(cut)
        assert mistakes(cut, made) == [], (cut.path, cut.word)
        found = rank(cut, made)
        among += found is not None and found < FIRST
    assert among >= 0.9 * len(chosen)
