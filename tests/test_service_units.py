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


@pytest.mark.parametrize(("unit", "limit"), MAX_EXPOSURE.items())
def test_the_exposure_is_low_and_documented(unit, limit):
    command = [need_tool("systemd-analyze", "systemd"), "security", "--offline=yes"]
    shown = subprocess.run(
        [*command, "--no-pager", str(ROOT / unit)], capture_output=True, text=True, check=True
    )
    exposure = float(re.search(r"exposure level for \S+: ([\d.]+)", shown.stdout)[1])
    assert exposure <= limit
    row = rf"\| `{re.escape(unit)}` \| ([\d.]+) \|"
    documented = float(re.search(row, (ROOT / "docs" / "install.md").read_text())[1])
    # Other versions of systemd weigh a little differently.
    assert abs(exposure - documented) <= 0.5


@pytest.mark.parametrize("unit", MAX_EXPOSURE)
def test_no_unit_gives_new_privileges_or_capabilities(unit):
    options = service(unit)
    assert options["NoNewPrivileges"] == "yes"
    assert options["CapabilityBoundingSet"] == ""
    assert options.get("User") != "root"
