"""The pages and the floor plan: each at its one address, and nothing else."""

from __future__ import annotations

import gzip
import json
import re
from base64 import b64encode
from hashlib import sha256
from pathlib import Path

import pytest

from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.map.pictures import floor_plan, logo_of, title_of
from pluto_fleet.station.web.static import FOLDER, pages
from tests.library.station.map.test_drawn import SVG, ward

from .asking import OURS, AStation, asked, without

KINDS = (".css", ".html", ".js", ".json", ".mjs", ".svg", ".webmanifest")


def test_there_is_each_page_and_nothing_else() -> None:
    table = pages()
    assert set(table) - {"/", "/manifest.webmanifest"} == {
        f"/pages/{file.relative_to(FOLDER)}"
        for file in FOLDER.rglob("*")
        if file.suffix in KINDS and file.is_file()
    }
    ask = asked()
    for path, held in table.items():
        assert ask("GET", path).body == held.plain
    assert ask("GET", "/").body == (FOLDER / "index.html").read_bytes()


def test_what_lies_in_subfolders_is_served_and_the_manifest_at_the_top(tmp_path: Path) -> None:
    for name in (
        *("index.html", "manifest.webmanifest", "map/draw.mjs", "map/icons/a-1.svg"),
        *("wire.d.ts", "LICENSE.txt", ".hidden/a.js", "Map/a.js", "map/.a.js", "map/__init__.py"),
    ):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(name)
    table = pages(tmp_path)
    assert {address: held.type.partition(";")[0] for address, held in table.items()} == {
        "/": "text/html",
        "/pages/index.html": "text/html",
        "/manifest.webmanifest": "application/manifest+json",
        "/pages/manifest.webmanifest": "application/manifest+json",
        "/pages/map/draw.mjs": "text/javascript",
        "/pages/map/icons/a-1.svg": "image/svg+xml",
    }


def test_a_page_takes_nothing_from_elsewhere() -> None:
    """It runs no script of its own text but the import map, by the hash of what is served."""
    page = asked()("GET", "/")
    policy = page.header("content-security-policy")
    rules = dict(rule.strip().split(" ", 1) for rule in policy.split(";"))
    assert rules.pop("img-src") == "'self' data: blob:"
    (inline,) = re.findall(rb'<script type="importmap">(.*?)</script>', page.body, re.DOTALL)
    digest = b64encode(sha256(inline).digest()).decode()
    assert rules.pop("script-src") == f"'self' 'sha256-{digest}'"
    assert {source for rule in rules.values() for source in rule.split()} == {"'none'", "'self'"}
    assert rules["manifest-src"] == "'self'"


def test_a_browser_that_has_a_page_is_not_sent_it_again() -> None:
    ask = asked()
    mark = ask("GET", "/").header("etag")
    again = ask("GET", "/", b"", {**OURS, "if-none-match": f'"other", {mark}'})
    assert (again.status, again.body) == (304, b"")
    assert ask("GET", "/", b"", {**OURS, "if-none-match": '"other"'}).status == 200


def test_pages_travel_packed() -> None:
    ask = asked()
    reply = ask("GET", "/", b"", {**OURS, "accept-encoding": "br, gzip"})
    assert reply.header("content-encoding") == "gzip"
    assert gzip.decompress(reply.body) == ask("GET", "/").body


def test_the_floor_plan_is_a_picture_that_can_do_nothing(tmp_path: Path) -> None:
    station, knows = AStation(), without(authorization="Bearer sesame")
    station.map = ward(tmp_path)
    ask = asked(station, token="sesame")
    reply = ask("GET", "/map", b"", knows)
    assert (reply.status, reply.type, reply.body) == (200, "image/svg+xml", SVG)
    policy = reply.header("content-security-policy")
    assert policy.endswith("sandbox") and "script" not in policy
    assert ask("GET", "/map").status == 401
    (tmp_path / "ward.svg").unlink()
    assert asked(station, token="sesame")("GET", "/map", b"", knows).status == 404


def test_a_logo_can_do_nothing_and_is_seen_before_anyone_has_said_a_token(tmp_path: Path) -> None:
    """It may be an SVG with a script, which no browser runs."""
    (tmp_path / "logo").write_text(SVG.decode().replace("/>", "><script>alert(1)</script></svg>"))
    logo = logo_of(tmp_path / "logo")
    ask = asked(logo=logo, token="sesame")
    reply = ask("GET", "/logo", b"", without("origin"))
    assert (reply.status, reply.type, reply.body) == (200, "image/svg+xml", logo.content)
    policy = reply.header("content-security-policy")
    assert policy.endswith("sandbox") and "script" not in policy
    assert asked()("GET", "/logo").status == 404


@pytest.mark.parametrize(
    ("content", "why"),
    [
        (None, "cannot be read"),
        (b"GIF89a", "no picture that can be shown"),
        (b"<svg", "no valid SVG"),
        (b"<p/>", "no SVG"),
        (b"\x89PNG\r\n\x1a\n" + bytes(200_000), "at most 200 kB"),
    ],
)
def test_what_is_no_logo_is_refused(tmp_path: Path, content: bytes | None, why: str) -> None:
    if content is not None:
        (tmp_path / "logo.png").write_bytes(content)
    with pytest.raises(BadInput, match=f"--logo .*logo.png.*{why}"):
        logo_of(tmp_path / "logo.png")


def test_a_title_is_one_line() -> None:
    assert title_of(" Ward 3 ") == "Ward 3"
    for text in ("", " ", "a" * 61, "Ward\n3", "Ward\x1b3"):
        with pytest.raises(BadInput, match="--title"):
            title_of(text)


def test_a_station_can_be_installed_as_a_program() -> None:
    """What its manifest names is there, and as large as anybody asks for."""
    ask = asked()
    manifest = json.loads(ask("GET", "/manifest.webmanifest").body)
    assert (manifest["start_url"], manifest["display"]) == ("/", "standalone")
    for icon in manifest["icons"]:
        assert ask("GET", icon["src"]).type == icon["type"] == "image/svg+xml"
        assert icon["sizes"] == "any"


NO_PICTURES = ["missions.toml", "ward.html", "gone.png", "folder.png", "link.png", "large.png"]
NO_PICTURES += ["../outside.png", "inside/../../outside.png", "linked/outside.png"]


@pytest.mark.parametrize("name", ["", "a\x00.png", *NO_PICTURES])
def test_a_fleet_file_names_no_file_but_a_picture_beside_it(tmp_path: Path, name: str) -> None:
    folder = tmp_path / "fleet"
    (folder / "folder.png").mkdir(parents=True)
    (folder / "inside").mkdir()
    for file in ("outside.png", "fleet/missions.toml", "fleet/ward.html"):
        (tmp_path / file).write_text("secret")
    (folder / "link.png").symlink_to(tmp_path / "outside.png")
    (folder / "linked").symlink_to(tmp_path)
    with (folder / "large.png").open("wb") as large:
        large.truncate(21 * 1024 * 1024)
    with pytest.raises(BadInput, match=r"map\.image"):
        floor_plan(folder, name)
    with pytest.raises(BadInput, match=r"map\.image"):
        floor_plan(folder, str(tmp_path / "outside.png"))


def test_a_picture_may_lie_deeper_or_be_linked_to_beside_it(tmp_path: Path) -> None:
    (tmp_path / "maps").mkdir()
    (tmp_path / "maps" / "ward.PNG").write_bytes(b"")
    (tmp_path / "now.png").symlink_to("maps/ward.PNG")
    for name in ("maps/ward.PNG", "now.png"):
        assert floor_plan(tmp_path, name).read_bytes() == b""
