"""A serial line whose other end a test controls: a real pty, and time that the test advances."""

import os
import select
import tty
from contextlib import suppress

from twisted.internet.defer import Deferred
from twisted.internet.task import Clock

from tests.support.old_firmware import ThesisReader
from tests.support.system import build_up, started
from up_simulator.firmware.wire import CheckedReader, checked_frame

STEP_S = 0.02


class VirtualReactor(Clock):
    """A clock that also knows descriptors; ``turn`` handles everything ready, without waiting."""

    def __init__(self):
        super().__init__()
        self.rightNow = 1000.0
        self.readers = set()
        self.writers = set()

    def addReader(self, reader):  # noqa: N802
        self.readers.add(reader)

    def removeReader(self, reader):  # noqa: N802
        self.readers.discard(reader)

    def addWriter(self, writer):  # noqa: N802
        self.writers.add(writer)

    def removeWriter(self, writer):  # noqa: N802
        self.writers.discard(writer)

    def callFromThread(self, call, *args):  # noqa: N802
        self.callLater(0, call, *args)

    def turn(self):
        while True:
            readable, writable, _ = select.select(list(self.readers), list(self.writers), [], 0)
            if not readable and not writable:
                return
            for each in readable:
                self._do(each, each.doRead)
            for each in writable:
                self._do(each, each.doWrite)

    def _do(self, each, call):
        if each.fileno() >= 0:
            lost = call()
            if lost is not None:
                self.removeReader(each)
                self.removeWriter(each)
                each.connectionLost(lost)


class Port:
    """A pty under a name of the test's choice, and the Arduino's end: sent and received data."""

    def __init__(self, link, framing="checked"):
        self.link = link
        self.framing = framing
        self.sequence = 0
        self.heard = []
        self._master = self._slave = -1
        self.plug_in()

    def plug_in(self):
        self._master, self._slave = os.openpty()
        tty.setraw(self._slave)
        os.set_blocking(self._master, False)
        self.link.parent.mkdir(parents=True, exist_ok=True)
        self.link.symlink_to(os.ttyname(self._slave))
        self._reader = CheckedReader() if self.framing == "checked" else ThesisReader()

    @property
    def slave(self):
        return self._slave

    def unplug(self):
        with suppress(FileNotFoundError):
            self.link.unlink()
        if self._master >= 0:
            os.close(self._slave)
            os.close(self._master)
        self._master = self._slave = -1

    def write(self, data):
        os.write(self._master, data)

    def frame(self, letter, payload=b"", sequence=None):
        if self.framing != "checked":
            return letter.encode() + payload
        if sequence is None:
            sequence = self.sequence
            self.sequence = (self.sequence + 1) % 256
        return checked_frame(sequence, letter, payload)

    def send(self, letter, payload=b"", sequence=None):
        self.write(self.frame(letter, payload, sequence))

    def raw(self):
        with suppress(BlockingIOError, OSError):
            return os.read(self._master, 65536)
        return b""

    def listen(self, now_s):
        """Return the Commands that came since the last call; ``heard`` has all of them."""
        new = []
        if self._master >= 0:
            new = list(self._reader.feed(self.raw(), now_s))
        self.heard += new
        return new


def run(deferred_or_coroutine):
    """Return the result of something that needs no time to pass."""
    outcome = []
    done = Deferred.fromCoroutine(deferred_or_coroutine)
    done.addBoth(outcome.append)
    assert outcome, "it waits"
    if hasattr(outcome[0], "raiseException"):
        outcome[0].raiseException()
    return outcome[0]


class Rig:
    """A system of some modules at one end of the line, a Port at the other."""

    def __init__(self, modules, folder, framing="checked", config=None):
        self.reactor = VirtualReactor()
        self.port = Port(folder / "board", framing)
        text = f"port: {folder / 'board'}\nframing: {framing}\n"
        text += "baud_rate: 9600\n" if framing == "thesis" else ""
        self.folder = folder / "config"
        self.up = build_up(
            modules,
            self.reactor,
            self.folder,
            config={"arduino.yml": text, **(config or {})},
        )
        self.life = None
        self.on_command = lambda command: None

    def start(self):
        self.life = run(started(self.up))
        self.turn()

    def stop(self):
        if self.life is not None:
            run(self.life.stop())
            self.life = None
        self.port.unplug()

    def turn(self):
        """Make both ends do everything that is due."""
        for _ in range(6):
            self.reactor.turn()
            for command in self.port.listen(self.reactor.seconds()):
                self.on_command(command)
        self.reactor.turn()

    def advance(self, seconds):
        """Let time pass, in small steps."""
        left = seconds
        while left > 1e-9:
            step = min(STEP_S, left)
            self.reactor.advance(step)
            self.turn()
            left -= step

    def say(self, letter, payload=b"", sequence=None):
        """Let the Arduino's end send a frame."""
        self.port.send(letter, payload, sequence)
        self.turn()

    def module(self, cls):
        return self.up.get_module(cls)
