"""A signal that comes while a worker starts, as Ctrl-C to the whole group does."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.waiting import HANG_S

ROOT = Path(__file__).parents[3]

# The signal comes when the first worker's process exists, to the parent alone; or, to the whole
# group as from a terminal, when that process has Python's handler.
PROGRAM = """
import os, pathlib, signal, sys
from multiprocessing import util
from up_simulator.harness.signal_handling import orderly_exit
from up_simulator.harness.workers import Workers

spawn = util.spawnv_passfds

def spawn_and_signal(*arguments):
    pid = spawn(*arguments)
    if "spawn_main" in str(arguments[1]):
        while IS_GROUP and not has_handler(pid):
            pass
        os.kill(0 if IS_GROUP else os.getpid(), NUMBER)
    return pid

def has_handler(pid):
    status = pathlib.Path(f"/proc/{pid}/status").read_text()
    return int(status.partition("SigCgt:")[2].split()[0], 16) >> signal.SIGINT - 1 & 1

util.spawnv_passfds = spawn_and_signal
if __name__ == "__main__":
    with orderly_exit() as ending:
        try:
            with Workers(2) as workers:
                workers.fly(abs, [(-1,), (-2,)])
        except KeyboardInterrupt:
            sys.exit(ending.status(130))
"""


@pytest.mark.parametrize(
    ("number", "is_group"),
    [
        (signal.SIGINT, False),
        (signal.SIGTERM, False),
        (signal.SIGHUP, False),
        (signal.SIGINT, True),
    ],
)
def test_a_signal_during_the_start_of_a_worker_leaves_no_traceback(tmp_path, number, is_group):
    path = tmp_path / "program.py"
    program = PROGRAM.replace("NUMBER", str(int(number))).replace("IS_GROUP", str(is_group))
    path.write_text(program)
    ended = subprocess.run(
        [sys.executable, str(path)],
        capture_output=True,
        text=True,
        timeout=HANG_S,
        check=False,
        start_new_session=True,
        cwd=os.fspath(tmp_path),
        # The tools are not installed; they are imported from the root.
        env={**os.environ, "PYTHONPATH": os.fspath(ROOT)},
    )
    assert (ended.stderr, ended.returncode) == ("", 128 + number)
