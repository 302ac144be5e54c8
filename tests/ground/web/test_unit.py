"""The systemd unit of the page."""

import subprocess
from pathlib import Path

from tests.ground.aircraft import UP_GROUND
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
