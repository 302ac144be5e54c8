"""The compiled firmware on a simulated chip, its serial line a pty, its time at most real time."""

import os
import threading
import time
import tty
from contextlib import contextmanager, suppress

from tests.support.tools import unavailable
from tests.support.waiting import DEADLINE_S, until
from up.protocols.checked_framing import cobs_decode
from up_rig import CYCLES_PER_US, Rig, RigUnavailableError

STEP_US = 2000.0


class BenchBoard:
    """A board behind ``link`` that a program can open; a thread lets its time pass.

    Its time never runs ahead of real time, and falls behind on a slow machine: limits in
    milliseconds are checked by its own cycles. ``rig()`` gives the bench while time stands still.
    """

    def __init__(self, elf, link, sticks=None):
        self.elf = elf
        self.link = link
        self.sticks = {"aux1": 2000, **(sticks or {})}
        self.eeprom = b""
        self.motion = None
        self.frames = []
        self.taken = []
        self.gate = None
        self._rig = None

    def fly(self):
        """Switch the board on."""
        try:
            self._rig = Rig(self.elf, eeprom=self.eeprom, is_measuring=False)
        except RigUnavailableError as error:
            unavailable(str(error))
        if self.motion is not None:
            self._rig.imu.motion = self.motion
        self._rig.receiver.sticks(**self.sticks)
        self._rig.receiver.start()
        self._own, self._other = os.openpty()
        tty.setraw(self._other)
        os.set_blocking(self._own, False)
        self.link.symlink_to(os.ttyname(self._other))
        self._partial = b""
        self._lock = threading.Lock()
        self._is_ended = threading.Event()
        self._failure = None
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def end(self):
        """Switch it off; its EEPROM stays."""
        if self._rig is None:
            return
        self._is_ended.set()
        self._thread.join(DEADLINE_S)
        self.eeprom = self._rig.eeprom.read()
        self.link.unlink()
        os.close(self._other)
        os.close(self._own)
        self._rig = None
        assert self._failure is None, self._failure

    @contextmanager
    def rig(self):
        """Hold the time and look at the bench."""
        with self._lock:
            yield self._rig

    def move(self, **sticks):
        """Let the pilot move sticks and switches."""
        self.sticks.update(sticks)
        with self.rig() as rig:
            rig.receiver.sticks(**sticks)

    def pulse_us(self, channel):
        """Return the newest pulse at a servo's pin."""
        with self.rig() as rig:
            return rig.servo.newest_us(channel)

    def gives(self, channel, wanted_us, tolerance_us):
        """Wait until a servo's pin gives a pulse near the wanted one."""

        def is_near():
            width_us = self.pulse_us(channel)
            return width_us is not None and abs(width_us - wanted_us) <= tolerance_us

        try:
            self.wait(is_near, channel)
        except AssertionError:
            given = self.pulse_us(channel)
            raise AssertionError(f"{channel} is {given} us, never near {wanted_us}") from None

    def pulses(self, channel):
        with self.rig() as rig:
            return rig.servo.pulses(channel)

    def wait(self, condition, what):
        """Wait for a condition; the death of the board is reported immediately."""

        def value():
            assert self._failure is None, self._failure
            return condition()

        return until(value, what)

    def pass_us(self, duration_us):
        """Wait until that much of the board's time has passed."""
        with self.rig() as rig:
            until_us = rig.now_us + duration_us

        def is_over():
            with self.rig() as rig:
                return rig.now_us >= until_us

        self.wait(is_over, f"{duration_us:g} us of the board's time")

    def _run(self):
        try:
            begun_s = time.monotonic() - self._rig.now_us / 1e6
            while not self._is_ended.is_set():
                with self._lock:
                    ahead_us = (time.monotonic() - begun_s) * 1e6 - self._rig.now_us
                    if ahead_us >= STEP_US:
                        self._step()
                    if ahead_us > 500_000:
                        # A machine that was busy elsewhere is not caught up with in a rush.
                        begun_s += (ahead_us - STEP_US) / 1e6
                if ahead_us < STEP_US:
                    time.sleep((STEP_US - ahead_us) / 1e6)
        except Exception as failure:
            self._failure = failure
            raise

    def _step(self):
        with suppress(BlockingIOError):
            data = os.read(self._own, 4096)
            if self.gate is not None:
                data = self.gate(data)
            if data:
                self._rig.serial.write(data)
                self.taken.append((self._rig.cycle, data))
        self._rig.run_us(STEP_US)
        stamped = self._rig.serial.read_stamped()
        sent = bytes(each.value for each in stamped)
        for each in stamped:
            if each.value:
                self._partial += bytes((each.value,))
                continue
            frame = cobs_decode(self._partial) if self._partial else None
            self._partial = b""
            if frame is not None and len(frame) >= 4:
                self.frames.append((each.cycle, chr(frame[1]), frame[2:-2]))
        with suppress(BlockingIOError):
            os.write(self._own, sent)


def ms(cycles):
    """Return cycles as milliseconds of the board's time."""
    return cycles / CYCLES_PER_US / 1000
