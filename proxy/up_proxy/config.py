"""proxy.yml."""

from up.config import ConfigFile, key, section
from up.quick_dataclass import dataclass
from up_cluster.config import ClusterConfig


def _port(default: int, comment: str, name: str) -> int:
    comment = f"{comment} 0: any free port, which is logged."
    return key(default, comment, name=name, minimum=0, maximum=65535)


@dataclass(frozen=True, slots=True)
class LimitsConfig:
    """Limits, so that one peer cannot disturb the others."""

    connections: int = key(
        2000, "Connections on each side.", name="connections per side", minimum=1, maximum=100000
    )
    per_address: int = key(
        200,
        "Connections on each side from one address (IPv6: from one /64 network).",
        name="connections per address",
        minimum=1,
        maximum=100000,
    )
    connections_hz: int = key(
        100,
        "New connections on each side. Twice as many may wait, and their addresses take turns: "
        "aircraft that connect together do not delay those that fly.",
        name="connections per second",
        minimum=20,
        maximum=100000,
    )
    aircraft: int = key(1000, "Aircraft names at one time.", minimum=1, maximum=100000)
    listeners: int = key(
        64,
        "Grounds that listen to one aircraft, in addition to the one in control.",
        name="listeners per aircraft",
        minimum=0,
        maximum=10000,
    )
    queue_bytes: int = key(
        65536,
        "Bytes that wait for one slow ground before its oldest lines are dropped.",
        name="queue (bytes)",
        unit="bytes",
        minimum=4096,
        maximum=16777216,
    )
    user_timeout_ms: int = key(
        3000,
        "A peer that acknowledges nothing for this long is disconnected (TCP_USER_TIMEOUT).",
        name="user timeout (ms)",
        unit="ms",
        minimum=500,
        maximum=60000,
    )


@dataclass(frozen=True, slots=True)
class QuotaConfig:
    """What the tenant may use at all nodes of its cluster together; 0: no limit."""

    aircraft: int = key(0, "Connected aircraft.", minimum=0, maximum=1000000)
    grounds: int = key(0, "Connected grounds.", minimum=0, maximum=1000000)
    mb_per_hour: int = key(
        0,
        "Received from aircraft and grounds within an hour. Beyond it new connections are refused, "
        "except that of an aircraft of this hour, and that of the ground which gets control.",
        unit="MB",
        minimum=0,
        maximum=1000000000,
    )


@dataclass(frozen=True, slots=True)
class TLSConfig:
    """Ports with TLS: each peer needs a certificate of the CA, whatever its address."""

    folder: str = key(
        "",
        "Folder with ca.pem, certificate.pem, key.pem and revoked.pem, as 'up certificates device' "
        "makes it; relative to this file. Empty: no TLS.",
        max_length=4096,
    )
    airborne_port: int = _port(3013, "TLS port for aircraft.", "airborne port")
    ground_port: int = _port(3014, "TLS port for ground stations.", "ground port")
    plain: bool = key(False, "Whether the plain ports are open, too.", name="plain ports")
    handshakes: int = key(
        500,
        "Unfinished handshakes on each side; a further one ends the oldest.",
        minimum=1,
        maximum=10000,
    )


@dataclass(frozen=True, slots=True)
class ProxyConfig:
    """The Ground Station Proxy: the relay between aircraft and ground stations."""

    airborne_port: int = _port(3003, "TCP port for aircraft.", "airborne port")
    ground_port: int = _port(3004, "TCP port for ground stations.", "ground port")
    address: str = key(
        "",
        "Address to listen on; empty: every interface, IPv4 and IPv6.",
        max_length=64,
    )
    i_accept_plain: bool = key(
        False,
        "Without TLS every host that reaches the ports can listen, and can take control when it is "
        "free. Peers with public addresses are refused there until this is true. Set it only when "
        "a firewall or VPN protects the ports, or when you accept the risk.",
    )
    metrics_port: int = _port(9303, "TCP port of the metrics page on 127.0.0.1.", "metrics port")
    metrics: bool = key(True, "Whether the metrics page is served.")
    log_level: str = key(
        "info",
        "Minimum level of log lines.",
        name="log level",
        choices=("debug", "info", "warning", "error"),
        ignore_case=True,
    )
    log_file: str = key(
        "",
        "File for JSON lines, rotated; empty: standard error (the journal) only.",
        name="log file",
        max_length=4096,
    )
    tls: TLSConfig = section(TLSConfig)
    cluster: ClusterConfig = section(ClusterConfig)
    limits: LimitsConfig = section(LimitsConfig)
    quota: QuotaConfig = section(QuotaConfig)


PROXY = ConfigFile("proxy.yml", ProxyConfig)
