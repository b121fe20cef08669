"""The graph as JSON, for other programs."""

from __future__ import annotations

from plutoc.check.model import Checked
from plutoc.report.graph.picture import picture


def json(checked: Checked) -> str:
    """Return the graph as one JSON object; lines count from 1."""
    from json import dumps  # slow to import, and other pictures do without

    graph = checked.graph
    return (
        dumps(
            {
                "app": graph.name,
                "blocks": [
                    {
                        "name": node.name,
                        "kind": node.block.name,
                        "line": graph.source.position(node.name_span.start)[0],
                        "resumes_at": list(checked.resumes[node.name]),
                    }
                    for node in graph.nodes
                ],
                "edges": [
                    {
                        "from": arrow.source,
                        "to": arrow.target,
                        "statuses": list(arrow.statuses),
                        "fork": arrow.fork,
                        "implicit": arrow.implicit,
                    }
                    for arrow in picture(checked).arrows
                ],
            },
            indent=2,
        )
        + "\n"
    )
