"""What a document says of its text, sound or not."""

from __future__ import annotations

from pathlib import Path

import pytest

from plutoc.compile import analyse, check_hooks
from plutoc.diagnostic import Diagnostic, Rejected
from plutoc.service.document import Document
from plutoc.service.symbols import Role, at, occurrences, same
from plutoc.source import Source
from tests.paths import CASES, ROOT

SOURCES = sorted(CASES.glob("*/app.pluto"))[1::3]
RETRY = ROOT / "examples" / "drugs_distribution_retry" / "app.pluto"


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: path.parent.name)
def test_it_says_what_check_says(path: Path) -> None:
    text = path.read_bytes().decode()
    hooks = path.with_name("hooks.py")
    code = Source("hooks.py", hooks.read_text(encoding="utf-8")) if hooks.is_file() else None
    found: tuple[Diagnostic, ...] = ()
    try:
        checked, found = analyse(Source("app.pluto", text))
        found += check_hooks(checked, code)
    except Rejected as rejected:
        found += rejected.diagnostics
    document = Document(path="app.pluto", text=text, find_hooks=lambda _: code)
    assert document.diagnostics == found


def test_statuses_are_known_as_far_as_missions_get() -> None:
    text = RETRY.read_text(encoding="utf-8")
    sound = Document(path="a", text=text)
    broken = Document(path="a", text=text.replace("when FAILED", "when COMPLETED"))
    assert broken.checked is None and broken.diagnostics
    passing = {(e.source, e.target): s for e, s in sound.carries.items()}
    still = {(e.source, e.target): s for e, s in broken.carries.items()}
    assert passing["launch", "watch"] == still["launch", "watch"] != frozenset()
    assert Document(path="a", text="pluto 1\napp a {\n}\n").carries == {}


def test_a_problem_of_the_graph_shows_the_way_to_it() -> None:
    text = RETRY.read_text(encoding="utf-8").replace("watch -> wait when STANDBY\n", "")
    one, *_ = (d for d in Document(path="a", text=text).diagnostics if d.path)
    blocks = [name for name, _ in one.path]
    assert blocks[0] == "create" and "launch" in blocks
    assert dict(one.path)["launch"] == "RUNNING"


def test_a_name_is_found_everywhere_it_stands() -> None:
    text = RETRY.read_text(encoding="utf-8")
    found = occurrences(Document(path="a", text=text).file)
    one = at(found, text.index("-> allocate") + 5)
    assert one is not None and one.role is Role.BLOCK
    places = same(found, one)
    assert len(places) == text.count("allocate")
    assert [place.declares for place in places].count(True) == 1
    assert at(found, 0) is None
