"""The daemon, and if required the proxy, as real programs with real sockets and a pty."""

from __future__ import annotations

from typing import Any

from up_rig.pty_line import PtyLine, PtyLineError
from up_simulator.aircraft.dynamics import FlightDynamics
from up_simulator.betaflight.packets import LINE as BETAFLIGHT_LINE
from up_simulator.harness.participants import ParticipantError
from up_simulator.harness.ports import choose_port_sets
from up_simulator.harness.programs import RealProxy, RealRaspilot, RealRunner
from up_simulator.harness.two_paths import (
    BEST,
    PROXY,
    PROXY_FOR_GROUND,
    SPARE,
    TwoPaths,
    check_paths,
)
from up_simulator.harness.world import BYTES_A_STEP, STEP_S
from up_simulator.in_process.config_folder import mavlink_file, merge, write_config
from up_simulator.in_process.ground import InProcessGround
from up_simulator.in_process.mavlink_ground import MavlinkGround
from up_simulator.in_process.metrics_reader import MetricsReader
from up_simulator.in_process.phone import InProcessPhone
from up_simulator.link.relay import LOOPBACK
from up_simulator.scenario.event import Event
from up_simulator.scenario.line_board import LineBoard
from up_simulator.scenario.participants import DaemonParticipants
from up_simulator.scenario.real_reactor import RealReactor
from up_simulator.scenario.runner_participants import RunnerDaemon, RunnerPhone, write_runner_config
from up_simulator.scenario.scenario import Scenario
from up_simulator.scenario.workspace import Workspace

FLIGHTS = "flights"


class SerialLineError(ParticipantError):
    """The serial line cannot be opened."""

    code = "serial_line"


class RealParticipants(DaemonParticipants):
    """``python main.py`` on a pty; phone and ground station are stubs on real sockets.

    The link lies between the daemon and its peer: the ground station at its listener, or the
    proxy. The flight keeps real time, from the boot on. Raises ParticipantError.
    """

    def __init__(
        self,
        scenario: Scenario,
        flight: FlightDynamics,
        board: LineBoard,
        settings: dict[str, dict[str, Any]],
    ) -> None:
        super().__init__(scenario, board)
        self._paths: TwoPaths | None = None
        if self.scenario.through == "two paths":
            check_paths()
            self._paths = TwoPaths()
        self._reactor = RealReactor()
        self._workspace = Workspace()
        self._folder = self._workspace.path
        # Three of the phone's and the link's own, and those of the programs.
        self._ports, self._before = choose_port_sets(2)
        self._line: PtyLine | None = self._open_line()
        self._receiver_line = self._open_receiver_line()
        self._goggles_line = None if self.goggles is None else self._open_line("goggles")
        self._flight = flight
        self._real = self._make_daemon(merge(self._files(), settings))
        self.raspilot = self._real
        self._make_ground()
        self._make_phone(flight)
        reactor: Any = self._reactor
        if scenario.metrics:
            self.metrics = MetricsReader(reactor, self._before.metrics)
        if scenario.mavlink:
            self.mavlink = MavlinkGround(reactor, self._before.mavlink)

    @property
    def _has_proxy(self) -> bool:
        return self.scenario.through != "listener"

    def seconds(self) -> float:
        return self._reactor.seconds()

    def start(self) -> None:
        if self._paths is not None:
            self._paths.open()
        if self._proxy is not None:
            self._proxy.start()
            self._proxy.wait_for_ports()
        super().start()

    def exchange(self) -> None:
        line = self._line
        if line is not None:
            data = line.read(0.0, BYTES_A_STEP)
            if data:
                self.board.write(data)
        sent = self.board.read()
        if line is not None and sent:
            line.write(sent)
        if self.receiver is not None and self._receiver_line is not None:
            self.receiver.exchange(self._receiver_line, self._flight.state)
        if self.goggles is not None and self._goggles_line is not None:
            self.goggles.exchange(self._goggles_line)
        self._reactor.advance(STEP_S)
        self.check_raspilot()

    def check_raspilot(self) -> None:
        """Raise ParticipantError with the daemon's last log lines if it should run and does not."""
        if isinstance(self._real, RunnerDaemon):
            self._real.check()
        elif self._should_run and not self._real.is_running:
            self._should_run = False
            self._real.check()

    def dispatch(self, event: Event) -> None:
        if event.path is not None and self._paths is not None:
            (self._paths.cut if event.path == "cut" else self._paths.restore)()
        elif event.proxy is None:
            super().dispatch(event)
        elif self._proxy is not None:
            if event.proxy == "killed":
                self._proxy.kill()
            else:
                self._proxy.start()

    def plug_serial(self, is_in: bool) -> None:
        if self._line is not None:
            self._line.close()
            self._line = None
        if is_in:
            self._line = self._open_line()

    def plug_receiver(self, is_in: bool) -> None:
        if self._receiver_line is not None:
            self._receiver_line.close()
        self._receiver_line = self._open_receiver_line() if is_in else None

    def load(self, percent: float) -> None:
        """Raise ParticipantError: a real daemon measures the load of the whole machine."""
        raise ParticipantError(
            "no scenario sets the load of a real machine: use 'runs: in process'"
        )

    def stop(self) -> None:
        super().stop()
        if self._proxy is not None:
            self._proxy.stop()
        if self._paths is not None:
            self._paths.close()
        for line in (self._line, self._goggles_line):
            if line is not None:
                line.close()
        self._line = self._goggles_line = None
        self.plug_receiver(False)
        self._reactor.stop()
        # An instance of a runner has its own folder in the one that it is given.
        found = sorted((self._folder / FLIGHTS).rglob("*.mcap"))
        self.black_boxes = {path.name: path.read_bytes() for path in found}
        self._workspace.close()

    def kill_raspilot(self) -> None:
        if isinstance(self._real, RunnerDaemon):
            self._real.end()
        else:
            self._real.kill()

    def terminate_raspilot(self) -> None:
        if isinstance(self._real, RealRaspilot):
            self._real.request_stop()
        else:
            self._real.stop()

    def _open_receiver_line(self) -> PtyLine | None:
        return None if self.receiver is None else self._open_line("gps")

    def _open_line(self, name: str = "board") -> PtyLine:
        try:
            return PtyLine(self._folder / name)
        except (PtyLineError, OSError) as error:
            raise SerialLineError(f"cannot open the serial line: {error}") from error

    def _make_daemon(self, files: dict[str, dict[str, Any]]) -> RealRaspilot | RunnerDaemon:
        folder, changes = self._folder / "config", self.scenario.raspilot.config
        config = write_config(folder, merge(files, changes))
        inside = () if self._paths is None else self._paths.inside
        self._proxy = RealProxy(config, self._folder, inside) if self._has_proxy else None
        if self.scenario.through != "runner":
            return RealRaspilot(config, self._folder)
        role = files["mission_control.yml"].get("role", "operator")
        own: dict[str, dict[str, Any]] = {
            "config.yml": {"mode": "black box"},
            "mission_control.yml": {"role": role},
            "black_box.yml": self._black_box(),
        }
        own = merge(own, changes)
        proxy = {"airborne port": self._ports.airborne, "ground port": self._ports.ground}
        write_runner_config(folder, self._folder / "run", own, proxy)
        self._runner = RealRunner(folder, self._folder)
        return RunnerDaemon(self._runner, self._folder / "run")

    def _files(self) -> dict[str, dict[str, Any]]:
        ports = self._ports
        files: dict[str, dict[str, Any]] = {
            "arduino.yml": {"port": str(self._folder / "board")},
            "android.yml": {
                "general port": ports.general,
                "orientation port": ports.orientation,
            },
            "discovery.yml": {"port": ports.discovery},
            "mission_control.yml": {"listener": {"port": ports.ground, "address": LOOPBACK}},
            "black_box.yml": self._black_box(),
        }
        if self.scenario.board == "betaflight":
            files["config.yml"] = {"flight controller": "msp"}
            files["msp.yml"] = {"port": BETAFLIGHT_LINE}
        if self.scenario.gps is not None:
            port, rate_hz = str(self._folder / "gps"), self.scenario.gps.rate_hz
            files["gps.yml"] = {"receivers": {"gps": {"port": port, "rate_hz": rate_hz}}}
        if self.scenario.goggles is not None:
            port, grid = str(self._folder / "goggles"), self.scenario.goggles
            files["osd.yml"] = {"port": port, "grid": grid}
        if self.scenario.metrics:
            files["metrics.yml"] = {"port": self._before.metrics}
        if self.scenario.mavlink:
            files["mavlink.yml"] = mavlink_file(self._before.mavlink)
        if self._has_proxy:
            uplink: dict[str, Any] = {"url": LOOPBACK, "port": self._before.airborne}
            if self._paths is not None:
                uplink = {"url": PROXY, "port": ports.airborne, "interfaces": [BEST, SPARE]}
            files["mission_control.yml"] = {"listener": {"port": 0}, "remote_server": uplink}
            files["proxy.yml"] = {
                "airborne port": ports.airborne,
                "ground port": ports.ground,
                "metrics port": ports.metrics,
            }
        return files

    def _black_box(self) -> dict[str, Any]:
        """Make it record as aboard, but only into this folder."""
        return {"enabled": True, "folder": str(self._folder / FLIGHTS)}

    def _make_ground(self) -> None:
        if self.scenario.ground is None:
            return
        ports, before = self._ports, self._before
        seed = self.scenario.seed
        reactor: Any = self._reactor
        if self.scenario.through == "runner":
            # The link is the phone's: daemon and proxy are on servers.
            self.ground = InProcessGround(reactor, ports.ground, seed=seed)
        elif self._paths is not None:
            self.ground = InProcessGround(reactor, ports.ground, host=PROXY_FOR_GROUND, seed=seed)
        elif self._has_proxy:
            # From the aircraft's side of the link: "up" leaves the aircraft.
            self._reactor.targets[before.airborne] = ports.airborne
            self._reactor.link(before.airborne, up=self.up, down=self.down)
            self.ground = InProcessGround(reactor, ports.ground, seed=seed)
        else:
            self._reactor.targets[before.ground] = ports.ground
            self._reactor.link(before.ground, up=self.down, down=self.up)
            self.ground = InProcessGround(reactor, before.ground, seed=seed)

    def _make_phone(self, flight: FlightDynamics) -> None:
        part = self.scenario.phone
        if part is None:
            return
        ports, before = self._ports, self._before
        if isinstance(self._real, RunnerDaemon):
            self.phone = RunnerPhone(
                self._reactor,
                flight,
                lambda: self._runner.port,
                lambda port: self._reactor.relay(0, port, self.up, self.down),
                orientation=part.orientation,
                seed=self.scenario.seed,
            )
            return
        self._reactor.targets[before.general] = ports.general
        self._reactor.targets[before.orientation] = ports.orientation
        reactor: Any = self._reactor
        self.phone = InProcessPhone(
            reactor,
            flight,
            orientation=part.orientation,
            seed=self.scenario.seed,
            general_port=before.general,
            orientation_port=before.orientation,
        )
