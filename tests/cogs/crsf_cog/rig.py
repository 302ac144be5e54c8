"""A receiver at a real pty beside an aircraft in flight, in a test's time."""

import select

from crsf_cog.frames import CHANNELS, LINK_STATISTICS, CrsfDecoder, frame
from crsf_cog.modules.crsf_receiver import CrsfReceiver

from raspilot.flight_modes.return_home import Return
from tests.cogs.serial_cog.rig import VirtualReactor, run
from tests.raspilot.navigation_rig import NavigationRig
from up.base_module import BaseModule
from up.commands.arming_commands import ArmCommand
from up.life_cycle import LifeCycle
from up.providers.base_rx_provider import UpRXProvider
from up_rig.pty_line import PtyLine

STEP_S = 0.05
MODES = "mode_channel: 6\nmodes: [LOITER, '', RETURN]\n"


def channels_frame(channels_us):
    """Return a frame of 16 channels; those that are not given are at 1500 us."""
    pulses = [channels_us.get(number, 1500) for number in range(1, 17)]
    values = [992 + round((each - 1500) * 1.6) for each in pulses]
    bits = sum(value << 11 * place for place, value in enumerate(values))
    return frame(CHANNELS, bits.to_bytes(22, "little"))


def statistics_frame(quality):
    return frame(LINK_STATISTICS, bytes([70, 90, quality, 9, 0, 4, 3, 60, 100, 7]))


class Arming(BaseModule):
    """Counts the Commands that were not refused."""

    def on_init(self):
        self.armed = []
        self.up.command_executor.register_command(ArmCommand, self.armed.append)


class CrsfRig(NavigationRig):
    """``pulses`` are the channels by number; ``quality`` None: no link statistics."""

    def __init__(self, folder, config=MODES, **more):
        folder.mkdir(exist_ok=True)
        self.path = folder / "receiver"
        self.line = PtyLine(self.path)
        super().__init__(
            folder / "config", clock=VirtualReactor(), modes=(Return,),
            modules=(CrsfReceiver, Arming), crsf=f"port: {self.path}\n{config}", **more,
        )  # fmt: skip
        self.pulses, self.quality = {6: 1500}, 100
        self.decoder = CrsfDecoder()
        self.receiver = self.up.get_module(CrsfReceiver)
        self.rx = self.up.get_module(UpRXProvider)
        self.armed = self.up.get_module(Arming).armed
        self.life = LifeCycle(self.up)
        run(self.life.start())
        self.state(armed=True)

    def advance(self, seconds, *, sends=True):
        for _ in range(round(seconds / STEP_S)):
            self.clock.advance(STEP_S)
            self.state(armed=True)
            self.setpoint()
            if sends:
                statistics = b"" if self.quality is None else statistics_frame(self.quality)
                self.send(statistics + channels_frame(self.pulses))

    def send(self, data):
        self.line.write(data)
        self.clock.turn()

    def heard(self):
        """Return the newest frames that the transmitter got, by type."""
        self.clock.turn()
        data = b""
        while select.select([self.line._own], [], [], 0)[0]:
            data += self.line.read(0.0, 4096)
        return dict(self.decoder.feed(data))

    @property
    def selected(self):
        return self.shown()["selected"]

    @property
    def content(self):
        return self.receiver.telemetry_content["crsf"]

    @property
    def counters(self):
        return self.receiver.telemetry_content["counters"]["crsf"]

    def stop(self):
        run(self.life.stop())
        if self.line is not None:
            self.line.close()
