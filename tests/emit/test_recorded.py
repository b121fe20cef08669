"""What stands in `pluto.lock` is read as TOML would be, by two ways."""

from __future__ import annotations

import pytest

from plutoc.emit import recorded
from plutoc.emit.lock import lock
from plutoc.emit.recorded import DamagedLock, read_lock

TEXTS = {"README.md": "a", "src/a/_runtime/blocks/x.py": "b", ".gitattributes": ""}
WRITTEN = lock("a", "a.pluto", [], TEXTS)


def test_what_we_wrote_is_read_without_a_reader_of_toml(monkeypatch: pytest.MonkeyPatch) -> None:
    """And just as one would read it."""
    wanted = recorded._read(WRITTEN.encode())
    monkeypatch.setattr(recorded, "_read", pytest.fail)
    assert read_lock(WRITTEN.encode()) == wanted
    assert read_lock(WRITTEN.replace("\n", "\r\n").encode()) == wanted
    assert list(wanted.files) == sorted(TEXTS)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('"README.md"', '"LICENSE"'),
        ('"README.md"', "'README.md'"),
        ("[files]", "[files] # all"),
        ('app = "a"', 'app="a"'),
        ("[versions]\n", '[versions]\nsurvey = "survey 1"\n'),
        ("\n\n", "\n\n\n"),
    ],
)
def test_what_somebody_changed_is_read_as_toml(old: str, new: str) -> None:
    """As far as it is any."""
    text = WRITTEN.replace(old, new).encode()
    assert text != WRITTEN.encode()
    assert read_lock(text) == recorded._read(text)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('"README.md"', '"../README.md"'),
        ('"README.md"', '"/README.md"'),
        ('"README.md"', '"a//README.md"'),
        ('"README.md"', '"./README.md"'),
        ('"README.md"', '"src/a/_runtime/blocks/x.py"'),
        ('plutoc = "', 'plutoc = "\x07'),
        ("[versions]\n", '[versions]\nplutoc = "1"\n'),
        ("\n[files]", "\n<<<<<<< ours\n[files]"),
    ],
)
def test_what_is_damaged_is_refused(old: str, new: str) -> None:
    """No path leads out of the folder, and nothing stands there twice."""
    with pytest.raises(DamagedLock):
        read_lock(WRITTEN.replace(old, new, 1).encode())
