"""The daemon, the phone and the ground station of a flight, all in this process."""

from __future__ import annotations

from typing import Any

from up_simulator.aircraft.dynamics import FlightDynamics
from up_simulator.harness.world import STEP_S
from up_simulator.in_process.config_folder import (
    CRSF_PORT,
    GOGGLES_PORT,
    GPS_PORT,
    GROUND_PORT,
    MAVLINK_PORT,
    METRICS_PORT,
    mavlink_file,
    merge,
    write_config,
)
from up_simulator.in_process.ground import InProcessGround
from up_simulator.in_process.mavlink_ground import MavlinkGround
from up_simulator.in_process.metrics_reader import MetricsReader
from up_simulator.in_process.phone import InProcessPhone
from up_simulator.in_process.raspilot import InProcessRaspilot
from up_simulator.in_process.reactor import SimulatedReactor
from up_simulator.radio.crsf_receiver import CHANNEL, CrsfReceiver
from up_simulator.scenario.line_board import LineBoard
from up_simulator.scenario.participants import DaemonParticipants
from up_simulator.scenario.scenario import Scenario
from up_simulator.scenario.workspace import Workspace
from up_simulator.sensors.chips import bus_of

I2C_PERIOD_S = 0.02
"""How often the chips measure."""


class InProcessParticipants(DaemonParticipants):
    """All members on one ``SimulatedReactor``, in step with the board: a reproducible flight.

    ``settings`` are the airframe's configuration files; the scenario's own values override them.
    """

    def __init__(
        self,
        scenario: Scenario,
        flight: FlightDynamics,
        board: LineBoard,
        settings: dict[str, dict[str, Any]],
    ) -> None:
        super().__init__(scenario, board)
        self._reactor = SimulatedReactor()
        self._workspace = Workspace()
        if scenario.gps is not None:
            receiver = {"source": "ubx", "port": GPS_PORT, "rate_hz": scenario.gps.rate_hz}
            settings = merge(settings, {"gps.yml": {"receivers": {"gps": receiver}}})
        if scenario.crsf:
            crsf = {"port": CRSF_PORT, "mode_channel": CHANNEL, "modes": list(scenario.crsf)}
            settings = merge(settings, {"crsf.yml": crsf})
            self.crsf = CrsfReceiver()
        if scenario.sensors:
            sensors = {name: {"chip": name} for name in scenario.sensors}
            settings = merge(settings, {"sensors.yml": {"sensors": sensors}})
        if scenario.goggles is not None:
            osd = {"port": GOGGLES_PORT, "grid": scenario.goggles}
            settings = merge(settings, {"osd.yml": osd})
        if scenario.metrics:
            settings = merge(settings, {"metrics.yml": {"port": METRICS_PORT}})
            self.metrics = MetricsReader(self._reactor)
        if scenario.mavlink:
            settings = merge(settings, {"mavlink.yml": mavlink_file(MAVLINK_PORT)})
            self.mavlink = MavlinkGround(self._reactor)
        self._flight = flight
        config = write_config(self._workspace.path, merge(settings, scenario.raspilot.config))
        self._daemon = InProcessRaspilot(self._reactor, config, seed=scenario.seed)
        self._daemon.i2c = bus_of(scenario.sensors, scenario.seed)
        self._i2c_due_s = 0.0
        self.raspilot = self._daemon
        self._reactor.link(GROUND_PORT, up=self.down, down=self.up)
        if scenario.ground is not None:
            self.ground = InProcessGround(self._reactor, seed=scenario.seed)
        if scenario.phone is not None:
            self.phone = InProcessPhone(
                self._reactor,
                flight,
                orientation=scenario.phone.orientation,
                seed=scenario.seed,
            )

    def seconds(self) -> float:
        return float(self._reactor.seconds())

    def exchange(self) -> None:
        self._daemon.pump(self.board)
        if self.receiver is not None:
            self.receiver.exchange(self._daemon.gps_line, self._flight.state)
        if self.crsf is not None:
            self.crsf.exchange(self._daemon.crsf_line, self.seconds())
        if self.goggles is not None:
            self.goggles.exchange(self._daemon.goggles_line)
        if self.scenario.sensors and self.seconds() >= self._i2c_due_s:
            self._i2c_due_s = self.seconds() + I2C_PERIOD_S
            self._daemon.i2c.update(self._flight.state)
        self._reactor.advance(STEP_S)
        self.check_raspilot()

    def plug_serial(self, is_in: bool) -> None:
        if is_in:
            self._daemon.line.plug()
        else:
            self._daemon.line.unplug()

    def plug_i2c(self, is_in: bool) -> None:
        self._daemon.i2c.fails = lambda: not is_in

    def plug_receiver(self, is_in: bool) -> None:
        if is_in:
            self._daemon.gps_line.plug()
        else:
            self._daemon.gps_line.unplug()

    def load(self, percent: float) -> None:
        self._daemon.meter.load = percent

    def stop(self) -> None:
        super().stop()
        self._workspace.close()
