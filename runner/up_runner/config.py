"""runner.yml: the instances that the runner starts, its clients and its limits."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Literal

from up.config import ConfigFile, items, key, mapping, section
from up.config.schema import ListOf
from up.fields import Constraint
from up.quick_dataclass import dataclass
from up.system.figures import PACKAGE_MISSING, is_installed
from up_runner.pool_config import PoolConfig
from up_runner.request import NAME

Security = Literal["auto", "off", "accept", "require"]
FILE_NAME = Constraint(str, max_length=64)
KEY_NAME = Constraint(str, max_length=64)
VARIABLE = re.compile(r"[A-Za-z_][A-Za-z0-9_]*\*?", re.ASCII)
PLAIN_FILE = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]*\.yml", re.ASCII)
LEARNED_FILE = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]*\.(yml|json)", re.ASCII)
NEVER_SETTABLE = frozenset(
    f"{name}.yml"
    for name in ("disabled_modules", "external_modules", "keys", "registered_modules", "runner")
)
NEVER_SETTABLE_KEY = re.compile(
    r"path|folder|\bfile\b|port\b|url|host|address|command|python|module|accept|role", re.I
)


def _path(comment: str, name: str | None = None) -> str:
    return key("", comment, name=name, max_length=4096)


@dataclass(frozen=True, slots=True)
class ProxyAddress:
    """The proxy between the instances and the ground: they use it, and responses name it."""

    host: str = key(
        "",
        "Name or address of the proxy, for instances (in place of mission_control.yml: "
        "remote_server) and grounds. Empty: remote_server applies, and responses name no proxy.",
        max_length=255,
    )
    airborne_port: int = key(
        3003, "TCP port of its airborne side.", name="airborne port", minimum=1, maximum=65535
    )
    ground_port: int = key(
        3004, "TCP port of its ground side.", name="ground port", minimum=1, maximum=65535
    )
    tls: str = _path(
        "Folder with the instances' certificate (mission_control.yml: remote_server: tls), "
        "relative to this file. Empty: remote_server: tls applies.",
    )


@dataclass(frozen=True, slots=True)
class Autostart:
    """An instance that starts with the runner, without a request from a phone."""

    aircraft: str = key("", "Name of the aircraft. Empty: wait for requests.", max_length=32)
    profile: str = key("", "Its profile. Empty: the plain configuration.", max_length=32)


@dataclass(frozen=True, slots=True)
class Logs:
    """Limits of the logs: the standard output and error of the instances."""

    size: int = key(
        1_000_000,
        "Size at which an instance's log is rotated; checked twice a second.",
        unit="bytes",
        minimum=1000,
        maximum=1_000_000_000,
    )
    keep: int = key(2, "Older logs of an instance that are kept.", minimum=0, maximum=100)


@dataclass(frozen=True, slots=True)
class Restarts:
    """Restarts of an instance that ended unexpectedly."""

    delay_s: float = key(
        0.25, "First delay; each further one is doubled.", name="delay", unit="s", minimum=0
    )
    max_delay_s: float = key(
        10.0, "Maximum delay.", name="longest delay", unit="s", minimum=0, maximum=3600
    )
    limit: int = key(
        5,
        "Restarts within the period; after more the runner gives up a black box. 0: no restart. "
        "It never gives up a flight controller.",
        minimum=0,
        maximum=1000,
    )
    period_s: float = key(
        60.0,
        "The period; ends before it do not count.",
        name="period",
        unit="s",
        minimum=1,
        maximum=86400,
    )


@dataclass(frozen=True, slots=True)
class Connections:
    """Limits of the request port."""

    limit: int = key(
        256,
        "Maximum number of connections. A further one displaces the one silent for longest.",
        minimum=1,
        maximum=100_000,
    )
    address_limit: int = key(
        32,
        "Maximum number of connections from one address (IPv6: from one /64 network).",
        name="address limit",
        minimum=1,
        maximum=100_000,
    )
    idle_s: float = key(
        15.0,
        "A connection that is silent for this time is closed.",
        name="idle",
        unit="s",
        minimum=1,
        maximum=3600,
    )


@dataclass(frozen=True, slots=True)
class KeyQuota:
    """What one key of keys.yml may start."""

    instances: int = key(4, "Instances that run at the same time.", minimum=1, maximum=1000)
    starts_per_minute: int = key(
        6, "Starts of instances.", name="starts per minute", minimum=1, maximum=1000
    )


@dataclass(frozen=True, slots=True)
class RunnerConfig:
    """The runner: spawns a Raspilot when a phone requests it, and supervises it."""

    port: int = key(3002, "TCP port of requests. 0: any free port.", minimum=0, maximum=65535)
    address: str = key(
        "", "Address to listen on. Empty: every IPv4 address; '::': every address.", max_length=64
    )
    tls: str = _path(
        "Folder with ca.pem, certificate.pem, key.pem and revoked.pem, as 'up certificates device' "
        "makes it; relative to this file. The port then speaks TLS alone, and a client of any "
        "address needs a certificate of the CA. Empty: plain.",
    )
    security: Security = key(
        "auto",
        "Requests under a key of keys.yml beside this file ('up keys'): require refuses all "
        "others; accept takes them too; off takes no keys; auto is require for peers with public "
        "addresses, accept for others, with tls or with i_accept_plain.",
    )
    metrics_port: int | None = key(
        None,
        "TCP port on 127.0.0.1 of a page for Prometheus, usually 9305. Empty: none. 0: any free "
        "port, which is logged.",
        name="metrics port",
        minimum=0,
        maximum=65535,
    )
    key_quota: KeyQuota = section(KeyQuota, name="key quota")
    i_accept_plain: bool = key(
        False,
        "Plain requests are not authenticated: every host that reaches the port can start "
        "instances. Without a key or TLS, peers with public addresses are therefore rejected; true "
        "accepts them.",
    )
    i_accept_root: bool = key(
        False,
        "The runner refuses to run as root: its instances would be root too, and every host that "
        "reaches the port can start them. true permits it.",
    )
    mode: Literal["black box", "flight controller", "auto"] = key(
        "black box",
        "The mode of the instances. A lost phone stops an instance in black box mode only: the "
        "others may be flying.",
    )
    application_root: str = _path(
        "Folder of the application. Empty: that of the installed Raspilot.",
        "application root",
    )
    script_path: str = _path(
        "The program to run, relative to the application root. Empty: main.py, or, with an empty "
        "application root, the installed Raspilot (python -m raspilot).",
        "script path",
    )
    python: str = _path("The Python interpreter. Empty: the one that runs the runner.")
    instance_config: str = _path(
        "Base configuration folder of every instance. Empty: the folder blackbox/ beside this file "
        "in black box mode, otherwise the folder of this file.",
        "instance config",
    )
    profiles_folder: str = _path(
        "Folder with a folder of configuration files for each profile. Empty: profiles/ beside "
        "this file.",
        "profiles folder",
    )
    run_folder: str = _path(
        "Folder for sockets and state, private to this user. Empty: RUNTIME_DIRECTORY, "
        "otherwise XDG_RUNTIME_DIR/up-runner, otherwise /tmp/up-runner-<user id>.",
        "run folder",
    )
    instances_folder: str = _path(
        "Folder for the instances' configuration and persisted files. Empty: STATE_DIRECTORY, "
        "otherwise the run folder.",
        "instances folder",
    )
    logs_folder: str = _path(
        "Folder for the instances' logs. Empty: LOGS_DIRECTORY, otherwise .logs in the run folder.",
        "logs folder",
    )
    instances: int = key(8, "Maximum number of instances.", minimum=1, maximum=1000)
    kept_instances: int = key(
        32,
        "Number of ended instances, the latest ones, whose configuration and logs are kept.",
        name="kept instances",
        minimum=0,
        maximum=10_000,
    )
    start_limit_s: float = key(
        10.0,
        "Time limit for an instance to bind its ports.",
        name="start limit",
        unit="s",
        minimum=0.1,
        maximum=600,
    )
    watchdog_s: float = key(
        2.0,
        "An instance without a sign of life for this time is killed. 0: never.",
        name="watchdog",
        unit="s",
        minimum=0,
        maximum=600,
    )
    exit_on_connection_lost: bool = key(
        True, "Whether a black box stops when its phone is gone.", name="exit on connection lost"
    )
    exit_delay_s: float = key(
        60.0,
        "Time that the phone may be gone.",
        name="exit delay",
        unit="s",
        minimum=0,
        maximum=86400,
    )
    stop_instances_on_exit: bool | None = key(
        None,
        "Whether the instances end with the runner. null: no under a service manager, which may "
        "restart the runner in flight; yes when it was started by hand.",
        name="stop instances on exit",
    )
    proxy: ProxyAddress = section(ProxyAddress)
    pool: PoolConfig = section(PoolConfig)
    autostart: Autostart = section(Autostart)
    restarts: Restarts = section(Restarts)
    logs: Logs = section(Logs)
    connections: Connections = section(Connections)
    dynamic_ports: dict[str, tuple[str, ...]] = mapping(
        FILE_NAME,
        ListOf(KEY_NAME, 16),
        "Ports of a black box that are 0 (any free port) unless its configuration sets them.",
        default={"android.yml": ("general port", "orientation port")},
        name="dynamic ports",
        max_length=32,
    )
    settable: dict[str, tuple[str, ...]] = mapping(
        FILE_NAME,
        ListOf(KEY_NAME, 64),
        "Files and keys that a request may set. Every host that reaches the port may set them: "
        "list only harmless keys, never paths, commands or modules.",
        default={
            "android.yml": ("forward interval for onboard device (ms)",),
            "load_guard.yml": ("interval",),
        },
        max_length=32,
    )
    environment: tuple[str, ...] = items(
        KEY_NAME,
        "Environment variables that an instance inherits; LC_* stands for all that begin with LC_. "
        "It inherits no others, and so no secrets of the runner.",
        default=("PATH", "HOME", "LANG", "LANGUAGE", "LC_*", "TZ", "XDG_STATE_HOME"),
        max_length=64,
    )
    persisted_files: tuple[str, ...] = items(
        FILE_NAME,
        "Files that an instance writes. They are kept from run to run while the profile is the "
        "same.",
        default=("pids.yml", "flight_state.yml", "mission.json", "fence.json"),
        name="learned files",
        max_length=32,
    )

    def problems(self) -> Iterator[tuple[str, str] | tuple[str, str, str]]:
        """Yield problems between keys: the attribute, the sentence and, of some, its code."""
        if self.metrics_port is not None and not is_installed():
            yield "metrics_port", *PACKAGE_MISSING
        if self.pool.servers and self.mode != "black box":
            yield "pool", "needs mode: black box; an instance with hardware belongs to its host"
        if self.pool.servers and self.autostart.aircraft:
            yield "autostart", "cannot be used in a pool; let the phone request its aircraft"
        for attribute, names in (
            ("settable", self.settable),
            ("dynamic_ports", self.dynamic_ports),
            ("persisted_files", self.persisted_files),
        ):
            is_learned = attribute == "persisted_files"
            for name in names:
                if not (LEARNED_FILE if is_learned else PLAIN_FILE).fullmatch(name):
                    kind = "YAML or JSON" if is_learned else "YAML"
                    yield attribute, f"{name!r} is not the name of a {kind} file"
        for name, keys in self.settable.items():
            if name in NEVER_SETTABLE:
                yield "settable", f"a request may never set anything of {name}"
            for each in keys:
                if NEVER_SETTABLE_KEY.search(each):
                    yield "settable", f"a request may never set a path, port or address: {each!r}"
        for variable in self.environment:
            if not VARIABLE.fullmatch(variable):
                yield "environment", f"{variable!r} is not the name of an environment variable"
        for attribute, value in (
            ("aircraft", self.autostart.aircraft),
            ("profile", self.autostart.profile),
        ):
            if value and not NAME.fullmatch(value):
                yield "autostart", f"{attribute} is not a name of A-Z a-z 0-9 _ . -: {value!r}"


RUNNER = ConfigFile("runner.yml", RunnerConfig)
