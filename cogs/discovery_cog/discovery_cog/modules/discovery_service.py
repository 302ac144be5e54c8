"""Discovery of the Raspberry Pi by the airborne phone (thesis 3.3.3)."""

from collections.abc import Mapping
from typing import Any

from twisted.internet.error import CannotListenError

from discovery_cog.answerer import Answerer, RateLimit, own_address_towards
from discovery_cog.config import DISCOVERY
from up.base_started_module import BaseStartedModule, StartFailedError
from up.mode import WITH_BOARD
from up.system.udp import listen_udp


class DiscoveryService(BaseStartedModule):
    """Answers the phone's broadcast; not in Black Box Mode, where the server's address is known."""

    CONFIG = DISCOVERY
    MODES = WITH_BOARD
    SHED_ORDER = 10

    def on_init(self) -> None:
        self._answerer = Answerer(RateLimit(self.context.reactor), own_address_towards)
        self._port: Any = None

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        return {"counters": {"discovery": dict(self._answerer.counters)}}

    def on_start(self) -> bool:
        try:
            self._port = listen_udp(self.context.reactor, self.config.port, self._answerer)
        except CannotListenError as error:
            reason = getattr(error.socketError, "strerror", None) or error.socketError
            raise StartFailedError(
                f"UDP port {error.port} cannot be opened: {reason} (discovery.yml: port)"
            ) from error
        self.up.advertise_port("discovery", self._port.getHost().port)
        return True

    async def on_stop(self) -> None:
        port, self._port = self._port, None
        if port is not None:
            await port.stopListening()
