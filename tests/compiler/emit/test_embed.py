"""What a package carries along: no module more than it needs, no byte different."""

from __future__ import annotations

import sys
from collections.abc import Callable
from importlib import import_module
from itertools import count
from pathlib import Path
from typing import Any

import pytest

import pluto_fleet
import plutoc_runtime
from plutoc.emit.embed import Carried, carried_library, embed
from plutoc.emit.modules import EmbedError
from plutoc.registry import STD
from plutoc_blocks.clock.step import wait_for_time
from plutoc_runtime.fleet.policies import nearest

RUNTIME = Path(plutoc_runtime.__path__[0])
NUMBERS = count()

Make = Callable[..., tuple[str, Callable[..., Any]]]


@pytest.fixture
def make(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Make:
    """Return a function that makes another package of blocks, and loads its `scan/step.py`."""
    monkeypatch.syspath_prepend(tmp_path)

    def made(step: str, **others: str) -> tuple[str, Callable[..., Any]]:
        name = f"others_{next(NUMBERS)}"
        (tmp_path / name / "scan").mkdir(parents=True)
        files = {"__init__": "", "scan/__init__": "", "scan/step": step}
        for path, text in {**files, **others}.items():
            (tmp_path / name / f"{path}.py").write_text(text.replace("OWN", name))
        function = import_module(f"{name}.scan.step").scan
        assert callable(function)
        return name, function

    return made


def carried(function: Callable[..., Any], package: str = STD) -> Carried:
    return Carried(package=package, function=function)


def test_modules_of_the_runtime_are_copied_byte_for_byte() -> None:
    """What is embedded is what is installed."""
    for path, text in embed([carried(wait_for_time)], ["plutoc_runtime.command"]).items():
        if not path.startswith("_runtime/blocks/"):
            assert (RUNTIME / path.removeprefix("_runtime/")).read_bytes() == text.encode()


def test_only_what_is_needed_is_carried() -> None:
    """A block that is not used, and a policy that was not chosen, stay behind."""
    files = embed([carried(wait_for_time), carried(nearest)], ["plutoc_runtime.command"])
    blocks = [path for path in files if path.startswith("_runtime/blocks/")]
    assert blocks == ["_runtime/blocks/__init__.py", "_runtime/blocks/clock.py"]
    assert "_runtime/fleet/policies.py" in files
    assert not {"_runtime/fleet/batch_optimal.py", "_runtime/fleet/own_policy.py"} & files.keys()


def test_the_library_can_be_carried_whole() -> None:
    """Each file of it is a text, the station's pages too: a package holds nothing else."""
    pages = Path(pluto_fleet.__path__[0], "station/pages")
    carried = carried_library()
    for path in (path for path in pages.rglob("*") if path.is_file()):
        name = path.relative_to(pages).as_posix()
        assert carried[f"_fleet/pluto_fleet/station/pages/{name}"] == path.read_text("utf-8")


def test_imports_inside_functions_count() -> None:
    """The command line loads its commands when they are asked for: they are carried all the same."""
    assert "_runtime/alone/simulate.py" in embed([], ["plutoc_runtime.command"])


def test_only_the_imports_of_a_block_change() -> None:
    """The prefix becomes dots; all other lines are as they were."""
    path = "_runtime/blocks/clock.py"
    old = Path(sys.modules[wait_for_time.__module__].__file__ or "").read_text()
    new = embed([carried(wait_for_time)], [])[path]
    assert new == old.replace("from plutoc_runtime.", "from ..")
    assert new != old


def test_modules_beside_a_step_come_along(make: Make) -> None:
    """However it imports them, a step keeps the modules of its own package."""
    package, scan = make(
        "from math import pi\n\n"
        "from plutoc_runtime.domain import text\n"
        "from plutoc_runtime.domain.status import (\n    Status,\n)\n\n"
        "from .grid import cells\n"
        "from ..shared import é; from OWN.deep import depth  # from plutoc_runtime.x\n\n\n"
        "def scan(run, status):\n"
        "    from plutoc_runtime.domain.text import counted\n\n"
        "    return Status, cells, é, depth, pi, text, counted\n",
        **{
            "scan/grid": "cells = 3\n",
            "shared": "from OWN.deep import depth\n\né = depth\n",
            "deep": "depth = 1\n",
        },
    )
    files = embed([carried(scan, "survey")], [])
    folder = "_runtime/blocks/survey"
    assert [path for path in files if path.startswith(folder)] == [
        f"{folder}/__init__.py",
        f"{folder}/deep.py",
        f"{folder}/scan.py",
        f"{folder}/scan_grid.py",
        f"{folder}/shared.py",
    ]
    assert files[f"{folder}/scan.py"] == (
        "from math import pi\n\n"
        "from ...domain import text\n"
        "from ...domain.status import (\n    Status,\n)\n\n"
        "from .scan_grid import cells\n"
        "from .shared import é; from .deep import depth  # from plutoc_runtime.x\n\n\n"
        "def scan(run, status):\n"
        "    from ...domain.text import counted\n\n"
        "    return Status, cells, é, depth, pi, text, counted\n"
    )
    assert files[f"{folder}/shared.py"] == "from .deep import depth\n\né = depth\n"
    assert {"_runtime/domain/text.py", "_runtime/domain/status.py"} <= files.keys()
    assert package not in "".join(files.values())


SCAN = "\n\ndef scan(run, status): ...\n"


@pytest.mark.parametrize(
    ("line", "problem"),
    [
        ("import pytest", "pytest is not of the standard library"),
        ("from pytest import fixture", "pytest is neither of the standard library"),
        (
            "import plutoc_runtime.domain.text",
            "write `from plutoc_runtime.domain.text import …` instead",
        ),
        ("from plutoc.block import Block", "plutoc.block is neither of the standard library"),
        ("from . import grid", "is not a module with a file of its own"),
        ("from plutoc_runtime . domain . text import counted", "on one line"),
        ("from \\\n plutoc_runtime.domain.text import counted", "on one line"),
    ],
)
def test_what_cannot_be_carried_is_refused_with_its_place(
    make: Make, line: str, problem: str
) -> None:
    """The error names the file and the line."""
    package, scan = make(f"import math\n{line}{SCAN}", **{"scan/grid": ""})
    with pytest.raises(EmbedError) as refused:
        embed([carried(scan, "survey")], [])
    assert f"{package}/scan/step.py:2: " in str(refused.value)
    assert problem in str(refused.value)


def test_two_modules_cannot_become_one_file(make: Make) -> None:
    """Names are flattened; where that makes two the same, nothing is lost silently."""
    _, scan = make(
        "from .grid import a\nfrom ..scan_grid import b" + SCAN,
        **{"scan/grid": "a = 1\n", "scan_grid": "b = 2\n"},
    )
    with pytest.raises(EmbedError, match=r"would both become .*scan_grid\.py"):
        embed([carried(scan, "survey")], [])


def test_a_step_must_be_a_function_that_can_be_imported(make: Make) -> None:
    """A function made inside another has no name to import it by."""
    _, scan = make("def maker():\n    def inner(): ...\n    return inner\n\n\nscan = maker()\n")
    with pytest.raises(EmbedError, match="at the top of its module"):
        embed([carried(scan, "survey")], [])
