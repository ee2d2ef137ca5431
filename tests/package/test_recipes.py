#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the steps of the GitHub Action, and compares the conda recipe with the package.

usage: test_recipes.py CLRT"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

try:
    import tomllib
    import yaml
except ImportError as missing:
    print(f"skipped: {missing}; tools/setup test installs it")
    sys.exit(77)

CLRT = pathlib.Path(sys.argv[1]).resolve()
ROOT = pathlib.Path(__file__).resolve().parents[2]
ACTION = "tools/package/action"
WORKFLOW = ROOT / "docs/ci-recipe.yml"


def read(path):
    return yaml.safe_load(path.read_text())


def names_of(requirements):
    """Returns the names of packages from requirements such as "name >=1.0"."""
    return {re.match(r"[\w-]+", requirement)[0] for requirement in requirements}


class Action(unittest.TestCase):
    """The tests imitate a user's checkout, with clrt in its folder clrt. Instead of building clrt,
    tools/render starts the program CLRT, and tools/setup records its arguments."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.work = pathlib.Path(folder.name)
        (self.work / "clrt" / ACTION).mkdir(parents=True)
        (self.work / "clrt/scenes").symlink_to(ROOT / "scenes")
        self.purposes = self.work / "purposes"
        for tool, command in ("render", f'exec "{CLRT}" "$@"'), ("setup", f'echo "$@" >"{self.purposes}"'):
            path = self.work / "clrt/tools" / tool
            path.write_text(f"#!/bin/sh\n{command}\n")
            path.chmod(0o755)
        self.action = read(ROOT / ACTION / "action.yml")
        self.step = next(step for step in read(WORKFLOW)["jobs"]["picture"]["steps"]
                         if step.get("uses") == f"./clrt/{ACTION}")

    def expand(self, text, given):
        """Replaces the expressions of GitHub's language that the action uses."""
        inputs = {name: given.get(name, value.get("default"))
                  for name, value in self.action["inputs"].items()}
        values = {f"inputs.{name}": value for name, value in inputs.items()}
        values["github.action_path"] = str(self.work / "clrt" / ACTION)
        return re.sub(r"\$\{\{ *(\S+) *\}\}", lambda match: values[match[1]], text)

    def run_action(self, given):
        """Runs the action as GitHub does. Returns the first step's result, its output, and the
        path to upload."""
        self.assertEqual(given.keys() - self.action["inputs"].keys(), set())
        first, upload = self.action["runs"]["steps"]
        output = self.work / "output"
        environment = {name: self.expand(text, given) for name, text in first["env"].items()}
        done = subprocess.run(
            ["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", first["run"]],
            cwd=self.work, env={**os.environ, **environment, "GITHUB_OUTPUT": str(output)},
            capture_output=True, text=True, check=False)
        self.assertEqual(upload["if"], "always()")
        path = self.work / self.expand(upload["with"]["path"], given)
        return done, output.read_text() if output.exists() else "", path

    def test_the_workflow_renders_the_picture_of_its_hash(self):
        given = self.step["with"]
        done, output, picture = self.run_action(given)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(output, f"hash={given['hash']}\n")
        self.assertTrue(picture.read_bytes().startswith(b"\x89PNG"))

    def test_another_picture_fails_and_is_kept(self):
        done, output, picture = self.run_action({**self.step["with"], "options": "-s 64x48 --aa=2"})
        found = output.removeprefix("hash=").strip()
        self.assertEqual(done.returncode, 1)
        self.assertIn(f"the picture's hash is {found} instead of {self.step['with']['hash']}",
                      done.stdout)
        self.assertTrue(picture.exists())

    def test_any_hash_passes_without_an_expected_hash(self):
        done, output, picture = self.run_action({"scene": "clrt/scenes/cone.ply"})
        self.assertEqual(done.returncode, 0)
        self.assertRegex(output, "^hash=[0-9a-f]{32}\n$")
        self.assertEqual(picture.name, "picture.png")

    def test_it_installs_the_reader_of_meshes(self):
        self.run_action(self.step["with"])
        self.assertEqual(self.purposes.read_text(), "meshes\n")

    def test_an_error_of_clrt_fails(self):
        done, output, _ = self.run_action({"scene": "none.scn"})
        self.assertEqual((done.returncode, output), (3, ""))
        self.assertIn("none.scn", done.stderr)


class Recipe(unittest.TestCase):
    def setUp(self):
        self.recipe = read(ROOT / "tools/package/conda/recipe.yaml")
        self.project = tomllib.loads((ROOT / "pyproject.toml").read_text())

    def test_the_version_is_the_projects(self):
        version = re.search(r"project\(clrt VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())
        self.assertEqual(self.recipe["context"]["version"], version[1])

    def test_it_requires_what_the_package_requires(self):
        requirements = {kind: names_of(line for line in lines if "${{" not in line)
                        for kind, lines in self.recipe["requirements"].items()}
        self.assertLessEqual(names_of(self.project["project"]["dependencies"]), requirements["run"])
        self.assertIn("pocl-cpu-minimal", requirements["run"])
        self.assertLessEqual(names_of(self.project["build-system"]["requires"]),
                             requirements["host"])

    def test_files_of_its_tests_exist_and_have_the_hash(self):
        test = self.recipe["tests"][1]
        for name in test["files"]["source"]:
            self.assertTrue((ROOT / name).exists(), name)
        scene, = re.findall(r"scenes/\w+\.scn", test["script"][0])
        printed = subprocess.run([CLRT, ROOT / scene, "--hash"], capture_output=True, text=True,
                                 check=True).stdout.strip()
        self.assertTrue(test["script"][0].endswith(printed), printed)


unittest.main(argv=sys.argv[:1])
