"""The daemon, the phone and the ground station of a flight, all in this process."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

from up_simulator.crew.protocols import CrewError
from up_simulator.flight import Flight
from up_simulator.in_process.config_folder import GROUND_PORT, write_config
from up_simulator.in_process.ground import InProcessGround
from up_simulator.in_process.phone import InProcessPhone
from up_simulator.in_process.raspilot import InProcessRaspilot
from up_simulator.in_process.reactor import SimulatedReactor
from up_simulator.link.model import LinkModel
from up_simulator.scenario.circumstances import LinkPart
from up_simulator.scenario.event import Event
from up_simulator.scenario.line_board import LineBoard
from up_simulator.scenario.scenario import Scenario
from up_simulator.scenario.settings import merge

PI_VETO = 1 << 4
SETTLED_S = 1.0


class InProcessCompanions:
    """Everybody on one ``SimulatedReactor``, in step with the board: the same flight every time.

    ``settings`` are the configuration files that the airframe gives; the scenario's own lie over
    them.
    """

    def __init__(
        self,
        scenario: Scenario,
        flight: Flight,
        board: LineBoard,
        settings: dict[str, dict[str, Any]],
    ) -> None:
        self._scenario = scenario
        self._board = board
        self._reactor = SimulatedReactor()
        # The folder goes when nobody refers to it any more, whatever ends the flight.
        self._folder = tempfile.TemporaryDirectory(prefix="up-sim-")
        config = write_config(Path(self._folder.name), merge(settings, scenario.raspilot.config))
        self.raspilot = InProcessRaspilot(self._reactor, config, seed=scenario.seed)
        self._up, self._down = LinkModel(seed=scenario.seed), LinkModel(seed=scenario.seed + 1)
        self._reactor.link(GROUND_PORT, up=self._down, down=self._up)
        self.ground: InProcessGround | None = None
        self.phone: InProcessPhone | None = None
        if scenario.ground is not None:
            self.ground = InProcessGround(self._reactor, seed=scenario.seed)
        if scenario.phone is not None:
            self.phone = InProcessPhone(
                self._reactor, flight, orientation=scenario.phone.orientation, seed=scenario.seed
            )
        self._ready_s: float | None = None
        self._is_wanted = False

    def start(self) -> None:
        """Start the daemon, the ground station and, where it is plugged in, the phone."""
        self.raspilot.start()
        self._is_wanted = True
        if self.ground is not None:
            self.ground.start()
        if self.phone is not None and self._scenario.phone and self._scenario.phone.plugged:
            self.phone.plug()

    def is_ready(self) -> bool:
        """Return whether all have connected, the daemon has no veto, and a second has passed."""
        if not self._has_connected():
            self._ready_s = None
            return False
        if self._ready_s is None:
            self._ready_s = self.seconds()
            self._set_up()
        return self.seconds() - self._ready_s >= SETTLED_S

    def exchange(self, step_s: float) -> None:
        """Let bytes pass and this time go by."""
        self.raspilot.pump(self._board)
        self._reactor.advance(step_s)
        if self._is_wanted and not self.raspilot.is_running:
            self._is_wanted = False
            raise CrewError("the daemon has ended by itself")

    def seconds(self) -> float:
        """Return the simulated time."""
        return float(self._reactor.seconds())

    def carry_out(self, event: Event) -> None:
        """Let happen what concerns the crew; raises CrewError."""
        match event.kinds[0]:
            case "serial" if event.serial == "back":
                self.raspilot.line.plug()
            case "serial":
                self.raspilot.line.unplug()
            case "phone" if self.phone is not None:
                move_cable = self.phone.plug if event.phone == "back" else self.phone.unplug
                move_cable()
            case "link":
                self._fail_link(event.link or "restore")
            case "link_settings" if event.link_settings is not None:
                self._set_link(event.link_settings)
            case "raspilot":
                self._command_raspilot(event.raspilot or "started")
            case "cpu_load_percent" if event.cpu_load_percent is not None:
                self.raspilot.meter.load = event.cpu_load_percent
            case _:
                pass

    def stop(self) -> None:
        """End everybody."""
        if self.ground is not None:
            self.ground.stop()
        if self.phone is not None:
            self.phone.stop()
        self._is_wanted = False
        self.raspilot.kill()
        self._folder.cleanup()

    def _has_connected(self) -> bool:
        if self.ground is not None and not self.ground.frames:
            return False
        if self._scenario.board == "direct":
            return True
        status = self._board.tap.status
        return status is not None and status.has_heard and not status.vetoes & PI_VETO

    def _set_up(self) -> None:
        """Ask for what the flight is to begin with; a bad link comes only now, with the flight."""
        ground = self._scenario.ground
        if self.ground is not None and ground is not None and ground.period_ms is not None:
            self.ground.send("up.telemetry.frequency", frequency=ground.period_ms)
        self._set_link(self._scenario.link)

    def _set_link(self, link: LinkPart) -> None:
        self._up.settings = link.up.settings()
        self._down.settings = link.down.settings()

    def _fail_link(self, what: str) -> None:
        for model in (self._up, self._down):
            if what == "blackout":
                model.black_out()
            elif what == "stall":
                model.stall(self.seconds())
            else:
                model.restore()
                model.resume(self.seconds())

    def _command_raspilot(self, what: str) -> None:
        self._is_wanted = what == "started"
        if what == "killed":
            self.raspilot.kill()
        elif what == "stopped":
            self.raspilot.stop()
        else:
            self.raspilot.start()
