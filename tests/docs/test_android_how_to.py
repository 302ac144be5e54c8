"""docs/how-to/android.md: its Java compiles and flies, without a phone and in the app."""

from __future__ import annotations

import json
import re
import shlex
import shutil
import socket
import subprocess
import sys
import threading
from contextlib import contextmanager

import pytest

from tests.android.real_daemon import RealDaemon
from tests.docs.flying import lines_of
from tests.ground.aircraft import Aircraft, frame
from tests.proxy.program import Program as Proxy
from tests.support.android import ANDROID, BUILD, JARS, lay_out, make, need_android, need_jdk
from tests.support.application import plan_of, write_application
from tests.support.virtual_environment import REPOSITORY
from tests.support.waiting import DEADLINE_S, until
from up.commands.roles import Role

PAGE = "how-to/android.md"
TEXT = (REPOSITORY / "docs" / PAGE).read_text(encoding="utf-8")
CORE = BUILD / "up-core.jar"
FILES = dict(
    re.findall(r"<!-- file: (\S+)(?: \(android\))? -->\n```\w+\n(.*?)```", TEXT, re.DOTALL)
)
ONLY_ANDROID = re.findall(r"<!-- file: (\S+) \(android\) -->", TEXT)
ONLY_JVM = ("org/raspilot/plane/Aboard.java", "org/raspilot/plane/Ashore.java")


def write(folder, names):
    for name in names:
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(FILES[name], encoding="utf-8")


def lines_that_start(program):
    """The lines of the page's terminal that start with a program, as words."""
    lines = map(shlex.split, lines_of(PAGE, "plane"))
    return [words for words in lines if words[0] == program]


@pytest.fixture(scope="module")
def compiled(tmp_path_factory):
    """The folder of the page's classes, compiled by the page's command and with every warning."""
    need_jdk()
    make("core")
    folder = tmp_path_factory.mktemp("page")
    write(folder, [name for name in FILES if name.endswith(".java") and name not in ONLY_ANDROID])
    (words,) = lines_that_start("javac")
    there = {"android/build/up-core.jar": str(CORE)}
    line = shlex.join([there.get(word, word) for word in words]).replace(
        "'org/raspilot/plane/*.java'", "org/raspilot/plane/*.java"
    )
    done = subprocess.run(
        ["bash", "-c", line.replace("javac ", "javac -Xlint:all -Xlint:-options -Werror ", 1)],
        cwd=folder, capture_output=True, text=True,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return folder


class Said:
    """The output of a program, line by line."""

    def __init__(self, process):
        self.lines = []
        self.process = process
        threading.Thread(target=self._hear, daemon=True).start()

    def _hear(self):
        for line in self.process.stdout:
            self.lines.append(line.strip())

    def wait_for(self, line):
        until(lambda: line in self.lines or self.process.poll() is not None, line)
        assert line in self.lines, self.lines


@contextmanager
def running(folder, program, *arguments):
    """One of the page's programs, started by the page's line with these arguments instead."""
    (words,) = [each for each in lines_that_start("java") if program in each]
    words = words[: words.index(program) + 1]
    words = [word.replace("android/build/up-core.jar", str(CORE)) for word in words]
    with subprocess.Popen(
        [*words, *map(str, arguments)],
        cwd=folder,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    ) as process:
        try:
            yield Said(process)
        finally:
            process.kill()


@pytest.fixture
def raspberry():
    """A port where a Raspberry Pi would listen; ``accept`` it for the phone's connection."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        server.settimeout(DEADLINE_S)
        yield server


def ask(stream, number, pictures):
    """Send the page's Command and return its outcome."""
    data = {"name": "plane.camera.release", "data": {"pictures": pictures}, "id": str(number)}
    stream.write(json.dumps(data) + "\n")
    stream.flush()
    for line in stream:
        answer = json.loads(line)
        if answer["name"] in ("up.ack", "up.nack") and answer["data"]["id"] == str(number):
            return answer["data"].get("code"), answer["data"].get("reason")
    raise AssertionError("the phone hung up")


def test_the_handler_carries_out_and_refuses(compiled, raspberry):
    with running(compiled, "org.raspilot.plane.Aboard", "127.0.0.1", raspberry.getsockname()[1]):
        connection, _ = raspberry.accept()
        with connection, connection.makefile("rw", encoding="utf-8") as stream:
            connection.settimeout(DEADLINE_S)
            assert ask(stream, 1, 3) == (None, None)
            code, reason = ask(stream, 2, 3)
            assert code == "refused" and "2 pictures" in reason
            code, reason = ask(stream, 3, 11)
            assert code == "invalid" and "pictures" in reason


def test_the_provider_is_in_the_flight_log_of_a_real_daemon(compiled, tmp_path):
    daemon = RealDaemon(tmp_path / "daemon")
    daemon.start()
    try:
        with running(
            compiled, "org.raspilot.plane.Aboard", "127.0.0.1", daemon.ports.general
        ) as aboard:
            aboard.wait_for(f"connected to 127.0.0.1:{daemon.ports.general}")
            until(lambda: len(daemon.log_of("phone.light")) >= 2, "two readings in the log")
        assert {each["lux"] for _, each in daemon.log_of("phone.light")} == {740.0}
        assert "provider_problem: location: no GPS" in aboard.lines
    finally:
        daemon.end()


def test_the_ground_handler_reads_telemetry_through_a_proxy(compiled, tmp_path):
    with (
        Proxy(tmp_path / "proxy", "metrics: false\n") as proxy,
        Aircraft(proxy.airborne_port, data=frame()) as aircraft,
        running(
            compiled, "org.raspilot.plane.Ashore", "127.0.0.1", proxy.ground_port, "default"
        ) as ashore,
    ):
        ashore.wait_for("steepest 12.5")
        aircraft.data = frame(orientation={"roll": -61.25, "pitch": 0.0, "yaw": 0.0})
        ashore.wait_for("steepest 61.25")
        aircraft.data = frame()
        assert "steepest 12.5" not in ashore.lines[ashore.lines.index("steepest 61.25") :]


def test_the_daemon_passes_the_command_on(tmp_path):
    files = {name: text for name, text in FILES.items() if name.endswith(".py")}
    try:
        plan = plan_of(write_application(tmp_path / "plane", files, "plane"))
    finally:
        for name in [name for name in sys.modules if name.split(".")[0] == "plane"]:
            del sys.modules[name]
    assert not plan.problems
    (command,) = plan.commands
    assert (command.NAME, command.ROUTE) == ("plane.camera.release", "android")
    assert command.NAME in FILES["org/raspilot/plane/ReleaseCommand.java"]
    assert command.from_data({"pictures": 10}).roles() == frozenset({Role.OPERATOR})
    with pytest.raises(ValueError, match="pictures"):
        command.from_data({"pictures": 11})


def added(source, lines):
    """Add a page's lines to a class: imports above the first one, the rest before its end."""
    imports = [line for line in lines.splitlines() if line.startswith("import ")]
    rest = [line for line in lines.splitlines() if line and not line.startswith("import ")]
    new = [line for line in imports if line not in source.splitlines()]
    source = source.replace("\nimport ", "\n" + "\n".join(new) + "\nimport ", 1)
    return source.rstrip().removesuffix("}") + "\n" + "\n".join(rest) + "\n}\n"


def test_all_of_it_compiles_in_the_app_and_keeps_to_android_4_1(tmp_path):
    need_android()
    app = tmp_path / "app"
    for name in ("core", "library", "raspilot"):
        shutil.copytree(ANDROID / name, app / name)
    write(app / "raspilot/src", [n for n in FILES if n.endswith(".java") and n not in ONLY_JVM])
    blocks = re.findall(r"<!-- lines of: (\S+) -->\n```java\n(.*?)```", TEXT, re.DOTALL)
    assert len(blocks) == 2
    for name, lines in blocks:
        file = app / "raspilot/src/org/raspilot/app" / name
        file.write_text(added(file.read_text(), lines))
    folder = lay_out(tmp_path / "laid", app)
    make("build/.guarded", f"JARS={JARS}", folder=folder)
