"""No code of a user's is run, and nothing is unpickled that others could have written."""

from __future__ import annotations

import ast
import os
import pickle
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import plutoc
import plutoc_blocks
import plutoc_grammar
import plutoc_runtime
from plutoc.cache import cache_file
from plutoc.syntax.grammar import parser
from tests.cli.conftest import APP, Call

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


def test_hooks_are_read_and_never_run(plutoc: Call, app: Path) -> None:
    """By no command that does not fly."""
    trap = Path("hacked")
    Path("hooks.py").write_text(
        f"open({str(trap)!r}, 'w').close()\n"
        "def pollinate(drone, trip, context, *, dose): ...\n"
        "def find_blooms(mission, results): ...\n"
    )
    for command in (["check"], ["compile"], ["compile", "--add-stubs"], ["graph"]):
        assert plutoc(*command, app).code == 0, command
    assert not trap.exists()


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


class Trap:
    """Makes a file when it is unpickled."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def __reduce__(self) -> tuple[object, tuple[str, str]]:
        return open, (str(self.path), "w")


@pytest.fixture
def broken(app: Path) -> Path:
    """An app with a mistake: a sound one takes no parser that is kept anywhere."""
    text = app.read_text(encoding="utf-8")
    app.write_text(text.replace("{", "{\n  a = = b", 1), encoding="utf-8")
    return app


def check_with_cache(home: Path, app: Path, code: int = 0) -> None:
    """Check an app in a process of its own, with this cache folder."""
    environment = {**os.environ, "XDG_CACHE_HOME": str(home)}
    environment["PYTHONPATH"] = os.pathsep.join(path for path in sys.path if path)
    done = subprocess.run(
        [sys.executable, "-m", "plutoc", "check", app],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == code, done.stderr


def poison_parser(kept: Path, trap: Path) -> bytes:
    """Write a trap in the place of the parser, with the digest that belongs to it."""
    poison = pickle.dumps(Trap(trap))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("plutoc.syntax.grammar.kept", lambda *_: None)
        patch.setattr("plutoc.syntax.grammar.cache_file", lambda _: kept)
        patch.setattr("lark.Lark.save", lambda _, file: file.write(poison))
        parser.__wrapped__()
    poisoned = kept.read_bytes()
    assert poisoned.endswith(poison)
    return poisoned


@pytest.mark.parametrize(
    "poison", ["folder for all", "folder is a link", "file for all", "file is a link", "a folder"]
)
def test_no_parser_is_unpickled_that_others_could_have_written(
    tmp_path: Path, broken: Path, poison: str
) -> None:
    """What is made of it all the same is a right answer, and the poison has not run."""
    home, trap, elsewhere = tmp_path / "cache", tmp_path / "hacked", tmp_path / "elsewhere"
    home.mkdir()
    elsewhere.mkdir()
    check_with_cache(home, broken, code=1)
    (kept,) = (path for path in (home / "pluto").iterdir() if path.is_file())
    assert kept.stat().st_mode & 0o777 == 0o600
    poisoned = poison_parser(kept, trap)
    if poison == "folder for all":
        kept.parent.chmod(0o777)
    elif poison == "folder is a link":
        kept.parent.rename(elsewhere / "pluto")
        (home / "pluto").symlink_to(elsewhere / "pluto")
    elif poison == "file for all":
        kept.chmod(0o664)
    elif poison == "file is a link":
        kept.rename(elsewhere / "poison")
        kept.symlink_to(elsewhere / "poison")
    else:
        kept.unlink()
        kept.mkdir()
    check_with_cache(home, broken, code=1)
    assert not trap.exists()
    if poison == "file is a link":
        assert (elsewhere / "poison").read_bytes() == poisoned
        assert not kept.is_symlink()


def test_the_trap_works(tmp_path: Path, broken: Path) -> None:
    """The same poison in a file of the user's own would run: it is the file that must be theirs."""
    check_with_cache(tmp_path, broken, code=1)
    (kept,) = (path for path in (tmp_path / "pluto").iterdir() if path.is_file())
    trap = tmp_path / "hacked"
    poison_parser(kept, trap)
    check_with_cache(tmp_path, broken, code=70)
    assert trap.exists()


@pytest.mark.skipif(not hasattr(os, "getuid") or os.getuid() != 0, reason="only root can give away")
@pytest.mark.parametrize("what", ["folder", "file"])
def test_what_belongs_to_another_user_is_not_used(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, what: str
) -> None:
    """Even if its mode is right."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    file = cache_file("kept")
    assert file is not None
    file.write_bytes(b"poison")
    file.chmod(0o600)
    os.chown(file if what == "file" else file.parent, 12345, 12345)
    if what == "folder":
        assert cache_file("kept") is None
    else:
        assert cache_file("kept") == file
        assert not file.exists()


def test_an_app_is_read_the_same_with_no_home_at_all(
    plutoc: Call, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """No cache is no error."""
    monkeypatch.setenv("XDG_CACHE_HOME", "/dev/null/nowhere")
    assert cache_file("kept") is None
    Path("crop.pluto").write_text(APP)
    assert plutoc("check", "crop.pluto").code == 0
    parser.cache_clear()
    Path("crop.pluto").write_text(APP + "}")
    assert plutoc("check", "crop.pluto").code == 1
