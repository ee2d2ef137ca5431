# SPDX-License-Identifier: MIT
"""Runs stages one after another."""

import collections
import pathlib
import shlex
import shutil
import subprocess
import sys


class Stage(collections.namedtuple("Stage", "script tasks")):
    """A script and the numbers of its tasks. Without numbers, the script runs once."""

    @property
    def text(self):
        return f"{self.script} {ranges(self.tasks or [])}".rstrip()


# ssh notices a lost host after 15 s, and parallel retries the task on another host.
SSH = "ssh -o BatchMode=yes -o ServerAliveInterval=5 -o ServerAliveCountMax=3"


def ranges(numbers):
    """Returns ascending numbers as text: 1-3,7."""
    runs = []
    for number in numbers:
        if runs and number == runs[-1][1] + 1:
            runs[-1][1] = number
        else:
            runs.append([number, number])
    return ",".join(str(a) if a == b else f"{a}-{b}" for a, b in runs)


def are_queued(jobs):
    found = subprocess.run(["squeue", "-h", "-j", jobs], capture_output=True, text=True,
                           check=False)
    return found.returncode == 0 and found.stdout.strip() != ""


def run_slurm(folder, stages):
    """Submits all stages. Each stage starts when the previous one has succeeded."""
    record, jobs = folder / "jobs", []
    if record.exists() and are_queued(record.read_text()):
        print(f"still queued or running: squeue -j {record.read_text()}")
        return 0
    for stage in stages:
        words = ["sbatch", "--parsable", f"--chdir={folder}"]
        if stage.tasks:
            words.append(f"--array={ranges(stage.tasks)}")
        if jobs:
            words += [f"--dependency=afterok:{jobs[-1]}", "--kill-on-invalid-dep=yes"]
        done = subprocess.run([*words, str(folder / f"{stage.script}.sh")], stdout=subprocess.PIPE,
                              text=True, check=False)
        if done.returncode != 0:
            subprocess.run(["scancel", *jobs], check=False)
            return done.returncode
        jobs.append(done.stdout.strip().split(";")[0])
        record.write_text(",".join(jobs))
        print(f"job {jobs[-1]}: {stage.text}")
    print(f"watch:  squeue -j {','.join(jobs)}; tail {shlex.quote(str(folder))}/*.log\n"
          f"cancel: scancel {' '.join(jobs)}")
    return 0


def run_parallel(hosts, folder, stage):
    """Runs the tasks on the hosts, one at a time on each."""
    script, log = (shlex.quote(str(folder / name)) for name in (f"{stage.script}.sh", "task-"))
    return subprocess.run(["parallel", "--sshlogin", hosts, "--ssh", SSH, "--jobs", "1",
                           "--retries", "3", "--joblog", str(folder / "joblog"),
                           f"sh {script} {{}} >>{log}{{}}.log 2>&1",
                           ":::", *map(str, stage.tasks)], check=False).returncode


def run_local(folder, stage):
    for task in stage.tasks or [""]:
        status = subprocess.run(["sh", str(folder / f"{stage.script}.sh"), str(task)],
                                check=False).returncode
        if status != 0:
            return status
    return 0


def require(program):
    """Exits with a message if the program is not installed."""
    if shutil.which(program) is None:
        sys.exit(f"tools/{pathlib.Path(sys.argv[0]).name}: {program} is not installed on this machine: "
                 "install it, or give --on local")


def run(engine, folder, stages):
    """Returns the exit status. With Slurm, returns once all stages are submitted."""
    if engine != "local":
        require("sbatch" if engine == "slurm" else "parallel")
    if engine == "slurm":
        return run_slurm(folder, stages)
    hosts = engine.removeprefix("parallel=")
    for stage in stages:
        is_local = engine == "local" or not stage.tasks
        print(f"{stage.text}; logs: {folder}", file=sys.stderr)
        status = run_local(folder, stage) if is_local else run_parallel(hosts, folder, stage)
        if status != 0:
            return status
    return 0
