# SPDX-License-Identifier: MIT
"""A Slurm cluster on one machine: a controller and four hosts, each in its own network, PID, mount
and UTS namespaces. They share the file system, and a bridge connects them. Only root can create the
cluster."""

import os
import pathlib
import shutil
import subprocess
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
HOSTS = 4
CONTROLLER = 0
PROGRAMS = ["slurmctld", "slurmd", "sbatch", "munged", "mpirun", "parallel", "ip", "unshare", "nsenter"]

# The cluster ends with the test, even if a signal ends the test.
DYING = ["setpriv", "--pdeathsig", "KILL"]

SLURM = """\
ClusterName=clrt
SlurmctldHost=n0(10.77.0.100)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=cred_expire=5
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
SlurmdParameters=config_overrides
ReturnToService=2
SlurmdTimeout=5
KillWait=5
SlurmctldTimeout=5
StateSaveLocation={folder}/state
SlurmdSpoolDir=/var/spool/slurmd
SlurmctldPidFile=/run/slurmctld.pid
SlurmdPidFile=/run/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd-%n.log
SchedulerParameters=sched_interval=2
NodeName=n[1-{hosts}] CPUs=1 RealMemory=1000 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""

# The script of a host's first process. When this process ends, all processes of the host end.
BOOT = """\
set -e
mount -t proc proc /proc
for place in /run /var/spool /var/log; do mount -t tmpfs tmpfs $place; done
mount --bind {folder}/etc /etc/slurm
mount --bind {folder}/hosts /etc/hosts
hostname n{host}
ip link set lo up
mkdir -p /run/munge /var/log/munge
munged --force --key-file={folder}/munge.key --num-threads=1 2>>{folder}/munged.log
until ip addr show eth0 2>/dev/null | grep -q 10.77; do sleep 0.05; done
exec {daemon} -D
"""


def reason_to_skip():
    missing = [program for program in PROGRAMS if shutil.which(program) is None]
    if os.geteuid() != 0:
        return "only root can make namespaces"
    return f"missing (tools/setup farm): {', '.join(missing)}" if missing else None


def address(host):
    return f"10.77.0.{host or 100}"


def wait_for(condition, seconds=240):
    end = time.monotonic() + seconds
    while not (found := condition()):
        if time.monotonic() > end:
            raise TimeoutError("the condition never holds")
        time.sleep(0.1)
    return found


def child_of(process):
    found = subprocess.run(["pgrep", "-P", str(process)], stdout=subprocess.PIPE, text=True, check=False)
    return found.stdout.strip()


class Cluster:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.boots, self.inits = {}, {}
        (self.folder / "etc").mkdir()
        (self.folder / "etc/slurm.conf").write_text(SLURM.format(folder=folder, hosts=HOSTS))
        (self.folder / "etc/cgroup.conf").write_text("CgroupPlugin=cgroup/v1\n")
        (self.folder / "hosts").write_text("127.0.0.1 localhost\n" + "".join(
            f"{address(host)} n{host}\n" for host in range(HOSTS + 1)))
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o600)
        self.bridge = subprocess.Popen([*DYING, "unshare", "--net", "sleep", "infinity"])
        time.sleep(0.2)

    def open(self):
        self.on_bridge("ip link add bridge type bridge && ip link set bridge up")
        for host in range(HOSTS + 1):
            self.start(host)
        wait_for(lambda: self.states() == {f"n{host}": "idle" for host in range(1, HOSTS + 1)})

    def on_bridge(self, command):
        subprocess.run(["nsenter", "-t", str(self.bridge.pid), "-n", "sh", "-c", command], check=True)

    def start(self, host):
        """Boots a host."""
        boot = BOOT.format(folder=self.folder, host=host, daemon="slurmd" if host else "slurmctld")
        with open(self.folder / f"boot-{host}.log", "w", encoding="utf-8") as log:
            self.boots[host] = subprocess.Popen(
                [*DYING, "unshare", "--net", "--pid", "--fork", "--kill-child", "--mount", "--uts", "sh", "-c", boot],
                stdout=subprocess.DEVNULL, stderr=log)
        self.inits[host] = wait_for(lambda: child_of(self.boots[host].pid), 10)
        self.on_bridge(
            f"ip link del v{host} 2>/dev/null; ip link add v{host} type veth peer name eth0 netns {self.inits[host]}"
            f" && ip link set v{host} master bridge up")
        self.on(host, "sh", "-c", f"ip addr add {address(host)}/24 dev eth0 && ip link set eth0 up")

    def on(self, host, *words, **settings):
        """Runs a command on a host and returns its output."""
        settings = {"check": True, "stdout": subprocess.PIPE, "text": True, **settings}
        return subprocess.run(self.enter(host) + list(words), **settings).stdout

    def enter(self, host):
        return ["nsenter", "-t", self.inits[host], "-n", "-p", "-m", "-u", f"--wd={os.getcwd()}"]

    def unplug(self, host):
        """Kills all processes of a host, as a power loss does."""
        subprocess.run(["kill", "-KILL", self.inits[host]], check=True)
        self.boots[host].wait()

    def cut_off(self, host, is_cut=True):
        """Disconnects or reconnects a host's network. The host's processes keep running."""
        self.on_bridge(f"ip link set v{host} {'down' if is_cut else 'up'}")

    def states(self):
        lines = self.on(CONTROLLER, "sinfo", "-h", "-N", "-o", "%N %T", check=False, stderr=subprocess.DEVNULL)
        return dict(line.split() for line in lines.splitlines())

    def tasks(self, job):
        """Returns the state and the host of each unfinished task of an array."""
        lines = self.on(CONTROLLER, "squeue", "-h", "-r", "-j", job, "-o", "%K %T %N", check=False)
        return {int(words[0]): words[1:] for words in map(str.split, lines.splitlines())}

    def close(self):
        for host in self.boots:
            if self.boots[host].poll() is None:
                self.unplug(host)
        self.bridge.kill()
        self.bridge.wait()
