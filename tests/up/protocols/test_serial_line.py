import errno
import os
import pty
import tty

import pytest
from twisted.internet.task import Clock

from tests.support.reactor import reactor, run_in_reactor, sleep, until
from tests.up.protocols.golden import TO_ARDUINO
from up.protocols.checked_framing import CheckedDecoder, CheckedEncoder
from up.protocols.serial_line import SerialLine
from up.protocols.serial_port import SerialPortError, open_serial

H = ord("h")


class Cable:
    """A path that a pty stands behind while it is plugged in."""

    def __init__(self, folder):
        self.path = folder / "ttyUSB0"
        self.master = -1

    def plug(self):
        self.master, slave = pty.openpty()
        tty.setraw(slave)
        self.path.symlink_to(os.ttyname(slave))
        os.close(slave)
        os.set_blocking(self.master, False)

    def unplug(self):
        self.path.unlink()
        os.close(self.master)
        self.master = -1

    def read(self):
        try:
            return os.read(self.master, 65536)
        except OSError as error:
            # Nothing there yet, or the other end is not open.
            if error.errno in (errno.EAGAIN, errno.EIO):
                return b""
            raise


class Notes:
    def __init__(self, cable, **options):
        self.data = b""
        self.events = []
        self.line = SerialLine(
            reactor,
            lambda: open_serial(str(cable.path), 115200),
            on_bytes=self.received,
            on_opened=lambda: self.events.append("opened"),
            on_lost=lambda why: self.events.append("lost"),
            on_open_failed=lambda why: self.events.append(why),
            **options,
        )

    def received(self, data):
        self.data += data


def with_line(folder, scenario, **options):
    async def run():
        cable = Cable(folder)
        notes = Notes(cable, **options)
        try:
            await scenario(cable, notes)
        finally:
            notes.line.stop()
            if cable.master >= 0:
                cable.unplug()

    run_in_reactor(run)


def test_bytes_pass_both_ways(tmp_path):
    async def scenario(cable, notes):
        cable.plug()
        assert notes.line.start()
        os.write(cable.master, bytes(range(256)))
        await until(lambda: notes.data == bytes(range(256)))
        assert notes.line.write(b"abc")
        assert notes.line.write_newest("r", b"def")
        received = bytearray()
        await until(lambda: received.extend(cable.read()) or received == b"abcdef")
        assert notes.events == ["opened"]

    with_line(tmp_path, scenario)


def test_a_frame_leaves_in_one_write_at_once(tmp_path):
    async def scenario(cable, notes):
        cable.plug()
        notes.line.start()
        assert notes.line.write(b"frame")
        # No turn of the reactor was between: the bytes exist already.
        assert cable.read() == b"frame"

    with_line(tmp_path, scenario)


def test_the_port_may_be_plugged_in_later(tmp_path):
    async def scenario(cable, notes):
        assert not notes.line.start()
        assert not notes.line.is_open
        assert not notes.line.write(b"x")
        assert not notes.line.write_newest("r", b"x")
        assert notes.line.counters.dropped == 2
        assert "is missing" in notes.line.last_error
        await sleep(0.5)
        cable.plug()
        await until(lambda: notes.line.is_open)
        # Several attempts failed for one reason, which is reported once.
        assert len(notes.events) == 2
        assert "is missing" in notes.events[0]
        assert notes.events[1] == "opened"
        assert notes.line.last_error == ""

    with_line(tmp_path, scenario)


def test_an_unplugged_line_comes_back_and_half_a_frame_does_not(tmp_path):
    async def scenario(cable, notes):
        frames = []
        decoder = CheckedDecoder(TO_ARDUINO)
        notes.line._on_bytes = lambda data: frames.extend(decoder.feed(data))
        notes.line._on_opened = decoder.reset
        encoder = CheckedEncoder()
        cable.plug()
        notes.line.start()
        whole, half, after = (encoder.encode(H, payload) for payload in (b"ab", b"cd", b"ef"))
        os.write(cable.master, whole + half[:4])
        await until(lambda: frames)
        await until(lambda: decoder._tail)
        cable.unplug()
        await until(lambda: not notes.line.is_open)
        assert "lost" in notes.events
        cable.plug()
        await until(lambda: notes.line.is_open)
        os.write(cable.master, half[4:] + after)
        await until(lambda: len(frames) == 2)
        assert [payload for _, payload, _ in frames] == [b"ab", b"ef"]
        assert (notes.line.counters.opened, notes.line.counters.lost) == (2, 1)

    with_line(tmp_path, scenario)


def test_a_write_to_a_port_that_has_just_gone_is_told_once_as_lost(tmp_path):
    async def scenario(cable, notes):
        cable.plug()
        notes.line.start()
        cable.unplug()
        for _ in range(100):
            notes.line.write(b"frame")
        assert notes.line.is_open
        await until(lambda: not notes.line.is_open)
        assert notes.events[:2] == ["opened", "lost"]
        assert notes.line.counters.lost == 1
        assert not notes.line.write(b"frame")

    with_line(tmp_path, scenario)


def test_a_line_may_be_stopped_from_its_own_callback(tmp_path):
    async def scenario(cable, notes):
        cable.plug()
        notes.line._on_bytes = lambda data: (notes.received(data), notes.line.stop())
        notes.line.start()
        os.write(cable.master, b"bye")
        await until(lambda: not notes.line.is_open)
        assert notes.data == b"bye"
        assert notes.line.start()

    with_line(tmp_path, scenario)


class Failing:
    """A reactor's clock and an opening that always fails."""

    def __init__(self):
        self.clock = Clock()
        self.attempts = []
        self.line = SerialLine(
            self.clock,
            self.open,
            on_bytes=lambda data: None,
            on_opened=lambda: None,
            on_lost=lambda why: None,
        )

    def open(self):
        self.attempts.append(self.clock.seconds())
        raise SerialPortError("gone")


def test_attempts_become_rarer_but_never_rarer_than_2_s_and_never_end():
    failing = Failing()
    failing.line.start()
    failing.clock.pump([0.05] * 20 * 60)
    gaps = [b - a for a, b in zip(failing.attempts, failing.attempts[1:], strict=False)]
    # The clock of this test moves in steps of 0.05 s.
    assert gaps[:5] == pytest.approx([0.2, 0.4, 0.8, 1.6, 1.6], abs=0.06)
    assert max(gaps) < 2.0
    assert failing.attempts[-1] > 58
    failing.line.stop()
    assert not failing.clock.getDelayedCalls()
    count = len(failing.attempts)
    failing.clock.advance(10)
    assert len(failing.attempts) == count


def fill(notes):
    """Write Commands until the port takes no more; return how many were taken."""
    taken = 0
    while notes.line.write(b"command%08d;" % taken):
        taken += 1
    return taken


def test_a_stuck_line_keeps_commands_in_order_and_of_streams_the_newest(tmp_path):
    async def scenario(cable, notes):
        cable.plug()
        notes.line.start()
        taken = fill(notes)
        assert notes.line.counters.dropped == 1
        assert notes.line._frames_size <= 1024
        for number in range(1000):
            assert notes.line.write_newest("S", b"setpoint%04d;" % number)
            assert notes.line.write_newest("v", b"veto%04d;" % number)
        assert notes.line.counters.replaced == 1998
        received = bytearray()
        await until(lambda: received.extend(cable.read()) or received.endswith(b"veto0999;"))
        frames = bytes(received).split(b";")
        assert frames[:taken] == [b"command%08d" % number for number in range(taken)]
        assert frames[taken:] == [b"setpoint0999", b"veto0999", b""]
        assert notes.line.write(b"again")
        assert cable.read() == b"again"

    with_line(tmp_path, scenario)


def test_what_waited_for_a_line_that_went_is_not_sent_to_the_next(tmp_path):
    async def scenario(cable, notes):
        cable.plug()
        notes.line.start()
        fill(notes)
        notes.line.write_newest("S", b"stale")
        cable.unplug()
        await until(lambda: not notes.line.is_open)
        cable.plug()
        await until(lambda: notes.line.is_open)
        notes.line.write(b"fresh")
        received = bytearray()
        await until(lambda: received.extend(cable.read()) or received)
        assert bytes(received) == b"fresh"

    with_line(tmp_path, scenario)


def test_a_stuck_line_closes_at_once_and_forgets_what_waits(tmp_path):
    async def scenario(cable, notes):
        cable.plug()
        notes.line.start()
        taken = fill(notes)
        notes.line.stop()
        assert not notes.line.is_open
        assert notes.events == ["opened"]
        received = bytearray()
        while piece := cable.read():
            received += piece
        # Data already in the other end's own buffer cannot be recalled.
        assert len(received) < taken * 16 / 2

    with_line(tmp_path, scenario)


def test_a_line_may_be_opened_anew(tmp_path):
    async def scenario(cable, notes):
        cable.plug()
        notes.line.start()
        notes.line.reopen()
        assert not notes.line.is_open
        await until(lambda: notes.line.is_open)
        assert notes.events == ["opened", "lost", "opened"]

    with_line(tmp_path, scenario)


def test_a_port_that_pyserial_opened_serves_too(tmp_path):
    import serial

    async def scenario(cable, notes):
        cable.plug()
        notes.line._open_port = lambda: serial.Serial(str(cable.path), 115200, timeout=0)
        notes.line.start()
        os.write(cable.master, b"hello")
        await until(lambda: notes.data == b"hello")
        await sleep(0.05)
        assert notes.line.is_open
        cable.unplug()
        await until(lambda: not notes.line.is_open)

    with_line(tmp_path, scenario)
