"""Ten thousand blocks are an app like any other."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

from tests.kit.command import plutoc

BLOCKS = 10_000


def chain(blocks: int) -> str:
    """Return an app of so many blocks: most of them tell something, one behind the other."""
    tellers = [f"tell_{i}" for i in range(blocks - 5)]
    return "\n".join(
        [
            "pluto 1",
            "app long {",
            "  modifier tell",
            "  create = MissionCreator",
            *(f"  {name} = MissionModifier(hook: tell)" for name in tellers),
            "  allocate = DroneAllocator",
            "  launch = TripLauncher",
            "  watch = TripMonitor",
            "  retry = PriorityManager",
            f"  start -> create -> {' -> '.join(tellers)} -> allocate -> launch -> watch",
            "  watch -> allocate when STANDBY",
            "  watch -> retry when FAILED",
            "  retry -> allocate when STANDBY",
            "  [watch, retry] -> end otherwise",
            "}",
            "",
        ]
    )


@pytest.mark.long  # half a minute; tests/test_benchmarks.py has large apps
def test_ten_thousand_blocks_are_compiled(here: Path) -> None:
    """Without an error, and to Python that Python reads."""
    Path("long.pluto").write_text(chain(BLOCKS))
    done = plutoc("compile", "long.pluto")
    assert (done.code, done.err) == (0, "")
    flow = Path("long/src/long/flow.py").read_bytes()
    compile(flow, "flow.py", "exec", dont_inherit=True)
    calls = [node for node in ast.walk(ast.parse(flow)) if isinstance(node, ast.Await)]
    assert len(calls) >= BLOCKS - 5
