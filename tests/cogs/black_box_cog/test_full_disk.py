"""A real file system that is full, or read-only."""

import errno
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.tools import need_root, need_tool, unavailable
from tests.support.waiting import HANG_S

ROOT = Path(__file__).parents[3]
SIZE = "size=800k"


def flown_on(folder, options, *arguments):
    """Fly on a tmpfs in a mount namespace that ends with the program."""
    need_root()
    unshare, mount = need_tool("unshare", "util-linux"), need_tool("mount")
    alone = [unshare, "--mount", "--propagation", "private"]
    mounted = f'"{mount}" -t tmpfs -o "$0" tmpfs "$1"'
    folder.mkdir()
    tried = subprocess.run(
        [*alone, "sh", "-c", mounted, options, folder], capture_output=True, text=True, check=False
    )
    if tried.returncode:
        unavailable(f"no file system can be mounted here: {tried.stderr.strip()}")
    script = f'{mounted} && shift && exec "$@"'
    program = [sys.executable, "-m", "tests.cogs.black_box_cog.full_disk", folder, *arguments]
    done = subprocess.run(
        [*alone, "sh", "-c", script, options, folder, *program],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=HANG_S,
        check=True,
    )
    return json.loads(done.stdout)


@pytest.fixture(scope="module")
def told(tmp_path_factory):
    return flown_on(tmp_path_factory.mktemp("disk") / "small", SIZE)


def test_a_full_disk_stops_the_recording_and_is_reported_once(told):
    full = told["full"]
    assert told["free_when_full"] == 0
    assert not full["recording"]
    assert full["problem"].endswith(os.strerror(errno.ENOSPC))
    assert full["errors"] == ["recording_stopped"]
    assert full["dropped"] > 0


def test_what_was_recorded_stays_readable_up_to_its_last_whole_record(told):
    first = told["numbers"][0]
    assert len(first) > 300 and first == list(range(len(first)))
    assert told["whole"] and told["complete"][0] is False


def test_with_room_again_the_flight_continues_in_another_part(told):
    assert told["later"] == {
        "recording": True,
        "problem": None,
        "dropped": told["later"]["dropped"],
        "errors": [],
    }
    assert told["files"][1] == told["files"][0].replace(".mcap", ".2.mcap")
    assert told["complete"][1]
    second = told["numbers"][1]
    assert second == list(range(second[0], 4900))
    assert told["codes"].count("recording_stopped") == 1


def test_a_read_only_disk_is_reported_once(tmp_path):
    told = flown_on(tmp_path / "small", f"{SIZE},ro", "read-only")
    assert told["files"] == []
    assert told["read_only"]["problem"].endswith("Read-only file system")
    assert told["read_only"]["errors"] == ["recording_stopped"]
