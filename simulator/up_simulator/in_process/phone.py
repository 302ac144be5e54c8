"""The phone aboard: a handset at the daemon's ports by a cable."""

from __future__ import annotations

from twisted.internet.defer import Deferred

from up_simulator.aircraft.dynamics import FlightDynamics
from up_simulator.harness.user_log import text_log
from up_simulator.in_process.network import ADDRESS
from up_simulator.in_process.reactor import SimulatedReactor
from up_simulator.link.model import LinkModel, LinkSettings
from up_simulator.phone.address import RaspberryPi
from up_simulator.phone.link import OrientationBy, PythonHandset

GENERAL_PORT, ORIENTATION_PORT = 50001, 50000
TICK_S = 0.01
CABLE = LinkSettings(delay_ms=1.0)
MAX_MESSAGES = 200


class InProcessPhone:
    """A phone at the daemon's ports by a cable, which both links share.

    ``plug`` and ``unplug`` move the cable: a connection without it hangs, as with USB tethering,
    until its own timeouts end it. ``messages`` has what the phone reports.
    """

    def __init__(
        self,
        reactor: SimulatedReactor,
        flight: FlightDynamics,
        *,
        orientation: OrientationBy = "tcp",
        seed: int = 1,
        general_port: int = GENERAL_PORT,
        orientation_port: int = ORIENTATION_PORT,
    ) -> None:
        self.messages: list[str] = []
        self.up = LinkModel(CABLE, seed)
        self.down = LinkModel(CABLE, seed + 1)
        self._reactor = reactor
        self._place = RaspberryPi(ADDRESS, general_port, orientation_port)
        for port in (general_port, orientation_port):
            reactor.link(port, self.up, self.down)
        self._host = reactor.host()
        self.handset = PythonHandset(
            self._host, flight, self.find, orientation, text_log(self._note), seed=seed
        )
        self.sensors = self.handset.sensors
        self._is_started = False

    @property
    def is_plugged(self) -> bool:
        return self._is_started and not self.up.is_black

    def plug(self) -> None:
        """Plug it in; the first time it also begins to connect."""
        self.up.restore()
        self.down.restore()
        if not self._is_started:
            self._is_started = True
            self.handset.start()
            self._tick()

    def unplug(self) -> None:
        self.up.black_out()
        self.down.black_out()

    def set_battery(self, percent: float) -> None:
        self.handset.set_battery(percent)

    def stop(self) -> None:
        self._is_started = False
        Deferred.fromCoroutine(self.handset.stop()).addErrback(lambda _: None)

    async def find(self) -> RaspberryPi:
        return self._place

    def _tick(self) -> None:
        if self._is_started:
            self._host.callLater(TICK_S, self._tick)
            self.handset.tick()

    def _note(self, text: str) -> None:
        if len(self.messages) < MAX_MESSAGES:
            self.messages.append(f"{self._reactor.seconds():9.3f} {text}")
