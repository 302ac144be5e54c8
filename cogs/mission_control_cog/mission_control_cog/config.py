"""mission_control.yml."""

import re
import socket
from collections.abc import Iterator
from pathlib import Path
from typing import Literal

from up.config import ConfigFile, items, key, section
from up.fields import Constraint
from up.protocols.encrypted_stream import is_available
from up.quick_dataclass import dataclass
from up.system.addresses import is_wildcard
from up.system.aircraft_name import AIRCRAFT_NAME, AIRCRAFT_NAME_RULE

_INTERFACE = re.compile(r"[A-Za-z0-9_.@-]{1,15}", re.ASCII)
_HOST = re.compile(r"[A-Za-z0-9_.:%-]*", re.ASCII)


Security = Literal["auto", "off", "accept", "require"]
_SECURITY = (
    "End-to-end protection of this link: require refuses Commands of devices without a key; accept "
    "takes them too, with at most the link's role; off refuses protected sessions; auto is require "
    "towards a public address, otherwise, or with i_accept_plain, accept."
)


@dataclass(frozen=True, slots=True)
class RemoteServerConfig:
    """Where the Ground Station Proxy is."""

    url: str = key("", "Host name or address of the proxy. Empty: no proxy.", max_length=255)
    port: int = key(3003, "TCP port of the proxy's airborne side.", minimum=1, maximum=65535)
    security: Security = key("auto", _SECURITY)

    tls: str = key(
        "",
        "Folder with ca.pem, certificate.pem and key.pem, as 'up certificates device' makes it; "
        "relative to this file. The link then speaks TLS alone, with the proxy's TLS port (3013). "
        "Empty: plain.",
        max_length=4096,
    )
    interfaces: tuple[str, ...] = items(
        Constraint(str, max_length=15),
        "Network interfaces that may carry the link, the best first, such as [wlan0, usb0]: when "
        "one is silent, the link moves to another. Linux only. Empty: the system chooses.",
        max_length=4,
    )
    return_after_s: float = key(
        10.0,
        "How long a better interface must answer before the link returns to it.",
        unit="s",
        minimum=1.0,
        maximum=3600.0,
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        if self.interfaces and not hasattr(socket, "SO_BINDTODEVICE"):
            yield "interfaces", "needs Linux"
        for name in self.interfaces:
            if not _INTERFACE.fullmatch(name):
                yield "interfaces", f"{name!r} is not the name of an interface"
        if len(set(self.interfaces)) < len(self.interfaces):
            yield "interfaces", "names one interface twice"
        if not _HOST.fullmatch(self.url):
            yield "url", "must be a host name or an address alone, without http:// and port"


@dataclass(frozen=True, slots=True)
class ListenerConfig:
    """A port for ground stations on the same network as the aircraft, without a proxy."""

    port: int | None = key(
        None,
        "TCP port, usually 50002. Empty: no port. 0: any free port, which is logged.",
        minimum=0,
        maximum=65535,
    )
    address: str = key(
        "",
        "Address of the interface to listen on. Empty: all, IPv4 only; '::': all, also IPv6.",
        max_length=64,
    )
    security: Security = key("auto", _SECURITY)
    tls: str = key(
        "",
        "Folder with ca.pem, certificate.pem, key.pem and revoked.pem, as 'up certificates device' "
        "makes it for the host of this port; relative to this file. The port then speaks TLS "
        "alone, and a ground station needs a certificate of the CA. Empty: plain.",
        max_length=4096,
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        try:
            is_wildcard(self.address)
        except ValueError:
            yield "address", f"must be a literal IP address, not {self.address!r}"


@dataclass(frozen=True, slots=True)
class MissionControlConfig:
    """The link to the ground station."""

    remote_server: RemoteServerConfig = section(RemoteServerConfig)
    aircraft: str = key(
        "",
        "Name that the proxy knows this aircraft by: 1 to 32 letters, digits, _ . or -. Empty: "
        "the name that a runner started it with, else default.",
        max_length=32,
    )
    hello: bool = key(
        True,
        "Whether the link begins with a hello that names the aircraft. false: for a legacy proxy, "
        "which knows no names.",
    )
    role: Literal["observer", "operator", "pilot"] = key(
        "operator",
        "Permissions of a ground station: observer sees telemetry; operator also sets the "
        "telemetry rate and the flight mode; pilot also arms and tunes gains.",
    )
    tune_in_flight: bool = key(
        False,
        "Whether a pilot on the ground may set gains while the aircraft is in flight or its switch "
        "is at AUTO.",
    )
    i_accept_plain: bool = key(
        False,
        "A plain link does not authenticate the ground. While this is false, a link to a public "
        "address requires protection (security: auto) or, where it accepts plain Commands and has "
        "no TLS, grants a pilot only the rights of an operator, and ground stations with public "
        "addresses cannot connect to a listener that does not require it. Set it when a VPN or "
        "firewall protects the proxy, or when you accept the risk.",
    )
    secrecy: Literal["off", "require"] = key(
        "off",
        "Whether protected messages are also encrypted, so that no relay can read them. require: "
        "every link of the aircraft requires protection and secrecy; devices that cannot encrypt "
        "are refused. Both ends need the Python package cryptography.",
    )
    data_budget_mb_per_hour: float | None = key(
        None,
        "Most data of the link to the proxy, in both directions and with all headers, in MB an "
        "hour. Empty: no limit. Telemetry becomes rarer, below 4 frames a second it has less "
        "detail; attitude and alarms come last.",
        minimum=1.0,
    )
    listener: ListenerConfig = section(ListenerConfig)
    audit_log: str = key(
        "",
        "File of the outcomes of all Commands from the ground, one line of JSON each, an absolute "
        "path. Empty: audit.jsonl in the state directory that systemd sets, otherwise none.",
        max_length=1024,
    )

    def problems(self) -> Iterator[tuple[str, str] | tuple[str, str, str]]:
        if self.secrecy == "require":
            if not is_available():
                text = "needs the Python package cryptography: pip install 'raspilot[tls]'"
                yield "secrecy", text, "package_missing"
            if {self.remote_server.security, self.listener.security} & {"off", "accept"}:
                yield "secrecy", "require needs security: require, or auto, on every link"
        if self.remote_server.interfaces and not self.hello:
            yield "hello", "interfaces need a proxy that resumes the link by its token"
        if self.audit_log and not Path(self.audit_log).is_absolute():
            yield "audit_log", "must be an absolute path"
        if self.aircraft and not AIRCRAFT_NAME.fullmatch(self.aircraft):
            yield "aircraft", f"must be {AIRCRAFT_NAME_RULE}"


def security_of(security: Security, is_public: bool, config: MissionControlConfig) -> Security:
    """Return the protection of a link: its own, or that for its peer's address."""
    if security != "auto":
        return security
    is_exposed = is_public and not config.i_accept_plain
    return "require" if is_exposed or config.secrecy == "require" else "accept"


def aircraft_name(config: MissionControlConfig, instance: str) -> str:
    """Return the aircraft's name; ``instance`` is the name that a runner gave it."""
    return config.aircraft or instance or "default"


MISSION_CONTROL = ConfigFile("mission_control.yml", MissionControlConfig)
