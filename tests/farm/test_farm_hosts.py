#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests tools/farm on a cluster whose hosts fail. The result must equal the file of a single machine,
# byte for byte.
# Usage: test_farm_hosts.py CLRT [TEST...]
import json
import os
import pathlib
import random
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from cluster import CONTROLLER, HOSTS, ROOT, Cluster, reason_to_skip, wait_for

sys.path.append(str(ROOT / "tests/cli"))
from skips import leave  # noqa: E402

CLRT = str(pathlib.Path(sys.argv[1]).resolve())
SCENE = str(ROOT / "scenes/reflections.scn")
# SLOW is drawn in PARTS parts. Each part has 32 tiles, and keeps a host busy for a few seconds.
PARTS = 8
SLOW = [SCENE, "-s", "512x512", "--tune", "tile=32x32", "--aa=16", "--precision=fp64", "-j", "1"]
TURN = [SCENE, "-s", "96x72", "--aa=8", "-j", "1", "--turntable", "1000"]
STORED = 50000  # bytes of a journal that holds some tiles

# Replaces ssh, which GNU parallel uses to reach the hosts: ssh -o OPTION... HOST -- WORD...
SSH = """\
#!/bin/sh
while [ "$1" = -o ]; do shift 2; done
init=$(cat {folder}/init-$1)
shift
[ "$1" != -- ] || shift
exec nsenter -t "$init" -n -p -m -u --wd=/ sh -c "$*"
"""


class Farm(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="clrt-farm-", ignore_cleanup_errors=True)
        cls.addClassCleanup(folder.cleanup)
        cls.home = pathlib.Path(folder.name)
        cls.cluster = Cluster(cls.home)
        cls.addClassCleanup(cls.cluster.close)
        cls.cluster.open()
        subprocess.run([CLRT, *SLOW, "-q", "-o", cls.home / "whole.exr"], check=True)

    def setUp(self):
        self.work = self.home / self.id().rsplit(".", 1)[1]
        self.work.mkdir()
        self.whole, self.picture = self.home / "whole.exr", self.work / "a.exr"
        self.folder = self.work / "a.exr.farm"

    def run_tool(self, name, *words):
        """Runs a tool on the controller and returns its output."""
        return self.cluster.on(CONTROLLER, ROOT / "tools" / name, *words, env={**os.environ, "CLRT": CLRT})

    def submit(self, *words):
        """Submits an array of tasks, and returns the id of its job."""
        told = self.run_tool("farm", *words)
        self.assertRegex(told, r"cancel: scancel \d+")
        return re.match(r"job (\d+)", told)[1]

    def log(self, task):
        path = self.folder / f"task-{task}.log"
        return path.read_text() if path.exists() else ""

    def stored(self, task):
        """Returns the number of bytes that a task has stored for its unfinished part."""
        return sum(path.stat().st_size for path in self.folder.glob(f"drawing.{task}.exr*"))

    def host_with_tiles(self, job):
        """Returns a task that has stored tiles, and its host."""
        for task, (state, *host) in self.cluster.tasks(job).items():
            if state == "RUNNING" and host and self.stored(task) > STORED:
                return task, int(host[0][1:])
        return None

    def found(self, task):
        """Returns the number of finished tiles that each run of the task found at its start."""
        return [int(number) for number in re.findall(r"^(\d+) of 32 tiles were finished before", self.log(task), re.M)]

    def expect_whole(self):
        try:
            wait_for(self.picture.exists)
        except TimeoutError:
            self.fail("\n".join(f"{log.name}:\n{log.read_text()}" for log in self.folder.glob("*.log")))
        self.assertTrue(self.picture.read_bytes() == self.whole.read_bytes(), "the files differ")

    def wait_for_hosts(self):
        wait_for(lambda: set(self.cluster.states().values()) == {"idle"})

    def submit_slow(self):
        return self.submit(*SLOW, "--stats", "-o", str(self.picture), "--parts", str(PARTS))

    def test_a_lost_host(self):
        job = self.submit_slow()
        task, host = wait_for(lambda: self.host_with_tiles(job))
        self.cluster.unplug(host)
        self.expect_whole()
        self.assertGreater(self.found(task)[-1], 0)
        self.cluster.start(host)
        self.wait_for_hosts()

    def test_a_host_that_is_cut_off_and_keeps_writing(self):
        job = self.submit_slow()
        task, host = wait_for(lambda: self.host_with_tiles(job))
        self.cluster.cut_off(host)
        # Stops the old process until the new process reports that another process draws this part.
        # Then the old process continues to write.
        found = subprocess.run(["pgrep", "-f", f"{self.folder}/drawing.{task}.exr"], stdout=subprocess.PIPE, text=True, check=True)
        old = [int(number) for number in found.stdout.split()]
        for number in old:
            os.kill(number, signal.SIGSTOP)
        wait_for(lambda: "another process draws" in self.log(task))
        for number in old:
            os.kill(number, signal.SIGCONT)
        self.expect_whole()
        self.cluster.cut_off(host, False)
        self.wait_for_hosts()

    def test_tasks_that_are_requeued_at_any_moment(self):
        job, moments = self.submit_slow(), random.Random(1)
        for _ in range(4):
            running = wait_for(lambda: [task for task, (state, *_) in self.cluster.tasks(job).items()
                                        if state == "RUNNING"] or self.picture.exists())
            if self.picture.exists():
                break
            time.sleep(moments.uniform(0, 4))
            for task in running:  # some tasks have ended
                self.cluster.on(CONTROLLER, "scontrol", "requeue", f"{job}_{task}", check=False)
        self.expect_whole()
        self.assertGreater(max(max(self.found(task)) for task in range(1, PARTS + 1)), 0)
        self.wait_for_hosts()

    def test_a_controller_that_restarts(self):
        job = self.submit_slow()
        wait_for(lambda: self.host_with_tiles(job))
        # Slurm saves its state every few seconds. A restart loses the jobs that were submitted
        # since the last save, and the tool cannot detect this loss.
        submitted, state = time.time(), self.home / "state/job_state"
        wait_for(lambda: state.exists() and state.stat().st_mtime > submitted)
        self.cluster.unplug(CONTROLLER)
        self.cluster.start(CONTROLLER)
        self.expect_whole()
        self.wait_for_hosts()

    def test_parallel_with_a_lost_host(self):
        programs = self.work / "bin"
        programs.mkdir()
        (programs / "ssh").write_text(SSH.format(folder=self.work))
        (programs / "ssh").chmod(0o755)
        for host in range(1, HOSTS + 1):
            (self.work / f"init-n{host}").write_text(self.cluster.inits[host])
        words = [ROOT / "tools/farm", *SLOW, "-o", str(self.picture), "--parts", str(PARTS),
                 "--on", "parallel=n1,n2,n3,n4"]
        path = f"{programs}:{os.environ['PATH']}"
        farm = subprocess.Popen(words, env={**os.environ, "CLRT": CLRT, "PATH": path})
        wait_for(lambda: any(self.stored(task) > STORED for task in range(1, PARTS + 1)))
        self.cluster.unplug(1)
        self.assertEqual(farm.wait(timeout=300), 0)
        self.expect_whole()
        self.cluster.start(1)
        self.wait_for_hosts()

    def test_mpirun(self):
        part = 'exec "$0" "$@" --part auto/4 -o part$OMPI_COMM_WORLD_RANK.exr'
        subprocess.run(["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", "4", "sh", "-c", part, CLRT, *SLOW, "-q"],
                       cwd=self.work, check=True)
        subprocess.run([CLRT, "merge", *self.work.glob("part*.exr"), "-o", self.picture], check=True)
        self.expect_whole()

    def test_a_thousand_pictures_with_a_lost_host(self):
        job = self.submit(*TURN, "-o", str(self.work / "t.pfm"))
        wait_for(lambda: len(list(self.work.glob("t.*.pfm"))) > 150)
        host = next(int(host[0][1:]) for state, *host in self.cluster.tasks(job).values() if state == "RUNNING")
        self.cluster.unplug(host)
        moments = {path: path.stat().st_mtime_ns for path in self.work.glob("t.*.pfm")}
        wait_for(lambda: not self.cluster.tasks(job))
        (self.work / "one").mkdir()
        subprocess.run([CLRT, *TURN, "-q", "-o", self.work / "one/t.pfm"], check=True)
        names = [f"t.{number:04}.pfm" for number in range(1, 1001)]
        for name in names:
            self.assertEqual((self.work / name).read_bytes(), (self.work / "one" / name).read_bytes(), name)
        self.assertEqual(sorted(path.name for path in self.work.glob("t.*.pfm*")), names)
        for path, moment in moments.items():
            self.assertEqual(path.stat().st_mtime_ns, moment, "a finished picture was drawn again")
        self.assertIn("is finished", self.run_tool("farm", *TURN, "-o", str(self.work / "t.pfm")))
        self.cluster.start(host)
        self.wait_for_hosts()

    def test_a_study_of_settings(self):
        self.run_tool("trade", SCENE, "--quick", "--runs", "1", "-s", "64x48", "--plain", "--reference-samples", "256",
                      "-o", self.work, "--on", "slurm")
        wait_for((self.work / "trade.json").exists)
        rows = json.loads((self.work / "trade.json").read_text())["scenes"][0]["rows"]
        self.assertGreaterEqual(len(rows), 7)
        self.wait_for_hosts()


if __name__ == "__main__":
    if reason := reason_to_skip():
        leave(reason)
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=2)
