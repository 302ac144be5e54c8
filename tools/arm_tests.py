"""Runs chosen tests on ARM under emulation: ``python -m tools.arm_tests [arm64] [armhf]``.

A Debian 12 root of each architecture is made once, in build/arm/, from the mirror of this
machine's apt. Its packages are extracted, not configured. Python packages come from the index, for
that architecture; on armhf those without a wheel come from Debian. Needs root and Linux's
binfmt_misc. Exit status: 0 all passed, 1 some did not, 2 something is missing here.
"""

from __future__ import annotations

import argparse
import importlib
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
BUILD = ROOT / "build" / "arm"
SUITE, PYTHON = "bookworm", "3.11"
BINFMT = Path("/proc/sys/fs/binfmt_misc")
TOOLS = {
    "mmdebstrap": "mmdebstrap",
    "unshare": "util-linux",
    "readelf": "binutils",
    "update-binfmts": "binfmt-support",
}
"""Programs, and the Debian packages that have them."""
SYSTEM = ("python3", "dash", "coreutils", "procps", "libstdc++6")
PURE = (
    "twisted", "attrs", "automat", "constantly", "hyperlink", "idna", "incremental",
    "typing-extensions", "pyserial", "pytest", "pluggy", "iniconfig", "packaging", "pygments",
    "pytest-timeout", "pytest-xdist", "execnet", "sortedcontainers", "mcap", "smbus2",
    "pynmeagps",
)  # fmt: skip
FALLBACK = "zope.interface"
"""Its compiled part is optional. Debian's is too old for Twisted, so on armhf its Python files are
taken, which pip installs where there is no compiler."""
COMPILED = {
    "PyYAML": "python3-yaml",
    "psutil": "python3-psutil",
    "hypothesis": "python3-hypothesis",
    "lz4": "python3-lz4",
    "zstandard": "python3-zstandard",
    "numpy": "python3-numpy",
}
"""Packages with compiled parts, and Debian's packages of them."""
TESTS = (
    "tests/up/protocols/test_attitude_frame.py",
    "tests/up/protocols/test_packed_telemetry.py",
    "tests/up/protocols/test_serial_port.py",
    "tests/up/flight_log/test_mcap_writer.py",
    "tests/up/system/test_clock.py",
    "tests/up/system/test_scheduling.py",
    "tests/cogs/crsf_cog/test_frames.py",
    "tests/cogs/black_box_cog/test_recorder.py",
    "tests/cogs/sensors_cog/test_i2c_sensors.py",
    "tests/flightlog/columns",
    "tests/simulator/aircraft/test_functions.py",
    "tests/simulator/aircraft/test_built_in_model.py::test_a_diverged_model_is_a_crash",
    "tests/simulator/aircraft/test_built_in_model.py"
    "::test_turbulence_moves_the_aircraft_and_only_where_it_is_asked_for",
)
"""What depends on word size, byte order, floating point and the kernel's interfaces."""
UNSUPPORTED = ("tests/up/protocols/test_serial_port.py::test_a_speed_without_a_name_is_set",)
"""QEMU 7.2 has no TCSETS2, by which Linux sets any speed of a serial port."""
SOURCES = ("", "runner", "proxy", "cluster", "ground", "simulator", "arduino/bench", "mavlink",
           "flightlog")  # fmt: skip


@dataclass(frozen=True, slots=True)
class Machine:
    """An architecture: Debian's name, QEMU's, the platforms of its wheels, its library folder."""

    name: str
    qemu: str
    platforms: tuple[str, ...]
    libraries: str
    has_wheels: bool

    @property
    def root(self) -> Path:
        return BUILD / self.name


MACHINES = {
    each.name: each
    for each in (
        Machine(
            "arm64", "qemu-aarch64",
            ("manylinux2014_aarch64", "manylinux_2_27_aarch64", "manylinux_2_28_aarch64"),
            "aarch64-linux-gnu", True,
        ),
        Machine("armhf", "qemu-arm", ("linux_armv7l",), "arm-linux-gnueabihf", False),
    )
}  # fmt: skip


def missing(machines: Sequence[Machine]) -> Iterator[str]:
    """Yield one sentence for each thing that this machine lacks."""
    if os.geteuid():
        yield "test-arm needs root, for chroot and mounts"
    for tool, package in TOOLS.items():
        if shutil.which(tool, path=f"{os.environ.get('PATH', '')}:/usr/sbin:/sbin") is None:
            yield f"test-arm needs {tool}: apt-get install {package}"
    for machine in machines:
        if not (BINFMT / machine.qemu).exists():
            yield (
                f"test-arm needs {machine.qemu} in {BINFMT}: apt-get install qemu-user-static"
                f" binfmt-support; mount -t binfmt_misc binfmt_misc {BINFMT};"
                f" update-binfmts --enable {machine.qemu}"
            )


def prepare(machine: Machine) -> None:
    """Make the root of an architecture with its Python packages, unless it is there already."""
    names = [*PURE, *((*COMPILED, FALLBACK) if machine.has_wheels else ())]
    wheels = [f"{name}=={version(name)}" for name in names]
    included = [*SYSTEM, *(() if machine.has_wheels else COMPILED.values())]
    contents = "\n".join([*included, *wheels])
    stamp = machine.root / "opt" / "contents"
    if stamp.is_file() and stamp.read_text() == contents:
        return
    shutil.rmtree(machine.root, ignore_errors=True)
    BUILD.mkdir(parents=True, exist_ok=True)
    targets = ["apt-get", "indextargets", "--format", "$(REPO_URI)"]
    mirrors = _output(*targets, "Created-By: Packages", f"Codename: {SUITE}").split()
    print(f"{machine.name}: making its root, a minute or two ...", flush=True)
    subprocess.run(
        [
            "mmdebstrap", "--quiet", "--variant=extract", f"--architectures={machine.name}",
            f"--include={','.join(included)}", "--format=directory", SUITE, machine.root,
            *mirrors[:1],
        ],
        check=True,
    )  # fmt: skip
    shell = machine.root / "bin" / "sh"
    if not shell.exists():
        shell.symlink_to("dash")
    subprocess.run(
        [
            sys.executable, "-m", "pip", "install", "--quiet", "--disable-pip-version-check",
            "--no-deps", "--only-binary=:all:", "--implementation=cp", f"--python-version={PYTHON}",
            *(f"--platform={each}" for each in machine.platforms),
            f"--target={machine.root / 'opt' / 'site'}", *wheels,
        ],
        check=True,
    )  # fmt: skip
    if not machine.has_wheels:
        files = Path(importlib.import_module(FALLBACK).__path__[0])
        target = machine.root / "opt" / "site" / FALLBACK.replace(".", "/")
        shutil.copytree(files, target, ignore=shutil.ignore_patterns("*.so", "__pycache__"))
    stamp.write_text(contents)


def run(machine: Machine, tests: Sequence[str]) -> int:
    """Run the tests in the root, in its own mounts and processes; return pytest's status."""
    root = machine.root
    inside = Path("/raspilot")
    cogs = sorted(str(each.relative_to(ROOT)) for each in ROOT.glob("cogs/*_cog"))
    libraries = f"/usr/lib/{machine.libraries}"
    environ = {
        "PATH": "/usr/bin:/bin",
        "LC_ALL": "C.UTF-8",
        "PYTHONDONTWRITEBYTECODE": "1",
        # The fewer examples of CI.
        "UP_REQUIRE_TOOLS": "1",
        "PYTHONPATH": ":".join(["/opt/site", *(str(inside / each) for each in (*SOURCES, *cogs))]),
        # Debian's alternatives are links that a configuration would have made.
        "LD_LIBRARY_PATH": f"{libraries}/blas:{libraries}/lapack",
    }
    mounts = (
        f'cd "{root}" && mkdir -p proc dev tmp root raspilot'
        " && mount -t proc proc proc && mount --rbind /dev dev && mount -t tmpfs tmpfs tmp"
        f' && mount --bind "{ROOT}" raspilot && exec /usr/sbin/chroot . "$@"'
    )
    command = [
        "/bin/sh", "-c", f'cd {inside} && exec python3 -m pytest "$@"', "pytest",
        "-q", "-p", "no:cacheprovider", "-n", "0", "--no-header",
        # Debian's older hypothesis does not see the references of frozen objects (conftest.py).
        "-W", "ignore:It looks like `register_random`",
        *(f"--deselect={each}" for each in UNSUPPORTED), *tests,
    ]  # fmt: skip
    return subprocess.run(
        ["unshare", "--mount", "--pid", "--fork", "sh", "-c", mounts, "sh", *command],
        env=environ,
        stdin=subprocess.DEVNULL,
        check=False,
    ).returncode


def architectures(machine: Machine) -> Iterator[str]:
    """Yield the architecture that each compiled Python package of the root is built for."""
    for folder in ("opt/site", "usr/lib/python3/dist-packages"):
        found: dict[str, set[str]] = {}
        for path in sorted((machine.root / folder).rglob("*.so*")):
            package = path.relative_to(machine.root / folder).parts[0]
            found.setdefault(package, set()).add(cpu_of(path))
        for package, cpus in found.items():
            yield f"{package}: {', '.join(sorted(cpus))}"


def cpu_of(path: Path) -> str:
    """Return the ARM architecture that a native file needs, such as ``v7``, or its machine."""
    attributes = _output("readelf", "-A", str(path))
    machine = _output("readelf", "-h", str(path))
    found = re.search(r"Tag_CPU_arch: (\S+)", attributes) or re.search(r"Machine: +(.+)", machine)
    return found[1] if found else "unknown"


def _output(*command: str) -> str:
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=str(__doc__).partition("\n")[0])
    parser.add_argument("machines", nargs="*", metavar="ARCH", help=f"default {' '.join(MACHINES)}")
    parser.add_argument("--test", action="append", help="another test than the chosen ones")
    options = parser.parse_args(arguments)
    if unknown := set(options.machines) - set(MACHINES):
        parser.error(f"unknown architecture {', '.join(unknown)}: {', '.join(MACHINES)}")
    machines = [MACHINES[name] for name in options.machines or MACHINES]
    if lacking := list(missing(machines)):
        print(*lacking, sep="\n", file=sys.stderr)
        return 2
    status = 0
    for machine in machines:
        try:
            prepare(machine)
        except subprocess.CalledProcessError as error:
            print(f"{machine.name}: {error.cmd[0]} failed: {error.returncode}", file=sys.stderr)
            return 2
        print(f"{machine.name}: compiled packages", flush=True)
        print(*(f"  {each}" for each in architectures(machine)), sep="\n", flush=True)
        status |= bool(run(machine, options.test or TESTS))
    return status


if __name__ == "__main__":
    sys.exit(main())
