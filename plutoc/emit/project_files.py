"""The files of a package that are not its app: project, entry points, what it offers."""

from __future__ import annotations

from plutoc.emit.markup import header, one_line, toml_text
from plutoc.emit.python import Import, import_lines
from plutoc.emit.render import render
from plutoc.emit.stubs import exports_of
from plutoc.graph.model import Graph
from plutoc_runtime.domain.app import SEAM, library_for


def init_file(graph: Graph, *, former: bool) -> str:
    """Return the text of `__init__.py`, not yet formatted."""
    exports = exports_of(graph, former=former)
    imports = [Import(module=module, name=name) for name, module in exports.items()]
    homes: dict[str, list[str]] = {}
    for name, module in exports.items():
        homes.setdefault(module, []).append(f'"{name}"')
    return render(
        "init.py",
        app=graph.name,
        imports=import_lines(imports),
        exports=list(exports),
        homes={module: ", ".join(names) for module, names in homes.items()},
    )


def main_file(graph: Graph) -> str:
    """Return the text of `__main__.py`, not yet formatted."""
    return render("main.py", app=graph.name)


def project_file(graph: Graph, source_name: str, *, carry: bool = False) -> str:
    """Return the text of `pyproject.toml`; `carry`: the library is inside the package."""
    return render(
        "pyproject.toml",
        header=header(source_name),
        app=graph.name,
        distribution=toml_text(graph.name.rstrip("_")),  # a distribution cannot end with one
        version=toml_text(graph.version),
        description=toml_text(one_line(graph.title) or graph.name),
        libraries=[toml_text(library.requirement) for library in graph.libraries],
        direct=any(library.direct for library in graph.libraries),
        speaks=library_for(SEAM),
        carry=carry,
    )


def attributes_file(source_name: str) -> str:
    """Return the text of `.gitattributes`."""
    return render("gitattributes", header=header(source_name))
