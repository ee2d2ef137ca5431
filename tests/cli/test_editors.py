#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests that the syntax files of editors (tools/editors) know exactly the words of the scene parser,
# and color them by their role.
import json
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

import grammar

ROOT = pathlib.Path(__file__).resolve().parents[2]
VIM = ROOT / "tools/editors/vim"
TEXTMATE = ROOT / "tools/editors/vscode/clrt.tmLanguage.json"
# Maps Vim's groups, and the first one or two words of TextMate's scopes, to roles.
ROLES = {"clrtStatement": "statement", "clrtUnknown": "unknown", "clrtProperty": "word", "clrtConstant": "word",
         "clrtNumber": "number", "clrtString": "string", "clrtComment": "comment", "keyword": "statement",
         "invalid": "unknown", "support": "word", "constant.language": "word", "constant.numeric": "number",
         "string": "string", "comment": "comment"}
PRINT_GROUPS = """
set runtimepath^={folder}
filetype on
syntax on
edit {scene}
let groups = map(range(1, line('$')), {{_, l -> map(range(1, strlen(getline(l))),
      \\ {{_, c -> synIDattr(synID(l, c, 0), 'name')}})}})
call writefile([json_encode(groups)], '{output}')
qall!
"""


def vim_roles(text):
    """Returns the role of every character, line by line, as Vim colors the text."""
    with tempfile.TemporaryDirectory() as folder:
        scene, script, output = (pathlib.Path(folder) / name for name in ("a.scn", "a.vim", "a.json"))
        scene.write_text(text)
        script.write_text(PRINT_GROUPS.format(folder=VIM, scene=scene, output=output))
        subprocess.run(["vim", "-N", "-u", "NONE", "-i", "NONE", "-n", "-es", "-S", script], timeout=60,
                       stdin=subprocess.DEVNULL, capture_output=True)
        groups = json.loads(output.read_text())
    return [[ROLES.get(group, "") for group in line] for line in groups]


def textmate_roles(text):
    """Returns the role of every character as an editor with TextMate grammars colors the text. The leftmost
    match wins. If several patterns match at one place, the first pattern wins."""
    patterns = json.loads(TEXTMATE.read_text())["patterns"]

    def roles(line):
        result, start = [""] * len(line), 0
        while True:
            matches = [(match.start(), number, match) for number, pattern in enumerate(patterns)
                       if (match := re.compile(pattern["match"]).search(line, start))]
            if not matches:
                return result
            _, number, match = min(matches)
            name = patterns[number]["name"]
            role = ROLES.get(name.split(".")[0]) or ROLES[".".join(name.split(".")[:2])]
            result[match.start() : match.end()] = [role] * len(match[0])
            start = match.end()

    return [roles(line) for line in text.splitlines()]


EDITORS = {"TextMate": textmate_roles}
if shutil.which("vim") and "+eval" in subprocess.run(["vim", "--version"], capture_output=True, text=True).stdout:
    EDITORS["Vim"] = vim_roles
else:
    print("skipped: no Vim with +eval is installed, so only the words of its syntax file are tested")


class Words(unittest.TestCase):
    def expect_words(self, statements, others):
        self.assertEqual(sorted(statements), sorted(grammar.usages()))
        self.assertEqual(sorted(others), sorted(grammar.value_words()))

    def test_the_parsers_words_are_found(self):
        self.assertGreater(len(grammar.usages()), 10)
        self.assertLessEqual({"diffuse", "matte", "translate", "own", "two"}, grammar.value_words())

    def test_vim_has_the_parsers_words(self):
        words = {"Statement": [], "Property": [], "Constant": []}
        text = (VIM / "syntax/clrt.vim").read_text()
        for group, line in re.findall(r"^syntax keyword clrt(\w+) contained (.*)", text, re.MULTILINE):
            words[group] += line.split()
        self.expect_words(words["Statement"], words["Property"] + words["Constant"])

    def test_textmate_has_the_parsers_words(self):
        words = {"statement": [], "word": []}
        for pattern in json.loads(TEXTMATE.read_text())["patterns"]:
            if listed := re.search(r"\(\?:([a-z_-]+(?:\|[a-z_-]+)+)\)", pattern["match"]):
                words["statement" if pattern["match"].startswith("^") else "word"] += listed[1].split("|")
        self.expect_words(words["statement"], words["word"])


class Colors(unittest.TestCase):
    def expect_roles(self, text, roles):
        """Expects one role for each word. Strings and comments in the text must contain no blanks."""
        for editor, color in EDITORS.items():
            (line,) = color(text + "\n")
            found = [set(line[word.start() : word.end()]) for word in re.finditer(r"\S+", text)]
            self.assertEqual(found, [{role} for role in roles], (editor, text))

    def test_statements_and_their_words(self):
        for keyword, usage in grammar.usages().items():
            words = [word for word in re.findall(r"[\w-]+", usage)[1:] if word in grammar.value_words()]
            self.expect_roles(" ".join([keyword, *words]), ["statement", *["word" for _ in words]])
        for name in grammar.properties():
            self.expect_roles(f"define a matte {name}", ["statement", "", "word", "word"])

    def test_other_first_words_are_errors(self):
        for word in "sphear", "spheres", "sphere-x", "Sphere", "diffuse", "3":
            self.expect_roles(f"{word} 1", ["unknown", "number"])
            self.expect_roles(f"  {word} 1", ["unknown", "number"])

    def test_values(self):
        self.expect_roles("sphere 1 -2.5 .5e-3 +4.", ["statement", *["number"] * 4])
        self.expect_roles("mesh one/two.ply scale 2x", ["statement", "", "word", ""])
        self.expect_roles("mesh 3rd.ply", ["statement", ""])
        self.expect_roles('material "wax" //x', ["statement", "string", "comment"])
        self.expect_roles("\tsize 4 5 #size", ["statement", "number", "number", "comment"])
        self.expect_roles("mesh http://a#b", ["statement", ""])

    def test_comments(self):
        for text in "#sphere", "//sphere", "  //sphere", "//1":
            self.expect_roles(text, ["comment"])

    def test_no_scene_of_the_project_has_an_error(self):
        for scene in [*ROOT.glob("scenes/*.scn"), *ROOT.glob("tests/**/*.scn")]:
            if "fuzz" in scene.parts:
                continue
            for editor, color in EDITORS.items():
                for line, roles in zip(scene.read_text().splitlines(), color(scene.read_text())):
                    self.assertNotIn("unknown", roles, (editor, scene.name, line))
                    first = roles[len(line) - len(line.lstrip())] if line.strip() else "comment"
                    self.assertIn(first, ("statement", "comment"), (editor, scene.name, line))


if __name__ == "__main__":
    unittest.main(verbosity=2)
