"""Receivers on ptys, the provider, the phone, in a test's time."""

from gps_cog.modules.gps_provider import GpsProvider

from tests.cogs.gps_cog.frames import state_at
from tests.cogs.serial_cog.rig import VirtualReactor, run
from tests.support.system import build_up, started
from up.commands.location_command import LocationCommand
from up.commands.origin import Origin
from up.commands.roles import Role
from up.protocols.serial_port import open_serial
from up.providers.up_location_provider import UpLocationProvider
from up_rig.pty_line import PtyLine

STEP_S = 0.01
PHONE = Origin("android", Role.SENSOR, 0)


class Aboard:
    """A receiver at a pty. ``send`` gives the bytes of a moment; a twin also hears the host."""

    def __init__(self, path, send, twin=None):
        self.path, self.send, self.twin = path, send, twin
        self.line = PtyLine(path)

    def unplug(self):
        self.line.close()
        self.line = None

    def plug(self):
        self.line = PtyLine(self.path)

    def step(self, time_s, baud_rate):
        if self.line is None:
            return
        heard = self.line.read(0.0, 4096)
        if self.twin is None:
            self.line.write(self.send(time_s))
            return
        if baud_rate != self.twin.baud_rate:
            # At another speed both hear noise.
            said = self.twin.poll(state_at(time_s))
            self.line.write(bytes(len(said)))
            return
        said = self.twin.feed(heard)
        if baud_rate == self.twin.baud_rate:
            self.line.write(said + self.twin.poll(state_at(time_s)))


class Rig:
    """``heard`` has (time, source, location) of what the bus carries."""

    def __init__(self, folder, config):
        self.reactor = VirtualReactor()
        self.aboard = []
        self.opened = []
        self.heard = []
        self.up = build_up([GpsProvider], self.reactor, folder, config={"gps.yml": config})
        self.provider = self.up.get_module(GpsProvider)
        self.provider.open_port = self._open
        executor = self.up.command_executor
        executor.register_command(LocationCommand, self._on_location)
        self.location = self.up.get_module(UpLocationProvider)
        self.life = run(started(self.up))
        self.begin_s = self.reactor.seconds()
        self.has_phone = False

    @property
    def time_s(self):
        return self.reactor.seconds() - self.begin_s

    @property
    def source(self):
        return self.location.reading and self.location.reading.source

    def counters(self, name="gps"):
        return self.up.telemetry_controller.collect()["counters"][f"gps_{name}"]

    def advance(self, seconds):
        for _ in range(round(seconds / STEP_S)):
            before_s = self.time_s
            self.reactor.advance(STEP_S)
            for each in self.aboard:
                speeds = [baud for path, baud in self.opened if path == str(each.path)]
                each.step(self.time_s, speeds[-1] if speeds else 0)
            self.reactor.turn()
            if self.has_phone and int(self.time_s) > int(before_s):
                self.up.command_executor.execute_command(LocationCommand(49.9, 14.5), PHONE)

    def stop(self):
        run(self.life.stop())
        for each in self.aboard:
            if each.line is not None:
                each.unplug()

    def _open(self, path, baud_rate):
        descriptor = open_serial(path, baud_rate)
        self.opened.append((path, baud_rate))
        return descriptor

    def _on_location(self, command):
        origin = self.up.command_executor.origin
        self.heard.append((self.time_s, origin.link, command))
