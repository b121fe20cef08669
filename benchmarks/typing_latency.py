"""How long does it take from a keystroke to what is published of it, through the protocol?

`python benchmarks/typing_latency.py` types statements, a character at a time, into the middle of apps
of 100 and 1,000 blocks, and prints the median and the 95th percentile. At most 50 ms and 300 ms are
what we promise.
"""

from __future__ import annotations

import argparse
import asyncio
import sys
import time
from pathlib import Path
from statistics import median, quantiles

sys.path.insert(0, str(Path(__file__).parents[1]))

from lsprotocol import types

from large_apps import SHAPES
from measuring.options import at_least_one
from tests.compiler.lsp.client import Client

TYPED = "  again = PriorityManager(max_attempts: 3)\n  again -> end when FAILED\n"


async def times_of(shape: str, size: int, rounds: int) -> list[float]:
    """Return the seconds of each keystroke: first a few statements are typed, then taken back."""
    body = list(SHAPES[shape](size))
    text = "\n".join(["pluto 1", "app measured {", *body, "}", ""])
    line = text[: len(text) // 2].count("\n")
    client, uri, found = Client(), "untitled:measured.pluto", []
    await client.begin()
    client.open(uri, text)
    await client.findings(uri)
    version = 0
    for _ in range(rounds):
        at = types.Position(line=line, character=0)
        end = at
        for char in TYPED:
            version += 1
            begun = time.perf_counter()
            client.change(uri, version, types.Range(start=end, end=end), char)
            await client.findings(uri, version)
            found.append(time.perf_counter() - begun)
            is_end = char == "\n"
            end = types.Position(
                line=end.line + is_end, character=0 if is_end else end.character + 1
            )
        version += 1
        client.change(uri, version, types.Range(start=at, end=end), "")
        await client.findings(uri, version)
    await client.end()
    return found


def main() -> None:
    """Measure all shapes of apps, in both sizes."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sizes", type=at_least_one, nargs="+", default=(100, 1_000), metavar="N")
    parser.add_argument("--rounds", type=at_least_one, default=1, metavar="N")
    options = parser.parse_args()
    print(f"{'':24}{'median':>10}{'95 %':>10}{'most':>10}")
    for size in options.sizes:
        for shape in SHAPES:
            found = asyncio.run(times_of(shape, size, options.rounds))
            p95 = quantiles(found, n=20)[-1]
            row = (median(found), p95, max(found))
            print(f"{f'{size} blocks, {shape}':24}" + "".join(f"{t * 1000:7.0f} ms" for t in row))


if __name__ == "__main__":
    main()
