"""What ``make test-arm`` needs and finds, without the emulation."""

import subprocess
import sys
from pathlib import Path

from tools import arm_tests

ROOT = Path(__file__).parents[2]


def test_each_missing_tool_is_named_with_its_package(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(arm_tests, "BINFMT", tmp_path)
    monkeypatch.setattr(arm_tests.shutil, "which", lambda tool, path: None)
    assert arm_tests.main(["armhf"]) == 2
    lines = capsys.readouterr().err.splitlines()
    for tool, package in arm_tests.TOOLS.items():
        assert any(f" {tool}: " in each and each.endswith(package) for each in lines)
    (emulator,) = (each for each in lines if " qemu-arm " in each)
    assert "qemu-user-static" in emulator and "qemu-aarch64" not in "".join(lines)


def test_the_chosen_tests_exist_and_its_packages_are_those_of_this_environment():
    for each in (*arm_tests.TESTS, *arm_tests.UNSUPPORTED):
        file, _, name = each.partition("::")
        assert (ROOT / file).exists()
        assert not name or f"def {name}(" in (ROOT / file).read_text()
    for name in (*arm_tests.PURE, *arm_tests.COMPILED, arm_tests.FALLBACK):
        assert arm_tests.version(name)


def test_the_project_itself_has_no_code_for_a_processor():
    """So that nothing of its own needs a newer one than a Pi Zero's ARMv6."""
    tracked = subprocess.run(
        ["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, check=True
    ).stdout.split(b"\0")
    paths = [ROOT / each.decode() for each in tracked if each]
    assert len(paths) > 1000
    for path in paths:
        if path.is_file():
            with path.open("rb") as file:
                assert file.read(4) != b"\x7fELF", path
        if path.name == "setup.py":
            assert "ext_modules" not in path.read_text(), path


def test_the_processor_of_a_native_file_is_read():
    machine = arm_tests.cpu_of(Path(sys.executable).resolve())
    assert machine != "unknown" and machine
