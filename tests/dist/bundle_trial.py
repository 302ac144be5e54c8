"""``make test-bundle``: a bundle of dist/, and what it installs without a network.

It downloads from the package index and builds a second version, so ``make test`` leaves it out.
Needs root: `unshare -n` gives a namespace without a network.
"""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.tools import need_root
from up.version import VERSION

ROOT = Path(__file__).parents[2]
LATER = "99.0.0"
BUILT = ("ground/up_ground/web/static/vendor", "ground/up_ground/web/static/docs", "arduino/build")


def run(*words, status=0, **more):
    done = subprocess.run(words, capture_output=True, text=True, timeout=900, **more)
    assert done.returncode == status, f"{words}:\n{done.stdout}{done.stderr}"
    return done.stdout + done.stderr


def bundle(dist, stick, *options):
    return run(sys.executable, "-m", "up.cli", "bundle", stick, "--dist", dist, *options)


class Machine:
    """A prefix, and programs that run without a network."""

    def __init__(self, prefix):
        self.prefix = prefix

    def install(self, folder, *options, status=0):
        words = [sys.executable, "-S", "-I", folder / "install.py", "--prefix", self.prefix]
        return self.run(*words, *options, status=status)

    def run(self, *words, status=0):
        kept = {k: v for k, v in os.environ.items() if not k.startswith(("UP_", "PYTHON"))}
        return run("unshare", "-n", *words, status=status, cwd="/", env=kept)

    def version(self):
        return self.run(self.prefix / "bin/up", "--version").split()[-1]


@pytest.fixture(scope="module")
def stick(tmp_path_factory):
    """Two bundles: this version's and one of a later version, built from a clone."""
    need_root()
    folder = tmp_path_factory.mktemp("stick")
    assert "4 of 4" in bundle(ROOT / "dist", folder)
    clone = tmp_path_factory.mktemp("later") / "clone"
    git = ["git", "-c", "user.name=a", "-c", "user.email=a@example.org"]
    run(*git, "clone", "--quiet", ROOT, clone)
    for name in BUILT:
        shutil.copytree(ROOT / name, clone / name)
    path = clone / "up/version.py"
    path.write_text(path.read_text().replace(f'"{VERSION}"', f'"{LATER}"'))
    run("make", "version", cwd=clone)
    run(*git, "commit", "--quiet", "-am", "a later version", cwd=clone)
    run(sys.executable, clone / "tools/dist.py", "--output", clone / "dist")
    bundle(clone / "dist", folder)
    return folder


def test_install_update_roll_back_remove(stick, tmp_path):
    machine = Machine(tmp_path / "raspilot")
    first, second = stick / f"raspilot-{VERSION}", stick / f"raspilot-{LATER}"
    assert "5 of 5" in machine.install(first)
    assert machine.version() == VERSION
    binaries, config = machine.prefix / "bin", machine.prefix / "share/raspilot/config"
    machine.run(binaries / "up", "-f", "raspilot", "check", "--config", config)
    machine.run(binaries / "up-sim", "--help")
    code = "import raspilot, sys; print(sys.prefix)"
    prefix = machine.run(binaries / "python", "-c", code).strip()
    assert Path(prefix) == machine.prefix / "versions" / VERSION
    machine.install(second)
    assert machine.version() == LATER
    machine.install(second, "--rollback")
    assert machine.version() == VERSION
    assert f"{VERSION} current" in machine.install(first, "--list")
    machine.install(first, "--uninstall")
    assert not machine.prefix.exists()
    assert (first / "docs/index.html").is_file()


def test_a_damaged_wheel_changes_nothing(stick, tmp_path):
    damaged = tmp_path / "damaged"
    shutil.copytree(stick / f"raspilot-{VERSION}", damaged)
    wheel = next((damaged / "wheels").glob("twisted-*.whl"))
    wheel.write_bytes(wheel.read_bytes()[:-1] + b"\0\0")
    machine = Machine(tmp_path / "raspilot")
    assert "(file_damaged)" in machine.install(damaged, status=1)
    assert not machine.prefix.exists()


def test_a_bundle_for_a_raspberry_pi_has_its_wheels(tmp_path):
    bundle(ROOT / "dist", tmp_path, "--platform", "linux_aarch64", "--python", "3.13")
    folder = tmp_path / f"raspilot-{VERSION}"
    assert json.loads((folder / "bundle.json").read_text())["pythons"] == ["3.13"]
    names = [each.name for each in (folder / "wheels").iterdir()]
    assert any("cp313" in name and "aarch64" in name for name in names)
    assert not any("x86_64" in name for name in names)
    # For this machine it is refused before anything is made.
    machine = Machine(tmp_path / "raspilot")
    machine.install(folder, status=1)
    assert not machine.prefix.exists()
