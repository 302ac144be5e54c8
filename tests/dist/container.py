"""A Debian 12 under its own systemd, in a container without network: for ``make test-deb``."""

import os
import shutil
import signal
import subprocess
import time
from pathlib import Path

from tests.support.tools import need_tool

INCLUDED = "systemd-sysv,dbus,python3.11,libstdc++6,procps,man-db"
LIMIT_S = 120.0
NAME = "up-deb-trial"


def base_image() -> Path:
    """Return the archive of a bare system, made once for this user."""
    cache = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache", "raspilot")
    image = cache / "bookworm.tar"
    if not image.exists():
        cache.mkdir(parents=True, exist_ok=True)
        made = image.with_suffix(".new.tar")
        options = ["--variant=apt", f"--include={INCLUDED}", "bookworm", str(made)]
        subprocess.run([need_tool("mmdebstrap"), "--quiet", *options], check=True)
        made.rename(image)
    return image


class Container:
    """A booted system; ``stop`` shuts it down."""

    def __init__(self, folder: Path) -> None:
        self._nspawn = need_tool("systemd-nspawn", "systemd-container")
        self.root = folder / "root"
        self.root.mkdir()
        subprocess.run(["tar", "-xpf", str(base_image()), "-C", str(self.root)], check=True)
        self._groups = Path(_cgroup2(), f"{NAME}-{os.getpid()}")
        self._process: subprocess.Popen[bytes] | None = None
        self._init = 0

    def boot(self) -> None:
        """Return when every unit of the boot is active."""
        self._groups.mkdir(exist_ok=True)

        def enter() -> None:
            # Other load on this machine must not lengthen the times that are measured.
            os.nice(-15)
            Path(self._groups, "cgroup.procs").write_text(str(os.getpid()))

        options = ["--boot", "--private-network", "--register=no", "--keep-unit", "--quiet",
                   "--link-journal=no", "--resolv-conf=off", f"--machine={NAME}"]  # fmt: skip
        self._process = subprocess.Popen(
            [self._nspawn, *options, f"--directory={self.root}"],
            env={**os.environ, "SYSTEMD_NSPAWN_UNIFIED_HIERARCHY": "1"},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            preexec_fn=enter,
            start_new_session=True,
        )
        children = Path(f"/proc/{self._process.pid}/task/{self._process.pid}/children")

        def init() -> int:
            """Return the process 1 of the container; before, systemd-nspawn has other children."""
            pids = children.read_text().split()
            named = (each for each in pids if _name_of(each) == "systemd")
            return int(next(named, 0))

        self._init = self.until(init)
        self.until(lambda: self.output("systemctl", "is-system-running", check=False) == "running")

    def output(self, *command: str, check: bool = True) -> str:
        """Return the standard output of a command in the container, without its last line feed."""
        environ = ["PATH=/usr/sbin:/usr/bin:/sbin:/bin", "DEBIAN_FRONTEND=noninteractive"]
        inside = ["nsenter", f"--target={self._init}", "--all", "env", "-i", "LC_ALL=C.UTF-8"]
        done = subprocess.run(
            [*inside, *environ, *command], capture_output=True, text=True, timeout=600, check=False,
            start_new_session=True,
        )  # fmt: skip
        assert done.returncode == 0 or not check, f"{command}: {done.stdout}{done.stderr}"
        return done.stdout.strip()

    def show(self, unit: str, name: str) -> str:
        """Return a property of a unit."""
        return self.output("systemctl", "show", "--value", f"--property={name}", unit)

    def until(self, wanted, limit_s: float = LIMIT_S):
        """Return the first true answer."""
        end_s = time.monotonic() + limit_s
        while not (answer := wanted()):
            assert time.monotonic() < end_s, "the limit has passed"
            time.sleep(0.02)
        return answer

    def files(self) -> set[str]:
        """Return every path that a package could have left."""
        skipped = ["/proc", "/sys", "/dev", "/tmp", "/var/tmp", "/run", "/root", "/var/log"]
        skipped += [f"/var/lib/{name}" for name in ("dpkg", "apt", "systemd")]
        skipped += ["/var/cache/apt", "/var/cache/man"]
        prune = [word for each in skipped for word in ("-path", each, "-prune", "-o")]
        found = self.output("find", "/", *prune, "-print")
        logs = self.output(
            "find", "/run", "/var/log", "-name", "*up-*", "-o", "-name", "*raspilot*"
        )
        return {*found.splitlines(), *logs.splitlines()}

    def stop(self) -> None:
        if self._process is not None:
            self._process.send_signal(signal.SIGTERM)
            self._process.wait(LIMIT_S)
            (self._groups / "cgroup.kill").write_text("1")
        folders = [each for each in self._groups.rglob("*") if each.is_dir()]
        for each in sorted([self._groups, *folders], reverse=True):
            self.until(lambda each=each: "populated 0" in (each / "cgroup.events").read_text())
            each.rmdir()
        shutil.rmtree(self.root)


def _name_of(pid: str) -> str:
    try:
        return Path(f"/proc/{pid}/comm").read_text().strip()
    except OSError:
        return ""


def _cgroup2() -> str:
    mounts = (line.split() for line in Path("/proc/mounts").read_text().splitlines())
    return next(place for _, place, kind, *_ in mounts if kind == "cgroup2")
