"""Whatever a client sends: it is answered in a sentence, and all go on."""

from __future__ import annotations

import asyncio
import json
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from plutoc.editor.asked import Refused, parsed
from plutoc.editor.session import Session
from plutoc.service.editing.operations import KINDS

from .editing import HOOKED, Page, app_in

NAMES = (
    "",
    "watch",
    "judge",
    "STANDBY",
    "app",
    "hooks",
    "../x",
    "\x00",
    "é🚁",
    "\ud800",
    "a" * 200,
    "a" * 5_000,
)
KEYS = ("from", "to", "insert", "source", "target", "when", "do", "", "watch")
FACTS = (
    *("id", "version", "changes", "file", "positions", "problem", "name", "keep", "offset"),
    *("source", "when", "code"),
)
VALUES = st.recursive(
    st.none()
    | st.booleans()
    | st.integers(-5, 400)
    | st.floats(allow_nan=False)
    | st.sampled_from(NAMES),
    lambda inner: st.lists(inner, max_size=3)
    | st.dictionaries(st.sampled_from(KEYS), inner, max_size=3),
    max_leaves=6,
)
OPS = (
    *("edit", "type", "undo", "redo", "place", "tidy", "fix", "format", "stub", "resolve"),
    *("complete", "hover", "definition", "references", "ports", "explain", "nothing"),
)
OPERATIONS = st.fixed_dictionaries(
    {"do": st.sampled_from([*KINDS, "Nothing"])},
    optional=dict.fromkeys(
        ("kind", "name", "new", "names", "arrow", "source", "target", "text", "title", "value"),
        VALUES,
    ),
)
MESSAGES = st.fixed_dictionaries(
    {"op": st.sampled_from(OPS)},
    optional={
        "operation": OPERATIONS | VALUES,
        "operations": st.lists(OPERATIONS | VALUES, max_size=3) | VALUES,
        **dict.fromkeys(FACTS, VALUES),
    },
)


@settings(max_examples=40)
@example([{"op": "edit", "operation": {"do": []}}])
@given(st.lists(MESSAGES, min_size=1, max_size=5))
def test_no_message_is_met_with_more_than_a_sentence(messages: list[dict[str, object]]) -> None:
    async def sent(folder: Path) -> None:
        session = Session(app_in(folder, HOOKED))
        page = Page(session)
        for message in messages:
            await session.hear(page.client, json.dumps(message))
        assert await page.ask("undo", number=10_000) == {
            "id": 10_000,
            "version": session.files.history.version,
            "new": [],
        }
        for push in page.pushes:
            assert "P9001" not in str(push.get("error"))
            assert "Traceback" not in json.dumps(push)

    with TemporaryDirectory() as folder:
        asyncio.run(sent(Path(folder)))


NO_OBJECTS = (
    *("", "null", "[]", '"x"', "{", '{"op": NaN}', '{"op": 1e999}', '{"op": "undo"', "\x00"),
    *('{"id": 99999999999999999999999}', "[" * 100_000, '{"a":' * 100_000),
)


@pytest.mark.parametrize("text", NO_OBJECTS, ids=range(len(NO_OBJECTS)))
async def test_what_is_no_object_of_plain_data_is_refused(tmp_path: Path, text: str) -> None:
    with pytest.raises(Refused):
        parsed(text)
    page = Page(Session(app_in(tmp_path)))
    await page.session.hear(page.client, text)
    await page.next()
    assert (await page.next())["error"]


@pytest.mark.parametrize(
    "missions",
    [
        *(f"{name}.toml" for name in NAMES if name),
        "é" * 200 + ".toml",
        ".toml",
        "/",
        "..",
        3,
        [],
        {},
    ],
)
async def test_missions_that_are_no_file_beside_the_source_are_a_sentence(
    tmp_path: Path, missions: object
) -> None:
    answer = await Page(Session(app_in(tmp_path, HOOKED))).ask("run", missions=missions)
    assert len(answer["error"]) < 200
    assert "missions must be" in answer["error"] or "beside the source" in answer["error"]
