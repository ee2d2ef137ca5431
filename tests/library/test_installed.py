#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests libclrt in an installed tree. Programs built with pkg-config and with CMake draw the same
# picture as clrt. Valgrind finds no leaks. The library exports only the functions of its header.
# Usage: test_installed.py CLRT BUILD_FOLDER C_COMPILER CMAKE_GENERATOR
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

CLRT, BUILD = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
COMPILER, GENERATOR = sys.argv[3:5]
TESTS = pathlib.Path(__file__).resolve().parents[1]
EXAMPLE = TESTS / "library/picture.c"
STRICT = ["-Wall", "-Wextra", "-Wpedantic", "-Werror"]

# The scene of the example tests/library/picture.c.
SCENE = """
light 4 -2 6 0.9
camera 3 -5 3 0 0 0 45
material 2
sphere 0 0 1 1
material 3
ply_file ground.ply
"""
GROUND = """ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
element face 2
property list uchar int vertex_indices
end_header
-3 -3 0
3 -3 0
3 3 0
-3 3 0
3 0 1 2
3 0 2 3
"""

PROJECT = """
cmake_minimum_required(VERSION 3.25)
project(example LANGUAGES C)
find_package(clrt 0.1 REQUIRED)
add_executable(picture picture.c)
target_link_libraries(picture PRIVATE clrt::clrt)
"""

# Functions that a library must not call in its host program.
FORBIDDEN = (
    r"_?exit|quick_exit|abort|raise|f?puts|put(char|s)|(__)?v?f?printf(_chk)?|perror|fputc|fwrite|"
    r"(un)?setenv|putenv|clearenv|setlocale|signal|sigaction|sigprocmask|pthread_sigmask|atexit|"
    r"fork|vfork|system|chdir|umask|srand"
)


def run(*words, **settings):
    words = [str(word) for word in words]
    done = subprocess.run(words, capture_output=True, **settings)
    if done.returncode != 0:
        raise AssertionError(f"{words} ended with {done.returncode}:\n{done.stderr.decode()}")
    return done.stdout


def text_of(*words, **settings):
    return run(*words, **settings).decode()


def dynamic_symbols(library, which):
    lines = text_of("nm", "-D", which, library).splitlines()
    return {line.split()[-1].split("@")[0] for line in lines if not line.endswith(" A CLRT_0")}


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.work = pathlib.Path(cls.folder.name)
        cls.prefix = cls.work / "installed"
        cls.cache = cls.work / "cache"
        run("cmake", "--install", BUILD, "--prefix", cls.prefix)
        (pc,) = cls.prefix.rglob("clrt.pc")
        cls.libraries = pc.parents[1]
        cls.library = cls.libraries / "libclrt.so"
        cls.environment = {**os.environ, "PKG_CONFIG_PATH": str(pc.parent), "LD_LIBRARY_PATH": str(cls.libraries)}
        cls.expected = cls.draw_with_the_program("320x240")

    @classmethod
    def draw_with_the_program(cls, size):
        (cls.work / "picture.scn").write_text(SCENE)
        (cls.work / "ground.ply").write_text(GROUND)
        picture = cls.work / "picture.pfm"
        run(CLRT, cls.work / "picture.scn", "-q", "--error", "1%", "-s", size, "-o", picture)
        return picture.read_bytes()

    def build_by_pkg_config(self, program, *options, source=EXAMPLE):
        flags = text_of("pkg-config", "--cflags", "--libs", "clrt", env=self.environment).split()
        run(COMPILER, *options, source, "-o", program, *flags)

    def test_pkg_config_builds_the_example_and_its_picture_is_the_programs(self):
        program = self.work / "by-pkg-config"
        self.build_by_pkg_config(program, "-std=c99", *STRICT)
        self.assertEqual(run(program, env=self.environment), self.expected)

    def test_the_example_lists_devices_meets_its_goal_and_explains_a_pixel(self):
        program = self.work / "talking"
        self.build_by_pkg_config(program)
        printed = subprocess.run([program], capture_output=True, check=True, env=self.environment).stderr.decode()
        self.assertRegex(printed, r"(?m)^device \d+:\d+: \S")
        (error,) = re.findall(r"error at most (\S+) after", printed)
        self.assertLessEqual(float(error), 0.01)
        (depth,) = re.findall(r"center at depth (\S+)", printed)
        (point,) = re.findall(r"ray 0: primitive 0 at (\S+ \S+ \S+), weight 1", printed)
        x, y, z = map(float, point.split())
        self.assertAlmostEqual(x * x + y * y + (z - 1) ** 2, 1, delta=0.01)
        # The camera looks along -(3, -5, 3) from (3, -5, 3).
        self.assertAlmostEqual((3 * (3 - x) + 5 * (5 + y) + 3 * (3 - z)) / 43 ** 0.5, float(depth), delta=0.01)

    def build_small_example(self, program):
        """Builds the example with a smaller picture and kernels that compile in half the time. Returns the
        picture that the program should print."""
        text, source = EXAMPLE.read_text(), self.work / "small.c"
        pairs = "&(ClrtSettings){.size = sizeof(ClrtSettings), .kernel = CLRT_KERNEL_PAIR}"
        for old, new in (("WIDTH = 320, HEIGHT = 240", "WIDTH = 80, HEIGHT = 60"),
                         ("clrt_renderer_create(NULL", f"clrt_renderer_create({pairs}")):
            self.assertIn(old, text)
            text = text.replace(old, new)
        source.write_text(text)
        self.build_by_pkg_config(program, "-g", source=source)
        return self.draw_with_the_program("80x60")

    def private_environment(self):
        """Returns the environment of the tests that share self.cache. Valgrind's virtual processor has no
        AVX-512, so the kernels are for AVX2 or SSE2. HOME is /proc, where not even root can create a folder."""
        hidden = ("POCL_CACHE_DIR", "XDG_CACHE_HOME", "POCL_WORK_GROUP_SPECIALIZATION")
        target = "avx2" if " avx2 " in pathlib.Path("/proc/cpuinfo").read_text() else "sse2"
        return {**{k: v for k, v in self.environment.items() if k not in hidden},
                "HOME": "/proc", "POCL_KERNELLIB_NAME": target}

    # This is one test, because compiling the example's kernels takes long. At first, PoCL has no cache.
    def test_kernels_lie_in_the_chosen_folder_and_a_damaged_one_is_compiled_again(self):
        program, home = self.work / "cached", self.work / "home"
        expected = self.build_small_example(program)
        environment = self.private_environment()
        failed = subprocess.run([program], capture_output=True, env=environment)
        self.assertNotEqual(failed.returncode, 0)
        self.assertIn(b"set POCL_CACHE_DIR to a folder", failed.stderr)

        environment["POCL_CACHE_DIR"] = str(self.cache)
        self.assertEqual(run(program, env={**environment, "XDG_CACHE_HOME": str(home)}), expected)
        sizes = {kernel: kernel.stat().st_size for kernel in self.cache.glob("clrt/*.bin")}
        self.assertGreater(len(sizes), 0)
        self.assertFalse((home / "clrt").exists())

        smallest = min(sizes, key=sizes.get)
        os.truncate(smallest, 5000)
        self.assertEqual(run(program, env=environment), expected)
        self.assertAlmostEqual(smallest.stat().st_size, sizes[smallest], delta=1000)  # binaries contain paths

    def test_cmake_builds_the_example_and_its_picture_is_the_programs(self):
        source, build = self.work / "source", self.work / "build"
        source.mkdir()
        shutil.copy(EXAMPLE, source)
        (source / "CMakeLists.txt").write_text(PROJECT)
        # A make that always fails stands for a machine without make.
        broken = self.work / "broken"
        broken.mkdir()
        for name in "make", "gmake":
            (broken / name).write_text("#!/bin/sh\nexit 1\n")
            (broken / name).chmod(0o755)
        environment = {**os.environ, "PATH": f"{broken}:{os.environ['PATH']}"}
        run("cmake", "-G", GENERATOR, "-S", source, "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}",
            f"-DCMAKE_C_COMPILER={COMPILER}", env=environment)
        run("cmake", "--build", build)
        self.assertEqual(run(build / "picture"), self.expected)

    def test_the_docs_show_the_example(self):
        code = EXAMPLE.read_text().split("\n", 1)[1]
        self.assertIn(f"```c\n{code}```\n", (TESTS.parent / "docs/library.md").read_text())

    def test_the_library_has_the_version_of_pkg_config(self):
        version = text_of("pkg-config", "--modversion", "clrt", env=self.environment).strip()
        self.assertEqual(text_of(CLRT, "--version").split()[-1], version)
        self.assertEqual(self.library.resolve().name, f"libclrt.so.{version}")

    def test_the_library_exports_only_the_functions_of_its_header(self):
        header = (self.prefix / "include/clrt.h").read_text()
        declared = set(re.findall(r"^CLRT_API [^(;]*?(\w+)\(", header, re.MULTILINE))
        self.assertGreater(len(declared), 10)
        self.assertEqual(dynamic_symbols(self.library, "--defined-only"), declared)

    def test_the_library_never_prints_exits_or_changes_the_environment(self):
        called = dynamic_symbols(self.library, "--undefined-only")
        self.assertIn("clBuildProgram", called)
        self.assertEqual([name for name in called if re.fullmatch(FORBIDDEN, name)], [])

    def test_the_librarys_name_has_the_version_of_its_interface(self):
        self.assertRegex(text_of("readelf", "-d", self.library), r"SONAME.*\[libclrt\.so\.0\]")

    def test_cplusplus_reads_the_header(self):
        compiler = shutil.which("c++")
        if compiler is None:
            self.skipTest("no C++ compiler is installed")
        source = self.work / "header.cpp"
        source.write_text("#include <clrt.h>\nint main() { return clrt_version() == nullptr; }\n")
        run(compiler, "-std=c++11", *STRICT, f"-I{self.prefix}/include", source, "-o",
            self.work / "header", f"-L{self.libraries}", "-lclrt")

    def test_valgrind_finds_no_fault_and_no_leak_of_ours(self):
        if shutil.which("valgrind") is None:
            self.skipTest("valgrind is not installed")
        program = self.work / "for-valgrind"
        expected = self.build_small_example(program)
        # Valgrind is fifty times as slow, so the first run compiles kernels without valgrind.
        environment = {**self.private_environment(), "POCL_CACHE_DIR": str(self.cache)}
        options = ["--error-exitcode=9", "--leak-check=full", f"--suppressions={TESTS / 'memory/drivers.supp'}"]
        self.assertEqual(run(program, env=environment), expected)
        self.assertEqual(run("valgrind", "-q", *options, program, env=environment), expected)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v"])
