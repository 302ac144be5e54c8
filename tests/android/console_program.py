"""The Up Library's ground side as a program."""

from tests.android.java_process import JavaProcess
from tests.android.numbered_motion import number_of
from tests.support.java import CONSOLE

ATTITUDE = (
    "orientation.roll", "orientation.pitch", "orientation.yaw",
    "rates.roll", "rates.pitch", "rates.yaw",
)  # fmt: skip


class ConsoleProgram(JavaProcess):
    """A ground station that keeps every frame that its telemetry handler receives."""

    def __init__(self, *options, values=(), prefix=()):
        paths = ",".join((*ATTITUDE, *values))
        super().__init__(CONSOLE, *options, "--values", paths, prefix=prefix)
        self._asked = 0

    @property
    def frames(self):
        """Return all frames of telemetry that came."""
        return self.all("telemetry")

    @property
    def status(self):
        """Return the newest status, empty before the first."""
        told = self.all("status")
        return told[-1] if told else {}

    def at(self, path):
        """Return the newest frame's value."""
        frames = self.frames
        return frames[-1]["values"][path] if frames else None

    def sees(self, what, **wanted):
        """Wait until telemetry has values (paths with two underscores for a dot)."""
        paths = {name.replace("__", "."): value for name, value in wanted.items()}
        self.until(lambda: all(self.at(each) == value for each, value in paths.items()), what)

    def number(self):
        """Return the number of the newest frame's attitude, None without one."""
        frames = self.frames
        return None if not frames else number_in(frames[-1])

    def seated(self, seat="command"):
        """Wait until the proxy gave it that seat."""
        self.until(lambda: self.status.get("seat") == seat, f"seat {seat}")

    def holds(self):
        """Wait until it may send: the seat, and telemetry that was seen since the link is open."""

        def may_send():
            shut = [at for at, said in list(self.events)
                    if said["event"] == "status" and said["link"] != "OPEN"]  # fmt: skip
            return self.status.get("standing") == "OURS" and self.all("telemetry", shut[-1])

        self.until(may_send, "the seat")

    def ask(self, name, **data):
        """Send a Command and return its outcome; again where a busy machine made telemetry late."""

        def answered():
            answer = self._ask(send=name, data=data)
            return None if answer.get("code") == "stale" else answer

        return self.until(answered, f"{name} with telemetry that is new")

    def gains(self, wanted):
        """Request gains, set them or undo a change; return the outcome."""
        return self._ask(gains=wanted)

    def ask_later(self, name, **data):
        """Send a Command; return the tag by which ``answer`` finds its outcome."""
        self._asked += 1
        self.say(send=name, data=data, tag=str(self._asked))
        return str(self._asked)

    def answer(self, tag):
        """Return the outcome of a Command, or None before it is known."""
        return next((each for each in self.all("answer") if each["tag"] == tag), None)

    def _ask(self, **line):
        self._asked += 1
        tag = str(self._asked)
        self.say(**line, tag=tag)
        return self.until(lambda: self.answer(tag), f"the answer to {line}")


def number_in(frame):
    """Return the number of a frame's attitude, None without one; fails for a foreign attitude."""
    values = [frame["values"][path] for path in ATTITUDE]
    return None if None in values else number_of(values)
