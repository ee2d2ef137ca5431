#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests tools/farm on this machine, and with stubs of Slurm's commands.
# Usage: test_farm_local.py CLRT
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

CLRT = str(pathlib.Path(sys.argv[1]).resolve())
ROOT = pathlib.Path(__file__).resolve().parents[2]
SMALL = [str(ROOT / "scenes/reflections.scn"), "-s", "61x43", "--tune", "tile=16x8"]
# The stubs of sbatch and scancel add a line to the log. A job's id is the number of lines.
SBATCH = '#!/bin/sh\nprintf "%s|" "$@" >>"$LOG"; echo >>"$LOG"\n[ -z "$BROKEN" ] || exit 1\nwc -l <"$LOG"\n'
STUBS = {"sbatch": SBATCH, "squeue": '#!/bin/sh\necho "$QUEUED"\n', "scancel": SBATCH}


class Tool(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.work = pathlib.Path(folder.name)
        (self.work / "bin").mkdir()
        for name, text in STUBS.items():
            (self.work / "bin" / name).write_text(text)
            (self.work / "bin" / name).chmod(0o755)
        self.log = self.work / "log"

    def run_program(self, *words, code=0, **more):
        environment = {**os.environ, "CLRT": CLRT, "PATH": f"{self.work}/bin:{os.environ['PATH']}",
                       "LOG": str(self.log), "BROKEN": "", "QUEUED": "", **more}
        done = subprocess.run(words, cwd=self.work, env=environment, text=True, errors="replace",
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertEqual(done.returncode, code, done.stdout)
        return done.stdout

    def farm(self, *words, **more):
        return self.run_program(ROOT / "tools/farm", *SMALL, *words, **more)

    def submissions(self):
        """Returns the arguments of each submission since the last call."""
        found = [line.split("|")[:-1] for line in self.log.read_text().splitlines()]
        self.log.unlink()
        return found

    def bytes_of(self, name):
        return (self.work / name).read_bytes()

    def test_parts_are_drawn_and_merged_and_only_missing_ones_again(self):
        words = ["-o", "it's 1.exr", "--parts", "3", "--on", "local"]
        folder = self.work / "it's 1.exr.farm"
        self.run_program(CLRT, *SMALL, "-o", "whole.exr")
        self.farm(*words)
        self.assertEqual(self.bytes_of("it's 1.exr"), self.bytes_of("whole.exr"))
        self.assertIn("is finished", self.farm(*words))
        (folder / "part.2.exr").unlink()
        kept = (folder / "part.1.exr").stat().st_mtime_ns
        (self.work / "it's 1.exr").unlink()
        self.farm(*words)
        self.assertEqual(self.bytes_of("it's 1.exr"), self.bytes_of("whole.exr"))
        self.assertEqual((folder / "part.1.exr").stat().st_mtime_ns, kept)

    def test_a_missing_scheduler_is_one_message(self):
        (self.work / "bin/python3").symlink_to(sys.executable)
        for engine, program in ("slurm", "sbatch"), ("parallel=a", "parallel"):
            (self.work / "bin" / program).unlink(missing_ok=True)
            told = self.farm("-o", "a.exr", "--parts", "2", "--on", engine, code=1, PATH=f"{self.work}/bin")
            self.assertEqual(told, f"tools/farm: {program} is not installed on this machine: install it, or "
                                   "give --on local\n")

    def test_another_command_does_not_mix_its_parts_in(self):
        self.farm("-o", "a.exr", "--parts", "2", "--on", "local")
        for more in ["--parts", "3"], ["--parts", "2", "--aa"]:
            self.assertIn("a.exr.farm belongs to another command", self.farm("-o", "a.exr", *more, code=1))

    def test_a_file_name_may_contain_any_characters(self):
        name = os.fsdecode(b"it's\ntouch broken\r\n\xff.exr")
        words = ["-o", name, "--parts", "2", "--on", "local"]
        self.run_program(CLRT, *SMALL, "-o", "whole.exr")
        self.farm(*words)
        self.assertEqual(self.bytes_of(name), self.bytes_of("whole.exr"))
        self.assertIn("is finished", self.farm(*words))
        self.assertFalse((self.work / "broken").exists())

    def test_changed_scripts_stay(self):
        words = ["-o", "a.exr", "--parts", "2"]
        self.farm(*words)
        script = self.work / "a.exr.farm/task.sh"
        script.write_text(script.read_text().replace("#SBATCH --requeue", "#SBATCH --requeue\n#SBATCH --partition=gpu"))
        self.farm(*words)
        self.assertIn("--partition=gpu", script.read_text())

    def test_pictures_are_the_turntable_s(self):
        for more, pattern in ((["--turntable", "7"], "a.pfm"), (["--frames", "1-6:2"], "b##.pfm"),
                              (["--turntable", "9", "--frames", "2-8"], "c#d#.pfm"),
                              (["--frames", "1-3"], ".pfm")):
            self.run_program(CLRT, *SMALL, *more, "-o", f"whole-{pattern}", "-q")
            words = [*more, "-o", pattern, "--parts", "3", "--on", "local"]
            self.farm(*words)
            names = sorted(path.name[len("whole-"):] for path in self.work.glob("whole-*"))
            for name in names:
                self.assertEqual(self.bytes_of(name), self.bytes_of(f"whole-{name}"))
            self.assertIn("is finished", self.farm(*words))
            (self.work / names[-1]).unlink()
            self.assertIn("task 3;", self.farm(*words))
            for path in self.work.glob("whole-*"):
                path.unlink()

    def test_slurm_gets_an_array_and_a_merge_that_depends_on_it(self):
        told = self.farm("-o", "a.exr", "--parts", "4")
        folder = str(self.work / "a.exr.farm")
        self.assertEqual(self.submissions(), [
            ["--parsable", f"--chdir={folder}", "--array=1-4", f"{folder}/task.sh"],
            ["--parsable", f"--chdir={folder}", "--dependency=afterok:1", "--kill-on-invalid-dep=yes",
             f"{folder}/merge.sh"]])
        self.assertIn("watch:  squeue -j 1,2; ", told)
        self.assertIn("cancel: scancel 1 2\n", told)
        script = (self.work / "a.exr.farm/task.sh").read_text()
        self.assertIn("#SBATCH --requeue\n", script)
        self.assertIn("#SBATCH --open-mode=append\n", script)
        for part in "2", "3":
            (self.work / f"a.exr.farm/part.{part}.exr").write_text("")
        self.assertEqual(self.farm("-o", "a.exr", "--parts", "4", QUEUED="1_1"),
                         "still queued or running: squeue -j 1,2\n")
        self.assertFalse(self.log.exists())
        self.farm("-o", "a.exr", "--parts", "4")
        self.assertEqual(self.submissions()[0][2], "--array=1,4")
        self.farm("-o", "a.exr", "--parts", "4", code=1, BROKEN="yes")

    def test_a_task_has_a_hundred_pictures(self):
        for number, tasks in ("100", "1"), ("101", "1-2"), ("1000", "1-10"):
            self.farm("--turntable", number, "-o", f"{number}.png")
            self.assertEqual([words[2] for words in self.submissions()], [f"--array={tasks}"])

    def test_the_commands_of_the_documentation_make_the_whole_picture(self):
        text = (ROOT / "docs/many-machines.md").read_text()
        commands = re.findall(r"clrt \S*scene.scn --part auto/8 --resume -o \S*part\$([A-Z_]+).exr", text)
        self.assertEqual(len(commands), 4)
        self.run_program(CLRT, *SMALL, "-o", "whole.exr")
        for variable in commands:
            folder = self.work / variable
            folder.mkdir()
            part = f'"$0" "$@" --part auto/8 --resume -q -o {folder}/part${variable}.exr'
            for task in range(8):
                number = task + (variable == "SLURM_ARRAY_TASK_ID")
                self.run_program("sh", "-c", part, CLRT, *SMALL, **{variable: str(number)})
            self.run_program(CLRT, "merge", *sorted(folder.glob("part*.exr")), "-o", "merged.exr")
            self.assertEqual(self.bytes_of("merged.exr"), self.bytes_of("whole.exr"))

    def test_wrong_arguments_are_refused(self):
        for words, sentence in (([], "--parts wants the number of parts"), (["--parts", "0"], "--parts wants"),
                                (["--frames", "3-2"], "--frames wants A-B or A-B:S, within the turntable"),
                                (["--turntable", "5", "--frames", "1-6"], "--frames wants"),
                                (["--parts", "2", "--on", "pbs"], "--on wants slurm, parallel=HOSTS or local"),
                                (["--turntable", "0"], "--turntable wants an integer between 1 and 1000000"),
                                (["--turntable", "-3"], "--turntable wants"),
                                (["--turntable", "1000001"], "--turntable wants"),
                                (["--parts", "2", "--exposure", "1"], "--exposure is for 8-bit files, and parts are EXR"),
                                (["--parts", "2", "--exposure=1", "-o", "a.png"], "--exposure is for"),
                                (["--turntable", "5", "-o", "a.gif"], "cannot write a GIF")):
            self.assertIn(sentence, self.farm("-o", "a.exr", *words, code=2))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=2)
