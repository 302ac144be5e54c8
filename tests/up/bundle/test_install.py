"""The installer of a bundle: checksums, versions side by side, what it refuses."""

import hashlib
import json
import platform
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.waiting import until
from up.bundle import install
from up.bundle.install import InstallError, Prefix, check_machine, check_sums


@pytest.fixture
def bundle(tmp_path):
    """A bundle of two files."""
    folder = tmp_path / "bundle"
    (folder / "wheels").mkdir(parents=True)
    files = {"wheels/a.whl": b"wheel", "bundle.json": b'{"version": "1.0"}'}
    lines = []
    for name, content in files.items():
        (folder / name).write_bytes(content)
        lines.append(f"{hashlib.sha256(content).hexdigest()}  {name}\n")
    (folder / "SHA256SUMS").write_text("".join(lines))
    return folder


def put(prefix, version):
    """Stand for an installed version: a program that prints which one it is."""
    binaries = prefix.place(version) / "bin"
    binaries.mkdir(parents=True)
    for name in ("up", "python"):
        (binaries / name).write_text(f'#!/bin/sh\necho {version} "$@"\n')
        (binaries / name).chmod(0o755)
    (prefix.place(version) / install.COMPLETE).touch()


def code_of(call, *arguments):
    with pytest.raises(InstallError) as error:
        call(*arguments)
    return error.value.code


def test_every_file_is_compared_with_its_sum(bundle):
    assert check_sums(bundle) == 2
    (bundle / "wheels/a.whl").write_bytes(b"wheeL")
    assert code_of(check_sums, bundle) == "file_damaged"
    (bundle / "wheels/a.whl").unlink()
    assert code_of(check_sums, bundle) == "file_missing"
    (bundle / "SHA256SUMS").write_text(f"{'0' * 64}  ../outside\n")
    assert code_of(check_sums, bundle) == "sums_damaged"
    (bundle / "SHA256SUMS").unlink()
    assert code_of(check_sums, bundle) == "no_sums"


def test_nothing_of_a_damaged_bundle_is_installed(bundle, tmp_path):
    (bundle / "bundle.json").write_bytes(b"{}")
    assert code_of(install.install, bundle, Prefix(tmp_path / "prefix")) == "file_damaged"
    assert not (tmp_path / "prefix").exists()


@pytest.mark.parametrize(("python", "machine"), [("3.9", "x86_64"), ("3.11", "armv7l")])
def test_a_bundle_for_another_machine_is_refused(python, machine):
    about = {"platforms": ["linux_x86_64", "linux_aarch64"], "pythons": ["3.11"]}
    check_machine(about, "3.11", "aarch64")
    assert code_of(check_machine, about, python, machine) == "other_machine"


def test_versions_are_side_by_side_and_one_can_go_back(tmp_path):
    prefix = Prefix(tmp_path / "a prefix")

    def answer():
        done = subprocess.run([prefix.folder / "bin/up", "x y"], capture_output=True, text=True)
        return done.stdout.strip()

    put(prefix, "1.0")
    prefix.use("1.0")
    assert answer() == "1.0 x y"
    assert code_of(prefix.roll_back) == "no_previous"
    put(prefix, "1.1")
    prefix.use("1.1")
    prefix.use("1.1")
    assert (answer(), prefix.linked("previous")) == ("1.1 x y", "1.0")
    assert (prefix.roll_back(), answer(), prefix.roll_back()) == ("1.0", "1.0 x y", "1.1")
    (prefix.place("1.0") / install.COMPLETE).unlink()
    assert prefix.versions() == ["1.1"]
    assert code_of(prefix.roll_back) == "no_previous"
    assert code_of(prefix.use, "2.0") == "no_such_version"


def test_all_versions_are_removed_and_nothing_of_others(tmp_path):
    prefix = Prefix(tmp_path / "prefix")
    assert code_of(prefix.remove) == "not_installed"
    put(prefix, "1.0")
    prefix.use("1.0")
    (prefix.folder / "notes").touch()
    sleep = prefix.place("1.0") / "bin/sleep"
    shutil.copy("/bin/sleep", sleep)
    running = subprocess.Popen([sleep, "1000"])
    # The kernel lets this process go on before it has set the other's words.
    until(Path(f"/proc/{running.pid}/cmdline").read_bytes, "the program")
    assert code_of(prefix.remove) == "still_runs"
    running.kill()
    running.wait()
    assert prefix.remove() == ["1.0"]
    assert [each.name for each in prefix.folder.iterdir()] == ["notes"]


def test_another_installation_in_the_folder_is_left_alone(tmp_path):
    prefix = Prefix(tmp_path)
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin/python").write_text("#!/bin/sh\n")
    assert code_of(prefix.check_free) == "prefix_in_use"


def test_it_is_a_program_of_the_standard_library_alone(bundle, tmp_path):
    about = {"version": "1.0", "platforms": ["linux_z80"], "pythons": ["3.11"]}
    text = json.dumps(about).encode()
    (bundle / "bundle.json").write_bytes(text)
    (bundle / "SHA256SUMS").write_text(f"{hashlib.sha256(text).hexdigest()}  bundle.json\n")
    shutil.copy(install.__file__, bundle / "install.py")
    words = [sys.executable, "-S", "-I", bundle / "install.py", "--prefix", tmp_path / "p"]
    done = subprocess.run(words, capture_output=True, text=True)
    assert done.returncode == 1 and "(other_machine)" in done.stderr
    assert f"linux_{platform.machine()}" in done.stderr
    assert subprocess.run([*words, "--rollback"], capture_output=True).returncode == 1
