# SPDX-License-Identifier: GPL-3.0-or-later
"""A Slurm of a test's own: munged, slurmctld and one slurmd as processes in a folder, which leave the machine's own alone."""
import os
import secrets
import shutil
import signal
import socket
import subprocess
import time
from pathlib import Path

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "sinfo", "scontrol", "scancel")
CONFIGURATION = """
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket,cred_expire=3
CredType=cred/munge
SlurmUser=root
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=2,batch_sched_delay=1,sched_min_interval=100000
MpiDefault=none
ReturnToService=2
SlurmdTimeout={timeout}
MinJobAge=5
KillWait=30
MaxArraySize=1001
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} Sockets=1 CoresPerSocket={cpus} ThreadsPerCore=1
PartitionName=main Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def missing():
    """What a Slurm of one's own would need and is not there; empty where all is."""
    absent = [program for program in PROGRAMS if not shutil.which(program) and not Path("/usr/sbin", program).exists()]
    if absent:
        return f"there is no {absent[0]} (Debian: slurm-wlm, munge)"
    return "" if os.geteuid() == 0 else "Slurm's daemons want to be started by root"


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class OwnSlurm:
    """The daemons, while the `with` lasts. timeout: s, after which a node that is silent is given up."""

    def __init__(self, folder, timeout=10, cpus=2):
        self.folder = Path(folder)
        self.host = socket.gethostname().split(".")[0]
        (self.folder / "munge").mkdir(parents=True)
        for name in ("state", "spool"):
            (self.folder / name).mkdir()
        self.folder.chmod(0o755)  # or munged refuses
        key = self.folder / "munge/key"
        key.write_bytes(secrets.token_bytes(1024))
        key.chmod(0o400)
        self.configuration = self.folder / "slurm.conf"
        self.configuration.write_text(CONFIGURATION.format(host=self.host, ports=free_ports(2), folder=self.folder, timeout=timeout, cpus=cpus))
        self.environment = {**os.environ, "SLURM_CONF": str(self.configuration), "PATH": os.environ["PATH"] + ":/usr/sbin"}
        self.daemons = {}

    def __enter__(self):
        munge = self.folder / "munge"
        self.start("munged", "--foreground", "--force", f"--key-file={munge}/key", f"--socket={munge}/socket", f"--pid-file={munge}/pid",
                   f"--log-file={munge}/log", f"--seed-file={munge}/seed", "--num-threads=2")
        self.wait_for((munge / "socket").exists, "munged does not come up")
        self.start("slurmctld", "-D", "-f", self.configuration)
        self.start_slurmd()
        self.wait_for(lambda: "idle" in self.node_state(), "the node does not come up")
        return self

    def __exit__(self, *_):
        for name in ("slurmd", "slurmctld", "munged"):
            self.daemons[name].terminate()
        for daemon in self.daemons.values():
            try:
                daemon.wait(20)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()

    def start(self, program, *words):
        log = (self.folder / f"{program}.out").open("a")
        self.daemons[program] = subprocess.Popen([program, *map(str, words)], env=self.environment, stdin=subprocess.DEVNULL, stdout=log, stderr=log)
        log.close()

    def start_slurmd(self):
        self.start("slurmd", "-D", "-f", self.configuration, "-N", self.host)

    def kill_slurmd(self):
        self.daemons["slurmd"].send_signal(signal.SIGKILL)
        self.daemons["slurmd"].wait()

    def ask(self, *words):
        return subprocess.run(list(map(str, words)), env=self.environment, capture_output=True, text=True, check=False)

    def node_state(self):
        return self.ask("sinfo", "--noheader", "--Format=StateLong").stdout.strip()

    def submit(self, *words):
        """The number of the job. Raises AssertionError where it is not taken."""
        taken = self.ask("sbatch", "--parsable", *words)
        assert taken.returncode == 0, taken.stderr
        return taken.stdout.strip()

    def queue(self):
        """The tasks that wait or run, a line each: number, state."""
        return self.ask("squeue", "--noheader", "--array", "--states=all", "--Format=ArrayTaskID:10,State:20").stdout.splitlines()

    def is_empty(self):
        asked = self.ask("squeue", "--noheader", "--array")
        return asked.returncode == 0 and not asked.stdout.strip()

    def wait_for(self, condition, complaint, patience=180):
        end = time.monotonic() + patience
        while not condition():
            logs = {name: self.folder / f"{name}.log" for name in ("slurmctld", "slurmd")}
            told = "".join(f"\n{name}: {path.read_text(errors='replace')[-800:]}" for name, path in logs.items() if path.exists())
            assert time.monotonic() < end, f"{complaint}{told}"
            time.sleep(0.3)
