# SPDX-License-Identifier: MIT
"""Writes the job scripts. Existing scripts stay unchanged, because users may have edited them."""

import os
import shlex
import sys

from benchmark import common

HEAD = """\
#!/bin/sh
#SBATCH --job-name={name}
#SBATCH --output={log}
#SBATCH --open-mode=append
#SBATCH --requeue
# {command}
# Change this script as your machines need. The command above runs the changed script.
set -eu
export CLRT={clrt}
folder={folder}
cd {here}
"""

# Gets a task's number from the command line or from Slurm.
TASK = """\
task=${1:-$SLURM_ARRAY_TASK_ID}
"""

# The part gets its final name last, so that a file with this name is complete.
PART = """\
part=$folder/part.$task.exr
[ ! -e "$part" ] || exit 0
status=0
"$CLRT" {words} --part "$task/{parts}" --resume -o "$folder/drawing.$task.exr" || status=$?
[ $status != 0 ] || mv "$folder/drawing.$task.exr" "$part"
"""

FRAMES = """\
status=0
"$CLRT" {words} --frames "{frames}$task/{parts}" --resume -o {output} || status=$?
"""

# After `scontrol requeue`, Slurm ends the script, and later starts the task again on any host. The
# script sleeps until Slurm ends it.
END = """\
# Status 75: another host, perhaps one cut off from the cluster, still draws this task.
if [ $status = 75 ] && [ -n "${SLURM_JOB_ID-}" ]; then
    scontrol requeue "$SLURM_JOB_ID"
    sleep 600
fi
exit $status
"""

MERGE = """\
"$CLRT" merge $(seq -f "part.%.0f.exr" {parts}) -o {output}
"""


def write(folder, command, scripts):
    """Writes the scripts to the folder. A script is (name, name of its log, folder in which it
    runs, lines). The head of each script contains the command's lines as comments."""
    first = folder / f"{scripts[0][0]}.sh"
    command = command.replace("\n", "\n# ")
    if first.exists():
        if os.fsencode(f"\n# {command}\n") not in first.read_bytes():
            sys.exit(f"{folder} belongs to another command: repeat that one, or remove the folder")
        return
    folder.mkdir(parents=True, exist_ok=True)
    for name, log, here, lines in scripts:
        head = HEAD.format(name=f"clrt-{name}", log=log, command=command,
                           here=shlex.quote(str(here)),
                           clrt=shlex.quote(os.path.abspath(common.CLRT)),
                           folder=shlex.quote(str(folder)))
        (folder / f"{name}.sh").write_bytes(os.fsencode(head + lines))


def write_farm(options, folder):
    """Writes task.sh and, for parts, merge.sh to the folder."""
    words = [options.scene, *options.more]
    if options.turntable:
        words += ["--turntable", str(options.turntable)]
    frames = ["--frames", options.frames] if options.frames else []
    command = "tools/farm " + shlex.join([*words, *frames, "-o", options.output,
                                          "--parts", str(options.parts)])
    output = options.output if options.numbers else os.path.abspath(options.output)
    values = {"words": shlex.join(words), "parts": options.parts,
              "frames": f"{options.frames}," if options.frames else "",
              "output": shlex.quote(output)}
    lines = TASK + (FRAMES if options.numbers else PART).format(**values) + END
    merge = [] if options.numbers else [("merge", "merge.log", folder, MERGE.format(**values))]
    write(folder, command, [("task", "task-%a.log", os.getcwd(), lines), *merge])
