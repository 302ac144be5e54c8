"""The how-to's file, put beside the others in a copy of the firmware, is a Command."""

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.arduino.flight import HIGH, Flight
from tests.support.firmware import ARDUINO, ROOT, need_toolchain

PAGE = ROOT / "docs" / "how-to" / "firmware-command.md"
FILE = re.compile(r"<!-- file: (\S+) -->\n```cpp\n(.*?)```", re.DOTALL)


@pytest.fixture(scope="module")
def elf(tmp_path_factory):
    """Build a copy of the firmware with the page's one new file."""
    need_toolchain()
    folder = tmp_path_factory.mktemp("firmware")
    shutil.copytree(ARDUINO, folder / "arduino", ignore=shutil.ignore_patterns("build*"))
    found = FILE.search(PAGE.read_text(encoding="utf-8"))
    assert found is not None
    path = Path(folder, found[1])
    assert not path.exists()
    path.write_text(found[2], encoding="utf-8")
    subprocess.run(
        ["make", "-C", str(folder / "arduino"), "build/raspilot.elf"],
        check=True,
        capture_output=True,
        text=True,
    )
    return folder / "arduino" / "build" / "raspilot.elf"


def test_one_new_file_is_a_command(elf, monkeypatch):
    monkeypatch.setenv("RASPILOT_ELF", str(elf))
    flight = Flight()
    assert flight.ask("W") == b"\0"
    assert flight.ask("L", b"\1") == "K"
    assert flight.ask("W") == b"\1"
    assert flight.ask("L", b"\2") == 3
    assert flight.ask("L") == 2
    flight.run_ms(1500)
    flight.arm()
    assert flight.ask("L", b"\0") == 4
    assert flight.ask("W") == b"\1"


def test_without_the_file_nobody_knows_it():
    assert Flight(aux1=HIGH).ask("L", b"\1") == 1
