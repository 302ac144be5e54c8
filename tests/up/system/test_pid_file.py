import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from up.system.pid_file import VARIABLE, PidFile, PidFileHeld, service

HOLD = (
    "import os, sys; from up.system.pid_file import service\n"
    "with service():\n"
    "    print('UP_PID_FILE' in os.environ, flush=True)\n"
    "    sys.stdin.read()\n"
)


def holder(path):
    return subprocess.Popen(
        [sys.executable, "-c", HOLD],
        env={**os.environ, VARIABLE: str(path)},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


@pytest.fixture
def path(tmp_path):
    return tmp_path / "it.pid"


def test_it_names_its_process_while_that_runs_and_not_those_that_it_starts(path):
    with holder(path) as process:
        assert process.stdout.readline() == "False\n"
        assert path.read_text() == f"{process.pid}\n"
        process.stdin.close()
        assert process.wait() == 0
    assert not path.exists()


def test_a_second_one_is_refused_and_the_first_stays_named(path):
    with holder(path) as first:
        first.stdout.readline()
        with holder(path) as second:
            assert second.wait(30) == 1
            assert second.stderr.read() == (f"process {first.pid} runs already (pid file {path})\n")
        assert path.read_text() == f"{first.pid}\n"


def test_a_stale_file_is_written_again(path):
    with holder(path) as killed:
        killed.stdout.readline()
        killed.send_signal(signal.SIGKILL)
    assert path.read_text() == f"{killed.pid}\n"
    with service({VARIABLE: str(path)}):
        assert path.read_text() == f"{os.getpid()}\n"
        with pytest.raises(PidFileHeld):
            PidFile(path).take()
    assert not path.exists()


def test_a_file_that_was_removed_while_waiting_for_its_lock_is_not_taken(path, monkeypatch):
    opened = []
    really_open = os.open

    def open_then_remove(name, flags, mode=0o777, **more):
        descriptor = really_open(name, flags, mode, **more)
        if Path(name) == path:
            opened.append(descriptor)
            if len(opened) == 1:
                path.unlink()
        return descriptor

    monkeypatch.setattr(os, "open", open_then_remove)
    file = PidFile(path)
    file.take()
    assert len(opened) == 2
    assert path.read_text() == f"{os.getpid()}\n"
    file.release()


def test_a_link_is_not_followed(path, tmp_path):
    path.symlink_to(tmp_path / "elsewhere")
    with pytest.raises(SystemExit, match=r"it\.pid"), service({VARIABLE: str(path)}):
        pytest.fail("held")
    assert not (tmp_path / "elsewhere").exists()


def test_without_a_name_there_is_no_file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with service({}):
        assert list(tmp_path.iterdir()) == []
