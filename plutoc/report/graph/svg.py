"""The graph as an SVG picture, drawn by Graphviz."""

from __future__ import annotations


class NoGraphviz(Exception):
    """Graphviz is not there, or it could not draw. The text says what to do."""


def dot_to_svg(text: str) -> str:
    """Have Graphviz draw what `dot` wrote; raise `NoGraphviz` where that fails."""
    import subprocess  # slow to import, and other pictures do without
    from shutil import which

    program = which("dot")
    if program is None:
        raise NoGraphviz(
            "SVG pictures are drawn by Graphviz, and its program `dot` was not found: "
            "install Graphviz (https://graphviz.org/download/), or use `--format mermaid`"
        )
    done = subprocess.run(
        [program, "-Tsvg"],
        input=text,
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=False,
    )
    if done.returncode:
        raise NoGraphviz(f"Graphviz could not draw the graph: {done.stderr.strip()}")
    return done.stdout
