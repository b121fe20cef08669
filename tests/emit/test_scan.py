"""What a module imports is found without its syntax tree, and is what the tree says."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

from plutoc.emit.scan import written_imports

ROOT = Path(__file__).parents[2]
MODULES = sorted(ROOT.glob("runtime/**/*.py")) + sorted(ROOT.glob("stdlib_blocks/**/*.py"))

Found = list[tuple[int, str, tuple[str, ...]]]


def scanned(text: str) -> Found | None:
    found = written_imports(text)
    return None if found is None else sorted((one.start, one.target, one.names) for one in found)


def parsed(text: str) -> Found:
    starts = [0]
    for line in text.split("\n"):
        starts.append(starts[-1] + len(line) + 1)
    found: Found = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import | ast.ImportFrom):
            names = tuple(alias.name for alias in node.names)
            start = starts[node.lineno - 1] + node.col_offset
            if isinstance(node, ast.ImportFrom):
                found.append((start, "." * node.level + (node.module or ""), names))
            else:
                found += [(start, name, ()) for name in names]
    return sorted(found)


@pytest.mark.parametrize("path", MODULES, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_the_imports_of_our_own_modules_are_plain(path: Path) -> None:
    """None of them needs its tree."""
    text = path.read_text(encoding="utf-8")
    assert scanned(text) == parsed(text)


@pytest.mark.parametrize(
    "text",
    [
        'x = """\nfrom a import b\n"""\nfrom c import d\n',
        "x = '''\nimport a\n\\'''\nimport b'''\nimport c\n",
        'x = "\\"\\\nimport a"\nimport b\n',
        "# it's\nfrom . import a\n# it's\n",
        "x = '#'\nfrom .. import a as b, c  # from d import e\n",
        'if x:\n    from a import (\n        b,  # the first\n        c as d,\n    )\nx = "# \'"\n',
        "try:\n    raise A\nexcept B as e:\n    raise C from e\n",
        "def f():\n    yield from (\n        importer\n    )\n    from_import = 1\n",
        "x = b'\\\\'\nimport a as b\n",
        "from.a import b\n",
    ],
)
def test_texts_and_comments_are_no_imports(text: str) -> None:
    """Nor do they hide any."""
    assert scanned(text) == parsed(text) or written_imports(text) is None


@pytest.mark.parametrize(
    "text",
    [
        "import a, b\n",
        "from a import *\n",
        "from a import b; import c\n",
        "from a import b, \\\n c\n",
        "if x: import a\n",
        "from a \\\n import b\n",
    ],
)
def test_what_is_not_plain_is_left_to_the_tree(text: str) -> None:
    """Nothing is guessed."""
    assert written_imports(text) is None
