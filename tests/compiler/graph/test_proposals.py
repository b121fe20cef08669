"""What is proposed is legal at its place."""

from __future__ import annotations

import pytest

from plutoc.diagnostic import Diagnostic
from tests.compiler.graph.test_cascades import found_in

AB = "make = Make\nwork = Work\npass_on = Pass\n"


def only(statements: str, uses: str = "") -> Diagnostic:
    """Return the one finding."""
    (found,) = found_in(statements, uses)
    return found


@pytest.mark.parametrize(
    ("statements", "help"),
    [
        (AB + "strt -> make", "did you mean `start`?"),
        (AB + "make -> edn", "did you mean `end`?"),
        (AB + "make -> Work", "did you mean `work`?"),
        (AB + "make -> Pass", "did you mean `pass_on`?"),
        (AB + "make -> Judge", "declare it in the app: `judge = Judge`"),
        (AB + "make -> passon", "did you mean `pass_on`?"),
        (AB + "make -> wrk when RUNNING", "declare it in the app: `wrk = KIND`"),
        (AB + "make -> end when DONE", "did you mean `COMPLETED`?"),
        (AB + "make -> end when COMPLETED, FAILD", "did you mean `FAILED`?"),
        (AB + "make -> end when standby", "only `COMPLETED` or `FAILED` can stand here"),
        ("a = pass", "did you mean `Pass`?"),
        ("a = Wrok(wait: 1 s)", "did you mean `Work`?"),
        ("a = Work(wait: 5 mins)", "did you mean `min`?"),
        ("a = Work(wait: 5 sec)", "did you mean `s`?"),
        ("a = Work(level: 5 percent)", "did you mean `%`?"),
        ("a = Work(tries: 1e3)", "numbers are written out, with digits and a point only: `1000`"),
        ("a = Work(tries: 1_000)", "numbers are written out, with digits and a point only: `1000`"),
        ("a = Work(level: 0.2)", "write `20 %`: a share is said in hundredths"),
        ("a = Work(level: 20)", "write `20 %`"),
        ('a = Work(way: "left")', "write `left`"),
        ('a = Work(way: "up")', "for instance `way: left`"),
        ('evaluator e\na = Judge(strictness: 1, hook: "e")', "write `e`"),
        ('evaluator e\na = Judge(strictness: 1, hook: "f")', "for instance `hook: e`"),
        ("action a(dose: mg)", "`mg` is a unit: the type is `mass`"),
        ("action a(dose: string)", "did you mean `text`?"),
        ("a = Pass\na = Pass", "remove one of them"),
        ("a = Pass\na = Make", "give one of them another name"),
        ("a = Work(tries: 3 times)", "`tries` has none: for instance `tries: 3`"),
        ("a = Work(wait: 1 s, wiat: 1 s)", None),
        ("category c can take_photo, takephoto", None),
    ],
)
def test_proposal(statements: str, help: str | None) -> None:
    """The nearest of what would be accepted; never what is there already."""
    said = only(statements).help or ""
    assert said == help if help else "did you mean" not in said


@pytest.mark.parametrize(("other", "ours"), [("true", "yes"), ("False", "no")])
def test_truth_of_other_languages_has_a_fix(other: str, ours: str) -> None:
    """There is only one thing that it can mean."""
    fix = only(f"a = Work(loud: {other})").fix
    assert fix and fix.text == ours


def test_letter_that_looks_like_a_plain_one_is_named() -> None:
    """Where a name is declared, and where it is used."""
    assert "U+0430 (cyrillic small letter a)" in only("w\u0430it = Pass").label
    used = only("wait = Pass\nstart -> w\u0430it").help or ""
    assert "U+0430 (cyrillic small letter a)" in used
    assert used.endswith("did you mean `wait`?")
