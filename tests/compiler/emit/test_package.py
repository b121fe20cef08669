"""A generated package is right under any name of its app, and it flies."""

from __future__ import annotations

import ast
import os
import re
import subprocess
import sys
import tomllib
from contextlib import suppress
from dataclasses import replace
from hashlib import sha256
from importlib.metadata import PackageNotFoundError, packages_distributions, requires
from pathlib import Path

import hypothesis.strategies as st
import pytest
from hypothesis import given

from plutoc.emit.flow_file import flow_file
from plutoc.emit.markup import one_line
from plutoc.emit.package import Package, emit
from plutoc.emit.project_files import project_file
from plutoc.emit.readme_file import readme
from plutoc.emit.render import owned
from plutoc.graph.app_names import taken_app_name
from plutoc.plan.model import Plan
from tests.compiler.emit.apps import ODD_NAMES, PARCELS, PLAIN, TYPED
from tests.compiler.emit.plans import plan_of
from tests.paths import ROOT

ALFALFA = (ROOT / "tests/cases/alfalfa/app.pluto").read_text(encoding="utf-8")
APPS = {
    "alfalfa": ALFALFA,
    "odd_": ODD_NAMES,
    "plain": PLAIN,
    "parcels": PARCELS,
    "typed_": TYPED,
}


def package_of(text: str, source_name: str = "app.pluto") -> Package:
    return emit(plan_of(text), source_name=source_name, picture="flowchart TD\n")


def titled(plan: Plan, title: str) -> Plan:
    graph = replace(plan.checked.graph, title=title)
    return replace(plan, checked=replace(plan.checked, graph=graph))


def write(package: Package, folder: Path) -> Path:
    for path, text in {**package.owned, **package.once}.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_bytes(text.encode())
    return folder


def run(folder: Path, *command: str) -> str:
    """Run Python in a folder where only the package can be found, and return what it printed."""
    environment = {**os.environ, "PYTHONPATH": "src", "PYTHONDONTWRITEBYTECODE": "1"}
    done = subprocess.run(
        [sys.executable, *command],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.mark.parametrize("name", ["odd_", "parcels", "typed_"])
def test_package_passes_its_own_tests(name: str, tmp_path: Path) -> None:
    """It flies as it is: all its missions end, and its stubs stand in for what is to be written."""
    folder = write(package_of(APPS[name]), tmp_path)
    assert " passed" in run(folder, "-m", "pytest", "-q", "-p", "no:cacheprovider", "tests")


@pytest.mark.parametrize("name", sorted(APPS))
def test_files_of_the_readme_can_be_flown(name: str, tmp_path: Path) -> None:
    """The missions and the fleet copied from there are a plan that nothing is wrong with."""
    folder = write(package_of(APPS[name]), tmp_path)
    text = (folder / "README.md").read_text(encoding="utf-8")
    missions, fleet = re.findall(r"^```toml\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    (folder / "missions.toml").write_text(missions, encoding="utf-8")
    (folder / "fleet.toml").write_text(fleet, encoding="utf-8")
    run(folder, "-m", name, "check", "missions.toml", "--fleet", "fleet.toml")


def test_package_is_strictly_typed(tmp_path: Path) -> None:
    """mypy has nothing to say, the runtime, odd names and the plain flow included."""
    folder = write(package_of(ODD_NAMES), tmp_path)
    plain = emit(plan_of(ODD_NAMES, optimise=False), source_name="app.pluto", picture="")
    for path in plain.owned.keys() - package_of(ODD_NAMES).owned.keys():
        (folder / path).write_text(plain.owned[path])
    (folder / "src/odd_/plain_flow.py").write_text(plain.owned["src/odd_/flow.py"])
    command = (
        "import os, sys; from mypy import api; os.environ['MYPYPATH'] = 'src';"
        "out, err, code = api.run(['--strict', '--cache-dir', os.devnull, 'src']);"
        "print(out, err); sys.exit(code)"
    )
    assert "no issues found" in run(folder, "-c", command)


@pytest.mark.parametrize("options", [["--isolated"], ["--config", str(ROOT / "pyproject.toml")]])
def test_package_is_clean_for_ruff(options: list[str], tmp_path: Path) -> None:
    """By ruff's own rules, and by ours."""
    for name, text in APPS.items():
        write(package_of(text), tmp_path / name)
    sources = [f"{name}/src/{name}" for name in APPS]
    found = run(tmp_path, "-m", "ruff", "check", "--no-cache", *options, *sources)
    assert "All checks passed" in found


def test_simulating_loads_nothing_of_the_station(tmp_path: Path) -> None:
    """Nor of the web: what only `serve` needs costs the other commands nothing."""
    folder = write(package_of(PLAIN), tmp_path)
    mission = 'name = "M"\ntrip = [{ action = "measure", target = [1.0, 2.0] }]'
    (folder / "missions.toml").write_text(f"[[mission]]\n{mission}\n")
    code = (
        "import sys; from plain.flow import APP; from plain._runtime.command import main;"
        "code = main(APP, ['simulate', 'missions.toml']); print(code, *sys.modules)"
    )
    code_and_modules = run(folder, "-c", code).splitlines()[-1].split()
    assert code_and_modules[0] == "0"
    assert "plain._runtime.flow.engine" in code_and_modules
    assert not [one for one in code_and_modules if "pluto_fleet.station" in one or "uvicorn" in one]


def test_importing_the_package_loads_next_to_nothing(tmp_path: Path) -> None:
    """Its types come when they are asked for, and none of them brings asyncio or argparse."""
    folder = write(package_of(ALFALFA), tmp_path)
    loaded = run(folder, "-c", "import sys, alfalfa; print(*sys.modules)").split()
    assert not {"asyncio", "argparse", "dataclasses"} & set(loaded)
    assert not [name for name in loaded if name.startswith("alfalfa.")]
    names = "import sys; from alfalfa import *; print(Trip.__name__, *sys.modules)"
    loaded = run(folder, "-c", names).split()
    assert loaded[0] == "Trip"
    assert not {"asyncio", "argparse"} & set(loaded)


def test_unknown_name_is_refused_as_usual(tmp_path: Path) -> None:
    """Loading types late does not change what a mistake looks like."""
    folder = write(package_of(PLAIN), tmp_path)
    code = "import plain\ntry: plain.Tripp\nexcept AttributeError as error: print(error)"
    assert run(folder, "-c", code) == "module 'plain' has no attribute 'Tripp'\n"


def test_header_is_the_first_line() -> None:
    """Every owned file says so, but those that are copied."""
    package = package_of(PLAIN)
    for path, text in package.owned.items():
        if path != "LICENSE" and "/_runtime/" not in path and not path.endswith("py.typed"):
            first, second = text.splitlines()[:2]
            assert "Code generated by plutoc from app.pluto. DO NOT EDIT." in first, path
            assert not path.endswith(".py") or second == "# fmt: off"
    for path, text in package.once.items():
        assert "DO NOT EDIT" not in text, path


def test_strange_source_name_stays_out() -> None:
    """A file name that could be something else in a comment is not named."""
    package = package_of(PLAIN, "a\ncoding: utf-7")
    first = package.owned["src/plain/flow.py"].splitlines()[0]
    assert first == "# Code generated by plutoc from a .pluto file. DO NOT EDIT."


def test_lock_records_every_other_owned_file() -> None:
    """With the SHA-256 of its bytes, and the versions of what made it."""
    package = package_of(PLAIN)
    lock = tomllib.loads(package.owned["pluto.lock"])
    digests = {path: sha256(text.encode()).hexdigest() for path, text in package.owned.items()}
    assert lock["app"] == "plain"
    assert list(lock["versions"]) == ["plutoc"]
    assert lock["files"] == {path: it for path, it in digests.items() if path != "pluto.lock"}


def test_app_without_hooks_has_no_tests_of_them() -> None:
    """There is a hooks.py to write in, and nothing in it yet but what it is for."""
    package = package_of(PLAIN)
    assert list(package.once) == ["src/plain/hooks.py"]
    assert len(ast.parse(package.once["src/plain/hooks.py"]).body) == 1
    assert "hooks" not in package.owned["src/plain/flow.py"]


def test_project_has_a_name_that_a_distribution_can_have() -> None:
    """It ends with a letter or a digit; the package and the command are named like the app."""
    project = tomllib.loads(package_of(ODD_NAMES).owned["pyproject.toml"])["project"]
    assert project["name"] == "odd"
    assert project["scripts"] == {"odd_": "odd_.__main__:main"}
    assert project["dependencies"] == []


def test_no_app_has_the_name_of_what_its_extras_bring() -> None:
    """Nor of anything that those or the compiler need: by its distribution, and as it is imported."""
    projects = (
        package_of(PLAIN).owned["pyproject.toml"],
        (ROOT / "runtime/pyproject.toml").read_text("utf-8"),  # which the first one's extras bring
    )
    extras = [tomllib.loads(text)["project"]["optional-dependencies"] for text in projects]
    compiler = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    of_compiler = compiler["optional-dependencies"]
    extras.append({name: of_compiler[name] for name in ("completion", "editor")})
    needed = [one for some in extras for extra in some.values() for one in extra]
    names = {_normal(re.split(r"[<>=\[]", one)[0]) for one in needed}
    assert {"starlette", "uvicorn", "websockets", "matplotlib", "cflib", "pytest"} <= names
    brought = _with_all_they_need(names | {"plutoc"})
    assert len(brought) > 2 * len(names)
    imported = {
        package
        for package, owners in packages_distributions().items()
        if not (package.startswith("_") or package.endswith("__mypyc"))
        and {_normal(one) for one in owners} & brought
    }
    assert {"PIL", "yaml", "usb", "jinja2"} <= imported
    every = {name.replace("-", "_") for name in brought | imported}
    assert {name for name in every if taken_app_name(name) is None} == set()


def _with_all_they_need(names: set[str]) -> set[str]:
    found: set[str] = set()
    left = {*names}
    while left:
        name = left.pop()
        with suppress(PackageNotFoundError):  # of another system, or an extra that is not here
            needed = [one for one in requires(name) or () if "extra ==" not in one]
            found.add(name)
            left |= {_normal(re.split("[^A-Za-z0-9_.-]", one)[0]) for one in needed} - found
    return found


def _normal(name: str) -> str:
    return re.sub("[-_.]+", "-", name).lower()


def test_no_app_has_the_name_of_what_builds_its_package() -> None:
    """It would be replaced by it, in the environment in which the app is installed."""
    needed = tomllib.loads(package_of(PLAIN).owned["pyproject.toml"])["build-system"]["requires"]
    assert needed and all(map(taken_app_name, needed))


SCRIPT = """
import sys
from tests.compiler.emit.test_package import ALFALFA, ODD_NAMES, package_of
for text in (ALFALFA, ODD_NAMES):
    package = package_of(text)
    print({**package.owned, **package.once})
"""


def test_output_depends_on_nothing_but_the_source(tmp_path: Path) -> None:
    """Hash seeds and folders change no byte."""
    paths = [str(ROOT), *(str(ROOT / name) for name in ("grammar", "runtime", "stdlib_blocks"))]
    outputs = set()
    for seed, folder in (("1", ROOT), ("2", tmp_path)):
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join(paths), "PYTHONHASHSEED": seed}
        done = subprocess.run(
            [sys.executable, "-c", SCRIPT],
            cwd=folder,
            env=environment,
            capture_output=True,
            check=True,
        )
        outputs.add(done.stdout)
    assert len(outputs) == 1


PLAN = plan_of(ALFALFA)
HOSTILE = (
    '"""\nimport os\n"""',
    "coding: utf-7",
    "# -*- coding: utf-7 -*-",
    "{{ 7 * 7 }}{% raw %}",
    "\\N{BULLET}",
    "'\nx = 1 #",
    "\ud800",
    "```\n# heading\n<script>alert(1)</script>",
    "]\n[tool.evil]\nx = 1",
)
MARKS = st.text("\"'\\{}#`<>\n\r\t%$;:=()[]\u2028\u202e")


def shape(text: str, title: str) -> str:
    """Return a module's syntax tree with the title, wherever it stands, left out."""
    tree = ast.parse(text.encode())
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and node.value == title:
            node.value = "TITLE"
    return ast.dump(tree)


FLOW = shape(flow_file(titled(PLAN, "TITLE")), "TITLE")
README = readme(titled(PLAN, "TITLE").checked.graph, "app.pluto", "flowchart TD").splitlines()


@pytest.mark.parametrize("title", HOSTILE)
def test_hostile_title_changes_no_finished_module(title: str) -> None:
    """Not in the bytes that Python reads, header and formatting included."""
    assert shape(owned(flow_file(titled(PLAN, title)), "app.pluto"), title) == FLOW


@given(st.one_of(st.text(), MARKS, st.sampled_from(HOSTILE)))
def test_no_title_changes_the_shape_of_a_file(title: str) -> None:
    """What a user writes in quotes stays a text in Python, TOML and Markdown."""
    plan = titled(PLAN, title)
    assert shape(flow_file(plan), title) == FLOW
    project = tomllib.loads(project_file(plan.checked.graph, "app.pluto"))
    assert list(project) == ["build-system", "project", "tool"]
    whole = one_line(title).encode(errors="replace")  # half a character is none in TOML
    described = project["project"]["description"].replace("\ufffd", "?").encode()
    assert described == (whole.replace("\ufffd".encode(), b"?") or b"alfalfa")
    lines = readme(plan.checked.graph, "app.pluto", "flowchart TD").splitlines()
    differing = [line for line in lines if line not in README]
    assert len(differing) <= 1 and all(line.startswith("**") for line in differing)


def test_title_is_in_no_other_file() -> None:
    """Two files carry it, and the README; docstrings and comments name the app."""
    title = "quite-unlikely"
    package = emit(titled(PLAN, title), source_name="app.pluto", picture="")
    texts = {**package.owned, **package.once}
    assert [path for path, text in texts.items() if title in text] == [
        "README.md",
        "pyproject.toml",
        "src/alfalfa/flow.py",
    ]
