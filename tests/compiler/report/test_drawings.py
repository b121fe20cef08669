"""Pictures of graphs: complete, valid, and safe for every title."""

from __future__ import annotations

import json as standard
import re
from pathlib import Path

import pytest

from plutoc.check.run import check
from plutoc.report.pictures import NoGraphviz, dot, dot_to_svg, json, mermaid
from tests.compiler.check.graphs import BASIC, GATED, build

APP = f"""{GATED}
    first -> allocate when STANDBY
    first -> end when COMPLETED"""
HOSTILE = 'a "b" \\N %%{init: {}}%% </script> --- & #quot; `x` 🚁'


def test_mermaid_shows_every_block_and_every_status() -> None:
    """Boxes, gates, ends, thick branches, and a dotted arrow where missions end unsaid."""
    assert mermaid(check(build(APP, title="A field"))[0]) == ("""---
title: "A field"
---
flowchart TD
    Start(["start"])
    MissionCreator["create<br/>MissionCreator"]
    DroneAllocator["allocate<br/>DroneAllocator"]
    TripLauncher["launch<br/>TripLauncher"]
    TripMonitor["watch<br/>TripMonitor"]
    TimerMonitor["timer<br/>TimerMonitor"]
    GateFIFO{{"first<br/>GateFIFO"}}
    End(["end"])
    Start -->|"UNEXECUTED"| MissionCreator
    MissionCreator -->|"UNEXECUTED"| DroneAllocator
    DroneAllocator -->|"UNEXECUTED<br/>STANDBY"| TripLauncher
    TripLauncher ==>|"RUNNING"| TripMonitor
    TripLauncher ==>|"RUNNING"| TimerMonitor
    TripMonitor -->|"STANDBY<br/>COMPLETED<br/>FAILED"| GateFIFO
    TimerMonitor -->|"STANDBY<br/>COMPLETED<br/>FAILED"| GateFIFO
    GateFIFO -->|"STANDBY"| DroneAllocator
    GateFIFO -->|"COMPLETED"| End
    GateFIFO -.->|"FAILED"| End
""")


def test_a_further_block_of_a_kind_has_its_name_in_mermaid() -> None:
    """So a new block renames no other, and a renamed one is a line of difference."""
    lines = mermaid(check(build(APP.replace("timer = TimerMonitor", "timer = TripMonitor")))[0])
    assert '    TripMonitor["watch<br/>TripMonitor"]\n' in lines
    assert '    TripMonitor_timer["timer<br/>TripMonitor"]\n' in lines
    assert '    TripLauncher ==>|"RUNNING"| TripMonitor_timer\n' in lines


def test_a_title_cannot_leave_its_place_in_mermaid() -> None:
    """Nothing of it but letters, digits and a few signs stands in the text as it is."""
    title = mermaid(check(build(APP, title=HOSTILE))[0]).splitlines()[1]
    assert re.fullmatch(r"title: \"(?:[\w ,.'()-]|\\U[0-9a-f]{8})*\"", title)


def test_a_title_cannot_leave_its_place_in_graphviz() -> None:
    """Quotes and backslashes are escaped, entities are not read."""
    line = dot(check(build(APP, title=HOSTILE))[0]).splitlines()[1]
    assert 'a \\"b\\" \\\\N' in line
    assert "&amp; #quot;" in line


def test_graphviz_marks_branches_gates_and_unsaid_ends() -> None:
    """Bold, hexagon, dashed."""
    lines = [line.strip() for line in dot(check(build(APP))[0]).splitlines()]
    assert lines[0] == 'digraph "app" {'
    assert '"first" [shape=hexagon, label="first\\nGateFIFO"];' in lines
    assert '"launch" -> "watch" [label=" RUNNING ", style=bold];' in lines
    assert '"first" -> "end" [label=" FAILED ", style=dashed];' in lines
    assert '"allocate" -> "launch" [label=" UNEXECUTED \\n STANDBY ", style=solid];' in lines


def test_json_tells_blocks_lines_and_statuses() -> None:
    """A program gets what a person sees."""
    found = standard.loads(json(check(build(APP))[0]))
    assert found["app"] == "app"
    assert found["blocks"][0] == {
        "name": "create",
        "kind": "MissionCreator",
        "line": 2,
        "resumes_at": ["create"],
    }
    assert {
        "from": "launch",
        "to": "timer",
        "statuses": ["RUNNING"],
        "fork": True,
        "implicit": False,
    } in found["edges"]
    assert found["edges"][-1] == {
        "from": "first",
        "to": "end",
        "statuses": ["FAILED"],
        "fork": False,
        "implicit": True,
    }


def test_an_arrow_that_takes_nothing_is_dotted() -> None:
    """It is in the source, so it is in the picture."""
    text = f"""{BASIC}
    start -> create -> allocate -> launch -> watch
    watch -> allocate when STANDBY
    watch -> end
    create -> end otherwise"""
    assert "    MissionCreator -.-> End\n" in mermaid(check(build(text))[0])


def test_without_graphviz_the_message_says_what_to_install(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """An empty PATH has no `dot`."""
    monkeypatch.setenv("PATH", "")
    with pytest.raises(NoGraphviz, match="install Graphviz"):
        dot_to_svg("digraph {}")


@pytest.mark.long
def test_the_picture_is_what_graphviz_makes_of_the_text(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A program in its place shows how it is called, and what becomes of its failure."""
    program = tmp_path / "dot"
    program.write_text(
        '#!/bin/sh\nread -r line\n[ "$line" != bad ] || exit 1\necho "<svg $1 $line>"\n'
    )
    program.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    assert dot_to_svg("digraph {}") == "<svg -Tsvg digraph {}>\n"
    with pytest.raises(NoGraphviz, match="could not draw"):
        dot_to_svg("bad")
