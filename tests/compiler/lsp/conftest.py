"""One client with its server, and folders of an app to open."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Iterable
from pathlib import Path
from shutil import copytree
from typing import TypeVar

import pytest
from lsprotocol.types import PositionEncodingKind

from tests.compiler.lsp.client import Client
from tests.paths import ROOT

T = TypeVar("T")
EXAMPLES = ROOT / "examples"
Talk = Callable[[Client], Awaitable[T]]


def talk(act: Talk[T], encodings: Iterable[PositionEncodingKind] = ()) -> T:
    """Let a client talk with a server of its own; neither has anything to complain of."""

    async def whole() -> T:
        client = Client()
        await client.begin(encodings)
        result = await act(client)
        await client.end()
        assert client.logged == []
        return result

    return asyncio.run(whole())


@pytest.fixture
def alfalfa(tmp_path: Path) -> Path:
    """A copy of an example with hooks beside it."""
    return Path(copytree(EXAMPLES / "alfalfa", tmp_path / "alfalfa"))
