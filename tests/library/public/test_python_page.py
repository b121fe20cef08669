"""What docs/python.md shows is run, from its first line to its last, and prints what it shows."""

from __future__ import annotations

import os
import re
from pathlib import Path

import pytest

from tests.kit.apps import compiled
from tests.kit.command import python
from tests.paths import ROOT

PAGE = ROOT / "docs/python.md"
SHOWN = re.compile(r"```python\n(.*?)```\n\n```\n(.*?)```", re.DOTALL)
RUNTIME = ROOT / "runtime"
BETWEEN = "-- next --\n"


@pytest.mark.long
@pytest.mark.process
def test_what_it_shows_is_so(tmp_path: Path, update: bool) -> None:
    packages = [str(compiled(name, tmp_path) / "src") for name in ("pm10", "drugs_distribution")]
    text = PAGE.read_text("utf-8")
    blocks = SHOWN.findall(text)
    assert len(blocks) == text.count("```python")
    code = f"print({BETWEEN!r}, end='')\n".join(code for code, _ in blocks)
    path = os.pathsep.join([*packages, str(RUNTIME)])
    done = python("-c", code, cwd=tmp_path, PYTHONPATH=path)
    assert (done.code, done.err) == (0, "")
    printed = done.out.split(BETWEEN)
    if update:
        for (code, before), now in zip(blocks, printed, strict=True):
            text = text.replace(
                f"```python\n{code}```\n\n```\n{before}```",
                f"```python\n{code}```\n\n```\n{now}```",
            )
        PAGE.write_text(text, "utf-8")
    else:
        assert printed == [shown for _, shown in blocks]
