"""One node of Slurm in a folder of its own: munged, slurmctld and slurmd as Debian packs them, by whoever runs this.

Nothing of the machine's own Slurm, if it has one, is read or changed; no port but the two that are free is used.
"""

import getpass
import os
import pathlib
import secrets
import shutil
import socket
import subprocess
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "sinfo", "squeue")
STARTING_S = 20
TASKS = 16  # at a time, however many processors there are: it schedules once a second


class SlurmFault(Exception):
    """Slurm cannot be run here."""


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def program(name):
    """Daemons are in /usr/sbin, which the search path of a user may lack."""
    return shutil.which(name, path=os.environ.get("PATH", "") + ":/usr/sbin:/sbin")


class Slurm:
    """As a context: the daemons run within. `environment` makes sbatch and the others talk to them."""

    def __init__(self, folder):
        missing = [name for name in PROGRAMS if not program(name)]
        if missing:
            raise SlurmFault(f"{', '.join(missing)} not found; Debian's package is slurm-wlm")
        self.folder = pathlib.Path(folder)
        self.environment = dict(os.environ, SLURM_CONF=str(self.folder / "slurm.conf"))
        self.daemons = []

    def configure(self):
        host, me = socket.gethostname().split(".")[0], getpass.getuser()
        for name in ("state", "spool"):
            (self.folder / name).mkdir()
        key = self.folder / "munge.key"
        key.write_bytes(secrets.token_bytes(1024))
        key.chmod(0o600)
        (self.folder / "slurm.conf").write_text(f"""ClusterName=dwell
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={free_port()}
SlurmdPort={free_port()}
SlurmUser={me}
SlurmdUser={me}
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket={self.folder}/munge.socket
StateSaveLocation={self.folder}/state
SlurmdSpoolDir={self.folder}/spool
SlurmctldPidFile={self.folder}/slurmctld.pid
SlurmdPidFile={self.folder}/slurmd.pid
SlurmctldLogFile={self.folder}/slurmctld.log
SlurmdLogFile={self.folder}/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
ReturnToService=2
SlurmdParameters=config_overrides
SchedulerParameters=sched_interval=1,sched_min_interval=100000
NodeName={host} NodeAddr=127.0.0.1 CPUs={TASKS}
PartitionName=all Nodes={host} Default=YES MaxTime=10
""")

    def start(self, *command):
        log = open(self.folder / f"{pathlib.Path(command[0]).name}.out", "w")
        self.daemons.append(subprocess.Popen(command, env=self.environment, stdin=subprocess.DEVNULL, stdout=log,
                                             stderr=subprocess.STDOUT, start_new_session=True))
        log.close()

    def run(self, *command, timeout=120):
        return subprocess.run(command, env=self.environment, capture_output=True, text=True, timeout=timeout,
                              check=False)

    def await_node(self):
        until = time.monotonic() + STARTING_S
        while time.monotonic() < until:
            ended = [d.args[0] for d in self.daemons if d.poll() is not None]
            if ended:
                raise SlurmFault(f"{ended[0]} ended:\n{self.said()}")
            if self.run(program("sinfo"), "--noheader", "--format=%t").stdout.strip() == "idle":
                return
            time.sleep(0.2)
        raise SlurmFault(f"no node after {STARTING_S} s:\n{self.said()}")

    def try_a_job(self):
        """Whether a node that is there also runs jobs: some containers let it start no process."""
        try:
            done = self.run(program("srun"), "--quiet", "true", timeout=30)
        except subprocess.TimeoutExpired as late:
            raise SlurmFault(f"a job that does nothing was not done in 30 s:\n{self.said()}") from late
        if done.returncode != 0:
            raise SlurmFault(f"a job that does nothing ended with {done.returncode}:\n{done.stderr}{self.said()}")

    def said(self):
        """The last lines of what the daemons said."""
        lines = []
        for file in sorted([*self.folder.glob("*.out"), *self.folder.glob("*.log")]):
            lines += [f"{file.name}: {line}" for line in file.read_text(errors="replace").splitlines()[-6:]]
        return "\n".join(lines)

    def __enter__(self):
        self.configure()
        try:
            here = self.folder
            self.start(program("munged"), "--foreground", "--force", f"--socket={here}/munge.socket",
                       f"--key-file={here}/munge.key", f"--pid-file={here}/munged.pid", f"--log-file={here}/munged.log",
                       f"--seed-file={here}/munged.seed")
            until = time.monotonic() + STARTING_S
            while not (here / "munge.socket").exists() and time.monotonic() < until:
                time.sleep(0.05)
            self.start(program("slurmctld"), "-D", "-f", str(here / "slurm.conf"))
            self.start(program("slurmd"), "-D", "-f", str(here / "slurm.conf"))
            self.await_node()
            self.try_a_job()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for daemon in reversed(self.daemons):
            daemon.terminate()
            try:
                daemon.wait(10)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()
