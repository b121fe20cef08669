"""Blocks of another package that end Python, or give what they do not declare: never in silence."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.compiler.cli.conftest import FIELD_APP, Call, declare

SIMPLE = "def chime(run, status):\n    {}\n"


@pytest.mark.parametrize("command", ["check", "compile", "run"])
@pytest.mark.parametrize(
    "code",
    [
        "import sys; sys.exit(0)",
        "import os; os._exit(0)",
        "raise GeneratorExit",
        "raise KeyboardInterrupt",
        "class Odd(BaseException): pass\nraise Odd('gone')",
        "def blocks():\n    raise SystemExit(0)\n    yield\nBLOCKS = blocks()",
    ],
)
def test_a_package_that_ends_python_as_it_is_imported_is_named(
    plutoc: Call, app: Path, here: Path, installed: Path, code: str, command: str
) -> None:
    """`sys.exit(0)` would pass for a compile that went well, and there would be no package."""
    (installed / "field_kit.py").write_text(code)
    app.write_text(FIELD_APP)
    said = plutoc(command, app)
    assert said.code == 1
    assert "the blocks of field_kit cannot be loaded from field_kit:BLOCKS" in said.err
    assert not (here / "crop").exists()


@pytest.mark.parametrize(
    "error",
    [
        "SystemExit(0)",
        "GeneratorExit()",
        "__import__('asyncio').CancelledError()",
        "__import__('os')._exit(0)",
    ],
)
def test_a_step_that_ends_python_is_its_blocks_fault(
    plutoc: Call, app: Path, installed: Path, error: str
) -> None:
    """The simulation does not end as if all were well, or by a traceback."""
    declare(installed, SIMPLE.format(f"raise {error}"))
    app.write_text(FIELD_APP)
    said = plutoc("run", app)
    assert said.code == 70
    assert "in block chime = field_kit.Chime" in said.err
    assert "Traceback" not in said.err


@pytest.mark.parametrize(
    ("gives", "what"),
    [
        ("Status.COMPLETED", "gave COMPLETED, and it declares UNEXECUTED"),
        ("Status.PAUSED", "gave PAUSED, and it declares UNEXECUTED"),
        ("'UNEXECUTED'", "gave a str, and it declares UNEXECUTED"),
        ("None", "gave a NoneType, and it declares UNEXECUTED"),
    ],
)
def test_a_step_that_gives_what_it_does_not_declare_fails_its_mission(
    plutoc: Call, app: Path, installed: Path, gives: str, what: str
) -> None:
    """All that was checked of the graph rests on the declaration: the mission goes no further."""
    step = f"from plutoc_runtime.domain.status import Status\n{SIMPLE.format(f'return {gives}')}"
    declare(installed, step)
    app.write_text(FIELD_APP)
    said = plutoc("run", app)
    assert said.code == 1
    assert f"North: FAILED: block chime {what}\n" in said.out


def test_a_step_is_asked_by_the_status_that_came(plutoc: Call, app: Path, installed: Path) -> None:
    """STANDBY and FAILED may both come and both be given; but not the one for the other."""
    step = """
from plutoc_runtime.domain.status import Status

async def chime(run, status):
    if status is Status.FAILED:
        return Status.STANDBY
    return status
"""
    declare(installed, step)
    app.write_text(
        FIELD_APP.replace("create -> chime -> allocate", "create -> allocate")
        .replace("watch -> allocate when STANDBY", "watch -> chime when STANDBY")
        .replace("watch -> retry when FAILED", "watch -> chime when FAILED")
        .replace(
            "retry -> allocate when STANDBY",
            "chime -> allocate when STANDBY\n  chime -> retry when FAILED\n"
            "  retry -> allocate when STANDBY",
        )
    )
    assert plutoc("compile", app).code == 0
    flow = Path("crop/src/crop/flow.py").read_text()
    assert "{STANDBY: (STANDBY,), FAILED: (FAILED,)}[status]" in "".join(flow.split("\n"))
