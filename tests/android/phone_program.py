"""The Up Library's airborne side as a program, and a thread that is its sensors."""

import threading
import time

from tests.android.java_process import JavaProcess
from tests.android.numbered_motion import MOST, sensors
from tests.support.java import MAIN

TICK_S = 0.002
FIX = {
    "latitude": 50.0755, "longitude": 14.4378, "altitude": 321.5, "accuracy": 3.5,
    "speed": 17.25, "bearing": 123.5, "satellites": 9,
}  # fmt: skip
PRESSURE_HPA = 954.608  # 500 m of the standard atmosphere (ISO 2533)
ALTITUDE_M = 500.0


class PhoneProgram(JavaProcess):
    """A phone that reads ``readings`` as often as it wants to; it turns by the numbered motion.

    ``number`` is that of the newest attitude that it received.
    """

    def __init__(self, *options, prefix=()):
        super().__init__(MAIN, *options, prefix=prefix)
        self.readings = {"fix": FIX, "pressure": PRESSURE_HPA, "battery": 87}
        self.number = 0
        self.is_turning = True
        self._periods_s = {}
        self._due_s = {}
        self._is_ended = threading.Event()
        self._feeder = threading.Thread(target=self._feed, daemon=True)
        self._feeder.start()

    @property
    def connections(self):
        """Return where it connected, each time."""
        return self.all("connected")

    @property
    def said(self):
        """Return the texts that it spoke."""
        return [event["text"] for event in self.all("says")]

    def connected(self):
        """Wait for its first connection and return where to."""
        return self.until(lambda: self.connections, "the phone's connection")[0]

    def end(self):
        self._stop()
        return super().end()

    def kill(self):
        self._stop()
        super().kill()

    def _stop(self):
        self._is_ended.set()
        self._feeder.join()

    def _take(self, said, now_s):
        super()._take(said, now_s)
        if said["event"] == "wants":
            self._due_s[said["sensor"]] = now_s
            self._periods_s[said["sensor"]] = said["period_ms"] / 1000

    def _feed(self):
        while not self._is_ended.wait(TICK_S):
            now_s = time.monotonic()
            for name, period_s in list(self._periods_s.items()):
                if period_s == 0 or now_s < self._due_s[name]:
                    continue
                # A busy machine's lost time is not caught up with in a rush.
                self._due_s[name] = max(self._due_s[name] + period_s, now_s)
                if name == "rotation":
                    if self.is_turning and self.number + 1 < MOST:
                        self.number += 1
                    self.say(**sensors(self.number))
                elif name in self.readings:
                    self.say(**{name: self.readings[name]})
