"""An aircraft that flies in real time, the daemon, and a pilot whose sticks a test moves."""

import socket
import sys
import threading
from dataclasses import replace

from tests.ground.aircraft import NAME
from up_simulator.harness.child import Child
from up_simulator.harness.ports import choose_ports
from up_simulator.harness.programs import RealRaspilot
from up_simulator.in_process.config_folder import write_config
from up_simulator.radio.remote_messages import write_sticks
from up_simulator.radio.sticks import Sticks

START_S = 60.0
LEVEL = Sticks(throttle=1550, aux2=2000)


class Pilot:
    """Sends the sticks five times a second; the switch is at AUTO."""

    def __init__(self, path):
        self.sticks = LEVEL
        self._path = str(path)
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._send, daemon=True)
        self._thread.start()

    def move(self, **channels):
        self.sticks = replace(self.sticks, **channels)

    def stop(self):
        self._ended.set()
        self._thread.join()
        self._socket.close()

    def _send(self):
        while not self._ended.wait(0.2):
            self._socket.sendto(write_sticks(self.sticks), self._path)


class Flying:
    """``ports`` are those of the endpoints, in their order; ``proxy`` relays to the ground."""

    def __init__(self, folder, *endpoints, proxy=None, **files):
        ports = choose_ports(True)
        uplink = {"url": "127.0.0.1", "port": proxy.airborne_port} if proxy else {}
        config = write_config(
            folder / "config",
            {
                "arduino.yml": {"port": str(folder / "board")},
                "android.yml": {
                    "general port": ports.general,
                    "orientation port": ports.orientation,
                },
                "discovery.yml": {"port": ports.discovery},
                "mission_control.yml": {
                    "listener": {"port": 0},
                    "remote_server": uplink,
                    "aircraft": NAME,
                    "role": "pilot",
                    "tune_in_flight": True,
                },
                "mavlink.yml": {"endpoints": list(endpoints)},
                **files,
            },
        )
        options = ["--board", "host", "--turbulence", "none", "--wind", "0"]
        options += ["--radio-socket", folder / "radio", "--pty-link", folder / "board"]
        options += ["--general-port", ports.general, "--orientation-port", ports.orientation]
        command = [sys.executable, "-m", "up_simulator", "start", *map(str, options)]
        self._aircraft = Child("aircraft", command, folder)
        self._daemon = RealRaspilot(config, folder)
        self.pilot = None
        try:
            self._aircraft.wait_for("board_ready", START_S)
            self.pilot = Pilot(folder / "radio")
            self._daemon.start()
            self._daemon.wait_for("started", START_S)
            names = [f"mavlink {number} listens" for number in range(len(endpoints))]
            self.ports = [self._port_of(each) for each in names]
        except BaseException:
            self.stop()
            raise

    def stop(self):
        if self.pilot is not None:
            self.pilot.stop()
        self._daemon.stop()
        self._aircraft.end()

    def _port_of(self, text):
        line = next(each for each in self._daemon.log if text in each)
        return int(line.rpartition(" ")[2])
