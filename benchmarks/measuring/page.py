"""What stands in the documentation of a run: a picture, and two tables."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from .chart import Bar, Group, chart
from .figures import FIGURES

Results = Mapping[str, Any]
"""What `table.results` gives, or what was read of it."""

GROUPS = {
    "In real time, on asyncio": {
        "direct_contended": "resumed from the callback",
        "ours_contended": "Pluto",
        "ideal_contended": "hand-written asyncio",
        "ours_journal": "Pluto, each transition as JSON",
        "ours_plain": "Pluto, plain plan (-O0)",
        "py_trees": "py_trees",
        "transitions": "transitions",
        "python_statemachine": "python-statemachine",
        "thesis": "the thesis's architecture, in Python",
        "langgraph": "LangGraph",
    },
    "In virtual time": {
        "generators_contended": "bare generators",
        "ours_virtual_contended": "Pluto",
        "simpy": "SimPy",
    },
}
"""Who is shown, and by what name."""

BEGIN, END = "<!-- measured: begin -->\n", "<!-- measured: end -->\n"


def picture(results: Results) -> str:
    """Return the chart of what a trip costs."""
    cases = results["cases"]
    groups = [
        Group(
            heading=heading,
            bars=[
                Bar(name=name, number=cases[case]["minimum_us"], ours=case.startswith("ours"))
                for case, name in names.items()
                if case in cases
            ],
        )
        for heading, names in GROUPS.items()
    ]
    title = "What a trip costs: the same flow, ten missions for each drone"
    return chart(title, "µs of CPU a trip", [group for group in groups if group.bars])


def tables(results: Results) -> Iterator[str]:
    """Give the lines of the tables."""
    about = results["about"]
    yield (
        f"Python {about['python']} on {about['machine']}, {about['cpus']} cores, "
        f"{about['rounds']} rounds."
    )
    yield ""
    yield "| figure | minimum | median | wanted | key |"
    yield "| --- | ---: | ---: | ---: | --- |"
    for figure in FIGURES:
        if results[figure.key] is not None:
            least, middle = (results[name][figure.key] for name in ("minima", "medians"))
            row = (figure.says, shown(least), shown(middle), figure.wanted, f"`{figure.key}`")
            yield f"| {' | '.join(row)} |"
    yield ""
    yield "| µs of CPU a trip | minimum | median | runs | most MiB | threads |"
    yield "| --- | ---: | ---: | ---: | ---: | ---: |"
    for name, case in results["cases"].items():
        cost = f"{shown(case['minimum_us'])} | {shown(case['median_us'])} | {case['runs']}"
        yield f"| `{name}` | {cost} | {case['peak_mib']:.0f} | {case['threads']} |"


def shown(number: float) -> str:
    """Return a number with as many digits as one can read."""
    return f"{number:,.0f}" if number >= 1000 else f"{number:.3g}"


def rewritten(page: str, results: Results) -> str:
    """Return a page of the documentation with the tables of this run between its two marks."""
    before, _, rest = page.partition(BEGIN)
    _, _, after = rest.partition(END)
    return "".join(
        [before, BEGIN, "\n", *(f"{line}\n" for line in tables(results)), "\n", END, after]
    )
