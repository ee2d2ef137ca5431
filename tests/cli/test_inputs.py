#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests that every command reads each input once: standard input, pipes, and files that change during
# the run. The debug build runs these tests under AddressSanitizer.
# Usage: test_inputs.py CLRT FORMATS [TEST...]
import contextlib
import itertools
import os
import re
import threading

from pictures import read_exr, read_pfm
from work import HAS_EXR, ROOT, Work, main, needs_exr

# The scene determines the picture's size, so an empty second reading would give another size.
SCENE = """size {0} {0}
camera 3 -5 2.5  0 0 0.8  40
camera -5 -3 2.5  0 0 0.8  40
light 4 -4 6 0.9
material 6
sphere 0 0 1 1
mesh {1}
"""
MESHES = [(ROOT / f"scenes/{name}.ply").read_bytes() for name in ("cone", "plateau")]
REFERENCE = ["--reference-samples", "2", "--reference"]
# All commands that read a scene, without the scene's name.
COMMANDS = [
    ["-o", "a.pfm", *REFERENCE[:2], "--reference=b.pfm"],
    ["-o", "a.#.pfm", "--frames", "1-2", "--aa-adaptive", *REFERENCE],
    ["-o", "a.pfm", "--turntable", "2", "--error", "5%", *REFERENCE],
    ["-o", "a.pfm", "--resume", "--crop", "3,5,40,30", "--stats"],
    ["-o", "-", "--format", "pfm", "--tune=bvh=none", *REFERENCE],
    ["explain", "20,20"],
    ["explain"],
    ["warm", "-q", "--tune=specialize=never"],
    ["check"],
    ["convert", "a.scn"],
]
if HAS_EXR:
    COMMANDS += [["-o", "a.exr", "--aov", "depth,certainty,error"], ["-o", "a.exr", "--part", "2/2"]]


def line_of(command, scene):
    is_named = not command[0].startswith("-")
    return [command[0], scene, *command[1:]] if is_named else [scene, *command]


class Inputs(Work):
    def run_command(self, command, scene, **more):
        """Runs a command, and fails if clrt crashes or corrupts memory."""
        done = self.run_clrt(*line_of(command, scene), **more)
        if b"LeakSanitizer has encountered a fatal error" in done.stderr:
            self.skipTest("LeakSanitizer crashed, as it rarely does while threads end")
        self.assertIn(done.returncode, (0, 3), (command, done.stderr))
        self.assertNotIn(b"Sanitizer", done.stderr, command)
        return done

    def feed(self, name, content):
        """Makes a pipe that gives the content to its first reader, and nothing to later readers."""
        path = self.work / name
        os.mkfifo(path)

        def write():
            with contextlib.suppress(BrokenPipeError):
                path.write_bytes(content)
            while not ended.is_set():
                path.write_bytes(b"")

        def release():
            ended.set()
            while writer.is_alive():
                os.close(os.open(path, os.O_RDONLY | os.O_NONBLOCK))  # the writer waits for a reader
                writer.join(0.01)

        ended, writer = threading.Event(), threading.Thread(target=write)
        writer.start()
        self.addCleanup(release)

    def take_outputs(self, done, mesh):
        """Returns a command's outputs without the names of the scene and the mesh. Removes the files."""
        outputs = {"": re.sub(rb"(?m)(^|of )(file\.scn|-)(?=[: \n])", b"", done.stdout).replace(mesh.encode(), b"")}
        for path in sorted(self.work.glob("[ab][.-]*")):
            outputs[path.name] = read_exr(path)[1] if path.suffix == ".exr" else path.read_bytes()
            path.unlink()
        return outputs

    def test_standard_input_and_pipes_give_what_files_give(self):
        self.write(cone_ply=MESHES[0], file_scn=SCENE.format(64, "cone.ply"))
        for number, command in enumerate(COMMANDS):
            done = self.run_command(command, "file.scn", content=b"")
            self.assertEqual(done.returncode, 0, done.stderr)
            expected = self.take_outputs(done, "cone.ply")
            mesh = f"cone-{number}.ply"
            self.feed(mesh, MESHES[0])
            done = self.run_command(command, "-", content=SCENE.format(64, mesh).encode())
            self.assertTrue(self.take_outputs(done, mesh) == expected, (command, done.stderr))

    def test_a_scene_in_a_pipe_is_read_once(self):
        self.write(cone_ply=MESHES[0])
        self.feed("pipe.scn", SCENE.format(64, "cone.ply").encode())
        done = self.run_command(COMMANDS[0], "pipe.scn", content=b"")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(read_pfm(self.work / "b.pfm")), 64)

    def test_files_that_change_during_the_run_are_read_once(self):
        ended = threading.Event()
        scenes = [SCENE.format(size, "mesh.ply").encode() for size in (48, 200, 64)]
        self.write(mesh_ply=MESHES[0], file_scn=scenes[0])

        def change():
            for scene, mesh in itertools.cycle(itertools.product(scenes, MESHES)):
                (self.work / "file.scn").write_bytes(scene)
                (self.work / "mesh.ply").write_bytes(mesh)
                if ended.wait(0.003):
                    return

        writer = threading.Thread(target=change)
        writer.start()
        try:
            for command in COMMANDS:
                self.run_command(command, "file.scn", content=b"")
        finally:
            ended.set()
            writer.join()

    # This test has a cache of its own. The cache of the other tests may hold the kernels already.
    def test_a_command_compiles_kernels_and_stores_them(self):
        self.write(cone_ply=MESHES[0], file_scn=SCENE.format(64, "cone.ply"))
        done = self.run_command(["-o", "a.pfm"], "file.scn", content=b"", POCL_CACHE_DIR=str(self.work))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreater(len(list(self.work.glob("clrt/*.bin"))), 0)

    def test_pictures_come_from_files(self):
        self.write(one_scn=SCENE.format(16, "cone.ply"), cone_ply=MESHES[0])
        self.clrt("one.scn", "-o", "a.pfm")
        self.feed("pipe.pfm", self.bytes_of("a.pfm"))
        for words in (["a.pfm", "pipe.pfm"], ["pipe.pfm", "a.pfm"]):
            self.refuses(3, "pipe.pfm: cannot be read: it is not a file", "compare", *words)
        (self.work / "pipe.pfm").read_bytes()


@needs_exr
class Merge(Work):
    PARTS = 8

    def draw(self, size, part):
        self.clrt("a.scn", "-s", size, "--part", f"{part}/{self.PARTS}", "-o", f"{part}.exr")

    def test_a_part_that_changes_during_the_merge_is_refused(self):
        self.write(a_scn=SCENE.format(64, "cone.ply"), cone_ply=MESHES[0])
        self.draw("2048x2048", self.PARTS)
        last = self.work / f"{self.PARTS}.exr"
        other = last.read_bytes()
        for part in range(1, self.PARTS + 1):
            self.draw("512x512", part)
        kept = last.read_bytes()
        process = None
        while process is None or process.returncode == 0:
            (self.work / "whole.exr").unlink(missing_ok=True)  # of a merge that ended before the change
            self.write(**{f"{self.PARTS}_exr": kept}, other_exr=other)
            process = self.start("merge", *(f"{part}.exr" for part in range(1, self.PARTS + 1)), "-o", "whole.exr")
            while process.poll() is None and not list(self.work.glob(".clrt-*")):
                pass  # the second reading begins once the output exists
            os.replace(self.work / "other.exr", last)
            talk = process.communicate()[1]
        self.assertEqual(process.returncode, 3, talk)
        self.assertRegex(talk, rf"^clrt: {last.name}: changed while the parts were merged\n$")
        self.assertFalse((self.work / "whole.exr").exists())


if __name__ == "__main__":
    main(2)
