"""What docs/security.md says of the station's limits is what holds, and is said once."""

from __future__ import annotations

import re

from pluto_fleet.station.operation import SMALL_BODY
from pluto_fleet.station.web.api import BODY_WITHIN, BYTES_A_SECOND
from pluto_fleet.station.web.handlers import OPERATIONS
from tests.paths import ROOT

PAGE = (ROOT / "docs" / "security.md").read_text("utf-8")
REFUSED = PAGE.partition("## What is refused")[2].partition("\n## ")[0]


def test_each_thing_that_is_refused_is_said_once() -> None:
    rows = [line.split("|")[1].strip() for line in REFUSED.splitlines() if line.startswith("| ")]
    begins = [" ".join(re.findall(r"\w+", row)[:4]) for row in rows]
    assert len(rows) > 8
    assert sorted(set(begins)) == sorted(begins)


def test_the_sizes_and_times_of_what_is_sent_are_those_of_the_code() -> None:
    [large] = {one.most_bytes for one in OPERATIONS.values()} - {SMALL_BODY}
    told = re.search(
        r"more than (\d+) MiB; content that does not come within (\d+) s"
        r" \(a floor plan: (\d+) MiB, (\d+) s\)",
        REFUSED,
    )
    assert told is not None
    seconds = [max(BODY_WITHIN, most / BYTES_A_SECOND) for most in (SMALL_BODY, large)]
    assert [int(number) for number in told.groups()] == [
        *(SMALL_BODY // 2**20, seconds[0]),
        *(large // 2**20, seconds[1]),
    ]
