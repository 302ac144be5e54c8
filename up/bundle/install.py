#!/usr/bin/env python3
"""Installs a version of Raspilot without a network, from the folder of this file.

  python3 install.py                   into /opt/raspilot, beside the other versions, and use it
  python3 install.py --list            the installed versions
  python3 install.py --rollback        use the version before this one
  python3 install.py --uninstall       remove all versions; the configuration stays

`up bundle` wrote the folder. The programs are in bin/ of the prefix and belong to the current
version. A version that runs already runs on until its end. Exit status: 1 it failed, and the
current version is still used; 2 wrong use.
"""

# Of the standard library only: it runs before anything is installed.

from __future__ import annotations

import argparse
import hashlib
import json
import os
import platform
import shutil
import subprocess
import sys
import venv
from pathlib import Path

DEFAULT_PREFIX = Path("/opt/raspilot")
SUMS, ABOUT, WHEELS, LOCK = "SHA256SUMS", "bundle.json", "wheels", "constraints.txt"
COMPLETE = ".complete"
"""In the folder of a version that was installed to its end."""
_LAUNCHER = """\
#!/bin/sh
# install.py of Raspilot wrote this: it runs the current version.
here="$(dirname "$(readlink -f "$0")")"
exec "$(readlink -f "$here/../current")/bin/{name}" "$@"
"""
_MARK = _LAUNCHER.splitlines()[1]


class InstallError(Exception):
    """It cannot be done; ``code`` is for programs, ``status`` the exit status."""

    def __init__(self, text: str, code: str, status: int = 1) -> None:
        super().__init__(text)
        self.code = code
        self.status = status


def sum_of(path: Path) -> str:
    """Return the SHA-256 of a file."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def check_sums(folder: Path) -> int:
    """Compare every file that SHA256SUMS lists; return their number. Raises InstallError."""
    try:
        lines = (folder / SUMS).read_text(encoding="utf-8").splitlines()
    except OSError as error:
        raise InstallError(f"cannot read {folder / SUMS}: {error.strerror}", "no_sums") from None
    for line in lines:
        wanted, _, name = line.partition("  ")
        path = folder / name
        if not name or not path.resolve().is_relative_to(folder.resolve()):
            raise InstallError(f"{folder / SUMS} is damaged: {line[:80]!r}", "sums_damaged")
        if not path.is_file():
            raise InstallError(f"{path} is missing: copy the folder again", "file_missing")
        if sum_of(path) != wanted:
            raise InstallError(f"{path} is damaged: copy the folder again", "file_damaged")
    return len(lines)


class Prefix:
    """The folder with the installed versions; ``current`` and ``previous`` are links to two."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._versions = folder / "versions"

    def versions(self) -> list[str]:
        """Return the versions that were installed to their end."""
        return sorted(each.parent.name for each in self._versions.glob(f"*/{COMPLETE}"))

    def linked(self, name: str) -> str | None:
        """Return the version to which ``current`` or ``previous`` leads; None without one."""
        link = self.folder / name
        version = link.readlink().name if link.is_symlink() else None
        return version if version in self.versions() else None

    def place(self, version: str) -> Path:
        return self._versions / version

    def check_free(self) -> None:
        """Raise InstallError if another kind of installation is in the folder."""
        for each in (self.folder / "bin").glob("*"):
            if not _is_launcher(each):
                text = f"{each} is of another installation: choose another --prefix"
                raise InstallError(text, "prefix_in_use", 2)

    def use(self, version: str) -> None:
        """Make a version the current one, and the current one the previous one."""
        former = self.linked("current")
        if version not in self.versions():
            raise InstallError(f"version {version} is not installed", "no_such_version", 2)
        if former not in (None, version):
            self._link("previous", str(former))
        self._write_launchers(version)
        self._link("current", version)

    def roll_back(self) -> str:
        """Use the previous version again; return it. Raises InstallError without one."""
        version = self.linked("previous")
        if version is None:
            raise InstallError(f"only one version is installed in {self.folder}", "no_previous")
        self.use(version)
        return version

    def remove(self) -> list[str]:
        """Remove all versions; return them. Raises InstallError while a program of one runs."""
        found = self.versions()
        if not found and not self._versions.is_dir():
            raise InstallError(f"nothing is installed in {self.folder}", "not_installed", 2)
        if running := _running_in(self._versions):
            text = f"process {running} still runs from {self._versions}: end it first"
            raise InstallError(text, "still_runs")
        for name in ("current", "previous", "share"):
            if (self.folder / name).is_symlink():
                (self.folder / name).unlink()
        for each in (self.folder / "bin").glob("*"):
            if _is_launcher(each):
                each.unlink()
        shutil.rmtree(self._versions)
        for each in (self.folder / "bin", self.folder):
            if each.is_dir() and not any(each.iterdir()):
                each.rmdir()
        return found

    def _link(self, name: str, version: str) -> None:
        new = self.folder / f".{name}.new"
        new.unlink(missing_ok=True)
        new.symlink_to(Path("versions", version))
        new.replace(self.folder / name)

    def _write_launchers(self, version: str) -> None:
        binaries = self.folder / "bin"
        binaries.mkdir(exist_ok=True)
        names = [each.name for each in (self.place(version) / "bin").glob("up*")]
        for name in [*names, "python"]:
            path = binaries / name
            path.write_text(_LAUNCHER.format(name=name), encoding="utf-8")
            path.chmod(0o755)
        share = self.folder / "share"
        if not share.exists() and not share.is_symlink():
            share.symlink_to(Path("current", "share"))


def _is_launcher(path: Path) -> bool:
    return path.is_file() and _MARK.encode() in path.read_bytes()[:200]


def _running_in(folder: Path) -> int | None:
    for each in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            words = each.read_bytes().split(b"\0")[:2]
        except OSError:
            continue
        if any(os.fsdecode(word).startswith(f"{folder}/") for word in words):
            return int(each.parent.name)
    return None


def check_machine(about: dict[str, list[str]], python: str, machine: str) -> None:
    """Raise InstallError if the bundle has no packages for this Python and this processor."""
    for name, own in (("platforms", f"linux_{machine}"), ("pythons", python)):
        if own not in about[name]:
            text = f"the bundle is for {', '.join(about[name])}, this machine has {own}"
            raise InstallError(f"{text}: up bundle --help", "other_machine")


def install(bundle: Path, prefix: Prefix) -> str:
    """Install the version of a bundle and use it; return it. Raises InstallError."""
    _step(1, "compare the files with their checksums")
    check_sums(bundle)
    about = json.loads((bundle / ABOUT).read_text(encoding="utf-8"))
    version = str(about["version"])
    check_machine(about, "{}.{}".format(*sys.version_info), platform.machine())
    prefix.check_free()
    if version not in prefix.versions():
        _install_version(bundle, prefix.place(version), about)
    _step(5, "switch")
    prefix.use(version)
    return version


def _install_version(bundle: Path, place: Path, about: dict[str, str]) -> None:
    # One that was not finished would look complete.
    shutil.rmtree(place, ignore_errors=True)
    _step(2, f"make the environment {place}")
    venv.EnvBuilder(symlinks=True, with_pip=False).create(place)
    python = place / "bin" / "python"
    (pip,) = (bundle / WHEELS).glob("pip-*.whl")
    offline = ("install", "--no-index", "--find-links", str(bundle / WHEELS), "--no-cache-dir")
    pip_install = (str(python), f"{pip}/pip", *offline, "--disable-pip-version-check")
    _step(3, "install the packages")
    _run(*pip_install, "--no-deps", "--require-hashes", "-r", str(bundle / LOCK))
    _run(*pip_install, *about["requirements"])
    _step(4, "register the cogs, check the modules")
    application = (str(place / "bin" / "up"), "-f", "raspilot")
    _run(*application, "gather", "--no-install")
    _run(*application, "check", "--config", str(place / "share" / "raspilot" / "config"))
    (place / COMPLETE).touch()


def _run(*words: str) -> None:
    environ = {k: v for k, v in os.environ.items() if not k.startswith(("PIP_", "PYTHON", "UP_"))}
    status = subprocess.run(words, env=environ, check=False).returncode
    if status:
        raise InstallError(f"{' '.join(words[:3])} ended with status {status}", "step_failed")


def _step(number: int, text: str) -> None:
    print(f"{number} of 5: {text} ...", flush=True)  # noqa: T201 - the user's answer


def main() -> int:
    """Carry out what the options ask for; return the exit status."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    text = f"folder of all versions (default: {DEFAULT_PREFIX})"
    parser.add_argument("--prefix", type=Path, default=DEFAULT_PREFIX, metavar="DIR", help=text)
    action = parser.add_mutually_exclusive_group()
    for name in ("list", "rollback", "uninstall"):
        action.add_argument(f"--{name}", action="store_true")
    options = parser.parse_args()
    prefix = Prefix(options.prefix.resolve())
    try:
        if options.list:
            marks = {prefix.linked("current"): "current", prefix.linked("previous"): "previous"}
            said = [f"{each} {marks.get(each, '')}".rstrip() for each in prefix.versions()]
        elif options.rollback:
            said = [f"version {prefix.roll_back()} is the current one: restart the programs"]
        elif options.uninstall:
            said = [f"removed: {', '.join(prefix.remove())}"]
        else:
            version = install(Path(__file__).resolve().parent, prefix)
            text = f"version {version} is the current one, in {prefix.folder}"
            said = [f"{text}: restart the programs"]
    except InstallError as error:
        sys.stderr.write(f"install.py: {error} ({error.code})\n")
        return error.status
    except OSError as error:
        sys.stderr.write(f"install.py: {error.filename}: {error.strerror} (os_error)\n")
        return 1
    print("\n".join(said))  # noqa: T201 - the user's answer
    return 0


if __name__ == "__main__":
    sys.exit(main())
