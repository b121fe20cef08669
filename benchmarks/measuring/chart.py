"""A chart of horizontal bars on a logarithmic scale, as SVG: text stays text, in light and in dark."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import ceil, floor, log10
from xml.sax.saxutils import escape

SVG = "http://www.w3.org/2000/svg"
WIDTH, LEFT, RIGHT = 760, 250, 70
"""Of the picture, of the names, and of the numbers behind the longest bar."""
ROW, BAR, HEAD = 26, 16, 54
GAP = 30
"""Room for the heading of a group."""

STYLE = """\
.card { fill: #ffffff }
text { font: 13px system-ui, sans-serif; fill: #24292f; stroke: #ffffff }
text { paint-order: stroke; stroke-width: 3px }
.title { font-size: 15px; font-weight: 600 }
.group { font-weight: 600 }
.tick { font-size: 11px; fill: #57606a }
.grid { stroke: #d0d7de }
.bar { fill: #8c959f }
.ours { fill: #0969da }
@media (prefers-color-scheme: dark) {
.card { fill: #0d1117 }
text { fill: #e6edf3; stroke: #0d1117 }
.tick { fill: #8d96a0 }
.grid { stroke: #30363d }
.bar { fill: #6e7681 }
.ours { fill: #4493f8 }
}"""
"""A number stands out from the line that it crosses."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Bar:
    """A name and a number."""

    name: str
    number: float
    ours: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Group:
    """Bars under one heading."""

    heading: str
    bars: Sequence[Bar]


def chart(title: str, unit: str, groups: Sequence[Group]) -> str:
    """Return the picture; the shortest bar of a group comes first."""
    numbers = [bar.number for group in groups for bar in group.bars]
    low, high = floor(log10(min(numbers))), ceil(log10(max(numbers)))
    scale = Scale(low=low, high=max(high, low + 1))
    height = HEAD + sum(GAP + ROW * len(group.bars) for group in groups) + 8
    told = "; ".join(f"{bar.name} {shown(bar.number)}" for g in groups for bar in ordered(g))
    shape = f'viewBox="0 0 {WIDTH} {height}" width="{WIDTH}" height="{height}"'
    parts = [
        f'<svg xmlns="{SVG}" {shape} role="img" aria-labelledby="title desc">',
        f'<title id="title">{escape(title)}</title>',
        f'<desc id="desc">{escape(unit)}: {escape(told)}</desc>',
        f"<style>{STYLE}</style>",
        f'<rect class="card" width="{WIDTH}" height="{height}" rx="6"/>',
        f'<text class="title" x="12" y="24">{escape(title)}</text>',
        *grid(scale, height, unit),
    ]
    top = HEAD
    for group in groups:
        parts.append(f'<text class="group" x="12" y="{top + 18}">{escape(group.heading)}</text>')
        top += GAP
        for bar in ordered(group):
            parts += drawn(bar, scale, top)
            top += ROW
    return "\n".join([*parts, "</svg>"]) + "\n"


@dataclass(frozen=True, slots=True, kw_only=True)
class Scale:
    """Powers of ten, and where they are."""

    low: int
    high: int

    def x(self, number: float) -> float:
        """Return where a number is."""
        share = (log10(number) - self.low) / (self.high - self.low)
        return round(LEFT + share * (WIDTH - LEFT - RIGHT), 1)


def ordered(group: Group) -> list[Bar]:
    """Return the bars, the shortest first."""
    return sorted(group.bars, key=lambda bar: bar.number)


def grid(scale: Scale, height: int, unit: str) -> Iterator[str]:
    """Give a line for each power of ten."""
    for power in range(scale.low, scale.high + 1):
        x = scale.x(10.0**power)
        yield f'<line class="grid" x1="{x}" x2="{x}" y1="{HEAD}" y2="{height - 8}"/>'
        yield (
            f'<text class="tick" x="{x}" y="{HEAD - 6}" text-anchor="middle">{10.0**power:,g}</text>'
        )
    yield f'<text class="tick" x="{LEFT - 14}" y="{HEAD - 6}" text-anchor="end">{escape(unit)}</text>'


def drawn(bar: Bar, scale: Scale, top: int) -> Iterator[str]:
    """Give a bar with its name before it and its number behind it."""
    x, middle = scale.x(bar.number), top + 14
    kind = "bar ours" if bar.ours else "bar"
    yield f'<text x="{LEFT - 8}" y="{middle}" text-anchor="end">{escape(bar.name)}</text>'
    yield (
        f'<rect class="{kind}" x="{LEFT}" y="{top + 1}" width="{round(x - LEFT, 1)}" '
        f'height="{BAR}" rx="2"/>'
    )
    yield f'<text x="{x + 6}" y="{middle}">{shown(bar.number)}</text>'


def shown(number: float) -> str:
    """Return a number with as many digits as one can read."""
    return (
        f"{number:,.0f}" if number >= 100 else f"{number:.1f}" if number >= 10 else f"{number:.2f}"
    )
