"""The pages' modules, handed out as one script."""

from __future__ import annotations

import re

import pytest

from plutoc_runtime.station.one_piece import in_one_piece
from plutoc_runtime.station.static import FIRST, FOLDER

PAGES = {file.name: file.read_text("utf-8") for file in sorted(FOLDER.glob("*.js"))}


def test_all_modules_of_the_pages_can_be_put_into_one_script() -> None:
    script = in_one_piece(PAGES, FIRST)
    assert script is not None
    for name in PAGES:
        assert script.count(f'$how["{name}"]=') == 1
    assert not re.search(r"^(import|export) ", script, re.MULTILINE)


def test_what_a_module_imports_is_taken_from_the_other_and_what_it_exports_handed_on() -> None:
    modules = {
        "main.js": '// Says so.\nimport { two, three as many } from "./numbers.js";\n'
        'import * as all from "./numbers.js";\n\nconsole.log(two, many, all);\n',
        "numbers.js": "export const two = 2;\nexport async function three() {\n  return 3;\n}\n",
    }
    assert in_one_piece(modules, "main.js") == (
        "const $made={},$how={};\n"
        "const $get=(name)=>$made[name]??=$how[name]();\n"
        "const $later=async(name)=>$get(name);\n"
        '$how["main.js"]=()=>{\n'
        'const { two, three: many } = $get("numbers.js");\n'
        'const all = $get("numbers.js");\n'
        "console.log(two, many, all);\n"
        "return{};};\n"
        '$how["numbers.js"]=()=>{\n'
        "const two = 2;\nasync function three() {\nreturn 3;\n}\n"
        "return{two,three};};\n"
        '$get("main.js");\n'
    )


def test_a_module_that_is_imported_later_runs_later() -> None:
    modules = {"main.js": 'const page = () => import("./page.js");\n', "page.js": "let a = 1;\n"}
    script = in_one_piece(modules, "main.js")
    assert script is not None
    assert 'const page = () => $later("page.js");' in script
    assert '$how["page.js"]=' in script


@pytest.mark.parametrize(
    "text",
    [
        'export { one } from "./other.js";\n',
        "export default 3;\n",
        'import one from "./other.js";\n',
        "import(name);\n",
        "const where = import.meta.url;\n",
        'import { one } from "./not-there.js";\n',
        "const text = `over\n  two lines`;\n",
    ],
)
def test_where_a_form_is_not_known_there_is_no_such_script(text: str) -> None:
    assert in_one_piece({"main.js": text, "other.js": "export const one = 1;\n"}, "main.js") is None
