"""The pages and the floor plan: each at its one address, and nothing else."""

from __future__ import annotations

import gzip
import re
from pathlib import Path

import pytest

from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.map.pictures import floor_plan
from pluto_fleet.station.web.static import FOLDER, pages

from .asking import OURS, AStation, asked, without

NOWHERE = [
    "/pages/",
    "/pages",
    "/pages/../http.py",
    "/pages/..\\http.py",
    "/pages/./main.js",
    "/pages//main.js",
    "//pages/main.js",
    "/pages/main.js/",
    "/pages/main.js\x00",
    "/pages/\x00",
    "/pages//etc/passwd",
    "/pages/%2e%2e/http.py",
    "/pages/__init__.py",
    "/pages/MAIN.JS",
    "/../../../etc/passwd",
    "/etc/passwd",
    "pages/main.js",
    "",
    ".",
    "/map/",
    "/map/../pages/main.js",
    "/pages/" + "a" * 10_000,
]


@pytest.mark.parametrize("path", NOWHERE, ids=range(len(NOWHERE)))
def test_no_path_leads_out_of_the_table(path: str) -> None:
    reply = asked()("GET", path)
    assert reply.status == 404
    assert b"root" not in reply.body


KINDS = (".css", ".html", ".js", ".json", ".mjs", ".png", ".svg", ".webmanifest", ".woff2")


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
        *("index.html", "manifest.webmanifest", "map/draw.mjs", "map/icons/a-1.png"),
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
        "/pages/map/icons/a-1.png": "image/png",
    }


def test_a_page_takes_nothing_from_elsewhere() -> None:
    policy = dict(asked()("GET", "/").headers)["Content-Security-Policy"]
    rules = dict(rule.strip().split(" ", 1) for rule in policy.split(";"))
    assert rules.pop("img-src") == "'self' data: blob:"
    scripts = rules["script-src"].removeprefix("'self' ")  # the import map alone is in the page
    assert re.fullmatch(r"'sha256-[A-Za-z0-9+/]{43}='", scripts)
    found = {source for rule in rules.values() for source in rule.split()}
    assert found == {"'none'", "'self'", scripts}
    assert rules["manifest-src"] == "'self'"


def test_a_browser_that_has_a_page_is_not_sent_it_again() -> None:
    ask = asked()
    mark = dict(ask("GET", "/").headers)["ETag"]
    again = ask("GET", "/", b"", {**OURS, "if-none-match": f'"other", {mark}'})
    assert (again.status, again.body) == (304, b"")
    assert ask("GET", "/", b"", {**OURS, "if-none-match": '"other"'}).status == 200


def test_pages_travel_packed() -> None:
    ask = asked()
    reply = ask("GET", "/", b"", {**OURS, "accept-encoding": "br, gzip"})
    assert dict(reply.headers)["Content-Encoding"] == "gzip"
    assert gzip.decompress(reply.body) == ask("GET", "/").body


def test_the_floor_plan_is_a_picture_that_can_do_nothing(tmp_path: Path) -> None:
    (tmp_path / "ward.svg").write_text("<svg/>")
    ask = asked(AStation(image=floor_plan(tmp_path, "ward.svg")), token="sesame")
    reply = ask("GET", "/map", b"", without(authorization="Bearer sesame"))
    assert (reply.status, reply.type, reply.body) == (200, "image/svg+xml", b"<svg/>")
    policy = dict(reply.headers)["Content-Security-Policy"]
    assert policy.endswith("sandbox") and "script" not in policy
    assert ask("GET", "/map").status == 401
    assert asked()("GET", "/map").status == 404


def test_a_floor_plan_that_is_gone_is_not_there(tmp_path: Path) -> None:
    assert asked(AStation(image=tmp_path / "gone.png"))("GET", "/map").status == 404


@pytest.mark.parametrize(
    "name",
    [
        "",
        ".",
        "missions.toml",
        "ward.svg.exe",
        "ward.html",
        "gone.png",
        "folder.png",
        "../outside.png",
        "inside/../../outside.png",
        "link.png",
        "linked/outside.png",
        "/etc/passwd",
        "a\x00.png",
        "large.png",
    ],
)
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
