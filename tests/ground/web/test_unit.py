"""The systemd unit of the page."""

import subprocess
import urllib.request
from pathlib import Path

from tests.ground.aircraft import UP_GROUND, coded, environment
from tests.support.sandbox import under
from tests.support.tools import need_tool

UNIT = Path(__file__).parents[3] / "ground" / "up-ground.service"


def test_systemd_finds_no_fault(tmp_path):
    # Verification looks at the program, so the unit names the one that is installed here.
    text = UNIT.read_text(encoding="utf-8").replace("/opt/raspilot/bin/up-ground", str(UP_GROUND))
    assert f"ExecStart={UP_GROUND} serve --listen" in text
    unit = tmp_path / UNIT.name
    unit.write_text(text, encoding="utf-8")
    verified = subprocess.run(
        [need_tool("systemd-analyze", "systemd"), "verify", str(unit)],
        capture_output=True,
        text=True,
    )
    assert (verified.returncode, verified.stderr) == (0, "")


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
