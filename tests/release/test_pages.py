"""The station's pages as they are installed: light, whole, and without a word of another machine."""

from __future__ import annotations

import gzip
import platform
import re
import shutil
import subprocess
from pathlib import Path
from zipfile import ZipFile

import pytest

from pluto_fleet.station.web.static import FOLDER, StaticFile, pages

MOST = 150_000
"""Bytes of all pages, each gzipped by itself, as browsers of one language get them."""

LANGUAGES = sorted(path.stem for path in (FOLDER / "texts").glob("*.js"))


@pytest.fixture(scope="module")
def installed(library: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the pages that lie in the wheel."""
    folder = tmp_path_factory.mktemp("unpacked")
    with ZipFile(library) as wheel:
        assert len(wheel.namelist()) == len(set(wheel.namelist()))
        wheel.extractall(folder)
    return folder / FOLDER.relative_to(FOLDER.parents[2])


@pytest.fixture(scope="module")
def served(installed: Path) -> dict[str, StaticFile]:
    """What is served of them, by its address."""
    return dict(pages(installed))


def test_a_wheel_has_every_page_of_the_checkout(served: dict[str, StaticFile]) -> None:
    """Scripts and styles are minified in it; what is vendored, and the import map, are as they were."""
    sources = pages()
    assert set(served) == set(sources)
    scripts = [one for one in sources if one.endswith((".js", ".css"))]
    assert not [one for one in scripts if len(served[one].plain) > len(sources[one].plain)]
    alike = [one for one in sources if one not in scripts]
    assert [one for one in alike if served[one].plain != sources[one].plain] == []


@pytest.mark.skipif(
    platform.machine() != "x86_64", reason="wheels that are released are built there"
)
@pytest.mark.parametrize("language", LANGUAGES)
def test_pages_weigh_less_than_150_kilobytes(served: dict[str, StaticFile], language: str) -> None:
    """Icons are asked for by a system that installs the station, and texts by who reads them."""
    always = re.findall(rb'from"\.\./texts/(\w+)\.js"', served["/pages/core/i18n.js"].plain)
    read = {language, *(one.decode() for one in always)}
    others = {f"/pages/texts/{one}.js" for one in LANGUAGES if one not in read}
    files = {one.mark: name for name, one in served.items()}  # one may have two addresses
    weights = {
        name: len(gzip.compress(served[name].plain, mtime=0))
        for name in files.values()
        if name not in others and not name.endswith(".png")
    }
    assert sum(weights.values()) < MOST, sorted(weights.items(), key=lambda one: -one[1])[:20]


def test_no_page_names_another_machine(served: dict[str, StaticFile]) -> None:
    """Neither a script, nor a style, nor a picture; a namespace is a name and no address."""
    for name, held in served.items():
        if not name.endswith(".png"):
            named = set(re.findall(rb"(?:https?:)?//[a-z0-9.-]+\.[a-z]+", held.plain))
            assert named <= {b"http://www.w3.org"}, name


def test_minified_modules_are_scripts(installed: Path, tmp_path: Path) -> None:
    """Every one is compiled, none is run."""
    node = shutil.which("node")
    if node is None:
        pytest.skip("node is not on the path")
    (tmp_path / "parse.mjs").write_text(PARSE)
    words = [node, "--experimental-vm-modules", "--no-warnings", str(tmp_path / "parse.mjs")]
    scripts = [str(path) for path in installed.rglob("*") if path.suffix in (".js", ".mjs")]
    done = subprocess.run([*words, *scripts], check=False, capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (0, f"{len(scripts)}\n"), done.stderr


PARSE = """
import { readFileSync } from "node:fs";
import { SourceTextModule } from "node:vm";
const files = process.argv.slice(2);
for (const identifier of files) new SourceTextModule(readFileSync(identifier, "utf8"), { identifier });
console.log(files.length);
"""
"""In one process: node takes longer to start than to parse."""
