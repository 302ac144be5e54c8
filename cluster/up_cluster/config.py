"""The section `cluster:` of proxy.yml, `pool:` of runner.yml, and all of fleet.yml."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from up.config import ConfigFile, key
from up.errors import UserError
from up.quick_dataclass import dataclass

DEFAULT_PORT = 4222
_SERVER = re.compile(
    r"(?:(?:nats|tls)://)?(?:\[([0-9A-Fa-f:.%]+)\]|([A-Za-z0-9._-]+))(?::([0-9]{1,5}))?", re.ASCII
)
_WORD = re.compile(r"[A-Za-z0-9_-]{1,32}", re.ASCII)


class ClusterError(UserError):
    """A file of `cluster:` is wrong; `code` is `cluster_credentials` or `no_file`."""


class Server(NamedTuple):
    """Address of a NATS server."""

    host: str
    port: int


@dataclass(frozen=True, slots=True)
class FleetConfig:
    """The NATS servers over which several proxies or runners act as one."""

    servers: str = key(
        "",
        "NATS servers with JetStream, separated by commas, as in nats://a:4222,nats://b:4222. "
        "Empty: no cluster.",
        max_length=4096,
    )
    tenant: str = key(
        "default",
        "The owner of the aircraft. One node serves one tenant; give each its own NATS account.",
        max_length=32,
    )
    credentials: str = key(
        "",
        "File with USER:PASSWORD or a token for NATS, mode 600, relative to this file. "
        "Empty: none, or the certificate of tls.",
        max_length=4096,
    )
    tls: str = key(
        "",
        "Folder with ca.pem, certificate.pem, key.pem and revoked.pem for the connection to NATS, "
        "relative to this file. The servers need 'handshake_first: true'. Empty: no TLS.",
        max_length=4096,
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        if not _WORD.fullmatch(self.tenant):
            yield "tenant", "must be 1 to 32 of A-Z a-z 0-9 _ -"
        for text in map(str.strip, self.servers.split(",") if self.servers else ()):
            match = _SERVER.fullmatch(text)
            if "@" in text:
                yield "servers", "has a password: put it into the file of 'credentials'"
            elif match is None or not 0 < int(match[3] or DEFAULT_PORT) < 65536:
                yield "servers", f"must be as in nats://a:4222,nats://b:4222, not '{text}'"
            elif text.startswith("tls:") and not self.tls:
                yield "servers", f"{text} needs 'tls', the folder of the certificates"

    def addresses(self) -> list[Server]:
        found = (_SERVER.fullmatch(text.strip()) for text in self.servers.split(","))
        return [Server(m[1] or m[2], int(m[3] or DEFAULT_PORT)) for m in found if m]

    def login(self, folder: Path) -> dict[str, str]:
        """Return the fields of CONNECT that identify this program. Raises ClusterError."""
        if not self.credentials:
            return {}
        text = read_secret(folder / self.credentials)
        user, colon, password = text.partition(":")
        return {"user": user, "pass": password} if colon else {"auth_token": text}


def read_secret(path: Path) -> str:
    """Return the one line of a file that only its owner may read. Raises ClusterError."""
    try:
        text = path.read_text(encoding="utf-8").strip()
        if path.stat().st_mode & 0o077:
            reason = f"others may read {path}: run 'chmod 600 {path}'"
            raise ClusterError(reason, "cluster_credentials")
    except (OSError, UnicodeDecodeError) as error:
        reason = f"cannot read {path}: {getattr(error, 'strerror', None) or error}"
        raise ClusterError(reason, "no_file") from None
    if not text or "\n" in text:
        raise ClusterError(f"{path} is not one line", "cluster_credentials")
    return text


@dataclass(frozen=True, slots=True)
class ClusterConfig(FleetConfig):
    """The NATS servers over which several proxies or runners act as one."""

    replicas: int = key(
        3, "Servers that keep each lease: 3, or 1 where there is one.", minimum=1, maximum=5
    )


FLEET = ConfigFile("fleet.yml", FleetConfig)
