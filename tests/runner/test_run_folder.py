"""The private folder of one runner."""

import contextlib
import os
import stat
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.tools import need_root
from up_runner.paths import default_run_folder
from up_runner.run_folder import MAX_PATH_BYTES, CannotStart, RunFolder


@contextlib.contextmanager
def refused(*codes):
    with pytest.raises(CannotStart) as error:
        yield
    assert error.value.code in codes


def test_where_it_is_by_default():
    assert default_run_folder({"RUNTIME_DIRECTORY": "/run/a:/run/b"}, 7) == Path("/run/a")
    assert default_run_folder({"XDG_RUNTIME_DIR": "/run/user/7"}, 7) == Path(
        "/run/user/7/up-runner"
    )
    assert default_run_folder({}, 7) == Path("/tmp/up-runner-7")


def test_it_is_made_private(short_path):
    folder = RunFolder(short_path / "a" / "b")
    folder.take()
    assert stat.S_IMODE(folder.path.stat().st_mode) == 0o700
    folder.release()


@pytest.mark.parametrize("mode", [0o777, 0o755, 0o710])
def test_a_folder_open_to_others_is_refused_and_not_changed(short_path, mode):
    short_path.chmod(mode)
    with refused("open_folder"):
        RunFolder(short_path).take()
    assert stat.S_IMODE(short_path.stat().st_mode) == mode


def test_a_folder_of_another_user_is_refused(short_path):
    need_root()
    os.chown(short_path, 12345, -1)
    with refused("foreign_folder"):
        RunFolder(short_path).take()


def test_a_link_or_a_file_is_refused(short_path):
    (short_path / "real").mkdir()
    (short_path / "link").symlink_to(short_path / "real")
    (short_path / "file").write_text("")
    for name in ("link", "file"):
        with refused("not_a_folder", "run_folder_unusable"):
            RunFolder(short_path / name).take()


def test_a_lock_that_is_a_link_is_not_followed(short_path):
    (short_path / ".runner.pid").symlink_to(short_path / "elsewhere")
    with refused("run_folder_unusable"):
        RunFolder(short_path).take()
    assert not (short_path / "elsewhere").exists()


def test_the_second_is_refused_until_the_first_lets_go(short_path):
    first, second = RunFolder(short_path), RunFolder(short_path)
    first.take()
    with refused("run_folder_in_use"):
        second.take()
    first.release()
    second.take()
    second.release()


def test_the_lock_of_a_killed_process_is_free(short_path):
    code = (
        "import sys, pathlib; from up_runner.run_folder import RunFolder;"
        "f = RunFolder(pathlib.Path(sys.argv[1])); f.take(); print('held', flush=True);"
        "sys.stdin.read()"
    )
    holder = subprocess.Popen(
        [sys.executable, "-c", code, str(short_path)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
    )
    with holder:
        assert holder.stdout.readline() == b"held\n"
        with refused("run_folder_in_use"):
            RunFolder(short_path).take()
        holder.kill()
    folder = RunFolder(short_path)
    folder.take()
    folder.release()


def test_a_path_too_long_for_sockets_is_refused(short_path):
    folder = short_path / ("x" * (MAX_PATH_BYTES + 1 - len(str(short_path)) - 1))
    assert len(str(folder)) == MAX_PATH_BYTES + 1
    with refused("path_too_long"):
        RunFolder(folder).take()
    assert not folder.exists()


def test_names_are_those_of_instances(short_path):
    folder = RunFolder(short_path)
    folder.take()
    (short_path / "b").mkdir()
    (short_path / "a").mkdir()
    (short_path / "file").write_text("")
    (short_path / ".logs").mkdir()
    (short_path / "link").symlink_to(short_path / "a")
    assert folder.names() == ["a", "b"]
    folder.release()
