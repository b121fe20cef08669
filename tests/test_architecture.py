"""What keeps the house in order, beyond what the linters see."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import plutoc
import plutoc_runtime
from plutoc.block import Block
from plutoc.emit.embed import Carried, embed
from plutoc.registry import STD
from plutoc_blocks import BLOCKS

RUNTIME = Path(plutoc_runtime.__path__[0])
COMPILER = Path(plutoc.__path__[0])
MODULES = sorted(path.relative_to(RUNTIME) for path in RUNTIME.rglob("*.py"))


def dotted(module: Path) -> str:
    parts = ("plutoc_runtime", *module.with_suffix("").parts)
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def texts_of(path: Path) -> Iterator[tuple[int, str]]:
    """Yield the string literals of a module, with their lines."""
    for node in ast.walk(ast.parse(path.read_bytes())):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield node.lineno, node.value


def test_every_module_of_the_runtime_can_be_carried_along() -> None:
    """Each imports the standard library and, with dots, the runtime; all others are refused."""
    files = embed([], [dotted(module) for module in MODULES])
    carried = {path for path in files if path.endswith(".py")}
    assert {f"_runtime/{module.as_posix()}" for module in MODULES} == carried


def test_the_runtime_never_spells_its_own_name() -> None:
    """In a package it is called otherwise: a text with its name in it would be wrong there."""
    named = [
        (module.as_posix(), line)
        for module in MODULES
        for line, text in texts_of(RUNTIME / module)
        if "plutoc_runtime" in text
    ]
    assert named == []


def test_the_runtime_is_imported_without_running_anything() -> None:
    """Its `__init__.py` is a docstring."""
    assert len(ast.parse((RUNTIME / "__init__.py").read_bytes()).body) == 1


@pytest.mark.parametrize("block", BLOCKS, ids=lambda block: block.name)
def test_step_of_every_block_can_be_carried_along(block: Block) -> None:
    """And what becomes of it knows neither the compiler nor where it came from."""
    carried = Carried(package=STD, function=block.step)
    files = embed([carried], [])
    path = f"{carried.home.removeprefix('.').replace('.', '/')}.py"
    assert "plutoc" not in files[path]


@pytest.mark.process
def test_declarations_load_no_event_loop() -> None:
    """The compiler reads all blocks' declarations: asyncio would cost it 80 ms."""
    code = "import sys, plutoc_blocks; print(*sys.modules)"
    paths = [path for path in sys.path if path]
    program = f"import sys; sys.path[:0] = {paths!r}; {code}"
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    loaded = set(done.stdout.split())
    assert "plutoc_runtime.flow.transitions" in loaded or "plutoc_runtime.domain.status" in loaded
    assert not {"asyncio", "argparse", "black", "jinja2"} & loaded


def test_the_compiler_names_no_block() -> None:
    """It asks for properties: a block of another author's is as good as ours."""
    names = {block.name for block in BLOCKS}
    named = [
        (path.relative_to(COMPILER).as_posix(), line)
        for path in sorted(COMPILER.rglob("*.py"))
        for line, text in texts_of(path)
        if text in names
    ]
    assert named == []
