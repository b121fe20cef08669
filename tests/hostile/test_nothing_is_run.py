"""No code of a user's is run, and nothing is unpickled."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import plutoc
import plutoc_blocks
import plutoc_grammar
import plutoc_runtime
from tests.kit import command as commands

FOLDERS = [Path(one.__path__[0]) for one in (plutoc, plutoc_runtime, plutoc_blocks, plutoc_grammar)]
MODULES = [path for folder in FOLDERS for path in sorted(folder.rglob("*.py"))]

CALLS = frozenset({"eval", "exec", "execfile", "__import__", "getoutput", "getstatusoutput"})
ATTRIBUTES = {
    "os": {"system", "popen", "execv", "execve", "execvp", "spawnv", "spawnl", "startfile"},
    "builtins": {"eval", "exec", "__import__"},
    "yaml": {"load", "unsafe_load", "full_load"},
    "subprocess": {"getoutput", "getstatusoutput"},
    "importlib": {"reload"},
}
LIBRARIES = frozenset({"pickle", "cPickle", "dill", "marshal", "shelve", "runpy", "code", "pty"})


def forbidden(tree: ast.Module) -> Iterator[tuple[int, str]]:
    """Yield what runs texts as code, or makes objects of bytes."""
    for node in ast.walk(tree):
        match node:
            case ast.Import(names=names):
                for alias in names:
                    if alias.name.partition(".")[0] in LIBRARIES:
                        yield node.lineno, alias.name
            case ast.ImportFrom(module=module, level=0) if module:
                for alias in node.names:
                    if module.partition(".")[0] in LIBRARIES:
                        yield node.lineno, module
                    elif alias.name in ATTRIBUTES.get(module, ()):
                        yield node.lineno, f"{module}.{alias.name}"
            case ast.Name(id=name) if name in CALLS:
                yield node.lineno, name
            case ast.Attribute(value=ast.Name(id=module), attr=name):
                if name in ATTRIBUTES.get(module, ()):
                    yield node.lineno, f"{module}.{name}"
            case ast.keyword(arg="shell", value=ast.Constant(value=False)):
                pass
            case ast.keyword(arg="shell"):
                yield node.value.lineno, "shell="


@pytest.mark.parametrize(
    "text",
    [
        "eval('1')",
        "x = exec",
        "import pickle",
        "from marshal import loads",
        "os.system('x')",
        "from os import system as fine",
        "subprocess.run('x', shell=True)",
        "subprocess.run('x', shell=asked)",
        "yaml.load(x)",
        "builtins.eval('1')",
    ],
)
def test_what_is_forbidden_is_found(text: str) -> None:
    """The search works."""
    assert list(forbidden(ast.parse(text)))


def test_no_module_of_ours_runs_texts() -> None:
    """Neither the compiler nor what generated packages carry along."""
    assert len(MODULES) > 200
    found = [
        (path.as_posix(), line, what)
        for path in MODULES
        for line, what in forbidden(ast.parse(path.read_bytes()))
    ]
    assert found == []


def test_hooks_are_read_and_never_run(app: Path) -> None:
    """By no command that does not fly."""
    trap = Path("hacked")
    Path("hooks.py").write_text(
        f"open({str(trap)!r}, 'w').close()\n"
        "def pollinate(drone, trip, context, *, dose): ...\n"
        "def find_blooms(mission, results): ...\n"
    )
    for command in (["check"], ["compile"], ["compile", "--add-stubs"], ["graph"]):
        assert commands.plutoc(*command, app).code == 0, command
    assert not trap.exists()


@pytest.mark.process
def test_the_folder_that_we_are_in_is_no_place_for_modules(app: Path) -> None:
    """A stranger's folder may hold a json.py, a lark.py or a plutoc_blocks.py beside the app."""
    for name in ("json", "lark", "ast", "black", "plutoc_blocks", "sitecustomize", "jinja2"):
        Path(f"{name}.py").write_text("open('hacked', 'w').close()\n")
    paths = [path for path in sys.path if path and Path(path).is_dir()]
    start = f"import sys; sys.path[:] = {paths!r}; from plutoc.cli import main; sys.exit(main())"
    done = subprocess.run(
        [sys.executable, "-P", "-c", start, "compile", app],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert not Path("hacked").exists()
