"""What the README shows is what the compiler does, and what CI runs is what the README says."""

from __future__ import annotations

import re

from plutoc.compile import compile_source
from plutoc.report.pictures import mermaid
from plutoc.source import Source
from tests.paths import ROOT

README = (ROOT / "README.md").read_text()
BLOCKS = re.findall(r"^```(\w*)\n(.*?)^```$", README, re.MULTILINE | re.DOTALL)


def test_the_readmes_python_and_picture_are_what_its_source_becomes() -> None:
    source = next(text for _, text in BLOCKS if text.startswith("pluto 1"))
    (python,) = (text for language, text in BLOCKS if language == "python")
    (picture,) = (text for language, text in BLOCKS if language == "mermaid")
    compiled = compile_source(
        Source("wards.pluto", source), source_name="wards.pluto", find_hooks=lambda checked: None
    )
    assert python in compiled.package.owned["src/wards/flow.py"]
    assert picture.strip() == mermaid(compiled.checked).strip()


def test_ci_runs_the_readmes_test_command_between_lint_and_the_long_tests() -> None:
    (command,) = (text.strip() for _, text in BLOCKS if "pytest" in text)
    lines = (ROOT / ".ci/run").read_text().splitlines()
    said = [line for line in lines if line and not line.startswith(("#", "set ", "cd ", "export "))]
    install, tests = command.rsplit(" && ", 1)
    assert said == [".ci/system &", install, "wait $!", ".ci/lint", tests, f"{tests} -m long"]


def test_every_page_that_the_readme_names_exists() -> None:
    pages = re.findall(r"\]\(([^)#:]+)\)", README)
    assert pages
    assert not [page for page in pages if not (ROOT / page).exists()]
