"""`version` and `requires` in the generated pyproject.toml."""

from __future__ import annotations

import tomllib
from typing import Any

from packaging.requirements import Requirement

from plutoc.emit.project_files import project_file
from plutoc.graph.model import Graph
from tests.compiler.emit.apps import PLAIN
from tests.compiler.emit.plans import plan_of
from tests.paths import ROOT


def graph_with(settings: str) -> Graph:
    """Return the plain app's graph with settings of its package."""
    text = PLAIN.replace("{\n", f"{{\n{settings}\n", 1)
    assert text != PLAIN
    return plan_of(text).checked.graph


def written(graph: Graph) -> dict[str, Any]:
    """Return what its pyproject.toml holds."""
    return tomllib.loads(project_file(graph, "app.pluto", carry=False))


def test_they_stand_where_installers_read_them() -> None:
    """A list of a line each: another library is one line in a pull request."""
    graph = graph_with('version "1.2.0-beta"\nrequires "numpy>=2", "b; os_name == \'nt\'"')
    project = written(graph)["project"]
    assert (project["version"], project["dependencies"]) == (
        "1.2.0b0",
        ["numpy>=2", "b; os_name == 'nt'"],
    )
    assert '\ndependencies = [\n    "numpy>=2",\n' in project_file(graph, "app.pluto", carry=False)


def test_a_library_with_an_address_is_allowed() -> None:
    """What builds the package refuses one elsewhere."""
    project = written(graph_with('requires "a", "tools @ https://example.org/tools.whl"'))
    assert project["tool"]["hatch"]["metadata"] == {"allow-direct-references": True}
    assert [Requirement(one).name for one in project["project"]["dependencies"]] == ["a", "tools"]


def test_a_package_that_carries_the_library_asks_for_what_that_needs() -> None:
    library = tomllib.loads((ROOT / "runtime" / "pyproject.toml").read_text("utf-8"))["project"]
    text = project_file(graph_with('version "1.0"'), "app.pluto", carry=True)
    extras = tomllib.loads(text)["project"]["optional-dependencies"]
    assert extras.pop("fleet") == library["dependencies"]
    assert extras.pop("test") == ["pytest"]
    assert extras == {name: library["optional-dependencies"][name] for name in extras}
