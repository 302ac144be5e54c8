"""Of several processes one builds in the folder, and it is never two."""

import fcntl
import os
import subprocess
import sys
from contextlib import contextmanager

import pytest

BUILD = (
    "import sys; from pathlib import Path; from up_rig import build;"
    " build.ARDUINO = Path(sys.argv[1]); build.make('anything')"
)
# Reports that it runs, then compiles until the other end of the pipe is closed.
COMPILER = """#!/bin/sh
echo runs > "$2/begun"
read -r _ < "$2/end"
"""


@pytest.fixture
def folder(tmp_path):
    """Firmware sources, a make that compiles for long, and the pipes to it."""
    (tmp_path / "raspilot").mkdir()
    (tmp_path / "raspilot" / "raspilot.ino").touch()
    (tmp_path / "make").write_text(COMPILER)
    (tmp_path / "make").chmod(0o755)
    for name in ("begun", "end"):
        os.mkfifo(tmp_path / name)
    return tmp_path


@contextmanager
def builder(folder):
    """A process that builds, at the moment when its make runs."""
    environ = {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"}
    process = subprocess.Popen([sys.executable, "-c", BUILD, str(folder)], env=environ)
    try:
        assert (folder / "begun").read_text() == "runs\n"
        yield process
    finally:
        process.kill()
        process.wait()


def test_a_compiler_that_outlives_its_builder_keeps_the_folder(folder):
    with builder(folder) as process:
        # Open before it ends, so that the compiler reads the end of the pipe and no sooner.
        end = os.open(folder / "end", os.O_WRONLY)
        process.kill()
        process.wait()
        with (folder / "build" / ".lock").open("w") as lock:
            with pytest.raises(BlockingIOError):
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            os.close(end)
            fcntl.flock(lock, fcntl.LOCK_EX)


def test_a_second_build_waits_for_the_first(folder):
    with builder(folder):
        end = os.open(folder / "end", os.O_WRONLY)
        with (folder / "build" / ".lock").open("w") as lock, pytest.raises(BlockingIOError):
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        os.close(end)


def test_a_lock_of_its_own_does_not_wait_for_the_firmwares(folder):
    with builder(folder):
        end = os.open(folder / "end", os.O_WRONLY)
        code = BUILD.replace("make('anything')", "make('other', lock_name='.other.lock')")
        with (folder / "make").open("w") as script:
            script.write("#!/bin/sh\n")
        environ = {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"}
        subprocess.run(
            [sys.executable, "-c", code, str(folder)], env=environ, check=True, timeout=60
        )
        os.close(end)
