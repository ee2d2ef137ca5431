# SPDX-License-Identifier: MIT
"""Writes the job scripts, unless they exist. Their users may have changed them."""

import os
import shlex
import sys

HEAD = """\
#!/bin/sh
#SBATCH --job-name={name}
#SBATCH --output={log}
#SBATCH --open-mode=append
#SBATCH --requeue
# {command}
# Change this script as your machines need; the command above runs it again as it is.
set -eu
clrt={clrt}
folder={folder}
cd {here}
"""

# A task that is requeued finds its number in the same variable. The part gets its final name last, so
# that a file of that name is whole.
PART = """\
task=${{1:-$SLURM_ARRAY_TASK_ID}}
part=$folder/part.$task.exr
[ ! -e "$part" ] || exit 0
status=0
"$clrt" {words} --part "$task/{parts}" --resume -o "$folder/drawing.$task.exr" || status=$?
[ $status != 0 ] || mv "$folder/drawing.$task.exr" "$part"
"""

FRAMES = """\
task=${{1:-$SLURM_ARRAY_TASK_ID}}
status=0
"$clrt" {words} --frames "{frames}$task/{parts}" --resume -o {output} || status=$?
"""

# Slurm starts the task again later, on any host. Until Slurm ends this run, it waits.
END = """\
# Status 75: a host that is cut off from the cluster still draws this.
if [ $status = 75 ] && [ -n "${SLURM_JOB_ID-}" ]; then
    scontrol requeue "$SLURM_JOB_ID"
    sleep 600
fi
exit $status
"""

MERGE = """\
"$clrt" merge $(seq -f "part.%.0f.exr" {parts}) -o {output}
"""


def write(options, folder, clrt):
    """Writes task.sh and, for parts, merge.sh to the folder."""
    words = [options.scene, *options.more]
    if options.turntable:
        words += ["--turntable", str(options.turntable)]
    frames = ["--frames", options.frames] if options.frames else []
    command = "tools/farm " + shlex.join([*words, *frames, "-o", options.output,
                                          "--parts", str(options.parts)])
    task = folder / "task.sh"
    if task.exists():
        if f"\n# {command}\n" not in task.read_text():
            sys.exit(f"tools/farm: {folder} is of another command: give that, or remove the folder")
        return
    folder.mkdir(parents=True, exist_ok=True)
    values = {"words": shlex.join(words), "parts": options.parts, "clrt": shlex.quote(clrt), "command": command,
              "frames": f"{options.frames}," if options.frames else "",
              "output": shlex.quote(options.output), "folder": shlex.quote(str(folder)),
              "here": shlex.quote(os.getcwd())}
    task.write_text(HEAD.format(name="clrt-task", log="task-%a.log", **values)
                    + (FRAMES if options.numbers else PART).format(**values) + END)
    if not options.numbers:
        values["here"], values["output"] = values["folder"], shlex.quote(os.path.abspath(options.output))
        (folder / "merge.sh").write_text(HEAD.format(name="clrt-merge", log="merge.log", **values)
                                         + MERGE.format(**values))
