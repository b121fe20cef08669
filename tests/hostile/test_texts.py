"""What a user writes between quotes stays a text: in Python, TOML, Markdown and pictures."""

from __future__ import annotations

import ast
import tomllib
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from plutoc.compile import analyse, package_of
from plutoc.emit.package import Package
from plutoc.source import Source
from plutoc.syntax.characters import HIDDEN
from tests.fuzz.texts import HOSTILE, legal

APP = Path(__file__).with_name("app.pluto").read_text(encoding="utf-8")
"""`TEXT` stands in all of its strings."""


def package(text: str, source_name: str = "crop.pluto") -> Package:
    """Return the package of a source with a text in all of its strings."""
    source = Source("crop.pluto", APP.replace("TEXT", legal(text)))
    return package_of(analyse(source)[0], source_name=source_name)


PLAIN = "plain"
ALWAYS = sorted({text for text in HOSTILE if not HIDDEN.search(text)})


@cache
def of_plain() -> Package:
    """The package that all others are held against."""
    return package(PLAIN)


def shape(data: bytes) -> list[str]:
    """Return the syntax tree of a file as Python reads it, the values of its texts left out."""
    nodes = []
    for node in ast.walk(ast.parse(data)):
        facts = [type(node).__name__]
        for _, value in ast.iter_fields(node):
            if isinstance(value, str) and not isinstance(node, ast.Constant):
                facts.append(value)
        nodes.append(" ".join(facts))
    return nodes


def keys(value: object) -> Iterator[str]:
    """Yield the paths of all keys in what a TOML or JSON file holds."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield key
            yield from (f"{key}.{path}" for path in keys(inner))
    elif isinstance(value, list):
        for inner in value:
            yield from (f"[].{path}" for path in keys(inner))


def assert_same_shape(package: Package) -> None:
    """Nothing but the values of texts differs from the plain package."""
    for texts, plain in (
        (package.owned, of_plain().owned),
        (package.once, of_plain().once),
    ):
        assert texts.keys() == plain.keys()
        for path, text in texts.items():
            if text == plain[path]:
                continue
            if path.endswith(".py"):
                assert shape(text.encode()) == shape(plain[path].encode()), path
                assert {c for c in text if not c.isascii()} <= set(plain[path]), path
            elif path.endswith((".toml", ".lock")):
                assert list(keys(tomllib.loads(text))) == list(keys(tomllib.loads(plain[path])))
                assert text.isascii(), path
            else:
                assert path in ("README.md", ".gitattributes")


def test_hostile_texts_leave_the_shape_of_every_file() -> None:
    """All of them at once, and each at the end of a text."""
    assert_same_shape(package("".join(ALWAYS)))
    assert_same_shape(package(" ".join(reversed(ALWAYS))))


@pytest.mark.parametrize(
    "name",
    [
        "coding: utf-7.pluto",
        "a\nimport os.pluto",
        '""".pluto',
        "-->.pluto",
        "{{ 1 }}.pluto",
        "\N{RIGHT-TO-LEFT OVERRIDE}a.pluto",
        "$(x).pluto",
    ],
)
def test_a_name_of_a_file_gets_into_no_file(name: str) -> None:
    """Only a plain one stands in the first lines."""
    odd = package(PLAIN, name)
    assert_same_shape(odd)
    for path, text in odd.owned.items():
        stem = name.removesuffix(".pluto")
        assert text.count(stem) == of_plain().owned[path].count(stem), path


def test_texts_say_what_was_written() -> None:
    """Python reads back the very characters; so does TOML, in one line."""
    text = "".join(ALWAYS)
    made = package(text)
    constants = [
        node.value
        for node in ast.walk(ast.parse(made.owned["src/crop/flow.py"].encode()))
        if isinstance(node, ast.Constant)
    ]
    assert constants.count(text) >= 4
    description = tomllib.loads(made.owned["pyproject.toml"])["project"]["description"]
    assert description == " ".join(text.split())
