"""Every example in many layouts, with comments and blanks put wherever they may stand."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from random import Random

from plutoc.diagnostic import Rejected
from plutoc.format.run import MeaningChanged
from tests.format.layouts import Liberty, Words, laid_out, words_of
from tests.format.promises import formatted, keep, meaning
from tests.paths import ROOT

EXAMPLES = tuple(path.parent.name for path in sorted(ROOT.glob("examples/*/app.pluto")))
EVERYTHING = "everything"
NAMES = (*EXAMPLES, EVERYTHING)

SAMPLE = """pluto 1
use pluto_survey
use pluto_weather as weather

# Every construct of the language, each in every form.
app everything "Texts \\"in\\" \\\\ # { -> texts" {
  version "1.2.0"
  requires "numpy>=2", "requests[socks] >= 2.32; python_version < '3.14'", "tools @ https://example.org/a,b"
  category plain can measure
  category big(payload: 5 g, speed: 0.8 m/s, reserve: 20 %) can pick_item, release_item, measure,

  action spray(dose: mass = 50 mg, kind: text = "a # b", wait: time) once
  action shout()
  modifier limit(limit: time = 3 min, list: text) emits STANDBY, FAILED, writes delay, gap
  modifier bare
  evaluator good  # enough
  policy mine

  scan = weather.Wind(limit: -5 C, policy: nearest, on: [1, -0.50, [2 km/h, yes], [], "x"], to: no)
  wide = SomeKindOfBlock(first: "a text that takes much of a line", second: [10, 20, 30], third: no)
  empty = Kind()
  [a, use] -> b
  version -> requires -> [version, requires] -> version when requires, otherwise_not
  [
    a,  # one
    # two
    b,
  ]
    # three
    -> c  # four
    -> [d, when] when STANDBY, FAILED
  one_long_name -> another_long_name -> [yet_another_one, and_one_more] -> the_last_one_of_all otherwise
}
"""


@cache
def text_of(name: str) -> str:
    """Return a source's text."""
    return SAMPLE if name == EVERYTHING else (ROOT / "examples" / name / "app.pluto").read_text()


@cache
def read(name: str) -> tuple[Words, str]:
    """Return a source's words, and what it means."""
    return words_of(text_of(name)), meaning(text_of(name))


def mutant(name: str, seed: int) -> str:
    """Return one of a source's layouts."""
    random = Random(f"{name} {seed}")
    return laid_out(read(name)[0], random, Liberty(comments=random.choice([0.02, 0.1, 0.4, 1])))


def broken_promises(name: str, seeds: range) -> Iterator[tuple[int, str]]:
    """Yield the seeds of the layouts that are not formatted as promised, and why."""
    for seed in seeds:
        try:
            keep(mutant(name, seed), read(name)[1])
        except (AssertionError, Rejected, MeaningChanged) as error:
            yield seed, f"{type(error).__name__}: {error}"


def forms(name: str, seeds: range) -> set[str]:
    """Return what becomes of layouts that differ in blanks, line breaks and spare commas only."""
    liberty = Liberty(comments=0, own=False, blank_lines=False)
    words = read(name)[0]
    return {formatted(laid_out(words, Random(f"{name} {seed}"), liberty)) for seed in seeds}
