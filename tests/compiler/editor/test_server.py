"""The real web server: what strangers get, what its own page gets, and what a kill leaves."""

from __future__ import annotations

import asyncio
import json
import re
import signal
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect
from websockets.typing import Origin

from plutoc.editor import static
from plutoc_runtime.connections import CONNECTIONS
from tests.kit.command import Process, plutoc
from tests.kit.station import until

from .editing import APP, app_in, files_of
from .serving import heard, served

PAGE = '<!doctype html><script src="/static/a/main.js"></script>'


@pytest.fixture(autouse=True)
def page(tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> None:
    """A page of two files, and one beside that is none of it."""
    folder = tmp_path_factory.mktemp("web") / "pages"
    (folder / "a").mkdir(parents=True)
    (folder / "index.html").write_text(PAGE)
    (folder / "a" / "main.js").write_text("1")
    (folder / "a" / "LICENSE").write_text("no page")
    (folder.parent / "secret.js").write_text("secret")
    found = static.pages(folder)
    monkeypatch.setattr("plutoc.editor.server.pages", lambda: found)


async def test_the_address_with_its_token_leads_to_the_page(tmp_path: Path) -> None:
    """The token goes into a cookie that no script and no other site can use."""
    async with served(app_in(tmp_path)) as editor:
        status, headers, _ = await editor.get(f"/?token={editor.guard.token}")
        assert (status, headers["location"]) == (303, "/")
        cookie = headers["set-cookie"]
        assert cookie.startswith(f"{editor.guard.cookie}={editor.guard.token};")
        assert {"HttpOnly", "SameSite=strict", "Path=/"} <= set(cookie.split("; "))
        status, headers, body = await editor.get("/")
        assert status == 200
        assert body.decode() == PAGE
        assert "script-src 'self'" in headers["content-security-policy"]
        assert headers["cache-control"] == "no-store"
        async with editor.connect() as socket:
            assert (await heard(socket, push="hello"))["text"] == APP


async def test_files_are_of_a_fixed_table(tmp_path: Path) -> None:
    async with served(app_in(tmp_path)) as editor:
        status, headers, body = await editor.get("/static/a/main.js")
        assert (status, body, headers["content-type"]) == (
            200,
            b"1",
            "text/javascript; charset=utf-8",
        )
        assert (await editor.get("/static/a/main.js", if_none_match=headers["etag"]))[0] == 304
        for path in (
            "/static/../secret.js",
            "/static/%2e%2e/secret.js",
            "/static/a/../../secret.js",
            "/static/a/LICENSE",
            "/static//etc/passwd",
            "/static/index.html",
            "/farm.pluto",
            "/ws",
            "/nothing",
        ):
            status, _, body = await editor.get(path)
            assert status == 404, path
            assert b"secret" not in body
        for method in ("POST", "PUT", "DELETE", "OPTIONS", "HEAD"):
            assert (await editor.get("/static/a/main.js", method))[0] in (200, 404)


async def test_strangers_get_nothing(tmp_path: Path) -> None:
    async with served(app_in(tmp_path)) as editor:
        for host in ("evil.example", f"evil.example:{editor.guard.port}", "127.0.0.1:1", ""):
            for path in ("/", f"/?token={editor.guard.token}", "/static/a/main.js"):
                status, headers, _ = await editor.get(path, Host=host)
                assert status == 403
                assert "set-cookie" not in headers
        assert (await editor.get("/?token=wrong"))[0] == 401
        assert "set-cookie" not in (await editor.get("/?token=wrong"))[1]
        sent = f"GET / HTTP/1.1\r\nHost: {editor.host}\r\nHost: evil.example\r\n\r\n"
        assert (await editor.say(sent.encode()))[:12] in (b"HTTP/1.1 400", b"HTTP/1.1 403")


@pytest.mark.parametrize(
    "attack",
    [{"origin": Origin("http://evil.example")}, {"headers": {"Host": "evil.example"}}],
)
async def test_a_page_of_another_site_is_not_talked_to(
    tmp_path: Path, attack: dict[str, Any]
) -> None:
    """Not even with the cookie, which its browser would send."""
    async with served(app_in(tmp_path)) as editor:
        with pytest.raises(InvalidStatus) as refused:
            async with editor.connect(**attack):
                pass
        assert refused.value.response.status_code in (400, 403)  # 400: two names at once


@pytest.mark.parametrize("token", ["", "wrong", "é"])
async def test_who_has_no_token_is_hung_up_on(tmp_path: Path, token: str) -> None:
    async with served(app_in(tmp_path)) as editor:
        async with editor.connect(token) as socket:
            with pytest.raises(ConnectionClosed) as closed:
                await socket.recv()
        assert closed.value.rcvd is not None
        assert closed.value.rcvd.code == 4401
        async with editor.connect(
            "", headers={"Authorization": f"Bearer {editor.guard.token}"}
        ) as socket:
            await heard(socket, push="hello")  # a program without cookies


async def test_too_much_is_too_much(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("plutoc.editor.server.MOST_CLIENTS", 1)
    async with served(app_in(tmp_path)) as editor:
        async with editor.connect() as socket:
            await heard(socket, push="hello")
            async with editor.connect() as other:
                with pytest.raises(ConnectionClosed) as closed:
                    await other.recv()
                assert closed.value.rcvd is not None
                assert closed.value.rcvd.code == 4429
            with pytest.raises(ConnectionClosed):
                await socket.send("x" * (9 * 1024 * 1024))
                await heard(socket, id=0)
        async with editor.connect() as again:  # and its place is free again
            await heard(again, push="hello")
        head = f"GET / HTTP/1.1\r\nHost: {editor.host}\r\nX: {'x' * 4_000_000}\r\n\r\n"
        assert not (await editor.say(head.encode())).startswith(b"HTTP/1.1 200")


@pytest.mark.long  # real processes fly
@pytest.mark.process
async def test_a_slow_question_keeps_no_one_waiting(tmp_path: Path) -> None:
    async with served(app_in(tmp_path)) as editor, editor.connect() as socket:
        await heard(socket, push="hello")
        await socket.send(json.dumps({"id": "run", "op": "run", "missions": None}))
        await socket.send(
            json.dumps(
                {
                    "id": "typed",
                    "op": "type",
                    "version": 0,
                    "changes": [{"from": 0, "to": 0, "insert": "#\n"}],
                }
            )
        )
        assert "version" in await heard(socket, id="typed")
        answer = await heard(socket, id="run")
        assert answer["exit"] == 0, answer
        await socket.send(json.dumps({"id": "first", "op": "run", "missions": None}))
        await socket.send(json.dumps({"id": "second", "op": "run", "missions": None}))
        assert "another" in (await heard(socket, id="first"))["error"]
        assert (await heard(socket, id="second"))["exit"] == 0


FIRST = "# kept\n"


def typed_there(line: str, until: Callable[[dict[str, Any]], bool]) -> None:
    """Type by the address that a process has printed, and wait for what it says of that."""
    found = re.search(r"http://(\S+)/\?token=(\S+)", line)
    assert found is not None, line
    headers = {"Authorization": f"Bearer {found[2]}"}
    change = {"from": 0, "to": 0, "insert": FIRST}
    with connect(
        f"ws://{found[1]}/ws", additional_headers=headers, max_size=None, proxy=None
    ) as socket:
        socket.send(json.dumps({"id": 1, "op": "type", "version": 0, "changes": [change]}))
        while not until(json.loads(socket.recv(60))):
            pass


def edited(folder: Path) -> Process:
    """Start the command as a person does."""
    return Process("-m", "plutoc", "edit", "farm.pluto", "--no-open", cwd=folder)


@pytest.mark.process
def test_ctrl_c_saves_what_was_typed_just_now(tmp_path: Path) -> None:
    app_in(tmp_path)
    with edited(tmp_path) as process:
        typed_there(process.until("edit it at"), lambda told: told.get("id") == 1)
        assert process.ended(signal.SIGINT)[0] == 0
    assert files_of(tmp_path) == {"farm.pluto": f"{FIRST}{APP}".encode()}


@pytest.mark.long  # real processes
@pytest.mark.process
def test_what_cannot_be_saved_is_not_given_up_at_the_first_ctrl_c(tmp_path: Path) -> None:
    """Once it can be, it is; what a signal to end loses is said."""
    path = app_in(tmp_path)
    path.chmod(0o444)
    with edited(tmp_path) as process:
        typed_there(process.until("edit it at"), lambda told: told.get("push") == "cannot_save")
        process.send(signal.SIGINT)
        assert "read-only" in process.until("not ended")
        path.chmod(0o644)
        until(lambda: FIRST in path.read_text(), "it is saved")
        assert process.ended(signal.SIGINT)[0] == 0
    path.chmod(0o444)
    with edited(tmp_path) as process:
        typed_there(process.until("edit it at"), lambda told: told.get("push") == "cannot_save")
        code, said = process.ended(signal.SIGTERM)
    assert code == 143
    assert "not saved: farm.pluto is read-only" in said


async def test_connections_without_the_token_shut_nobody_out(tmp_path: Path) -> None:
    """Idle ones make room, and those who guess; the page's own connection stays."""
    async with served(app_in(tmp_path)) as editor, editor.connect() as socket:
        await heard(socket, push="hello")
        head = f"GET / HTTP/1.1\r\nHost: {editor.host}\r\nCookie: {editor.guard.cookie}="
        own = await asyncio.open_connection("127.0.0.1", editor.guard.port)
        strangers = []
        for number in range(CONNECTIONS + 20):
            strangers.append(await asyncio.open_connection("127.0.0.1", editor.guard.port))
            strangers[-1][1].write(f"{head}x\r\n\r\n".encode() * (number % 2))
            if not number:
                own[1].write(f"{head}{editor.guard.token}\r\n\r\n".encode())
                assert b"200 OK" in await own[0].readline()
        assert (await editor.get("/"))[0] == 200
        async with editor.connect() as another:
            await heard(another, push="hello")
        await socket.send('{"id": 7, "op": "tidy"}')
        await heard(socket, id=7)
        own[1].write(f"{head}{editor.guard.token}\r\n\r\n".encode())
        while b"200 OK" not in (line := await own[0].readline()):
            assert line, "the connection with the token was closed"
        for _, writer in (*strangers, own):
            writer.close()


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (("missions.toml",), "is no app"),
        (("none/farm.pluto",), "there is no folder none"),
        (("farm.pluto", "--port", "99999"), "a port is a number"),
        (("farm.pluto", "--host", "no such host"), "there is no such address"),
    ],
)
def test_what_cannot_be_served_is_said(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, words: tuple[str, ...], why: str
) -> None:
    app_in(tmp_path)
    monkeypatch.chdir(tmp_path)
    done = plutoc("edit", *words, "--no-open")
    assert done.code == 2
    assert why in done.err


def test_without_its_extra_it_says_how_to_install_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("plutoc.cli.edit.find_spec", lambda name: None)
    done = plutoc("edit", app_in(tmp_path))
    assert done.code == 2
    assert 'pip install "plutoc[editor]"' in done.err
