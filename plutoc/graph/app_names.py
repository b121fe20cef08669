"""Which names an app cannot have, since its package and its command are named like it.

Installed beside the package of that name it would stand in its way, replace it, or be taken for it:
pip knows no two distributions of one name, and Python imports some modules whenever it starts.
"""

from __future__ import annotations

import re
import sys

_STARTS_PYTHON = frozenset(
    {
        *("sitecustomize", "usercustomize"),  # imported at each start
        *("python", "python2", "python3", "pythonw", "py", "pypy", "pypy3", "activate", "pydoc3"),
        *("distutils_hack", "distutils_precedence", "virtualenv"),
    }
)
"""Modules that Python imports by itself, and commands that start it or lead into an environment."""

_INSTALLS = frozenset(
    {
        *("pip", "pip2", "pip3", "pipx", "uv", "uvx", "wheel", "easy_install", "installer"),
        *("setuptools", "setuptools_scm", "distribute", "pkg_resources", "twine", "editables"),
        *("hatch", "hatchling", "trove_classifiers", "pathspec", "calver", "tomli", "tomllib"),
        *("flit", "flit_core", "flit_scm", "hatch_vcs", "pdm", "pdm_backend", "poetry"),
        *("poetry_core", "maturin", "scikit_build_core", "meson_python", "mesonpy", "cython"),
        *("conda", "mamba", "pipenv", "tox", "nox", "pyproject_hooks", "pyproject_api"),
        *("certifi", "distlib", "distro", "filelock", "platformdirs", "resolvelib", "truststore"),
        *("build", "setup"),
    }
)
"""What builds and installs packages, the generated one included, and what that needs."""

_NEEDED = frozenset(
    {
        *("cflib", "starlette", "uvicorn", "websockets", "pytest", "matplotlib", "numpy", "scipy"),
        *("msgspec", "tomlkit", "shapely"),  # what flies needs, and areas
        *("markdown_it", "markdown_it_py", "mdurl", "rich"),  # and its tables
        *("anyio", "click", "h11", "idna", "sniffio", "typing_extensions"),  # a station needs these
        *("lz4", "mcap", "zstandard"),  # and these for its exports
        *("examples", "libusb_package", "lpslib", "packaging", "pyusb", "pyyaml", "sys_test"),
        *("importlib_resources", "tools", "usb", "yaml"),  # to here cflib
        *("fastcrc", "lxml", "mavsdk", "pymavlink"),  # to fly MAVLink vehicles
        *("contourpy", "cycler", "dateutil", "fonttools", "kiwisolver", "mpl_toolkits", "pil"),
        *("pillow", "pylab", "pyparsing", "python_dateutil", "six", "tzdata"),  # to here plots
        *("colorama", "exceptiongroup", "iniconfig", "pluggy", "pygments"),  # and pytest these
        *("black", "blackd", "blib2to3", "jinja2", "lark", "markupsafe", "mypy_extensions"),
        *("networkx", "pytokens"),  # the compiler, which is often installed beside its apps
        *("argcomplete", "attr", "attrs", "cattr", "cattrs", "lsprotocol", "pygls", "watchfiles"),
    }
)
"""What the extras of a generated package bring, by distribution and by module, and the compiler needs."""

_OURS = frozenset(
    {
        *("pluto", "plutoc", "plutoc_runtime", "plutoc_blocks", "plutoc_grammar", "pluto_fleet"),
        *("src", "tests", "test", "docs", "dist", "conftest"),
    }
)
"""Our own packages, and folders and files that a generated package stands beside."""

_OF_SOME_PYTHONS = frozenset(
    {
        *("aifc", "asynchat", "asyncore", "audioop", "cgi", "cgitb", "chunk", "crypt"),
        *("distutils", "imghdr", "imp", "lib2to3", "mailcap", "msilib", "nis", "nntplib"),
        *("ossaudiodev", "pipes", "smtpd", "sndhdr", "spwd", "sunau", "telnetlib", "uu", "xdrlib"),
        *("annotationlib", "compression"),
    }
)
"""Modules of Python's that some of the versions have on which an app can run, and others have not."""

_DEVICES = frozenset(
    {"con", "prn", "aux", "nul"}
    | {f"{port}{number}" for port in ("com", "lpt") for number in range(10)}
)
"""Names that Windows keeps for devices: no folder can have them."""

_SEPARATORS = re.compile(r"[-_.]+")


def taken_app_name(name: str) -> str | None:
    """Say what has that name already, for an app, whose name is its package's."""
    lower = name.lower()
    same = _SEPARATORS.sub("_", lower).strip("_")  # as installers compare: `Pip_` installs as pip
    if lower in sys.stdlib_module_names or lower in _OF_SOME_PYTHONS:
        return "a module of Python's standard library"
    if same in _STARTS_PYTHON:
        return "what starts Python, or runs whenever it starts"
    if same in _INSTALLS:
        return "what builds or installs packages"
    if same in _NEEDED or same in _OURS:
        return "a package or folder that a generated app needs"
    return "a device on Windows" if lower in _DEVICES else None
