"""Lines to the phone's JVM arrive whole, or not at all."""

import sys
import time

import pytest

from up_simulator.phone.java_process import JavaPhoneProcess

LIMIT_S = 60.0
# It reads only when the file exists, and prints the number of each line, or an error without one.
READER = """
import json, os, sys, time
while not os.path.exists(sys.argv[1]):
    time.sleep(0.01)
for line in sys.stdin:
    try:
        print(json.dumps({"event": "heard", "n": json.loads(line)["n"]}), flush=True)
    except ValueError:
        print("no line: " + line[:40], flush=True)
"""


class SlowReader:
    """A program that is not a JVM, and does not read for a while."""

    def __init__(self, gate):
        self.gate = gate

    def command(self, *_options):
        return [sys.executable, "-c", READER, str(self.gate)]


@pytest.fixture
def reader(tmp_path):
    made = JavaPhoneProcess(SlowReader(tmp_path / "gate"))
    yield made, tmp_path / "gate"
    made.end()


def test_a_line_that_was_begun_is_finished_before_the_next(reader):
    process, gate = reader
    said = 0
    while process.dropped < 3:
        # Not a divisor of the pipe's capacity: half of the last one fits.
        process.send({"n": said, "content": "x" * 5000})
        said += 1
    gate.touch()
    heard = []
    deadline_s = time.monotonic() + LIMIT_S
    while not heard or heard[-1].get("n", 0) < said:
        assert time.monotonic() < deadline_s, heard[-3:]
        process.send({"n": said})
        heard.extend(process.receive())
    assert all(each["event"] == "heard" for each in heard), heard
    numbers = [each["n"] for each in heard if each["n"] < said]
    # The started line arrived; the three after it were dropped, and counted.
    assert numbers == list(range(said - 3))
