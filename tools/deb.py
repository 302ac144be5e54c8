"""Builds Debian packages from dist/: ``python -m tools.deb [--arch amd64 arm64] [--revision N]``.

raspilot-common has a virtual environment, /usr/lib/raspilot, with our wheels and the packages of
constraints.txt. Its compiled parts are for the version of Python that runs this program. The
packages of the services have unit, configuration and manual. The same wheels give the same bytes,
with the times of SOURCE_DATE_EPOCH or of the last commit.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from importlib.metadata import distributions
from pathlib import Path

import up.cli.main
from tools.deb_services import PREFIX, SERVICES, Service, script_text, unit_of
from tools.dist import CONSTRAINTS, SUMS
from tools.man_page import man_page
from up.cli.completion import script
from up.cli.option_parser import OptionParser, parser_in
from up.version import VERSION

ROOT = Path(__file__).resolve().parents[1]
MACHINES = {"amd64": "x86_64", "arm64": "aarch64"}
PYTHON = f"python{sys.version_info.major}.{sys.version_info.minor}"
COMMON = "raspilot-common"
SITE = f"{PREFIX}/lib/{PYTHON}/site-packages"
NEWEST_GLIBC = 36
"""That of Debian 12: wheels for a newer one are not taken."""


class Builder:
    """Builds every package of one architecture."""

    def __init__(self, dist: Path, scratch: Path, arch: str, version: str, epoch_s: int) -> None:
        self._dist, self._scratch, self._arch = dist, scratch, arch
        self._version, self._epoch_s = version, epoch_s

    def build(self) -> list[Path]:
        """Return the packages' files. Ends the program if a step fails."""
        common = self._folder(COMMON, self._arch)
        site = common / SITE.lstrip("/")
        _echo(f"{self._arch}: installing the locked packages for {PYTHON}")
        self._install(site)
        share = common / "usr/share/raspilot"
        shutil.copytree(site / "share" / "raspilot", share)
        shutil.rmtree(site / "share")
        units = {each.stem: each.read_text("utf-8") for each in share.glob("systemd/*.service")}
        for each in ("systemd", "upstart"):
            shutil.rmtree(share / each)
        made = [
            self._service(each, unit_of(units[each.name]), share / "config") for each in SERVICES
        ]
        _echo(f"{self._arch}: compiling and packing {COMMON}")
        self._environment(common, site)
        self._program(common, "up", parser_in(up.cli.main.main), "framework for autopilots")
        self._write(common, "usr/lib/sysusers.d/raspilot.conf", script_text("sysusers"))
        scripts = {name: script_text(f"common.{name}") for name in ("postinst", "postrm")}
        self._times(common)
        _compile(common, site)
        made.append(
            self._pack(common, scripts, {
                "Depends": f"{PYTHON}, libc6, libgcc-s1, libstdc++6, systemd | systemd-sysusers",
                "Recommends": "ca-certificates",
                "Description": "Up and Raspilot: programs and libraries of the services",
            })
        )  # fmt: skip
        return made

    def _folder(self, package: str, arch: str) -> Path:
        folder = self._scratch / f"{package}_{self._version}_{arch}"
        (folder / "DEBIAN").mkdir(parents=True)
        return folder

    def _install(self, site: Path) -> None:
        machine = MACHINES[self._arch]
        tags = [f"manylinux_2_{minor}_{machine}" for minor in range(NEWEST_GLIBC, 4, -1)]
        platforms = [f"--platform={each}" for each in [*tags, f"manylinux2014_{machine}"]]
        pip = [sys.executable, "-m", "pip", "install", "--quiet", "--disable-pip-version-check",
               "--no-deps", "--no-compile", "--only-binary=:all:", f"--target={site}"]  # fmt: skip
        _run([*pip, *platforms, "--require-hashes", "-r", str(self._dist / CONSTRAINTS)])
        # pip adds to packages in the same folder, but not to these.
        for name in ("bin", "share"):
            shutil.rmtree(site / name, ignore_errors=True)
        wheels = sorted(self._dist.glob("*.whl"))
        if not wheels:
            sys.exit(f"make deb: {self._dist} has no wheels; 'make dist' builds them")
        names = ["==".join(each.name.split("-")[:2]) for each in wheels]
        _run([*pip, "--no-index", f"--find-links={self._dist}", *names])
        shutil.rmtree(site / "bin")
        for each in _unused(site):
            shutil.rmtree(each) if each.is_dir() else each.unlink()
        # pip's lists of files have sums of the removed programs; dpkg has its own.
        for each in site.glob("*.dist-info/RECORD"):
            each.unlink()
        _run(
            [sys.executable, "-m", "up.cli", "-f", str(site / "raspilot"), "gather", "--no-install"]
        )

    def _environment(self, common: Path, site: Path) -> None:
        settings = (
            f"home = /usr/bin\ninclude-system-site-packages = false\nversion = {PYTHON[6:]}\n"
        )
        self._write(common, f"{PREFIX}/pyvenv.cfg", settings)
        (ours,) = (each for each in distributions(path=[str(site)]) if each.name == "raspilot")
        for entry in ours.entry_points.select(group="console_scripts"):
            text = f"#!{PREFIX}/bin/python\nimport sys\nfrom {entry.module} import {entry.attr}\n\n"
            self._write(
                common, f"{PREFIX}/bin/{entry.name}", f"{text}sys.exit({entry.attr}())\n", 0o755
            )
        for name in ("python", "python3"):
            (common / PREFIX.lstrip("/") / "bin" / name).symlink_to(f"/usr/bin/{PYTHON}")

    def _service(self, service: Service, unit: str, config: Path) -> Path:
        folder = self._folder(service.name, "all")
        self._write(folder, f"lib/systemd/system/{service.name}.service", unit)
        files = service.config_files(config)
        for name, source in files.items():
            mode = 0o640 if source.suffix == ".env" else 0o644
            self._write(folder, name, source.read_text("utf-8"), mode)
        self._write(folder, "DEBIAN/conffiles", "".join(f"{name}\n" for name in files))
        if service.name == service.program:
            self._program(folder, service.name, service.parser, service.about, 8)
        else:
            page = man_page(service.parser, service.name, 8, service.about, self._epoch_s)
            self._write(folder, f"usr/share/man/man8/{service.name}.8", page)
        self._times(folder)
        return self._pack(folder, service.scripts(unit), {
            "Depends": f"{COMMON} (= {self._version})",
            "Description": service.about,
        })  # fmt: skip

    def _program(
        self, folder: Path, name: str, parser: OptionParser, about: str, section: int = 1
    ) -> None:
        """Add the command, its manual and its completion."""
        page = man_page(parser, name, section, about, self._epoch_s)
        self._write(folder, f"usr/share/man/man{section}/{name}.{section}", page)
        completion = script("bash", name, parser.completion())
        self._write(folder, f"usr/share/bash-completion/completions/{name}", completion)
        (folder / "usr/bin").mkdir()
        (folder / "usr/bin" / name).symlink_to(f"{PREFIX}/bin/{name}")

    def _write(self, folder: Path, name: str, text: str, mode: int = 0o644) -> None:
        path = folder / name.lstrip("/")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        path.chmod(mode)

    def _times(self, folder: Path) -> None:
        """Give every file the time of the release; a compiled file states that of its source."""
        for each in folder.rglob("*"):
            os.utime(each, (self._epoch_s, self._epoch_s), follow_symlinks=False)

    def _pack(self, folder: Path, scripts: Mapping[str, str], fields: Mapping[str, str]) -> Path:
        package, version, arch = folder.name.split("_")
        copyright_file = f"usr/share/doc/{package}/copyright"
        self._write(folder, copyright_file, (ROOT / "LICENSE").read_text("utf-8"))
        for name, text in scripts.items():
            self._write(folder, f"DEBIAN/{name}", text, 0o755)
        files = [each for each in _files(folder) if each.parent.name != "DEBIAN"]
        control = {
            "Package": package,
            "Version": version,
            "Architecture": arch,
            "Section": "misc",
            "Priority": "optional",
            "Maintainer": "The Raspilot project <raspilot@localhost>",
            "Installed-Size": str(sum(each.stat().st_size for each in files) // 1024),
            **fields,
        }
        self._write(folder, "DEBIAN/control", "".join(f"{k}: {v}\n" for k, v in control.items()))
        self._write(folder, "DEBIAN/md5sums", "".join(_md5_lines(folder, files)))
        self._times(folder)
        for each in [folder, *(each for each in folder.rglob("*") if each.is_dir())]:
            each.chmod(0o755)
        target = self._dist / f"{folder.name}.deb"
        environ = {**os.environ, "SOURCE_DATE_EPOCH": str(self._epoch_s)}
        _run(
            ["dpkg-deb", "--root-owner-group", "-Zxz", "--build", str(folder), str(target)], environ
        )
        return target


def _unused(site: Path) -> list[Path]:
    """Return what no program of ours imports, half of all: other dialects, Twisted's tests."""
    dialects = site / "pymavlink" / "dialects"
    others = [each for each in dialects.glob("v20/*") if each.stem not in ("__init__", "common")]
    return [dialects / "v10", *others, *site.glob("twisted/**/test")]


def _compile(common: Path, site: Path) -> None:
    """Compile for the target: services may not write there, and a restart must be fast."""
    command = [sys.executable, "-m", "compileall", "-q", "-j", "0", "-s", str(common), "-p", "/",
               "--invalidation-mode", "timestamp", str(site)]  # fmt: skip
    environ = {k: v for k, v in os.environ.items() if k != "SOURCE_DATE_EPOCH"}
    _run(command, {**environ, "PYTHONHASHSEED": "0"})


def _files(folder: Path) -> list[Path]:
    return sorted(each for each in folder.rglob("*") if each.is_file() and not each.is_symlink())


def _md5_lines(folder: Path, files: Iterable[Path]) -> Iterable[str]:
    for each in files:
        yield f"{hashlib.md5(each.read_bytes()).hexdigest()}  {each.relative_to(folder)}\n"


def _run(command: Sequence[str], environ: Mapping[str, str] | None = None) -> None:
    done = subprocess.run(command, env=environ, umask=0o022, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"make deb: {command[0]}: {(done.stderr or done.stdout).strip()}")


def _echo(text: str) -> None:
    sys.stdout.write(f"{text}\n")
    sys.stdout.flush()


def main(arguments: Sequence[str] | None = None) -> None:
    """Build the packages into the folder of the wheels, and list them in its SHA256SUMS."""
    if shutil.which("dpkg-deb") is None:
        sys.exit("make deb: dpkg-deb is missing (Debian package dpkg)")
    own = subprocess.run(
        ["dpkg", "--print-architecture"], capture_output=True, text=True, check=True
    )
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--arch", nargs="+", choices=MACHINES, default=[own.stdout.strip()])
    parser.add_argument("--dist", type=Path, default=ROOT / "dist", metavar="DIR")
    parser.add_argument("--revision", type=int, default=1, help="higher for the same version again")
    options = parser.parse_args(arguments)
    last = ["git", "log", "-1", "--format=%ct"]
    given = os.environ.get("SOURCE_DATE_EPOCH")
    epoch_s = int(given or subprocess.run(last, cwd=ROOT, capture_output=True, check=True).stdout)
    version = f"{VERSION}-{options.revision}"
    made: list[Path] = []
    for arch in options.arch:
        with tempfile.TemporaryDirectory(prefix="up-deb-") as scratch:
            made += Builder(options.dist, Path(scratch), arch, version, epoch_s).build()
    sums = options.dist / SUMS
    kept = [each for each in sums.read_text().splitlines(True) if not each.endswith(".deb\n")]
    packages = sorted(options.dist.glob("*.deb"))
    new = [f"{hashlib.sha256(each.read_bytes()).hexdigest()}  {each.name}\n" for each in packages]
    sums.write_text("".join(kept + new))
    for each in made:
        _echo(f"{each} {each.stat().st_size / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
