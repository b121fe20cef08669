"""From a plan to a package: {path: text}, and nothing else."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from plutoc.emit.callables import carried_functions
from plutoc.emit.embed import BLOCKS, FOLDER, carried_library, embed
from plutoc.emit.flow_file import flow_file
from plutoc.emit.hooks_file import hooks_file
from plutoc.emit.hooks_tests import fixtures_file, hooks_test, testing_file
from plutoc.emit.lock import NAME, Hooks, hooks_of, lock
from plutoc.emit.model_file import model_file
from plutoc.emit.modules import RUNTIME, import_statements
from plutoc.emit.project_files import attributes_file, init_file, main_file, project_file
from plutoc.emit.readme_file import readme
from plutoc.emit.render import owned, verbatim
from plutoc.emit.test_file import flow_test
from plutoc.plan.model import Plan


@dataclass(frozen=True, slots=True, kw_only=True)
class Package:
    """The files of a generated package, by path; folders are separated by `/`."""

    name: str
    owned: Mapping[str, str]
    """Written anew each time."""
    once: Mapping[str, str]
    """Written where there is no such file yet; the user's from then on."""


_NONE: Mapping[str, str] = MappingProxyType({})


def emit(
    plan: Plan,
    *,
    source_name: str,
    picture: str,
    graph_data: str,
    carry: bool = False,
    former: Mapping[str, str] = _NONE,
    for_all: frozenset[str] = frozenset(),
) -> Package:
    """Return the package of a plan; `picture` is its graph in Mermaid, for the README, `graph_data` for pages.

    `carry`: with the library that flies inside it. `former` are hooks that the app does not declare
    any more, and hooks.py still defines, with their kinds: the lock remembers them. `for_all`: the
    policies that hooks.py has for all that wait.
    """
    graph = plan.checked.graph
    app = f"src/{graph.name}"
    modules = {
        "__init__.py": init_file(graph, former=bool(former)),
        "__main__.py": main_file(graph),
        "flow.py": flow_file(plan),
        "model.py": model_file(graph),
    }
    hooks = hooks_of(graph)
    if hooks or former:  # tests of hooks that are left over go on importing it
        modules["testing.py"] = testing_file(graph)
    carried = embed(carried_functions(plan), sorted(_runtime_modules(modules.values())))
    library = carried_library() if carry else {}
    files = {
        ".gitattributes": attributes_file(source_name),
        "LICENSE": verbatim("LICENSE"),
        "README.md": readme(graph, source_name, picture),
        "pyproject.toml": project_file(graph, source_name, carry=carry),
        **{f"{app}/{name}": owned(text, source_name) for name, text in modules.items()},
        **{f"{app}/{path}": text for path, text in carried.items()},
        **{f"{app}/{path}": text for path, text in library.items()},
        f"{app}/graph.json": graph_data,
        f"{app}/py.typed": "",
        "tests/test_flow.py": owned(flow_test(graph), source_name),
    }
    packages = (node.package for node in graph.nodes)
    files[NAME] = lock(
        graph.name, source_name, packages, files, Hooks(declared=hooks, former=former)
    )
    once = {f"{app}/hooks.py": hooks_file(plan.checked)}
    if hooks:
        once["tests/conftest.py"] = fixtures_file(graph)
        once["tests/test_hooks.py"] = hooks_test(plan.checked, for_all)
    return Package(
        name=graph.name,
        owned=dict(sorted(files.items())),
        once=once,
    )


def _runtime_modules(texts: Iterable[str]) -> Iterator[str]:
    """Yield the modules of the runtime that the app's own modules import."""
    for node in (node for text in texts for node in import_statements(text)):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith(FOLDER):
            inner = (node.module or "").removeprefix(FOLDER).removeprefix(".")
            if not inner.startswith(BLOCKS):
                names = [inner] if inner else [alias.name for alias in node.names]
                yield from (f"{RUNTIME}.{name}" for name in names)
