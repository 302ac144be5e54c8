"""The module in a system: on the reactor, with its real thread and files."""

import subprocess
import sys
import threading
from dataclasses import dataclass
from pathlib import Path

import pytest
from black_box_cog import recorder_maker
from black_box_cog.commands.black_box_commands import MarkCommand, RecordCommand
from black_box_cog.modules import black_box
from black_box_cog.modules.black_box import BlackBox
from black_box_cog.record_policy import MAX_MARKS
from twisted.internet.task import Clock
from twisted.logger import Logger

from tests.cogs.black_box_cog.flights import (
    BOARD,
    GROUND,
    PHONE,
    TestedDisk,
    codes_in,
    codes_of,
    lines_in,
    messages,
    numbers_in,
)
from tests.support.reactor import reactor, run_in_reactor, until
from tests.support.system import build_up, started
from tests.up.commands.samples import Log
from up.base_started_module import BaseStartedModule
from up.commands.orientation_command import OrientationCommand
from up.commands.origin import INTERNAL
from up.commands.roles import Role
from up.commands.telemetry_commands import TelemetryCommand
from up.flight_log.flight_file import flight_files
from up.protocols.general_message import GeneralMessage, decode
from up.telemetry_controller import TelemetryController
from up_flightlog.read.flight_log import FlightLog


class Talkative(BaseStartedModule):
    """Logs a line at its start and at its stop."""

    def on_start(self):
        self.log.info("opened a port")
        return True

    def on_stop(self):
        self.log.info("closed a port")


class System:
    """A system with a black box, run by a test's coroutine on the real reactor."""

    def __init__(self, folder, modules=(BlackBox,), **config):
        self.flights = folder / "flights"
        lines = [f"{key}: {value}" for key, value in {"keep free (MB)": 0, **config}.items()]
        text = "\n".join([f'folder: "{self.flights}"', *lines]) + "\n"
        self.up = build_up(modules, reactor, folder / "config", config={"black_box.yml": text})
        for cls in (MarkCommand, RecordCommand):
            self.up.command_executor.registry.add(cls)
        self.box = self.up.get_module(BlackBox)
        self.answers = []

    def publish(self, number, origin=BOARD):
        self.up.command_executor.execute_command(
            OrientationCommand(float(number), 0.0, 0.0), origin
        )

    def say(self, role, name, data):
        """Send a message over a link of that role; return the code of the answer, or ack."""
        sent = []
        link = self.up.open_link("peer", role, sent.append, role_key="test.yml: role")
        self.up.command_receiver.receive(GeneralMessage(name, data, "a"), link)
        answer = decode(sent[0])
        return answer.data.get("code", "ack"), answer.data.get("reason", "")

    async def recording(self):
        await until(lambda: self.box.status.recording, what="a file")

    @property
    def files(self):
        return [each.path for each in flight_files(self.flights)]


@dataclass
class Flown:
    """A recorded flight of a whole system, the answers to its messages and its log."""

    path: Path
    answers: list
    codes: list
    telemetry: dict

    @property
    def messages(self):
        return [(topic, data) for topic, _, data in messages(self.path)]


@pytest.fixture(scope="module")
def flown(tmp_path_factory):
    async def fly():
        system = System(tmp_path_factory.mktemp("flown"), (Talkative, BlackBox))
        frames = []
        system.up.command_executor.add_observer(
            lambda command, _: isinstance(command, TelemetryCommand) and frames.append(command)
        )
        with Log() as log:
            life = await started(system.up)
            battery = Logger(namespace="Battery")
            battery.debug("too fine")
            Logger(namespace="twisted.internet").info("starting factory")
            battery.warn("{what} is low", what="the battery", code="low")
            for number in range(100):
                system.publish(number)
            content = {"speed": 12.5, "name": "äöü"}
            answers = [
                system.say(role, name, data)[0]
                for role, name, data in (
                    (Role.OPERATOR, "black_box.mark", {"text": "thermal"}),
                    (Role.OBSERVER, "black_box.mark", {"text": "no"}),
                    (Role.OPERATOR, "black_box.mark", {"text": "x" * 201}),
                    (Role.SENSOR, "black_box.record", {"topic": "pitot.air", "content": content}),
                    (Role.SENSOR, "black_box.record", {"topic": "up.rx.update", "content": {}}),
                    (Role.OPERATOR, "black_box.record", {"topic": "a.b", "content": {}}),
                )
            ]
            # A program that marks without end fills neither the log nor the terminal.
            flood = {"text": "flood"}
            codes = [system.say(Role.OPERATOR, "black_box.mark", flood)[0] for _ in range(200)]
            assert codes[: MAX_MARKS - 1] == ["ack"] * (MAX_MARKS - 1)
            await system.recording()
            system.publish(100)
            await until(
                lambda: frames and frames[-1].content["black_box"]["recording"], what="frames"
            )
            telemetry = system.up.get_module(TelemetryController).collect()["black_box"]
            await life.stop()
        assert codes.count("ack") == codes_of(log).count("mark") - 1 < 100
        return Flown(system.files[0], answers, codes_of(log), telemetry)

    return run_in_reactor(fly)


def test_a_flight_from_the_start_to_the_stop(flown):
    assert numbers_in(flown.path) == list(range(101))
    log = FlightLog.read([flown.path])
    assert log.is_complete and not log.problems
    # It starts first and stops last.
    lines = {line["message"] for line in lines_in(flown.path)}
    assert {"opened a port", "closed a port"} <= lines
    assert log.metadata["flight"].keys() >= {"aircraft", "mode", "flight_controller", "instance"}
    assert log.metadata["versions"]["black_box_cog"] == "0.1.0"
    assert "config/black_box.yml" in log.attachments


def test_marks_and_records_by_role(flown):
    assert flown.answers == ["ack", "forbidden", "invalid", "ack", "refused", "forbidden"]
    assert ("black_box.mark", {"text": "thermal", "_origin": "peer (operator)"}) in flown.messages
    assert "mark" in codes_in(flown.path)
    record = {"speed": 12.5, "name": "äöü", "_origin": "peer (sensor)"}
    assert flown.messages.count(("pitot.air", record)) == 1
    assert "black_box.record" not in {topic for topic, _ in flown.messages}


def test_telemetry_has_the_file_and_is_recorded_without_a_ground(flown):
    assert flown.telemetry.pop("megabytes") >= 0
    expected = {"recording": True, "file": flown.path.name, "dropped": 0, "problem": None}
    assert flown.telemetry == expected
    frames = [data for topic, data in flown.messages if topic == "up.telemetry.update"]
    assert frames[-1]["black_box"]["file"] == flown.path.name and "_beacon" in frames[-1]


def test_log_lines_with_code_and_fields_once(flown):
    lines = {line["message"]: line for line in lines_in(flown.path)}
    assert not {"too fine", "starting factory"} & lines.keys()
    line = lines["the battery is low"]
    assert (line["level"], line["name"]) == (3, "Battery")
    assert (line["code"], line["fields"]) == ("low", {"what": "the battery"})
    # The recorder's own lines make no loop.
    assert flown.codes.count("recording_started") == 1
    assert codes_in(flown.path).count("recording_started") == 1


def test_marks_and_records_are_refused_without_a_file(tmp_path):
    (tmp_path / "flights").write_text("a file")

    async def fly():
        system = System(tmp_path)
        life = await started(system.up)
        system.publish(1)
        await until(lambda: system.box.status.problem, what="the problem")
        answers = [
            system.say(Role.OPERATOR, "black_box.mark", {"text": "thermal"}),
            system.say(Role.SENSOR, "black_box.record", {"topic": "a.b", "content": {}}),
        ]
        content = system.up.get_module(TelemetryController).collect()["black_box"]
        await life.stop()
        return answers, content

    answers, content = run_in_reactor(fly)
    assert [code for code, _ in answers] == ["refused", "refused"]
    assert content == {
        "recording": False,
        "file": None,
        "megabytes": 0.0,
        "dropped": 0,
        "problem": f"{tmp_path}/flights: File exists",
    }


@pytest.mark.parametrize(
    ("origin", "wanted"), [(BOARD, True), (PHONE, True), (GROUND, False), (INTERNAL, False)]
)
def test_telemetry_is_requested_while_board_or_phone_send(tmp_path, origin, wanted):
    async def fly():
        system = System(tmp_path, always="true")
        controller = system.up.get_module(TelemetryController)
        life = await started(system.up)
        before = controller.is_wanted
        await system.recording()
        system.publish(1, origin)
        await until(lambda: len(system.box.queue) == 0, what="the thread's look")
        during = controller.is_wanted
        system.box.recorder.last_source_s -= black_box.SOURCE_S
        after = controller.is_wanted
        await life.stop()
        return before, during, after

    assert run_in_reactor(fly) == (False, wanted, False)


def test_telemetry_is_not_requested_if_disabled(tmp_path):
    async def fly():
        system = System(tmp_path, telemetry="false")
        life = await started(system.up)
        system.publish(1)
        await system.recording()
        wanted = system.up.get_module(TelemetryController).is_wanted
        await life.stop()
        return wanted

    assert run_in_reactor(fly) is False


def test_a_disabled_recorder_is_not_loaded(tmp_path):
    up = build_up(
        [BlackBox], Clock(), tmp_path, config={"black_box.yml": "enabled: false\n"}, builtins=False
    )
    assert up.get_module(BlackBox) is None


def test_without_a_start_nothing_is_recorded(tmp_path):
    system = System(tmp_path)
    system.publish(1)
    Logger().info("said")
    assert len(system.box.queue) == 0 and not system.flights.exists()


def test_an_excluded_recorder_stops_observing(tmp_path):
    clock = Clock()
    up = build_up([BlackBox], clock, tmp_path, config={"black_box.yml": f'folder: "{tmp_path}"\n'})
    box = up.get_module(BlackBox)
    with up.cleanup_of(box).recording():
        box.on_start()
    up.exclude(box, "test")
    up.command_executor.execute_command(OrientationCommand(1.0, 2.0, 3.0), BOARD)
    Logger().info("said")
    assert all(type(subject).__name__ == "LogLine" for _, subject, _ in box.queue.pop(100))


def test_a_disk_that_hangs_keeps_neither_reactor_nor_stop(tmp_path, monkeypatch):
    hanging, release = threading.Event(), threading.Event()

    class HangingDisk(TestedDisk):
        def sync(self, descriptor):
            hanging.set()
            release.wait(30)

    monkeypatch.setattr(recorder_maker, "Disk", HangingDisk)

    async def fly():
        system = System(tmp_path)
        life = await started(system.up)
        system.publish(1)
        await until(hanging.is_set, what="the sync")
        heard = []
        system.up.command_executor.register_command(OrientationCommand, heard.append)
        for number in range(1000):
            system.publish(number)
        assert len(heard) == 1000
        began_s = reactor.seconds()
        with Log() as log:
            await life.stop()
        release.set()
        await until(lambda: not system.box._is_thread_alive, what="the thread's end")
        return reactor.seconds() - began_s, log.of("thread_left_behind")

    took_s, reported = run_in_reactor(fly)
    assert took_s < 10
    assert reported


def test_the_start_waits_for_nothing_that_only_the_thread_needs_and_that_comes_in_small_pieces():
    code = """
import importlib, sys
from up.commands import builtin
from black_box_cog.modules import black_box
ours = lambda: {name for name in sys.modules if name.startswith(("black_box_cog", "up."))}
at_start, pieces = ours(), []
for name in black_box.DEFERRED_IMPORTS:
    before = ours()
    importlib.import_module(name)
    pieces.append(len(ours() - before))
print("black_box_cog.recorder" in at_start, max(pieces), min(pieces))
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    is_recorder_there, largest, least = done.stdout.split()
    assert (is_recorder_there, least) == ("False", "1")
    assert int(largest) <= 3
