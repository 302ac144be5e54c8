"""The whole daemon in this process: its life, its errors, its leftovers."""

import gc
import os
import threading

import pytest
from twisted.internet.protocol import Factory
from twisted.logger import globalLogPublisher

from tests.support.tools import unavailable
from up_rig.imu import motion_at
from up_simulator.firmware.build import BoardUnavailableError, choose_board
from up_simulator.harness.participants import ParticipantError
from up_simulator.in_process.config_folder import GROUND_PORT, write_config
from up_simulator.in_process.ground import InProcessGround
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


def test_it_boots_connects_to_the_board_and_sends_telemetry(tmp_path):
    bench = Bench(tmp_path)
    bench.raspilot.start()
    bench.ground.start()
    bench.run(2.0)
    assert bench.raspilot.up.ports == {
        "general": 50001, "orientation": 50000, "discovery": 3001, "ground": GROUND_PORT
    }  # fmt: skip
    assert bench.ground.telemetry["arduino"]["connected"] is True
    assert bench.ground.telemetry["orientation"]["roll"] == pytest.approx(3.25, abs=0.01)
    assert bench.ground.frames >= 15
    assert bench.reactor.seconds() - bench.ground.newest_s <= 0.11
    (line,) = (line for line in bench.raspilot.log if f"port {GROUND_PORT}" in line)
    assert line.split()[:2] == ["0.002", "INFO"]
    assert "ERROR" not in bench.log()


def test_configuration_errors_have_file_and_line(tmp_path):
    files = {"config.yml": {"log levl": "info"}, "arduino.yml": {"baud_rate": 12}}
    bench = Bench(tmp_path, files)
    with pytest.raises(ParticipantError) as caught:
        bench.raspilot.start()
    first, second = str(caught.value).splitlines()
    assert "config.yml:1:1" in first and "log level" in first
    assert "arduino.yml:2:12" in second
    assert not bench.raspilot.is_running
    assert bench.raspilot.up is None


def test_a_failed_boot_is_logged_and_ends_the_daemon(tmp_path):
    bench = Bench(tmp_path)
    another = bench.reactor.host()
    for number in (50000, 50001):
        another.listenTCP(number, Factory())
    bench.raspilot.line.unplug()
    bench.raspilot.start()
    bench.run(3.0)
    assert not bench.raspilot.is_running
    assert "port 50001 " in bench.log()


def test_a_stop_ends_it_in_time_and_releases_all_ports(tmp_path):
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


def test_a_kill_may_cut_a_frame(tmp_path):
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


def test_consecutive_daemons_share_no_state(tmp_path):
    observers = list(globalLogPublisher._observers)
    threads = threading.active_count()
    logs, opened = [], []
    for number in range(3):
        bench = Bench(tmp_path / str(number))
        bench.raspilot.start()
        bench.ground.start()
        bench.run(1.5)
        assert bench.ground.frames >= 8
        bench.raspilot.kill()
        bench.raspilot.kill()
        logs.append(bench.raspilot.log)
        Bench.alive.clear()
        del bench
        gc.collect()
        # The first flight of a process may import Twisted's own reactor, which stays open.
        opened.append(descriptors())
    assert logs[0] == logs[1] == logs[2]
    assert opened[0] == opened[1] == opened[2]
    assert threading.active_count() == threads
    assert list(globalLogPublisher._observers) == observers


def test_a_second_start_of_a_running_daemon_is_rejected(tmp_path):
    bench = Bench(tmp_path)
    bench.raspilot.start()
    with pytest.raises(ParticipantError, match="already running"):
        bench.raspilot.start()
    bench.raspilot.kill()


def test_the_log_is_bounded(tmp_path):
    bench = Bench(tmp_path)
    bench.raspilot.start()
    module = bench.raspilot.module("LoadGuard")
    for number in range(5000):
        module.log.warn("line {number}", number=number)
    assert len(bench.raspilot.log) == 2000
    assert bench.raspilot.log[-1].endswith("WARNING  LoadGuard: line 4999")
    bench.raspilot.kill()
    module.log.warn("after the end")
    assert bench.raspilot.log[-1].endswith("line 4999")
