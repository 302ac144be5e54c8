"""The distributions of a release: contents, and a start from nothing but the wheel."""

import hashlib
import os
import re
import shutil
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import pytest

from tests.support.firmware import make, need_toolchain
from tests.support.tools import need_tool
from up.version import VERSION

ROOT = Path(__file__).parents[2]
SERIAL = "cogs/serial_cog"
TIME = {"SOURCE_DATE_EPOCH": "1700000000"}
VENDOR = ROOT / "ground/up_ground/web/static/vendor"


def dist(output, *folders, root=ROOT):
    return subprocess.run(
        [sys.executable, root / "tools/dist.py", "--output", str(output), *folders],
        capture_output=True,
        text=True,
        env={**os.environ, **TIME},
        check=False,
    )


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    need_toolchain()
    need_tool("npm", "npm")
    subprocess.run([ROOT / "tools/web_assets"], check=True)
    make("release")
    output = tmp_path_factory.mktemp("dist")
    done = dist(output, ".", SERIAL)
    assert done.returncode == 0, done.stderr
    return output


def names_in(wheel):
    with zipfile.ZipFile(wheel) as archive:
        return set(archive.namelist())


def test_the_wheel_has_what_the_tree_has(built):
    names = names_in(built / f"raspilot-{VERSION}-py3-none-any.whl")
    share = f"raspilot-{VERSION}.data/data/share/raspilot"
    tracked = subprocess.run(
        ["git", "ls-files", "config", "*.service", "*/up-*.conf", "arduino/raspilot", "up", "raspilot"],
        cwd=ROOT, capture_output=True, text=True, check=True,
    ).stdout.split()  # fmt: skip
    places = {"config": share, "arduino": "up_rig", "up": "", "raspilot": ""}
    for file in tracked:
        place = f"{share}/systemd/{Path(file).name}" if file.endswith(".service") else None
        place = f"{share}/upstart/{Path(file).name}" if file.endswith(".conf") else place
        place = place or f"{places[file.split('/')[0]]}/{file}".lstrip("/")
        assert place in names, file
    ours = {each.parent.name for each in ROOT.glob("*/up_*/__init__.py")} - {"up_flightlog"}
    assert {f"{each}/__init__.py" for each in ours} <= names
    assert f"{share}/firmware/raspilot.hex" in names
    assert {"up_rig/arduino/release/raspilot.elf", "up_rig/arduino/host/host.mk"} <= names
    for each in VENDOR.rglob("*.*"):
        if each.is_file() and not each.name.startswith("."):
            assert f"up_ground/web/static/{each.relative_to(VENDOR.parent)}" in names
    assert not any(re.search(r"\.pyc$|/tests?/|egg-info", name) for name in names)


def test_the_same_bytes_again_and_from_the_sdist(built, tmp_path):
    sums = (built / "SHA256SUMS").read_text()
    again = dist(tmp_path / "again", SERIAL)
    assert again.returncode == 0, again.stderr
    for file in (tmp_path / "again").iterdir():
        if file.name != "SHA256SUMS":
            assert f"{hashlib.sha256(file.read_bytes()).hexdigest()}  {file.name}\n" in sums
    with tarfile.open(built / f"raspilot_serial_cog-{VERSION}.tar.gz") as archive:
        archive.extractall(tmp_path, filter="data")
    (sources,) = tmp_path.glob("raspilot_serial_cog-*")
    build = "import setuptools.build_meta as backend; backend.build_wheel('.')"
    subprocess.run(
        [sys.executable, "-c", build], cwd=sources, env={**os.environ, **TIME}, check=True,
        capture_output=True, umask=0o022,
    )  # fmt: skip
    name = f"raspilot_serial_cog-{VERSION}-py3-none-any.whl"
    assert (sources / name).read_bytes() == (built / name).read_bytes()


def test_the_wheel_alone_loads_the_application_and_its_firmware(built, tmp_path):
    """Unpacked in a folder that comes before the source tree on the path."""
    packages = tmp_path / "packages"
    for wheel in built.glob("*.whl"):
        with zipfile.ZipFile(wheel) as archive:
            archive.extractall(packages)
    environ = {
        **{k: v for k, v in os.environ.items() if not k.startswith(("UP_", "PYTHON"))},
        "PYTHONPATH": str(packages),
        "XDG_CACHE_HOME": str(tmp_path / "cache"),
        "PYTHONDONTWRITEBYTECODE": "1",
    }

    def run(*words):
        done = subprocess.run(
            [sys.executable, *words], cwd=tmp_path, env=environ, capture_output=True, text=True
        )
        assert done.returncode == 0, f"{words}: {done.stdout}{done.stderr}"
        return done.stdout

    assert run("-m", "raspilot", "--version").strip() == f"Raspilot {VERSION}"
    run("-m", "up.cli", "-f", "raspilot", "register", "-n", "serial_cog")
    config = packages / f"raspilot-{VERSION}.data/data/share/raspilot/config"
    listed = run("-m", "up.cli", "-f", "raspilot", "modules", "--json", "--config", str(config))
    assert "serial_cog.modules" in listed and "raspilot.modules" in listed
    assert not (ROOT / "raspilot" / "UpFile").samefile(packages / "raspilot" / "UpFile")
    places = "import up_rig.build as b; print(b.build_firmware()); print(b.has_sources(), b.ARDUINO)"
    elf, sources = run("-c", places).splitlines()
    assert Path(elf).is_relative_to(packages) and sources.startswith("True ")
    assert Path(sources.split()[1]).is_relative_to(tmp_path / "cache")


def test_a_release_without_the_built_parts_is_refused(tmp_path):
    """In a copy of the packaging alone; a clone with nothing built stands for it."""
    clone = tmp_path / "clone"
    (clone / "tools").mkdir(parents=True)
    for name in ("setup.py", "pyproject.toml", "README.md", "LICENSE", "constraints.txt"):
        shutil.copy(ROOT / name, clone)
    shutil.copy(ROOT / "tools/dist.py", clone / "tools")
    for name in ("up/version.py", "up/__init__.py", "raspilot/Cogfile.yml", "raspilot/__init__.py"):
        (clone / name).parent.mkdir(exist_ok=True)
        shutil.copy(ROOT / name, clone / name)
    git = ["git", "-c", "user.name=a", "-c", "user.email=a@example.org"]
    subprocess.run([*git, "init", "-q"], cwd=clone, check=True)
    subprocess.run([*git, "add", "."], cwd=clone, check=True)
    subprocess.run([*git, "commit", "-qm", "a"], cwd=clone, check=True)
    done = dist(tmp_path / "out", ".", root=clone)
    assert done.returncode == 1 and "raspilot.elf" in done.stderr and "leaflet" in done.stderr
    assert not list((tmp_path / "out").glob("*.whl"))
