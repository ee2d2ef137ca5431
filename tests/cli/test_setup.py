#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests tools/setup, tools/render and tools/test. Stubs replace apt-get, dpkg-query, sudo, id, cmake
# and ctest. Also tests that tools without arguments or packages print one sentence. Usage: test_setup.py
import os
import pathlib
import pty
import re
import shutil
import subprocess
import tempfile
import unittest

from skips import has_terminals, leave, needs_terminal

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Imitates apt-get on a machine without /dev/pts: fails if the status goes to standard output.
APT = """#!/bin/sh
echo "$*" >>"$LOG"
case "$*" in *Status-Fd=1*) exec 3>&1 ;; esac
case "$*" in
*update*) echo "dlstatus:1:50.0:lists" >&3 ;;
*--assume-no*)
    echo "0 upgraded, 96 newly installed, 0 to remove and 0 not upgraded."
    echo "Need to get 155 MB of archives."
    echo "After this operation, 734 MB of additional disk space will be used."
    exit 1 ;;
*--download-only*) echo "dlstatus:7:42.5:Retrieving file 7 of 96" >&3; sleep "$DELAY" ;;
*Status-Fd=1*) echo "echo: I/O error"; exit 100 ;;
*) echo "pmstatus:gcc:77.1:Unpacking gcc" >&3
    [ -z "$BROKEN" ] || { echo "E: no space left"; exit 100; } ;;
esac
"""
CMAKE = """#!/bin/sh
echo "cmake $*" >>"$LOG"
case "$*" in
*--build*)
    [ ! -f build/release/clrt ] || { echo "ninja: no work to do."; exit 0; }
    mkdir -p build/release
    echo "[30/120] Building C object main.c.o"
    printf '#!/bin/sh\\nsleep "$DELAY"; echo "clrt $*"; echo "$*" >>"$LOG.clrt"; exit 3\\n' >build/release/clrt
    chmod +x build/release/clrt ;;
esac
exit 0
"""
CTEST = """#!/bin/sh
echo "1/3 Test #1: one ...   Passed 0.1 sec"
sleep "$DELAY"
printf "2/3 Test #2: two ... Failed\\n3/3 Test #3: three ...***Skipped\\n"
mkdir -p build/release/Testing/Temporary
cat >build/release/Testing/Temporary/LastTest.log <<END
1/3 Testing: one
test_it (__main__.It.test_it) ... skipped 'no terminal'
OK (skipped=1)
3/3 Testing: three
skipped: no Slurm
END
exit 8
"""
STUBS = {
    "apt-get": APT, "cmake": CMAKE, "sudo": '#!/bin/sh\n[ "$1" = -v ] || exec "$@"\n',
    "id": "#!/bin/sh\necho 1000\n", "dpkg-query": '#!/bin/sh\nprintf "$INSTALLED"\n',
    "ctest": CTEST,
}


def is_known_debian():
    text = pathlib.Path("/etc/os-release").read_text()
    return "ID=debian" in text and re.search(r'VERSION_ID="1[23]"', text)


class Setup(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.work = pathlib.Path(folder.name)
        shutil.copytree(ROOT / "tools", self.work / "tools")
        (self.work / "CMakePresets.json").write_text("{}")
        os.utime(self.work / "CMakePresets.json", (0, 0))
        (self.work / "bin").mkdir()
        for name, text in STUBS.items():
            (self.work / "bin" / name).write_text(text)
            (self.work / "bin" / name).chmod(0o755)
        self.environment = {**os.environ, "PATH": f"{self.work}/bin:{os.environ['PATH']}", "TERM": "xterm",
                            "LOG": str(self.work / "log"), "INSTALLED": "", "BROKEN": "", "DELAY": "0"}

    def run_tool(self, *words, code=0, **settings):
        """Runs a tool without a terminal and returns its output."""
        done = subprocess.run(words, cwd=self.work, env={**self.environment, **settings}, text=True,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertEqual(done.returncode, code, done.stdout)
        return done.stdout

    def run_on_terminal(self, *words, code=0, **settings):
        """Runs a tool on a terminal and returns its output."""
        ours, theirs = pty.openpty()
        process = subprocess.Popen(words, cwd=self.work, env={**self.environment, **settings}, stdin=theirs,
                                   stdout=theirs, stderr=theirs)
        os.close(theirs)
        output = b""
        try:
            while part := os.read(ours, 4096):
                output += part
        except OSError:  # the terminal's other side is closed
            pass
        os.close(ours)
        self.assertEqual(process.wait(), code, output)
        return output.decode()

    def runs(self):
        return (self.run_tool, self.run_on_terminal) if has_terminals() else (self.run_tool,)

    def log(self):
        return (self.work / "log").read_text()

    def test_a_picture_needs_neither_assimp_nor_the_window_nor_openimageio(self):
        self.run_tool("tools/setup", "picture")
        self.assertIn("pocl-opencl-icd", self.log())
        for package in "assimp", "glfw", "openimageio", "g++", "cmocka":
            self.assertNotIn(package, self.log())

    def test_each_purpose_adds_its_packages(self):
        for purpose, package in (("window", "libglfw3-dev"), ("meshes", "libassimp-dev"),
                                 ("images", "libopenimageio-dev"), ("test", "libcmocka-dev"),
                                 ("package", "dpkg-dev file"), ("farm", "slurmctld"),
                                 ("emulated", "qemu-user-static")):
            self.assertIn(package, self.run_tool("tools/setup", purpose))
        self.assertIn("libassimp-dev", self.run_tool("tools/setup"))
        self.assertIn("use picture, window", self.run_tool("tools/setup", "pictures", code=1))

    def test_packages_are_named_with_reasons_sizes_and_durations(self):
        told = self.run_tool("tools/setup", "picture", INSTALLED="gcc installed\\ncmake installed\\n")
        self.assertIn("  to build clrt: ninja-build libc6-dev pkgconf\n", told)
        self.assertIn("\n96 packages with their dependencies, 155 MB to download, 734 MB on the disk\n", told)
        self.assertRegex(told, r"\ndownload: done in \d+ s; next: installation\n")
        self.assertNotRegex(told, "[\r\x1b]")

    def hasten(self):
        """Makes tools print progress lines every 2 s instead of every 15 s if there is no terminal."""
        steps = self.work / "tools/steps.sh"
        text = steps.read_text()
        self.assertIn("period=14", text)
        steps.write_text(text.replace("period=14", "period=1"))

    def test_without_a_terminal_a_line_follows_each_silence(self):
        self.hasten()
        told = self.run_tool("tools/setup", "picture", DELAY="2.5")
        self.assertRegex(told, r"(?m)^download, 42 %, [12] s$")
        told = self.run_tool("tools/render", "a.scn", code=3, DELAY="2.5")
        self.assertRegex(told, r"(?m)^picture, [12] s\n(.*\n)*clrt a.scn$")
        told = self.run_tool("tools/test", code=8, DELAY="2.5")
        self.assertRegex(told, r"(?m)sec\ntests, 33 %, [12] s\n(.*\n)*2/3 Test")
        self.assertNotRegex(told, "[\r\x1b]")

    @needs_terminal
    def test_a_terminal_shows_progress_every_second(self):
        told = self.run_on_terminal("tools/setup", "picture", DELAY="2.5")
        self.assertIn("\r\x1b[Kdownload, 42 %, 2 s", told)
        self.assertRegex(told, r"\r\x1b\[Kdownload: done in [23] s; next: installation\r\n")

    def test_installed_packages_are_not_mentioned(self):
        packages = "cmake ninja-build gcc libc6-dev pkgconf pocl-opencl-icd ocl-icd-opencl-dev libpng-dev " \
                   "libjansson-dev libxxhash-dev libopenexr-dev libdeflate-dev"
        installed = "".join(f"{package} installed\\n" for package in packages.split())
        self.assertEqual(self.run_tool("tools/setup", "picture", INSTALLED=installed), "")

    def test_failures_show_the_output(self):
        for run in self.runs():
            self.assertIn("E: no space left", run("tools/setup", "picture", code=1, BROKEN="yes"))

    @needs_terminal
    def test_render_names_the_program_once(self):
        told = self.run_on_terminal("tools/render", "a.scn", "-o", "a b.png", code=3)
        self.assertRegex(told, r"\r\x1b\[Kbuild, 25 %, \d+ s")
        self.assertRegex(told, r"build: done in \d+ s; next: kernels\r\n")
        self.assertRegex(told, r"kernels: done in \d+ s; next: picture\r\nclrt a.scn -o a b.png\r\n")
        self.assertEqual("warm\na.scn -o a b.png\n", (self.work / "log.clrt").read_text())
        self.assertTrue(told.endswith("From now on, run build/release/clrt.\r\n"), told)
        packages = "".join(f"{name} installed\\n" for name in re.findall(r"[a-z0-9-]+", APT + self.log()))
        told = self.run_tool("tools/render", "b.scn", code=3, INSTALLED=packages)
        self.assertEqual(told, "clrt b.scn\n")

    def test_test_shows_each_test_and_exits_as_ctest(self):
        for run in self.runs():
            told = run("tools/test", code=8)
            self.assertIn("1/3 Test #1: one ...   Passed 0.1 sec", told)
            self.assertIn("one: test_it (__main__.It.test_it) ... skipped 'no terminal'", told)
            self.assertRegex(told, r"(?m)^three: skipped: no Slurm\r?$")
            self.assertNotIn("OK (", told)
            self.assertEqual("build: done in " in told, run == self.run_tool)  # the second run has no work


class OtherTools(unittest.TestCase):
    def test_tools_without_arguments_or_packages_print_one_sentence(self):
        for words in ["tools/balance"], ["python3", "-I", "-S", "tools/bench_rays"]:
            done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), done.stderr)


if __name__ == "__main__":
    if not is_known_debian():
        leave("tools/setup knows Debian 12 and 13")
    unittest.main(verbosity=2)
