# SPDX-License-Identifier: GPL-3.0-or-later
"""Starts a Slurm cluster that consists of this machine alone, from Debian's slurmctld, slurmd and munge. All its files
are in one folder."""

from __future__ import annotations

import contextlib
import os
import shutil
import signal
import socket
import subprocess
import time
from collections.abc import Callable, Iterator
from pathlib import Path

_LONG = 300  # seconds after which a daemon is assumed to hang
PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "sinfo", "scontrol")

_CONFIGURATION = """
ClusterName=macadam
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser=root
SlurmctldPort={control}
SlurmdPort={node}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
MailProg=/bin/true
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
SchedulerParameters=sched_interval=1,batch_sched_delay=0
NodeName={host} NodeAddr=127.0.0.1 CPUs={cores} State=UNKNOWN
PartitionName=debug Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def why_not() -> str:
    """Returns why a cluster cannot run on this machine; empty if nothing speaks against it."""
    path = f"{os.environ.get('PATH', '')}:/usr/sbin:/sbin"
    missing = [p for p in PROGRAMS if not shutil.which(p, path=path)]
    if missing:
        return f"no {', '.join(missing)}: Debian's packages slurmctld, slurmd, slurm-client and munge have them"
    return "" if os.geteuid() == 0 else "slurmd and munged in a folder of their own are started by root only"


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@contextlib.contextmanager
def cluster(folder: Path) -> Iterator[dict[str, str]]:
    """A context with a running cluster; yields the environment in which sbatch finds it. Raises RuntimeError with the
    logs if the cluster does not start."""
    host = socket.gethostname().split(".")[0]
    (folder / "state").mkdir(parents=True)
    (folder / "spool").mkdir()
    configuration = folder / "slurm.conf"
    configuration.write_text(
        _CONFIGURATION.format(
            folder=folder, host=host, user="root", control=_free_port(), node=_free_port(), cores=os.cpu_count()
        )
    )
    key = folder / "munge.key"
    key.write_bytes(os.urandom(1024))
    key.chmod(0o400)
    environment = {
        **os.environ,
        "SLURM_CONF": str(configuration),
        "PATH": f"{os.environ.get('PATH', '')}:/usr/sbin:/sbin",
    }
    daemons = [
        [
            "munged",
            "--foreground",
            "--force",
            f"--key-file={key}",
            f"--socket={folder}/munge.socket",
            f"--pid-file={folder}/munged.pid",
            f"--log-file={folder}/munged.log",
            f"--seed-file={folder}/munge.seed",
        ],
        ["slurmctld", "-D", "-f", str(configuration)],
        ["slurmd", "-D", "-f", str(configuration)],
    ]
    running: list[subprocess.Popen] = []
    try:
        for daemon in daemons:
            with open(folder / f"{daemon[0]}.out", "w") as out:
                running.append(subprocess.Popen(daemon, env=environment, stdout=out, stderr=out))
            if daemon[0] == "munged":  # the daemons of Slurm need the socket of munged
                _wait(folder, running, (folder / "munge.socket").exists)
            elif daemon[0] == "slurmctld":  # the node registers with slurmctld
                _wait(folder, running, lambda: "is UP" in _said(environment, "scontrol", "ping"))
        _wait(folder, running, lambda: "idle" in _said(environment, "sinfo", "-h", "-o", "%T"))
        yield environment
    finally:
        subprocess.run(["scancel", "--user=root"], env=environment, capture_output=True, timeout=60)
        for process in reversed(running):
            process.send_signal(signal.SIGTERM)
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


def _said(environment: dict[str, str], *command: str) -> str:
    return subprocess.run(command, env=environment, capture_output=True, text=True).stdout


def _wait(folder: Path, running: list[subprocess.Popen], ready: Callable[[], bool]) -> None:
    """Returns when ready() is true. Raises RuntimeError with the logs if a daemon ends before, or after _LONG
    seconds."""
    end = time.monotonic() + _LONG
    while time.monotonic() < end and all(p.poll() is None for p in running):
        if ready():
            return
        time.sleep(0.1)
    logs = "\n".join(
        f"== {f.name}\n{f.read_text(errors='replace')[-1500:]}"
        for f in sorted(folder.glob("*.log")) + sorted(folder.glob("*.out"))
    )
    raise RuntimeError(f"Slurm does not come up in this machine:\n{logs}")
