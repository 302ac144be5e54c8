"""A peer that is connected but receives nothing, as in a cellular gap; needs root and nftables."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.tools import need_root, need_tool, unavailable
from tests.support.waiting import HANG_S

SCRIPT = Path(__file__).with_name("blackhole.py")
TOOLS = {"unshare": "util-linux", "nft": "nftables", "ip": "iproute2"}

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("way", ["sending", "idle"])
def test_a_blackhole_is_noticed_long_before_the_system_would(way):
    need_root()
    for tool, package in TOOLS.items():
        need_tool(tool, package)
    environment = {**os.environ, "PYTHONPATH": str(SCRIPT.parents[3])}
    result = subprocess.run(
        ["unshare", "-n", sys.executable, str(SCRIPT), way],
        capture_output=True,
        text=True,
        timeout=HANG_S,
        env=environment,
        check=False,
    )
    if "unshare" in result.stderr:
        unavailable(result.stderr.strip())
    seconds = result.stdout.partition(" ")[0]
    assert seconds, result.stderr
    # 1.5 s without an acknowledgement; an idle link is first probed after 3 s.
    assert float(seconds) < 20
