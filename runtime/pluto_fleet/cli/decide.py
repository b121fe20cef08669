"""`decide`: what only a person can know."""

from __future__ import annotations

import json
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING

from plutoc_runtime import output
from plutoc_runtime.domain.errors import BadInput
from plutoc_runtime.domain.text import in_shell, printable, quoted

from ..journal.store import Store
from ..process.ipc import NotRunning
from .flown import ANSWERS, records_in, waiting, waiting_lines
from .tell import asked as asked_of_app

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App

    from ..journal.fold import Records
    from .options import Options


def decide(app: App, options: Options) -> int:
    """Settle what a mission waits for, in the running app or in its journal."""
    journal, mission, answer = options.the_journal, options.mission, options.answer
    records = records_in(app, journal)
    if mission is None:
        listed = [*waiting_lines(app, journal, records)]
        for line in listed or ["no mission waits for a person"]:
            output.line(line)
        return 0
    # Whoever was mistaken may say otherwise, as long as nothing has come of it.
    asked = {name: (what, why) for name, what, why in waiting(records, answered=True)}
    if mission not in asked:
        raise BadInput(_not_asked(journal, mission, records))
    what, question = asked[mission]
    if answer not in ANSWERS[what]:
        fitting = ", ".join(ANSWERS[what])
        raise BadInput(
            f"{journal}: mission {quoted(mission)}: {printable(question)}; say one of: {fitting}"
        )
    try:
        request = {"command": "decide", "mission": mission, "answer": answer}
        output.line(asked_of_app(app, options, request))
    except NotRunning:
        _put_down(journal, mission, answer, records.time)
        output.line(
            f"mission {quoted(mission)}: {answer}; it is on record, and "
            f"{app.name} resume {in_shell(journal)} acts on it"
        )
    return 0


def _not_asked(journal: Path, mission: str, records: Records) -> str:
    known = mission in records.missions
    what = "waits for nobody's decision" if known else "is not in this journal"
    others = ", ".join(quoted(name) for name, _, _ in waiting(records))
    rest = f"; those that wait are: {others}" if others else ""
    return f"{journal}: mission {quoted(mission)} {what}{rest}"


def _put_down(journal: Path, mission: str, answer: str, now: float) -> None:
    """Write an answer into a journal that nobody is writing."""
    event = {"t": now, "event": "mission.decided", "mission": mission, "answer": answer}
    with closing(Store.open(journal)) as store:
        store.append([json.dumps([event])])
