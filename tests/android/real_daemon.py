"""`python main.py` for a phone and a ground: its ports are the same after each start."""

import re
from pathlib import Path

from tests.cogs.arduino_cog.daemon import Daemon
from tests.test_whole_system_log import Log
from up_simulator.harness.ports import choose_port_sets

AIRCRAFT = "glider-5"
GUARDS = (
    "load_guard_cog.modules.load_guard.LoadGuard",
    "load_guard_cog.modules.system_state_provider.SystemStateProvider",
)
"""For streams that a test counts: any load of this machine would slow them."""


class RealDaemon(Daemon):
    """Raspilot, with a proxy and an Arduino where they are named; it flies without as well."""

    def __init__(self, folder, proxy=None, board=None, mission="", security="auto", **files):
        folder.mkdir(exist_ok=True)
        (self.ports,) = choose_port_sets(1)
        self.flights = folder / "flights"
        server = ""
        if proxy is not None:
            port = proxy.airborne_port
            server = f"remote_server: {{url: 127.0.0.1, port: {port}, security: {security}}}\n"
        texts = {
            "config": "mode: flight controller\n",
            "android": f"general port: {self.ports.general}\n"
            f"orientation port: {self.ports.orientation}\n",
            "discovery": f"port: {self.ports.discovery}\n",
            "black_box": f"folder: {self.flights}\n",
            "disabled_modules": f"disabled modules: [{', '.join(GUARDS)}]\n",
            "mission_control": f"role: pilot\naircraft: {AIRCRAFT}\n{server}{mission}"
            "listener: {port: 0, address: 127.0.0.1}\n",
        }
        super().__init__(folder, board or folder / "no-board", **{**texts, **files})

    @property
    def listener_port(self):
        """Return the port of its listener for grounds."""
        return int(re.findall(r"ground listens on port (\d+)", self.said())[-1])

    @property
    def place(self):
        """Return the options of a phone that knows where it is."""
        return self.place_at("127.0.0.1")

    def place_at(self, host, general=None, orientation=None):
        """Return the options of a phone that looks for it there."""
        general = general or self.ports.general
        orientation = orientation or self.ports.orientation
        return ("--raspberry", f"{host}:{general}:{orientation}")

    def log_of(self, topic):
        """Return a topic's records in the flight's log, oldest first; it may still be growing."""
        return [each for log in self.logs() for each in log.messages.get(topic, [])]

    def logs(self):
        """Return the recorded messages, flight by flight."""
        return [Log(path) for path in sorted(Path(self.flights).glob("*.mcap"))]
