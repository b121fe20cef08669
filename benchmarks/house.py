"""How large are the rooms of the house, and which of them need each other?

`python benchmarks/house.py` prints, for each package and each folder in it (its rooms), the files, lines,
lines that are not blank, and the median and the largest file. Then it prints the rings: rooms or files
that import each other, directly or through others, be it only for types. A file that is in no folder of
its package is its own room there.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterable
from pathlib import Path
from statistics import median

import grimp
import networkx

from measuring.rounds import HOME

ROOT = HOME.parent
PACKAGES = {
    "plutoc": "plutoc",
    "plutoc_grammar": "grammar/plutoc_grammar",
    "plutoc_runtime": "runtime/plutoc_runtime",
    "plutoc_blocks": "stdlib_blocks/plutoc_blocks",
    "pluto_fleet": "runtime/pluto_fleet",
}
OTHERS = ("tests", "benchmarks", "docs")
"""They have Python, and nothing imports them."""
TOP = "its top files"


def lines_of(file: Path) -> list[str]:
    """Return a file's lines."""
    return file.read_text(encoding="utf-8").splitlines()


def row(name: str, files: Iterable[Path]) -> str:
    """Return a line of the table."""
    texts = {file: lines_of(file) for file in files}
    sizes = {file: len(lines) for file, lines in texts.items()}
    written = sum(bool(line.strip()) for lines in texts.values() for line in lines)
    largest = max(sizes, key=lambda file: sizes[file])
    return (
        f"{name:32}{len(sizes):6,}{sum(sizes.values()):9,}{written:9,}"
        f"{median(sizes.values()):8.0f}{sizes[largest]:7,}  {largest.relative_to(ROOT)}"
    )


def rooms(folder: Path) -> dict[str, list[Path]]:
    """Return the files of each folder in this one, and those that are in none."""
    found: dict[str, list[Path]] = {}
    for file in sorted(folder.rglob("*.py")):
        inner = file.relative_to(folder).parts
        found.setdefault(inner[0] if len(inner) > 1 else TOP, []).append(file)
    return dict(sorted(found.items(), key=lambda room: (room[0] == TOP, room[0])))


def sizes() -> None:
    """Print the table."""
    print(f"{'':32}{'files':>6}{'lines':>9}{'written':>9}{'median':>8}{'most':>7}  largest file")
    every: list[Path] = []
    for folder in PACKAGES.values():
        known = rooms(ROOT / folder)
        files = [file for room in known.values() for file in room]
        every += files
        print(row(folder, files))
        for name, inside in known.items() if len(known) > 1 else ():
            print(row(f"  {name}", inside))
    print(row("all of these", every))
    for folder in OTHERS:
        print(row(folder, (ROOT / folder).rglob("*.py")))


def imports(node: Callable[[str], str]) -> networkx.DiGraph:
    """Return who imports whom; a module stands for its node."""
    sys.path[:0] = [str((ROOT / folder).parent) for folder in PACKAGES.values()]
    known = grimp.build_graph(*PACKAGES, cache_dir=None)
    graph = networkx.DiGraph()
    for importer in known.modules:
        for imported in known.find_modules_directly_imported_by(importer):
            if node(importer) != node(imported):
                graph.add_edge(node(importer), node(imported))
    return graph


def rings(what: str, graph: networkx.DiGraph) -> None:
    """Print the strongly connected components that are more than one node."""
    found = [ring for ring in networkx.strongly_connected_components(graph) if len(ring) > 1]
    print(f"\nrings between {what}: {len(found)}")
    for ring in sorted(found, key=lambda ring: (-len(ring), min(ring))):
        inside = graph.subgraph(ring)
        pairs = sorted((a, b) for a, b in inside.edges if a < b and inside.has_edge(b, a))
        print(f"  {len(ring)}, of which {len(pairs)} pairs import each other:")
        print("".join(f"    {name}\n" for name in sorted(ring)), end="")
        print("".join(f"      {a} <-> {b}\n" for a, b in pairs), end="")


def main() -> None:
    """Print everything."""
    argparse.ArgumentParser(description="How large the rooms are, and their rings.").parse_args()
    sizes()
    rings("rooms", imports(lambda module: ".".join(module.split(".")[:2])))
    rings("files", imports(lambda module: module))


if __name__ == "__main__":
    main()
