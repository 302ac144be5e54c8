"""The systemd units: the exposure of the system to a program, by systemd's own measure."""

import re
import subprocess
from pathlib import Path

import pytest

from tests.support.sandbox import service
from tests.support.tools import need_tool

ROOT = Path(__file__).parents[1]
MAX_EXPOSURE = {
    "proxy/up-proxy.service": 2.0,
    "ground/up-ground.service": 4.0,
    "raspilot/raspilot.service": 4.0,
    "runner/up-runner.service": 4.0,
}


def test_every_unit_is_here():
    listed = subprocess.run(
        ["git", "ls-files", "*.service"], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert set(listed.stdout.split()) == set(MAX_EXPOSURE)


def test_the_exposure_is_low_and_documented():
    command = [need_tool("systemd-analyze", "systemd"), "security", "--offline=yes", "--no-pager"]
    shown = subprocess.run(
        [*command, *(str(ROOT / unit) for unit in MAX_EXPOSURE)],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    measured = dict(re.findall(r"exposure level for (\S+): ([\d.]+)", shown.stdout))
    page = (ROOT / "docs" / "install.md").read_text()
    for unit, limit in MAX_EXPOSURE.items():
        exposure = float(measured[Path(unit).name])
        assert exposure <= limit, unit
        documented = float(re.search(rf"\| `{re.escape(unit)}` \| ([\d.]+) \|", page)[1])
        # Other versions of systemd weigh a little differently.
        assert abs(exposure - documented) <= 0.5, unit


@pytest.mark.parametrize("unit", MAX_EXPOSURE)
def test_no_unit_gives_new_privileges_or_capabilities(unit):
    options = service(unit)
    assert options["NoNewPrivileges"] == "yes"
    assert options["CapabilityBoundingSet"] == ""
    assert options.get("User") != "root"
