"""The whole daemon in this process: its life, its errors, its leftovers."""

import gc
import os
import threading
from random import Random

import pytest
from twisted.internet.protocol import Factory
from twisted.logger import globalLogPublisher

from tests.simulator.bench import StillFlight
from tests.support.tools import unavailable
from up_rig.imu import motion_at
from up_simulator.firmware.build import BoardUnavailableError, choose_board
from up_simulator.harness.participants import ParticipantError
from up_simulator.in_process.config_folder import GROUND_PORT, write_config
from up_simulator.in_process.ground import InProcessGround
from up_simulator.in_process.phone import InProcessPhone
from up_simulator.in_process.raspilot import InProcessRaspilot
from up_simulator.in_process.reactor import SimulatedReactor


class StillBoard:
    """The firmware, built for this computer, at rest; behind the two calls that ``pump`` makes."""

    def __init__(self):
        self.heard = b""
        try:
            self._board = choose_board("host")
        except BoardUnavailableError as error:
            unavailable(str(error))
        self._board.set_motion(motion_at(3.25, 0.0))
        self._board.run_us(1_500_000)
        self.read = self._board.read

    def tick(self):
        self._board.run_us(2000)

    def write(self, data):
        self.heard += data
        self._board.write(data)


class Bench:
    alive = []

    def __init__(self, folder, files=None, **options):
        self.alive.append(self)
        self.reactor = SimulatedReactor()
        write_config(folder, files)
        self.raspilot = InProcessRaspilot(self.reactor, folder, **options)
        self.board = StillBoard()
        self.ground = InProcessGround(self.reactor)

    def run(self, duration_s):
        for _ in range(round(duration_s / 0.002)):
            self.board.tick()
            self.raspilot.pump(self.board)
            self.reactor.advance(0.002)

    def log(self):
        return "\n".join(self.raspilot.log)


@pytest.fixture(autouse=True)
def end_every_daemon():
    yield
    while Bench.alive:
        Bench.alive.pop().raspilot.kill()


def descriptors():
    return len(os.listdir("/proc/self/fd"))  # noqa: PTH208 - counted, not walked


def test_it_boots_speaks_with_the_board_and_sends_telemetry(tmp_path):
    bench = Bench(tmp_path)
    bench.raspilot.start()
    bench.ground.start()
    bench.run(2.0)
    assert bench.raspilot.ports == {
        "general": 50001, "orientation": 50000, "discovery": 3001, "ground": GROUND_PORT
    }  # fmt: skip
    assert bench.ground.telemetry["arduino"]["connected"] is True
    assert bench.ground.telemetry["orientation"]["roll"] == pytest.approx(3.25, abs=0.01)
    assert bench.ground.frames >= 15
    assert bench.reactor.seconds() - bench.ground.newest_s <= 0.11
    assert "    0.002 INFO     Up: ground listens on port 50002" in bench.raspilot.log
    assert "ERROR" not in bench.log()


def test_a_wrong_configuration_is_told_in_the_daemons_own_sentences(tmp_path):
    files = {"config.yml": {"log levl": "info"}, "arduino.yml": {"baud_rate": 12}}
    bench = Bench(tmp_path, files)
    with pytest.raises(ParticipantError) as caught:
        bench.raspilot.start()
    first, second = str(caught.value).splitlines()
    assert "config.yml:1:1" in first and "log level" in first
    assert "arduino.yml:2:12" in second
    assert not bench.raspilot.is_running
    assert bench.raspilot.ports == {}


def test_a_boot_that_stops_is_told_and_ends_it(tmp_path):
    bench = Bench(tmp_path)
    another = bench.reactor.host()
    for number in (50000, 50001):
        another.listenTCP(number, Factory())
    bench.raspilot.line.unplug()
    bench.raspilot.start()
    bench.run(3.0)
    assert not bench.raspilot.is_running
    assert "port 50001 cannot be opened: Address already in use" in bench.log()
    assert "there is nothing to run" in bench.log()


def test_a_boot_takes_its_time(tmp_path):
    bench = Bench(tmp_path, boot_s=1.5)
    bench.raspilot.start()
    bench.run(1.4)
    assert bench.raspilot.is_running
    assert bench.raspilot.ports == {}
    bench.run(0.2)
    assert bench.raspilot.ports


def test_a_stop_ends_it_in_time_and_gives_everything_back(tmp_path):
    bench = Bench(tmp_path)
    bench.raspilot.start()
    bench.ground.start()
    bench.run(1.0)
    bench.raspilot.stop()
    assert bench.raspilot.is_running
    bench.run(2.0)
    assert not bench.raspilot.is_running
    assert not bench.ground.is_connected
    network = bench.reactor.network
    assert network.tcp == network.udp == {}
    heard = len(bench.board.heard)
    bench.run(1.0)
    assert len(bench.board.heard) == heard


def test_killed_it_says_nothing_more_and_may_start_again(tmp_path):
    bench = Bench(tmp_path)
    bench.raspilot.start()
    bench.ground.start()
    bench.run(2.0)
    frames = bench.ground.frames
    bench.raspilot.kill()
    assert not bench.raspilot.is_running
    heard = len(bench.board.heard)
    bench.run(2.0)
    assert bench.ground.frames == frames
    assert len(bench.board.heard) == heard
    assert not bench.ground.is_connected
    bench.raspilot.start()
    bench.run(4.0)
    assert bench.ground.is_connected
    assert bench.ground.frames > frames + 10
    assert bench.raspilot.boots == 2


def test_a_kill_may_cut_a_frame_in_two(tmp_path):
    bench = Bench(tmp_path)
    bench.raspilot.start()
    bench.run(1.0)
    frame = bytes(range(1, 90))
    bench.raspilot.module("SerialProvider")._line.write(frame)
    before = bench.board.heard
    bench.run(0.004)
    bench.raspilot.kill()
    bench.run(0.1)
    arrived = bench.board.heard[len(before) :]
    assert 0 < len(arrived) < len(frame)


def test_a_port_that_is_unplugged_is_found_again(tmp_path):
    bench = Bench(tmp_path)
    bench.raspilot.start()
    bench.run(1.0)
    bench.raspilot.line.unplug()
    bench.run(2.0)
    assert "lost /dev/ttySimulated" in bench.log()
    assert "/dev/ttySimulated is missing: is the Arduino plugged in?" in bench.log()
    bench.raspilot.line.plug()
    bench.ground.start()
    bench.run(4.0)
    assert bench.ground.telemetry["arduino"]["connected"] is True


def test_the_load_that_is_set_switches_panic_mode(tmp_path):
    bench = Bench(tmp_path)
    phone = InProcessPhone(bench.reactor, StillFlight())
    bench.raspilot.start()
    bench.ground.start()
    phone.plug()
    bench.run(2.0)
    assert bench.ground.telemetry["load"]["panic"] is False
    bench.raspilot.meter.load = 100.0
    bench.run(10.0)
    assert bench.ground.telemetry["load"]["panic"] is True
    assert any("busy: nothing quicker" in each for each in phone.said)


def test_two_daemons_one_after_the_other_know_nothing_of_each_other(tmp_path):
    observers = list(globalLogPublisher._observers)
    threads = threading.active_count()
    gc.collect()
    opened = descriptors()
    logs = []
    for number in range(3):
        bench = Bench(tmp_path / str(number))
        bench.raspilot.start()
        bench.ground.start()
        bench.run(1.5)
        assert bench.ground.frames >= 8
        bench.raspilot.kill()
        bench.raspilot.kill()
        logs.append(bench.raspilot.log)
    assert logs[0] == logs[1] == logs[2]
    assert threading.active_count() == threads
    assert list(globalLogPublisher._observers) == observers
    Bench.alive.clear()
    del bench
    gc.collect()
    assert descriptors() == opened


def test_two_daemons_at_once_need_two_networks(tmp_path):
    first, second = Bench(tmp_path / "1"), Bench(tmp_path / "2")
    for bench in (first, second):
        bench.raspilot.start()
        bench.ground.start()
    for _ in range(10):
        first.run(0.1)
        second.run(0.1)
    assert first.ground.frames == second.ground.frames >= 8
    first.raspilot.kill()
    frames = second.ground.frames
    second.run(1.0)
    assert second.ground.frames > frames
    second.raspilot.kill()


def test_a_second_start_of_a_running_daemon_is_refused(tmp_path):
    bench = Bench(tmp_path)
    bench.raspilot.start()
    with pytest.raises(ParticipantError, match="runs already"):
        bench.raspilot.start()
    bench.raspilot.kill()


def test_the_log_is_bounded(tmp_path):
    bench = Bench(tmp_path)
    bench.raspilot.start()
    module = bench.raspilot.module("LoadGuard")
    for number in range(5000):
        module._log_warning(f"line {number}")
    assert len(bench.raspilot.log) == 2000
    assert bench.raspilot.log[-1].endswith("WARNING  LoadGuard: line 4999")
    bench.raspilot.kill()
    module._log_warning("nobody listens any more")
    assert bench.raspilot.log[-1].endswith("line 4999")


def test_a_role_that_may_not_is_refused_with_a_reason(tmp_path):
    bench = Bench(tmp_path, {"mission_control.yml": {"role": "observer"}})
    bench.raspilot.start()
    bench.ground.start()
    bench.run(1.0)
    command_id = bench.ground.send("up.flight_mode.set", mode="FBW")
    assert bench.ground.answer(command_id) is None
    bench.run(0.5)
    assert "mission_control.yml: role" in bench.ground.answer(command_id)


def test_a_black_box_has_the_phone_alone(tmp_path):
    files = {
        "config.yml": {"mode": "black box"},
        "mission_control.yml": {"remote_server": {"url": "127.0.0.1"}},
    }
    bench = Bench(tmp_path, files)
    phone = InProcessPhone(bench.reactor, StillFlight())
    bench.raspilot.start()
    bench.ground.start()
    phone.plug()
    bench.run(2.0)
    telemetry = bench.ground.telemetry
    assert telemetry["mode"] == "black box"
    assert telemetry["source"]["orientation"] == "android"
    assert telemetry["orientation"]["roll"] == pytest.approx(3.25)
    assert bench.board.heard == b""
    with pytest.raises(LookupError, match="SerialProvider"):
        bench.raspilot.module("SerialProvider")
    # The proxy's port has no listener: it keeps retrying and does no harm.
    assert "127.0.0.1" in bench.log()
    assert "CRITICAL" not in bench.log()


def test_any_bytes_on_the_serial_line_are_dropped_and_counted(tmp_path):
    bench = Bench(tmp_path)
    bench.raspilot.start()
    bench.ground.start()
    bench.run(1.0)
    random = Random(3)
    for _ in range(500):
        bench.raspilot.line.write(random.randbytes(40))
        bench.run(0.002)
    assert "CRITICAL" not in bench.log()
    assert bench.ground.telemetry["counters"]["serial"]["format_errors"] > 20
    bench.run(2.0)
    assert bench.ground.telemetry["arduino"]["connected"] is True
