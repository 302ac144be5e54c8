"""Setting up a folder of JavaScript: npm, once, quietly, or a sentence with the reason."""

import shutil
import subprocess
from pathlib import Path

import pytest

NPM_MODULES = Path(__file__).parents[2] / "tools" / "npm_modules"
USED = ("sh", "cmp", "cp", "mktemp", "rm", "cat", "grep", "mkdir")
NPM = """\
#!/bin/sh
echo "$*" >>../calls
rm -rf node_modules
if [ -f ../fault ]; then cat ../fault >&2; exit 1; fi
mkdir node_modules
echo 'added 2 packages'
"""


class Machine:
    """A machine of which only these programs are seen."""

    def __init__(self, folder):
        self.folder = folder
        self.modules = folder / "page"
        self.modules.mkdir()
        self.lock = self.modules / "package-lock.json"
        self.lock.write_text("{}", encoding="ascii")
        self.bin = folder / "bin"
        self.bin.mkdir()
        for name in USED:
            (self.bin / name).symlink_to(shutil.which(name))
        self.npm = self.bin / "npm"
        self.npm.write_text(NPM, encoding="ascii")
        self.npm.chmod(0o755)

    @property
    def calls(self):
        path = self.folder / "calls"
        return path.read_text().splitlines() if path.exists() else []

    def set_up(self):
        done = subprocess.run(
            [self.bin / "sh", NPM_MODULES, self.modules],
            env={"PATH": str(self.bin)},
            capture_output=True,
            text=True,
        )
        return done.returncode, (done.stdout + done.stderr).strip()


@pytest.fixture
def machine(tmp_path):
    return Machine(tmp_path)


def test_npm_installs_what_the_lock_file_names_and_runs_nothing_of_it(machine):
    status, said = machine.set_up()
    assert status == 0 and str(machine.modules) in said and "\n" not in said
    assert len(machine.calls) == 1
    assert machine.calls[0].startswith("ci --ignore-scripts")


def test_it_does_so_once_until_the_lock_file_changes(machine):
    machine.set_up()
    assert machine.set_up() == (0, "")
    assert len(machine.calls) == 1
    machine.lock.write_text('{"packages": {}}', encoding="ascii")
    assert machine.set_up()[0] == 0
    assert len(machine.calls) == 2


def test_without_npm_it_names_the_package(machine):
    machine.npm.unlink()
    status, said = machine.set_up()
    assert status == 3 and "nodejs" in said and "\n" not in said


def test_a_network_that_is_down_is_one_sentence_and_leaves_no_stamp(machine):
    (machine.folder / "fault").write_text("npm error code ENOTFOUND\nnpm error syscall\n")
    status, said = machine.set_up()
    assert status == 4 and said.count("\n") == 1 and "ENOTFOUND" not in said
    (machine.folder / "fault").unlink()
    assert machine.set_up()[0] == 0
    assert len(machine.calls) == 2


def test_any_other_fault_is_told_in_npm_s_words(machine):
    (machine.folder / "fault").write_text("npm error code EINTEGRITY\n")
    status, said = machine.set_up()
    assert status == 1 and said.endswith("EINTEGRITY")
