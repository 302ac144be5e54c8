"""A ground's link through a time without packets, a separate process.

Arguments: host, port, folder of the certificate, folder of the key, seconds of darkness, the prefix
of a command in the namespace of the relay. Prints the seconds from the end of darkness to the next
telemetry that the key authenticates.
"""

import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from twisted.internet import reactor as _reactor

from up.protocols.general_message import GeneralMessage
from up_ground.ground_link import GroundLink
from up_ground.key_store import KeyStore
from up_ground.settings import Seat, Settings
from up_ground.telemetry import NAME as TELEMETRY
from up_ground.token_store import TokenStore

reactor: Any = _reactor
_CHAIN = "chain {0} {{ type filter hook {0} priority 0; {1} != lo drop; }}\n"
DROP = (
    f"table inet hole {{\n{_CHAIN.format('input', 'iifname')}{_CHAIN.format('output', 'oifname')}}}"
)


class Watcher:
    """Darkens the network once the link is open, and measures the way back."""

    def __init__(
        self, host: str, port: int, folders: list[Path], dark_s: float, inside: list[str]
    ) -> None:
        certificate, keys = folders
        ((aircraft, pairing),) = KeyStore(keys).all().items()
        settings = Settings(host, port, aircraft, Seat.LISTEN, tls=certificate, pairing=pairing)
        self._link = GroundLink(
            reactor, settings, self, TokenStore(Path(tempfile.mkdtemp()), settings)
        )
        self._dark_s = dark_s
        self._inside = inside
        self._light_s: float | None = None
        self._is_dark = False
        self._link.start()

    def on_message(self, message: GeneralMessage) -> None:
        if message.name != TELEMETRY:
            return
        if self._light_s is not None:
            print(f"{reactor.seconds() - self._light_s:.3f}", flush=True)
            self._light_s = None
            reactor.stop()
        elif not self._is_dark:
            self._is_dark = True
            reactor.callLater(1.0, self._darken)

    def on_link(self) -> None: ...

    def _darken(self) -> None:
        self._nft(DROP)
        reactor.callLater(self._dark_s, self._lighten)

    def _lighten(self) -> None:
        if self._link.status.is_open:
            sys.stderr.write("the link stayed open in darkness\n")
            reactor.stop()
        self._nft("delete table inet hole")
        self._light_s = reactor.seconds()

    def _nft(self, rules: str) -> None:
        subprocess.run([*self._inside, "nft", "-f", "-"], input=rules, text=True, check=True)


if __name__ == "__main__":
    host, port, certificate, keys, dark_s, inside = sys.argv[1:]
    folders = [Path(certificate), Path(keys)]
    watcher = Watcher(host, int(port), folders, float(dark_s), inside.split())
    reactor.callLater(float(dark_s) + 60, reactor.stop)
    reactor.run()
