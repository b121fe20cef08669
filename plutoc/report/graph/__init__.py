"""Pictures of a checked graph, with the statuses on every edge."""

from __future__ import annotations

from plutoc.report.graph.dot import dot
from plutoc.report.graph.json import json
from plutoc.report.graph.mermaid import mermaid
from plutoc.report.graph.svg import NoGraphviz, dot_to_svg

__all__ = ["NoGraphviz", "dot", "dot_to_svg", "json", "mermaid"]
