"""How long does one wait for `plutoc compile`, measured in starts of an empty Python?

`python benchmarks/compile.py` compiles an app of ten blocks, each way in turn with `python -c pass`,
round after round, and prints the least and the median time of each and their ratios:

- cold_black: nothing is in the cache and no package is there yet,
- black_asked: the same, and a title has both kinds of quotes,
- edit: one setting is another one than in the compile before,
- cold: a comment is another one, so the app is compiled and no file's text changes,
- unchanged: nothing at all has changed.

Then it compiles apps of 1,000 and of 10,000 blocks, with nothing in the cache, for how much longer
the large one takes. `grcc`, the compiler of GNU Radio, does the same for a flow graph of ten blocks
where it is installed. With --json, one object: the ratios, and beside them all times in `raw`.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median

from cold_start import SOUND, program
from large_apps import SHAPES, write_app
from measuring.options import at_least_one

FORGETFUL = ("cold_black", "black_asked")
EMPTY = "python -c pass"
GRCC = "grcc"
WAYS = ("black_asked", "cold_black", "edit", "cold", "unchanged")
QUOTES = SOUND.replace("app sound {", 'app sound "It\'s \\"sound\\"" {')


@dataclass(slots=True)
class Bench:
    """Where things are compiled, and how long each took."""

    home: Path
    times: dict[str, list[float]] = field(default_factory=dict)

    @property
    def environment(self) -> dict[str, str]:
        """A cache of its own; and Python may keep its bytecode, as it does where it is installed."""
        unwanted = ("PYTHONDONTWRITEBYTECODE", "PYTHONPROFILEIMPORTTIME")
        kept = {name: value for name, value in os.environ.items() if name not in unwanted}
        return {**kept, "XDG_CACHE_HOME": str(self.home / "cache")}

    def run(self, name: str, command: Iterable[str]) -> None:
        """Run a command, and note its time under a name."""
        begun = time.perf_counter()
        subprocess.run(
            list(command), check=True, capture_output=True, cwd=self.home, env=self.environment
        )
        self.times.setdefault(name, []).append(time.perf_counter() - begun)

    def forget(self) -> None:
        """Remove what compiles have left."""
        for name in ("cache", "package"):
            shutil.rmtree(self.home / name, ignore_errors=True)


def small(bench: Bench, number: int) -> None:
    """Compile ten blocks in each way, once."""
    app = bench.home / "app.pluto"
    command = [*program(), "compile", "app.pluto", "-o", "package"]
    before: Mapping[str, Callable[[], object]] = {
        "black_asked": lambda: app.write_text(QUOTES),
        "cold_black": lambda: app.write_text(SOUND),
        "edit": lambda: app.write_text(SOUND.replace("attempts: 3", f"attempts: {number + 4}")),
        "cold": lambda: app.write_text(f"{app.read_text()}# {number}\n"),
        "unchanged": lambda: None,
    }
    for name in WAYS:
        bench.run(EMPTY, [sys.executable, "-c", "pass"])
        before[name]()
        if name in FORGETFUL:
            bench.forget()
        bench.run(name, command)


def large(bench: Bench, sizes: Iterable[int]) -> None:
    """Compile an app of each shape and size, once."""
    for shape in SHAPES:
        for size in sizes:
            bench.forget()
            app = write_app(bench.home, shape, size)
            bench.run(f"{shape} {size}", [*program(), "compile", str(app), "-o", "package"])


def flow_graph(bench: Bench) -> None:
    """Have GNU Radio compile a flow graph of ten blocks, once."""
    graph = bench.home / "ten.grc"
    graph.write_text(GRAPH)
    bench.run(GRCC, [GRCC, "-o", str(bench.home), str(graph)])


GRAPH = "\n".join(
    [
        "options:",
        "  parameters: {id: ten, generate_options: no_gui, output_language: python}",
        "  states: {state: enabled}",
        "blocks:",
        "- {name: source, id: analog_sig_source_x, parameters: {type: float, samp_rate: '32000'}}",
        *(
            f"- {{name: times_{number}, id: blocks_multiply_const_vxx,"
            " parameters: {type: float, const: '2'}}"
            for number in range(8)
        ),
        "- {name: sink, id: blocks_null_sink, parameters: {type: float}}",
        "connections:",
        "- [source, '0', times_0, '0']",
        *(f"- [times_{number}, '0', times_{number + 1}, '0']" for number in range(7)),
        "- [times_7, '0', sink, '0']",
        "metadata: {file_format: 1}",
        "",
    ]
)


def results(bench: Bench, sizes: tuple[int, int]) -> dict[str, object]:
    """Return the ratios of the least times, and all times."""
    least = {name: min(times) for name, times in bench.times.items()}
    few, many = sizes
    growth = {shape: least[f"{shape} {many}"] / least[f"{shape} {few}"] for shape in SHAPES}
    ways = [name for name in (*WAYS, GRCC) if name in least]
    return {
        **{name: round(least[name] / least[EMPTY], 2) for name in ways},
        "growth_10k": round(max(growth.values()), 2),
        "growth": {shape: round(ratio, 2) for shape, ratio in growth.items()},
        "raw": {
            name: {"least_s": min(times), "median_s": median(times), "all_s": times}
            for name, times in bench.times.items()
        },
    }


def main() -> None:
    """Measure, and print."""
    parser = argparse.ArgumentParser(description="How long one waits for plutoc compile.")
    parser.add_argument("--rounds", type=at_least_one, default=15, help="of ten blocks")
    parser.add_argument("--large-rounds", type=at_least_one, default=3, help="of the large apps")
    parser.add_argument("--sizes", type=at_least_one, nargs=2, default=(1_000, 10_000), metavar="N")
    parser.add_argument("--json", action="store_true", help="print one object instead of a table")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(home=Path(folder))
        for number in range(given.rounds + 1):
            if number == 1:
                bench.times.clear()  # the first round fills caches: bytecode
            small(bench, number)
            if shutil.which(GRCC):
                flow_graph(bench)
        for _ in range(given.large_rounds):
            large(bench, given.sizes)
    if not shutil.which(GRCC):
        print(f"{GRCC} is not installed, and left out", file=sys.stderr)
    found = results(bench, (given.sizes[0], given.sizes[1]))
    if given.json:
        print(json.dumps(found))
        return
    empty = bench.times[EMPTY]
    print(f"{'':16}{'least':>10}{'ratio':>8}{'median':>11}{'ratio':>8}")
    for name, times in bench.times.items():
        print(
            f"{name:16}{min(times) * 1000:7.0f} ms{min(times) / min(empty):8.1f}"
            f"{median(times) * 1000:8.0f} ms{median(times) / median(empty):8.1f}"
        )
    print(
        f"{given.sizes[1]:,} blocks take {found['growth_10k']} times as long as {given.sizes[0]:,}"
    )


if __name__ == "__main__":
    main()
