"""Fetch CodeMirror for the graph editor's text pane: `python editors/vendor_codemirror.py`, with npm on the path.

Its packages are plain ES modules. Each is copied as it is, but for the names of its imports, which
become relative: so a browser loads them without a bundler, and without an inline import map.
"""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import tempfile
from pathlib import Path

FOLDER = Path(__file__).parents[1] / "plutoc" / "editor" / "pages" / "codemirror"

PACKAGES = {  # package: version, its ES module
    "@codemirror/autocomplete": ("6.20.4", "dist/index.js"),
    "@codemirror/commands": ("6.11.1", "dist/index.js"),
    "@codemirror/lang-python": ("6.2.1", "dist/index.js"),
    "@codemirror/language": ("6.13.1", "dist/index.js"),
    "@codemirror/lint": ("6.9.8", "dist/index.js"),
    "@codemirror/search": ("6.7.2", "dist/index.js"),
    "@codemirror/state": ("6.7.6", "dist/index.js"),
    "@codemirror/streamparser": ("6.0.0", "dist/index.js"),
    "@codemirror/view": ("6.43.15", "dist/index.js"),
    "@lezer/common": ("1.5.5", "dist/index.js"),
    "@lezer/highlight": ("1.2.5", "dist/index.js"),
    "@lezer/lr": ("1.4.12", "dist/index.js"),
    "@lezer/python": ("1.1.19", "dist/index.js"),
    "@marijn/find-cluster-break": ("1.0.4", "src/index.js"),
    "crelt": ("1.0.7", "index.js"),
    "style-mod": ("4.1.5", "src/style-mod.js"),
    "w3c-keyname": ("2.2.8", "index.js"),
}

IMPORT = re.compile(r"""^((?:import|export)\b[^'"\n]*?from\s*)(['"])([^'"\n]+)\2""", re.MULTILINE)


def file_of(package: str) -> str:
    """Return the name of a package's file: `@codemirror/state` is `codemirror-state.js`."""
    return package.removeprefix("@").replace("/", "-") + ".js"


def with_relative_imports(text: str) -> str:
    """Return a module that imports its neighbours as files beside it."""
    return IMPORT.sub(lambda found: f"{found[1]}{found[2]}./{file_of(found[3])}{found[2]}", text)


def main() -> None:
    """Fetch the pinned versions, and write them with their licences and a list of them."""
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    with tempfile.TemporaryDirectory() as folder:
        pinned = [f"{package}@{version}" for package, (version, _) in PACKAGES.items()]
        subprocess.run(
            ["npm", "install", "--ignore-scripts", "--no-audit", "--no-fund", *pinned],
            cwd=folder,
            check=True,
        )
        rows: list[str] = []
        licences: dict[str, list[str]] = {}
        for package, (version, module) in PACKAGES.items():
            place = Path(folder) / "node_modules" / package
            text = (place / module).read_text(encoding="utf-8")
            (FOLDER / file_of(package)).write_text(with_relative_imports(text), encoding="utf-8")
            licences.setdefault((place / "LICENSE").read_text(encoding="utf-8"), []).append(package)
            licence = json.loads((place / "package.json").read_text(encoding="utf-8"))["license"]
            rows.append(f"| `{file_of(package)}` | {package} | {version} | {licence} |")
        (FOLDER / "LICENSE").write_text(
            "\n\n".join(
                f"{', '.join(packages)}:\n\n{text.strip()}\n" for text, packages in licences.items()
            ),
            encoding="utf-8",
        )
    table = "\n".join(rows)
    (FOLDER / "README.md").write_text(
        "# CodeMirror\n\nThe text editor of the panes. These files are not ours and not edited:"
        " `editors/vendor_codemirror.py` fetches them,\nand changes the names of their imports"
        " alone. Licences: [LICENSE](LICENSE).\n\n| file | npm package | version | licence |\n"
        f"| --- | --- | --- | --- |\n{table}\n",
        encoding="utf-8",
    )


if __name__ == "__main__":
    main()
