#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests the files of an installation and of the Debian packages, and the licenses of all files.
# Usage: test_package.py CLRT BUILD_FOLDER
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "cli"))

from work import has_private_disks  # noqa: E402

CLRT, BUILD = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENE = "share/doc/clrt/examples/reflections.scn"
INSTALLED = [
    "bin/clrt",
    "libexec/clrt/clrt-foreign",
    "share/bash-completion/completions/clrt",
    "share/clrt/check.schema.json",
    "share/clrt/compare.schema.json",
    "share/clrt/devices.schema.json",
    "share/clrt/explanation-scene.schema.json",
    "share/clrt/explanation.schema.json",
    "share/clrt/statistics.schema.json",
    "share/doc/clrt/copyright",
    "share/doc/clrt/changelog.gz",
    SCENE,
    "share/fish/vendor_completions.d/clrt.fish",
    "share/man/man1/clrt.1.gz",
    "share/man/man5/clrt-scene.5.gz",
    "share/vim/vimfiles/ftdetect/clrt.vim",
    "share/vim/vimfiles/syntax/clrt.vim",
    "share/zsh/site-functions/_clrt",
]
CACHE = (BUILD / "CMakeCache.txt").read_text()
LIBRARY = ["libclrt0", "libclrt-dev"] if "CLRT_WITH_LIBRARY:BOOL=ON" in CACHE else []
DEVELOPMENT = [
    "include/clrt.h",
    "cmake/clrt/clrtConfig.cmake",
    "libclrt.so",
    "pkgconfig/clrt.pc",
    "doc/clrt/examples/picture.c",
]
# lintian expects libraries in the architecture's folder, which CMake uses only if the prefix is /usr.
LINTIAN = ["lintian", "--fail-on", "error,warning"]
if "CMAKE_INSTALL_LIBDIR:PATH=lib\n" in CACHE:
    LINTIAN += ["--suppress-tags", "pkg-config-unavailable-for-cross-compilation"]


def run(*words, **settings):
    words = [str(word) for word in words]
    return subprocess.run(words, capture_output=True, text=True, check=True, **settings).stdout


def files_under(folder):
    return sorted(str(file.relative_to(folder)) for file in folder.rglob("*") if file.is_file())


def is_here(*programs):
    return all(map(shutil.which, programs))


@unittest.skipUnless(is_here("cpack", "dpkg-deb", "dpkg-shlibdeps"), "Debian's packaging tools are not installed")
class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        work = pathlib.Path(cls.folder.name)
        run("cpack", "-G", "DEB", "-B", work / "made", "--config", BUILD / "CPackConfig.cmake")
        cls.packages = {file.name.split("_")[0]: file for file in (work / "made").glob("*.deb")}
        cls.package = cls.packages["clrt"]
        cls.root = work / "root"
        run("dpkg-deb", "-x", cls.package, cls.root)
        cls.clrt = cls.root / "usr/bin/clrt"
        cls.library_root = work / "library_root"
        for name in LIBRARY:
            run("dpkg-deb", "-x", cls.packages[name], cls.library_root)

    def test_the_package_contains_all_installed_files(self):
        for name in INSTALLED:
            self.assertTrue((self.root / "usr" / name).is_file(), name)

    @unittest.skipUnless(LIBRARY, "the library is not built")
    def test_the_library_and_its_development_files_are_separate_packages(self):
        self.assertEqual(set(self.packages), {"clrt", *LIBRARY})
        for name in DEVELOPMENT:
            self.assertEqual(len(list((self.library_root / "usr").rglob(name))), 1, name)
            self.assertEqual(len(list((self.root / "usr").rglob(name))), 0, name)
        depends = run("dpkg-deb", "-f", self.packages["libclrt-dev"], "Depends")
        self.assertRegex(depends, r"^libclrt0 \(= [\w.-]+\)\n$")

    def test_cmake_installs_the_same_files(self):
        with tempfile.TemporaryDirectory() as prefix:
            run("cmake", "--install", BUILD, "--prefix", prefix)
            installed = files_under(pathlib.Path(prefix))
        packed = files_under(self.root / "usr") + [
            name for name in files_under(self.library_root / "usr")
            if not re.match(r"share/(doc|lintian/overrides)/libclrt", name)  # added for Debian
        ]
        without_folder = [
            sorted(re.sub(r"^lib/.*/", "lib/", name) for name in names)
            for names in (installed, packed)
        ]
        self.assertEqual(*without_folder)

    def test_they_name_the_maintainer_of_the_builds_settings(self):
        told = re.search(r"CLRT_MAINTAINER:STRING=(.*)\n", CACHE)[1]
        for package in self.packages.values():
            self.assertEqual(run("dpkg-deb", "-f", package, "Maintainer"), told + "\n")

    def test_only_the_program_runs_scripts_when_it_is_installed(self):
        more = {"clrt": ["postinst", "prerm"], "libclrt0": ["shlibs", "triggers"]}
        for name, package in self.packages.items():
            data = more.get(name, [])
            with tempfile.TemporaryDirectory() as control:
                run("dpkg-deb", "-e", package, control)
                self.assertEqual(files_under(pathlib.Path(control)), ["control", "md5sums"] + data)

    @unittest.skipUnless(has_private_disks(), "only root outside of a chroot can mount disks")
    def test_the_first_picture_after_installation_needs_no_compiler(self):
        with tempfile.TemporaryDirectory() as work:
            run("dpkg-deb", "-e", self.package, f"{work}/control")
            script = f"""mount -t tmpfs none /var/cache && {work}/control/postinst configure
                clrt warm && {work}/control/prerm remove && ls /var/cache"""
            environment = {**os.environ, "XDG_CACHE_HOME": f"{work}/cache",
                           "PATH": f"{self.clrt.parent}:{os.environ['PATH']}"}
            environment.pop("POCL_CACHE_DIR", None)
            text = run("unshare", "-m", "sh", "-ec", script, env=environment)
            self.assertRegex(text, r"^general kernels, .* already compiled, ready in 0\.\d\d s\n$")

    def test_they_depend_on_their_libraries_and_on_an_opencl_driver(self):
        common = ["pocl-opencl-icd | opencl-icd", "libc6", "libxxhash0", "ocl-icd-libopencl1"]
        for package in ["clrt", *LIBRARY[:1]]:
            depends = run("dpkg-deb", "-f", self.packages[package], "Depends")
            own = ["libdeflate0", "libjansson4", "libopenexr-3-1-30", "libpng16-16"] if package == "clrt" else []
            for name in common + own:
                self.assertIn(name, depends)

    @unittest.skipUnless(is_here("lintian"), "lintian is not installed")
    def test_lintian_accepts_them(self):
        done = subprocess.run(
            [*LINTIAN, *self.packages.values()], capture_output=True, text=True
        )
        self.assertEqual((done.stdout, done.returncode), ("", 0))

    def test_it_draws_the_builds_picture_without_a_writable_home(self):
        formats = re.search(r"writes (.*)", subprocess.run(
            [self.clrt, "a", "-o", "a.none"], capture_output=True, text=True
        ).stderr)[1].split(", ")
        homeless = {**os.environ, "HOME": "/proc", "XDG_CACHE_HOME": "/proc"}
        homeless.pop("POCL_CACHE_DIR", None)
        with tempfile.TemporaryDirectory() as work:
            # clrt writes png and exr itself, and clrt-foreign writes tif. Without a home, each picture compiles.
            for ending in {"png", "exr", "tif"}.intersection(formats):
                pictures = [f"{work}/{whose}.{ending}" for whose in ("package", "build")]
                scene = [self.root / "usr" / SCENE, "-s", "24x16", "-q", "-o"]
                run(self.clrt, *scene, pictures[0], env=homeless if ending == "png" else None)
                run(CLRT, *scene, pictures[1])
                package, build = (pathlib.Path(picture).read_bytes() for picture in pictures)
                self.assertEqual(package, build, ending)

    @unittest.skipUnless("pkgcfg_lib_ASSIMP_assimp:" in CACHE, "this build is without Assimp")
    def test_it_reads_other_formats(self):
        with tempfile.TemporaryDirectory() as work:
            model = pathlib.Path(work, "a.obj")
            model.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
            run(self.clrt, model, "-s", "8x8", "-o", f"{work}/a.pfm")

    @unittest.skipUnless(is_here("readelf"), "readelf is not installed")
    def test_its_programs_are_hardened(self):
        modules = (self.root / "usr/lib").rglob("*.so")
        programs = [self.clrt, *modules, *(self.library_root / "usr/lib").rglob("*.so.0")]
        programs += (self.root / "usr/libexec").rglob("clrt-*")
        for program in programs:
            text = run("readelf", "-lWd", program)
            self.assertIn("GNU_RELRO", text)
            self.assertRegex(text, r"FLAGS.*NOW")
            self.assertNotRegex(text, r"RUNPATH|RPATH")
            self.assertRegex(text, r"GNU_STACK .* RW ")
        text = run("readelf", "-lWd", "--dyn-syms", self.clrt)
        self.assertRegex(text, r"FLAGS_1.*PIE")
        for name in ("__stack_chk_fail", "__snprintf_chk", "__fprintf_chk"):
            self.assertIn(name, text)


def reuse_reads_toml():
    if not is_here("reuse"):
        return False
    return int(re.search(r"version (\d+)", run("reuse", "--version"))[1]) >= 4


class Licenses(unittest.TestCase):
    @unittest.skipUnless(reuse_reads_toml(), "reuse 4 or later is not installed (pip install reuse)")
    def test_reuse_has_nothing_to_say(self):
        done = subprocess.run(["reuse", "--root", ROOT, "lint", "--quiet"], capture_output=True)
        self.assertEqual(done.returncode, 0)

    def test_the_package_contains_the_license_of_the_project(self):
        def words(path):
            return re.sub(r"[\s.]+", " ", (ROOT / path).read_text())

        license_text = words("LICENSES/MIT.txt").split("authors ", 1)[1]
        self.assertIn(license_text.strip(), words("tools/package/copyright"))
        self.assertEqual((ROOT / "LICENSE").read_text(), (ROOT / "LICENSES/MIT.txt").read_text())


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v"])
