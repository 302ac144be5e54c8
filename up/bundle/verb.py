"""``up bundle``: everything that an installation without a network needs, in one folder."""

import argparse
import json
import platform
import shutil
import subprocess
import sys
import zipfile
from collections.abc import Sequence
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from up.bundle import install
from up.bundle.install import ABOUT, LOCK, SUMS, WHEELS, InstallError, check_sums, sum_of
from up.cli.cli_error import CliError
from up.output import echo

EXTRAS = "cogs,ground,keys,mavlink,metrics,tls"
"""The extras of the main distribution whose packages the lock has."""
SITE = "up_ground/web/static/docs/"
NEWEST_GLIBC, OLDEST_GLIBC = 36, 17
"""The minor versions of glibc 2 whose wheels are accepted; Debian 12 has 2.36."""
STEPS = 4


def run(values: argparse.Namespace) -> int:
    """Write the bundle."""
    dist: Path = values.dist
    try:
        check_sums(dist)
    except InstallError as error:
        text = f"{error}; make dist in a clone writes the wheels (--dist DIR names their folder)"
        raise CliError(text, 2, error.code) from None
    wheels = list(dist.glob("raspilot-[0-9]*.whl"))
    if len(wheels) != 1:
        text = f"{dist} has {len(wheels)} wheels of raspilot, not one: make dist"
        raise CliError(text, 2, "dist_incomplete")
    wheel = wheels[0]
    name = "-".join(wheel.name.split("-")[:2])
    target = values.folder / name
    if target.exists():
        raise CliError(f"{target} exists: remove it, or choose another folder", 2, "bundle_exists")
    platforms = values.platform or [f"linux_{platform.machine()}"]
    pythons = values.python or ["{}.{}".format(*sys.version_info)]
    # Complete, or under another name.
    work = values.folder / f".{name}.part"
    shutil.rmtree(work, ignore_errors=True)
    (work / WHEELS).mkdir(parents=True)
    _step(1, f"copy the wheels of {dist}")
    for each in dist.glob("*.whl"):
        shutil.copy(each, work / WHEELS)
    shutil.copy(dist / LOCK, work)
    shutil.copy(str(install.__file__), work / "install.py")
    for tag in platforms:
        for python in pythons:
            _step(2, f"download the packages for {tag}, Python {python}")
            download(work, tag, python)
    _step(3, "unpack the documentation")
    _unpack_site(wheel, work)
    release = name.partition("-")[2]
    about = {
        "version": release,
        "platforms": platforms,
        "pythons": pythons,
        "requirements": [f"raspilot[{EXTRAS}]=={release}", f"up-flightlog=={release}"],
    }
    (work / ABOUT).write_text(json.dumps(about, indent=2) + "\n", encoding="utf-8")
    _step(4, "write the checksums")
    files = sorted(each for each in work.rglob("*") if each.is_file())
    lines = [f"{sum_of(each)}  {each.relative_to(work).as_posix()}\n" for each in files]
    (work / SUMS).write_text("".join(lines), encoding="utf-8")
    size_mb = sum(each.stat().st_size for each in files) / 1e6
    work.rename(target)
    text = f"{target}: {len(files)} files, {size_mb:.0f} MB; there: sudo python3 install.py"
    echo(text, "bundle_written", path=str(target), files=len(files))
    return 0


def platform_tags(tag: str) -> list[str]:
    """Return the tags of wheels that run on a platform such as ``linux_aarch64`` (PEP 600)."""
    machine = tag.removeprefix("linux_")
    minors = range(NEWEST_GLIBC, OLDEST_GLIBC - 1, -1)
    return [*(f"manylinux_2_{n}_{machine}" for n in minors), f"manylinux2014_{machine}", tag]


def download(work: Path, tag: str, python: str) -> None:
    """Download the locked packages, and pip itself, for a platform. Raises CliError."""
    for more in (
        ("--require-hashes", "-r", str(work / LOCK)),
        (f"pip=={_pip_version()}",),
    ):
        command = [sys.executable, "-m", "pip", "download", "--dest", str(work / WHEELS)]
        command += ["--no-deps", "--only-binary", ":all:", "--python-version", python]
        command += [word for each in platform_tags(tag) for word in ("--platform", each)]
        command += ["--implementation", "cp", "--progress-bar", "off"]
        # Its lines are the progress.
        _run([*command, "--disable-pip-version-check", *more], tag, python)


def _run(command: Sequence[str], tag: str, python: str) -> None:
    status = subprocess.run(command, check=False).returncode
    if status:
        text = f"pip cannot download every package for {tag} and Python {python}"
        raise CliError(f"{text} (status {status})", code="download_failed")


def _pip_version() -> str:
    try:
        return version("pip")
    except PackageNotFoundError:
        raise CliError("up bundle needs pip in this environment", 2, "import_missing") from None


def _unpack_site(wheel: Path, work: Path) -> None:
    """Unpack the documentation of a wheel. Raises CliError if it has none."""
    with zipfile.ZipFile(wheel) as archive:
        names = [each for each in archive.namelist() if each.startswith(SITE)]
        if not names:
            raise CliError(f"{wheel} has no documentation: make dist", 2, "docs_missing")
        for name in names:
            path = work / "docs" / name.removeprefix(SITE)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(archive.read(name))


def _step(number: int, text: str) -> None:
    echo(f"{number} of {STEPS}: {text} ...", "bundle_step", number=number)
