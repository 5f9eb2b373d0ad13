#!/usr/bin/env python3
"""apps/slurm/sweep.sbatch in a Slurm of one node, started for the test. Skipped, visibly, where Slurm cannot start."""

import os
import pathlib
import shutil
import socket
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.retrace_cli import RETRACE, SOURCE, check, draw_walk, rows, street, write_truth  # noqa: E402

SKIPPED = 77
PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "sinfo")
PATH = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"


def free_port():
    with socket.socket() as bound:
        bound.bind(("", 0))
        return bound.getsockname()[1]


def until(seconds, condition):
    """True as soon as the condition holds; False if it does not within that time."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if condition():
            return True
        time.sleep(0.2)
    return False


class Slurm:
    """Controller, node and authentication, each as a process of this test in a folder of its own."""

    def __init__(self, folder):
        self.folder = folder
        self.processes = []
        host = socket.gethostname().split(".")[0]
        for name in ("state", "spool"):
            (folder / name).mkdir()
        key = folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        (folder / "slurm.conf").write_text(f"""ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
SlurmctldPort={free_port()}
SlurmdPort={free_port()}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/builtin
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
ReturnToService=2
NodeName={host} NodeAddr=127.0.0.1 CPUs={os.cpu_count()} State=UNKNOWN
PartitionName=test Nodes={host} Default=YES State=UP MaxTime=10
""")
        self.environment = dict(os.environ, PATH=PATH, SLURM_CONF=str(folder / "slurm.conf"))

    def start(self):
        """True if jobs can be submitted."""
        f = self.folder
        self.spawn("munged", "--foreground", "--force", f"--socket={f}/munge.socket", f"--key-file={f}/munge.key",
                   f"--pid-file={f}/munge.pid", f"--log-file={f}/munge.log", f"--seed-file={f}/munge.seed")
        if not until(10, lambda: (f / "munge.socket").exists()):
            return False
        self.spawn("slurmctld", "-D")
        self.spawn("slurmd", "-D")
        return until(40, lambda: "idle" in self.call("sinfo", "-h", "-o", "%T").stdout)

    def spawn(self, *command):
        log = open(self.folder / f"{command[0]}.out", "w")
        self.processes.append(subprocess.Popen(command, env=self.environment, stdout=log, stderr=log))

    def call(self, *command, **more):
        return subprocess.run(list(map(str, command)), env=self.environment, capture_output=True, text=True, timeout=60, **more)

    def stop(self):
        for process in reversed(self.processes):
            process.terminate()
        for process in self.processes:
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


class SlurmTest(unittest.TestCase):
    def test_an_array_of_jobs_gives_the_files_of_one_sweep(self):
        folder = self.folder
        wall = street()
        reference_at, query_at = [1.0 * i for i in range(400)], [2.0 * i for i in range(200)]
        walks = {"reference": draw_walk(folder / "reference", wall, reference_at),
                 "query": draw_walk(folder / "query", wall, query_at, gain=0.8)}
        sweep = [walks["query"], "--reference", walks["reference"], "--query-truth", write_truth(folder / "q.csv", query_at),
                 "--reference-truth", write_truth(folder / "r.csv", reference_at), "--tolerance-m", "0.1", "--motion", "sad",
                 "--sequence-length", "5,10", "--search-range-rad", "0,0.1,0.3"]
        check("sweep", *sweep, "-o", folder / "whole")
        script = pathlib.Path(SOURCE) / "apps/slurm/sweep.sbatch"
        environment = dict(self.slurm.environment, RETRACE=str(pathlib.Path(RETRACE).resolve()))

        def submit(*more):
            done = subprocess.run(list(map(str, ["sbatch", "--parsable", "--cpus-per-task=1", *more])), env=environment, cwd=folder,
                                  capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, 0, done.stderr)
            return done.stdout.strip()

        # An array that begins at 3 and leaves numbers out has four parts all the same.
        array = submit("--array=3-9:2", script, *sweep, "-o", folder / "divided")
        submit(f"--dependency=afterok:{array}", script, *sweep, "-o", folder / "divided", "--merge")
        self.assertTrue(until(150, lambda: self.slurm.call("squeue", "-h").stdout.strip() == ""), "jobs did not end")
        logs = "\n".join(path.read_text() for path in sorted(folder.glob("retrace-sweep-*.log")))
        self.assertEqual(len(list(folder.glob(f"retrace-sweep-{array}-*.log"))), 4, logs)
        for name in ("sweep.csv", "methods.json", "report.html", "heat_map.png", "sweep.toml"):
            self.assertTrue((folder / "divided" / name).exists(), f"{name}\n{logs}")
            self.assertEqual((folder / "whole" / name).read_bytes(), (folder / "divided" / name).read_bytes(), name)
        self.assertEqual(len(rows(folder / "divided/sweep.csv")), 6)


if __name__ == "__main__":
    missing = [name for name in PROGRAMS if shutil.which(name, path=PATH) is None]
    if missing or os.geteuid() != 0:
        print("skipped: root expected, to start a Slurm of one node" if not missing else f"skipped: no {', '.join(missing)}; "
              "Debian's slurmctld, slurmd, slurm-client and munge expected")
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory(prefix="retrace-slurm-") as made:
        SlurmTest.folder = pathlib.Path(made)
        SlurmTest.slurm = Slurm(SlurmTest.folder)
        try:
            if not SlurmTest.slurm.start():
                logs = [path for path in SlurmTest.folder.iterdir() if path.suffix in (".out", ".log")]
                print("skipped: Slurm does not start here:", *(f"\n{path.name}: {path.read_text()[-600:]}" for path in logs))
                SlurmTest.slurm.stop()
                sys.exit(SKIPPED)
            result = unittest.main(exit=False).result
        finally:
            SlurmTest.slurm.stop()
    sys.exit(0 if result.wasSuccessful() else 1)
