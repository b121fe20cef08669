"""What a mission does, and when, is what it was when packages carried everything: 10 seeds of each."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.as_before import EXAMPLES, KEPT, MISHAPS, as_it_was, compiled, hashes

SEEDS = 10


@pytest.mark.parametrize("example", sorted(path.name for path in EXAMPLES.iterdir()))
def test_simulate_prints_what_it_printed(example: str, tmp_path: Path) -> None:
    kept = json.loads(KEPT.read_text("utf-8"))[example]
    assert set(kept) == set(MISHAPS)
    source = as_it_was(example, tmp_path)
    package = compiled(source, tmp_path)
    for name, mishaps in MISHAPS.items():
        found = hashes(source, package, mishaps, SEEDS)
        assert found == kept[name][:SEEDS], name
