"""A program that is run to its end → what it took."""

import dataclasses
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent


@dataclasses.dataclass
class Run:
    """Seconds of the clock and of all threads of a process, and its greatest memory in bytes."""

    wall: float
    cpu: float
    memory: int


def run(command, home):
    """Runs a program to its end."""
    env = {**os.environ, "PYTHONPATH": str(HERE), "HOME": str(home)}
    start = time.monotonic()
    with tempfile.TemporaryFile() as said:
        child = subprocess.Popen([str(c) for c in command], env=env, stdout=said, stderr=said)
        _, status, usage = os.wait4(child.pid, 0)
        wall = time.monotonic() - start
        child.returncode = os.waitstatus_to_exitcode(status)
        if child.returncode:
            said.seek(0)
            sys.exit(said.read().decode(errors="replace") + f"\n{command} failed")
    return Run(wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024)
