"""Stations of examples, in this process."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.library.station.in_process import Flown, world

Serve = Callable[..., Flown]


@pytest.fixture
def serve(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Serve]:
    """Serve stations of examples, with the missions of these."""
    with world(monkeypatch) as here:

        def serve(
            name: str = "drugs_distribution", folder: str = "station", **options: object
        ) -> Flown:
            return Flown(world=here, name=name, folder=tmp_path / folder, options=options)

        yield serve
