"""The ways that docs/architecture.md describes are those that a frame and a Command really take."""

from __future__ import annotations

import json
import re
import socket
import struct
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

import pytest
from mission_control_cog.modules.mission_control_provider import MissionControlProvider
from twisted.internet.address import IPv4Address
from twisted.internet.error import ConnectionDone
from twisted.internet.testing import StringTransport
from twisted.python.failure import Failure

from raspilot.flight_controller.attitude_controller import AttitudeController
from raspilot.flight_controller.flight_mode_manager import FlightModeManager
from raspilot.flight_modes.acro import Acro
from raspilot.flight_modes.fbw import FlyByWire
from tests.cogs.arduino_cog.board import BoardRig
from tests.cogs.black_box_cog.flights import BOARD, Flight
from tests.cogs.mission_control_cog.hostile_relay import fly
from tests.ground.aircraft import Aircraft as Kite
from tests.ground.web.page import Page, Serve
from tests.proxy.program import Program
from tests.support.reactor import reactor, run_in_reactor, until
from tests.support.tools import need_browser
from tests.support.virtual_environment import REPOSITORY
from tests.support.waiting import HANG_S
from up.commands.servo_command import ServoCommand
from up_ground.catalogue import Catalogue
from up_ground.settings import Settings
from up_ground.web.access import Access
from up_ground.web.listen_address import ListenAddress
from up_ground.web.serve import make_sessions
from up_ground.web.server import Server

PAGE = (REPOSITORY / "docs" / "architecture.md").read_text(encoding="utf-8")
HELLO = b"UP1 ok aircraft=default seat=air token=" + b"0" * 32 + b"\n"


def steps(name):
    """The file and function of each row of one of the page's tables."""
    table = re.search(rf"<!-- calls: {name} -->\n\|.*\n\|[-|]+\n((?:\|.*\n)+)", PAGE)[1]
    return re.findall(r"^\| `([^`]+)` \| `([^`]+)` \|", table, re.MULTILINE)


class Wire(StringTransport):
    """A connection to a proxy whose bytes the test gives; the socket only takes the options."""

    def __init__(self):
        super().__init__(peerAddress=IPv4Address("TCP", "127.0.0.1", 3003))
        self.socket = socket.socket()

    def getHandle(self):  # noqa: N802
        return self.socket

    def setTcpNoDelay(self, enabled):  # noqa: N802
        pass

    def setTcpKeepAlive(self, enabled):  # noqa: N802
        pass

    def loseConnection(self):  # noqa: N802
        self.protocol.connectionLost(Failure(ConnectionDone()))
        self.socket.close()


class Aircraft(BoardRig):
    """Raspilot's controller between a board on a pty and a proxy."""

    def __init__(self, folder):
        super().__init__(
            folder,
            config={
                "config.yml": "flight controller: raspberry\n",
                "mission_control.yml": "remote_server: {url: 127.0.0.1}\n",
            },
            modules=[
                FlightModeManager,
                AttitudeController,
                FlyByWire,
                Acro,
                MissionControlProvider,
            ],
        )
        self.wire = Wire()
        self.reactor.connectTCP = self.connect_tcp

    def connect_tcp(self, host, port, factory, timeout=None, bindAddress=None):  # noqa: N803
        self.protocol = self.wire.protocol = factory.buildProtocol(None)
        self.protocol.makeConnection(self.wire)
        self.protocol.dataReceived(HELLO)

    def inputs_and_orientation(self, sequence):
        inputs = self.port.frame("i", struct.pack(">6HB", 1600, 1500, 1300, 1500, 2000, 2000, 63))
        attitude = struct.pack(">H6f", sequence, 0.0, 5.0, 10.0, 0.0, 0.0, 0.0)
        self.port.write(inputs + self.port.frame("O", attitude))
        self.turn()


@pytest.fixture
def aircraft(tmp_path):
    rig = Aircraft(tmp_path)
    rig.mode = b"u"
    rig.connect(armed=True)
    rig.inputs_and_orientation(1)
    rig.forget()
    yield rig
    rig.stop()


@contextmanager
def traced():
    """Collect the functions that are called, in order, each with the file of its module."""
    calls = []

    def note(frame, event, argument):
        if event == "call":
            module = frame.f_globals.get("__name__", "").replace(".", "/")
            calls.append((f"{module}.py", frame.f_code.co_qualname))

    sys.setprofile(note)
    try:
        yield calls
    finally:
        sys.setprofile(None)


def assert_in_order(wanted, calls):
    rest = iter(calls)
    done = []
    for path, function in wanted:
        # These packages lie deeper in the tree than where they are installed.
        step = (re.sub(r"^(cogs/\w+|ground)/", "", path), function)
        assert step in rest, f"after {done[-3:]} comes no {step}"
        done.append(step)


def test_one_receiver_frame(aircraft):
    with traced() as calls:
        aircraft.inputs_and_orientation(2)
    assert len(aircraft.sent("u")) == 1
    assert len(steps("frame")) > 15
    assert_in_order(steps("frame"), calls)


def test_telemetry(aircraft):
    aircraft.wire.clear()
    with traced() as calls:
        aircraft.advance(0.12)
    # Queued data is sent when the transport requests it.
    aircraft.wire.producer.resumeProducing()
    assert b"up.telemetry.update" in aircraft.wire.value()
    assert_in_order(steps("telemetry"), calls)


def test_one_ground_command(aircraft):
    beacon = aircraft.up.beacons.draw()
    aircraft.wire.clear()
    line = b'{"name": "up.flight_mode.set", "data": {"mode": "FBW"}, "id": "a", "beacon": %d}\n'
    with traced() as calls:
        aircraft.protocol.dataReceived(line % beacon)
        aircraft.turn()
    assert aircraft.sent("M") == [b"f"]
    aircraft.wire.producer.resumeProducing()
    assert b'"name": "up.ack", "data": {"id": "a"}' in aircraft.wire.value()
    assert_in_order(steps("command"), calls)


def test_one_protected_command(tmp_path):
    async def body(scene):
        await scene.ground.ready()
        with traced() as calls:
            scene.ground.send()
            await until(lambda: scene.armed)
        return calls

    calls = fly(body, tmp_path)
    assert_in_order(steps("protected"), calls)


def test_a_wrong_order_would_be_found(aircraft):
    with traced() as calls:
        aircraft.inputs_and_orientation(2)
    wanted = steps("frame")
    with pytest.raises(AssertionError):
        assert_in_order([*wanted[1:4], wanted[0]], calls)


def test_every_file_of_the_tables_exists():
    for name in ("frame", "telemetry", "command", "page", "click", "recorder"):
        assert steps(name)
        for path, _ in steps(name):
            assert (REPOSITORY / Path(path)).is_file()


@pytest.fixture
def proxy(tmp_path):
    with Program(tmp_path / "proxy", "metrics: false\n") as program, Kite(program.airborne_port):
        yield program


def in_a_page(proxy, folder, act):
    """Serve the page in this process; return the calls while a page acts there."""

    async def run():
        catalogue = Catalogue.installed()
        settings = Settings("127.0.0.1", proxy.ground_port)
        environ = {"XDG_STATE_HOME": str(folder)}
        server = Server(
            reactor,
            ListenAddress("127.0.0.1", 0),
            Access(frozenset(), None, False),
            lambda pages: make_sessions(reactor, [settings], environ, pages, catalogue),
            catalogue=catalogue,
        )
        server.start()
        try:
            page = Page(server._port.getHost().port)
            await page.hello()
            await page.next("frame")
            await page.control()
            with traced() as calls:
                await act(page)
            await page.leave()
            return calls
        finally:
            await server.stop()

    return run_in_reactor(run)


def test_a_frame_on_its_way_to_the_page(proxy, tmp_path):
    async def look(page):
        count = len(page.of("frame"))
        await until(lambda: len(page.of("frame")) > count + 2)

    assert_in_order(steps("page"), in_a_page(proxy, tmp_path, look))


def test_a_command_of_the_page(proxy, tmp_path):
    async def select(page):
        answer = await page.command("up.flight_mode.set", {"mode": "FBW"})
        assert answer["outcome"] == "ack"

    calls = in_a_page(proxy, tmp_path, select)
    assert_in_order(steps("click"), calls)
    with pytest.raises(AssertionError):
        assert_in_order(steps("click")[::-1], calls)


def scripts(name):
    """The file and function of each row of one of the page's tables of JavaScript."""
    table = re.search(rf"<!-- scripts: {name} -->\n\|.*\n\|[-|]+\n((?:\|.*\n)+)", PAGE)[1]
    return re.findall(r"^\| `([^`]+)` \| `(?:\w+\.)?([^`]+)` \|", table, re.MULTILINE)


def test_an_attitude_passes_at_most_28_files_on_its_way_to_the_pixel():
    """From the serial line through the proxy, without the control step and the events."""

    def until_step(name, last):
        files = [path for path, _ in steps(name)]
        return files[: [function for _, function in steps(name)].index(last)]

    files = {
        *until_step("frame", "FlightModeManager._on_orientation"),
        *(path for path, _ in steps("telemetry")),
        *re.findall(r"`(proxy/[a-z_/]+\.py)`", PAGE.split("### To the pixel")[0]),
        *until_step("page", "AircraftSession._process"),
        *(path for path, _ in scripts("page")),
    }
    assert len(files) <= 28, sorted(files)


def test_what_runs_in_the_browser(proxy, tmp_path):
    node = need_browser()
    with Serve(tmp_path, proxy.ground_port) as server:
        address = f"http://127.0.0.1:{server.port}/"
        program = Path(__file__).with_name("architecture_page.mjs")
        done = subprocess.run(
            [node, program, address], capture_output=True, text=True, timeout=HANG_S
        )
    assert done.returncode == 0, done.stderr
    called = json.loads(done.stdout)
    later = [("js/link/connection.js", "take"), ("js/panels/messages.js", "answerText")]
    assert all(f"{function}`" in PAGE for _, function in later)
    for name, more in (("page", []), ("click", later)):
        assert len(scripts(name)) > 5
        missing = [each for each in scripts(name) + more if list(each) not in called[name]]
        assert not missing
    assert ["js/panels/flight_modes.js", "#select"] not in called["page"]


def test_what_is_recorded(tmp_path):
    flight = Flight(tmp_path)
    flight.say(1)
    flight.recorder.work()
    with traced() as calls:
        flight.queue.observe(ServoCommand(1500, 1500, 1000, 1500), BOARD)
        flight.pass_s(2)
        flight.recorder.work()
    flight.recorder.finish()
    Flight.stop_all()
    assert_in_order(steps("recorder"), calls)
