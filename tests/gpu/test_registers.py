#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Compiles the kernels for two GPUs without running them. Tests that render_tile needs few
# registers, because a GPU divides them among its threads. Tests that render_tile needs little local
# or scratch memory, which is slow. Usage: test_registers.py KERNEL_FOLDER CACHE_FOLDER
import functools
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

KERNELS, CACHE = map(pathlib.Path, sys.argv[1:3])
PTXAS_PACKAGE = "nvidia-cuda-nvcc-cu12==12.9.86"
BITCODE = pathlib.Path("/usr/lib/clc")
STACK = 64 * (4 + 4)  # bytes of PairStack in fp32
PAIR = "-DCLRT_GPU=1"
FP64 = "-DCLRT_FP64=1"
CREATURE = "-DCLRT_GPU=1 -DCLRT_SPHERES=0 -DCLRT_COLORS=0"
# Each program has a kernel, a file that is appended to render.cl, and options.
PROGRAMS = (*(("render_tile", "tile.cl", options) for options in (PAIR, CREATURE, FP64)),
            ("trace_samples", "samples.cl", PAIR + " -DCLRT_PLACES=1"),
            ("trace_samples", "samples.cl", PAIR), ("trace_paths", "aov.cl", PAIR),
            ("explain_sample", "explain.cl", PAIR), ("certify_tile", "certify.cl", FP64),
            ("trace_rays", "rays.cl", PAIR + " -DCLRT_RAYS=1"),
            ("trace_rays", "rays.cl", PAIR + " -DCLRT_RAYS=1 -DCLRT_ALL_HITS=1"))


def skip(reason):
    print("skipped:", reason)
    sys.exit(77)


@functools.cache
def find_ptxas():
    """Returns the path of NVIDIA's assembler. The first run installs a fixed version."""
    folder = CACHE / "ptxas"
    found = list(folder.glob("lib/**/ptxas"))
    if not found:
        commands = ([sys.executable, "-m", "venv", "--clear", folder],
                    [folder / "bin/pip", "install", "-q", PTXAS_PACKAGE])
        if any(subprocess.run(command, capture_output=True).returncode for command in commands):
            skip("NVIDIA's assembler cannot be fetched from PyPI")
        found = list(folder.glob("lib/**/ptxas"))
    return found[0]


def assembly(program, target, bitcode):
    """Returns the assembly text of a program."""
    _, appended, options = program
    text = "".join(f'#include "{KERNELS / name}"\n' for name in ("render.cl", appended))
    command = ["clang-19", "-w", "-x", "cl", "-cl-std=CL1.2", *options.split(), *target, "-O3",
               "-Xclang", "-finclude-default-header", "-Xclang", "-mlink-builtin-bitcode", "-Xclang",
               str(BITCODE / bitcode), "-S", "-o", "-", "-"]
    return subprocess.run(command, input=text, capture_output=True, check=True, text=True).stdout


@functools.cache
def nvidia(program):
    """Returns the number of registers, the bytes of stack and the PTX of a kernel for sm_90."""
    target = ("--target=nvptx64-nvidia-nvcl", "-march=sm_90", "-mllvm", "-nvptx-fma-level=0")
    ptx = assembly(program, target, "nvptx64--nvidiacl.bc")
    path = CACHE / "kernel.ptx"
    path.write_text(ptx)
    report = subprocess.run([find_ptxas(), "-arch=sm_90", "-v", path, "-o", "/dev/null"],
                            capture_output=True, check=True, text=True).stderr
    kernel = report[report.index(f"entry function '{program[0]}'"):]
    return (int(re.search(r"Used (\d+) registers", kernel)[1]),
            int(re.search(r"(\d+) bytes stack", kernel)[1]), ptx)


def amd(program):
    """Returns the number of registers and the bytes of scratch memory of a kernel for gfx1100."""
    target = ("--target=amdgcn-amd-amdhsa", "-mcpu=gfx1100", "-nogpulib")
    text = assembly(program, target, "amdgcn--amdhsa.bc")
    about = re.search(rf"\.name: +{program[0]}\n(.*?)\.vgpr_spill", text, re.DOTALL)[1]
    return (int(re.search(r"\.vgpr_count: +(\d+)", about)[1]),
            int(re.search(r"\.private_segment_fixed_size: (\d+)", about)[1]))


class Registers(unittest.TestCase):
    def test_sizes_of_kernels(self):
        for program in PROGRAMS:
            registers, stack, _ = nvidia(program)
            vectors, scratch = amd(program)
            print(f"{program[0]:16} {program[2]:50} sm_90 {registers:3} registers, {stack:4} bytes of stack; "
                  f"gfx1100 {vectors:3} VGPRs, {scratch:4} bytes of scratch", flush=True)
            if program[0] != "render_tile" or "FP64" in program[2]:
                continue
            with self.subTest(program=program):
                self.assertLessEqual(registers, 180)
                self.assertLessEqual(stack, 800)
                self.assertLessEqual(vectors, 210)
                self.assertLessEqual(scratch, 800)

    def test_only_the_traversal_stack_is_in_local_memory(self):
        for program in PROGRAMS[:2]:
            with self.subTest(program=program):
                ptx = nvidia(program)[2]
                sizes = [int(size) for size in re.findall(r"\.local .*__local_depot\d+\[(\d+)\]", ptx)]
                self.assertEqual(sizes, [STACK])
                # Instructions that name no state space access generic memory.
                self.assertEqual(re.findall(r"\b(?:ld|st)\.(?:v[24]\.)?[ubsf]\d+\s.*", ptx), [])


if __name__ == "__main__":
    missing = [name for name, found in (("clang-19", shutil.which("clang-19")),
                                        ("libclc-19", (BITCODE / "nvptx64--nvidiacl.bc").exists())) if not found]
    if missing:
        skip("missing (tools/setup gpu): " + ", ".join(missing))
    CACHE.mkdir(parents=True, exist_ok=True)
    unittest.main(argv=sys.argv[:1])
