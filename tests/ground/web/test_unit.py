"""The systemd unit of the page."""

import subprocess
import urllib.request

from tests.ground.aircraft import UP_GROUND, coded, environment
from tests.support.sandbox import under, verify
from tests.support.tools import need_tool


def test_systemd_finds_no_fault(tmp_path):
    need_tool("systemd-analyze", "systemd")
    verify("ground/up-ground.service", UP_GROUND, tmp_path)


def test_it_runs_under_the_units_system_call_filter(tmp_path, proxy):
    need_tool("systemd-analyze", "systemd")
    command = [*under("ground/up-ground.service"), UP_GROUND, "serve", "--listen", "127.0.0.1:0"]
    with subprocess.Popen(
        command, env=environment(tmp_path, proxy.ground_port), stdout=subprocess.PIPE, text=True
    ) as server:
        address = next(coded(line)[0]["url"] for line in server.stdout if "page_open" in line)
        with urllib.request.urlopen(address) as page:
            assert page.status == 200
        server.terminate()
        assert server.wait() == 0
