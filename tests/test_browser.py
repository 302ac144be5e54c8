"""The ground station's page in a real browser: one item for each file of tests/browser."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.tools import need_browser, need_tool, unavailable

ROOT = Path(__file__).parents[1]
FOLDER = ROOT / "tests" / "browser"
FILES = sorted(FOLDER.glob("*.test.mjs"))
LIMIT_S = 600.0
OLDEST_NODE = 18
# A network with nothing in it but this machine itself.
ALONE = ("unshare", "--net", "sh", "-c", 'ip link set lo up && exec "$0" "$@"')


@pytest.fixture(scope="session")
def modules():
    """See to node, Chromium and the modules of the tests."""
    node = need_browser()
    version = subprocess.run([node, "--version"], capture_output=True, text=True, check=True).stdout
    if int(version.removeprefix("v").split(".")[0]) < OLDEST_NODE:
        unavailable(f"node {version.strip()} is older than {OLDEST_NODE}")
    done = subprocess.run([ROOT / "tools" / "web_assets"], capture_output=True, text=True)
    if done.returncode != 0:
        unavailable(done.stderr.strip())
    return node


@pytest.fixture(scope="session")
def alone():
    """Return the command that runs another without any network; none where that needs more."""
    if os.geteuid() != 0:
        return ()
    need_tool("ip", "iproute2")
    may = subprocess.run([*ALONE, "true"], capture_output=True)
    return ALONE if may.returncode == 0 else ()


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.name.removesuffix(".test.mjs"))
def test_in_the_browser(file, modules, alone):
    environment = {**os.environ, "UP_PYTHON": sys.executable, "UP_ALONE": "yes" if alone else ""}
    process = subprocess.Popen(
        [*alone, modules, "--test", "--test-reporter=spec", str(file)],
        cwd=ROOT,
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    )
    try:
        said, _ = process.communicate(timeout=LIMIT_S)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGTERM)
        said, _ = process.communicate()
        pytest.fail(f"not within {LIMIT_S:.0f} s:\n{said}")
    print(said)
    assert process.returncode == 0, f"{file.name}: see above"


def test_there_is_something_to_run():
    assert FILES
