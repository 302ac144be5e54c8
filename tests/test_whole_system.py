"""The whole system as a user starts it: aircraft, phone, daemon, proxy, runner and ground."""

import csv
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import pytest

from tests.support.firmware import build_firmware

ROOT = Path(__file__).parents[1]
LIMIT_S = 60.0


def wait(condition, what, limit_s=LIMIT_S):
    deadline = time.monotonic() + limit_s
    while not (value := condition()):
        assert time.monotonic() < deadline, f"not within {limit_s} s: {what}"
        time.sleep(0.05)
    return value


class Showcase:
    """`make run` on any free ports, without the picture."""

    def __init__(self, folder, *options, path=None, **environment):
        self.folder = folder
        self.log = folder / "showcase.log"
        with self.log.open("wb") as output:
            self.process = subprocess.Popen(
                [sys.executable, "-m", "up_simulator.showcase", "--folder", str(folder),
                 "--any-ports", "--no-watch", "--state-log", str(folder / "truth.csv"), *options],
                stdout=output, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, cwd=folder,
                env={**os.environ, "PATH": path or os.environ["PATH"], **environment},
            )  # fmt: skip

    def ready(self):
        wait(lambda: "Ctrl-C stops" in self.said() or self.process.poll() is not None, "start")
        assert self.process.poll() is None, self.said()
        return self

    def said(self):
        return self.log.read_text(encoding="utf-8")

    @property
    def ground_port(self):
        lines = (self.folder / "config" / "proxy.yml").read_text(encoding="utf-8").splitlines()
        return next(line.split()[-1] for line in lines if line.startswith("ground port"))

    def ground(self, *arguments, timeout=LIMIT_S):
        state = {**os.environ, "XDG_STATE_HOME": str(self.folder / "state")}
        return subprocess.run(
            [sys.executable, "-m", "up_ground.main", "--port", self.ground_port, *arguments],
            capture_output=True, text=True, timeout=timeout, env=state, check=False,
        )  # fmt: skip

    def telemetry(self, count):
        result = self.ground("watch", "--json", "--count", str(count))
        assert result.returncode == 0, result.stderr
        messages = [json.loads(line) for line in result.stdout.splitlines()]
        return [message["data"] for message in messages]

    def gains(self):
        asked = self.ground("send", "arduino.pids.tunings", "request=true").stdout
        return json.loads(asked.split("arduino.pids.values ", 1)[1].splitlines()[0])

    def truth(self):
        with (self.folder / "truth.csv").open(encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def daemon_pid(self):
        return child_with(self.process.pid, "main.py")

    def stop(self, number=signal.SIGINT):
        if self.process.poll() is None:
            self.process.send_signal(number)
        return self.process.wait(20)


def child_with(pid, word):
    children = Path(f"/proc/{pid}/task/{pid}/children").read_text(encoding="ascii").split()
    for child in children:
        command = Path(f"/proc/{child}/cmdline").read_bytes().decode()
        if word in command:
            return int(child)
    raise AssertionError(f"no child {word}")


@pytest.fixture(scope="module")
def flight(tmp_path_factory):
    build_firmware()
    showcase = Showcase(tmp_path_factory.mktemp("showcase"))
    try:
        yield showcase.ready()
    finally:
        showcase.stop(signal.SIGTERM)


def steepest(frames):
    attitudes = [frame["orientation"] for frame in frames]
    return max(max(abs(each["roll"]), abs(each["pitch"])) for each in attitudes)


def test_it_says_what_flies_what(flight):
    said = flight.said()
    assert "aboard: the firmware on a simulated ATmega328P" in said
    assert "flying motor glider, 1.8 m by JSBSim: wind 4 m/s, turbulence moderate" in said
    assert "The Arduino holds the attitude (FBW)" in said
    assert "Traceback" not in said


def test_the_attitude_on_the_ground_is_the_attitude_of_the_model(flight):
    """What the firmware makes of its IMU's bytes, in turbulence, within its own error."""
    frames = flight.telemetry(20)
    truth = [(float(row["roll_deg"]), float(row["pitch_deg"])) for row in flight.truth()]
    for frame in frames:
        shown = frame["orientation"]["roll"], frame["orientation"]["pitch"]
        nearest = min(max(abs(shown[0] - roll), abs(shown[1] - pitch)) for roll, pitch in truth)
        assert nearest < 2.0, (shown, nearest)


def test_the_firmware_holds_the_attitude(flight):
    frames = flight.telemetry(60)
    assert all(frame["flight_mode"] == "FBW" for frame in frames)
    assert all(frame["armed"] for frame in frames)
    assert steepest(frames) < 45
    outputs = {frame["servo"]["ailerons"] for frame in frames}
    assert len(outputs) > 5, "the servos move against the gusts"
    assert all(float(row["height_m"]) > 80 for row in flight.truth())


def test_moving_the_controller_to_the_pi_is_configuration_only(tmp_path):
    build_firmware()
    showcase = Showcase(tmp_path, "--controller", "raspberry").ready()
    try:
        assert "Raspilot's controller on the Raspberry Pi holds the attitude" in showcase.said()
        frames = showcase.telemetry(60)
    finally:
        assert showcase.stop(signal.SIGTERM) == 0
    assert all(frame["flight_mode"] == "OUTPUT" for frame in frames)
    assert all(frame["flight_control"]["mode"] == "FBW" for frame in frames)
    assert steepest(frames) < 45
    before, after = frames[0]["counters"], frames[-1]["counters"]
    sent = after["flight_control"]["outputs"] - before["flight_control"]["outputs"]
    assert sent > 60


def test_telemetry_has_every_reading_with_source_and_age(flight):
    frame = flight.telemetry(1)[0]
    assert frame["source"]["orientation"] == frame["source"]["rx"] == "arduino"
    assert frame["source"]["location"] == frame["source"]["heading"] == "android"
    assert frame["age_ms"]["orientation"] < 500
    assert frame["mode"] == "flight controller"
    assert frame["flight_controller"] == "arduino"
    assert frame["android"]["connected"] and frame["android"]["batteryLevel"] > 0
    assert frame["arduino"]["connected"] and frame["arduino"]["framing"] == "checked"
    assert set(frame["rx"]) == {"ailerons", "elevator", "throttle", "rudder", "aux1", "aux2"}
    assert "orientation" in frame["system"]["providers"]
    assert frame["vetoes"] == ["arduino: the throttle is not low"], "in flight it never is"
    assert frame["home"]["distance"] is not None


@pytest.mark.parametrize(
    "command",
    [
        ["up.telemetry.frequency", "frequency=50"],
        ["up.heading.change", "heading=90", "mode=required"],
        ["up.altitude.change", "altitude=120.5", "mode=required"],
        ["android.speak", "text=hello"],
        ["up.flight_mode.set", "mode=RATE"],
        ["up.flight_mode.set", "mode=FBW"],
    ],
    ids=lambda command: command[0],
)
def test_a_ground_command_is_carried_out_and_acked(flight, command):
    result = flight.ground("send", *command)
    assert result.returncode == 0, result.stdout + result.stderr
    assert "ack" in result.stdout


def test_the_phone_got_what_was_said_to_it(flight):
    assert flight.ground("send", "android.speak", "text=mind the trees").returncode == 0
    log = flight.folder / "aircraft.log"
    wait(lambda: "mind the trees" in log.read_text(encoding="utf-8"), "the phone speaks")


def test_gains_set_from_the_ground_fly_in_the_firmware_and_are_saved(flight):
    def loop(p):
        return {axis: {"p": p, "i": 0.5, "d": 0.0} for axis in ("ailerons", "elevator")}

    rudder = flight.gains()["ratePIDs"]["rudder"]
    gains = {"ratePIDs": loop(1.123456), "stabPIDs": loop(3.0)}
    set_them = flight.ground("send", "arduino.pids.tunings", f"pids={json.dumps(gains)}")
    assert set_them.returncode == 0, set_them.stdout + set_them.stderr
    # The answer is the Arduino's, which holds them as 32-bit numbers.
    values = flight.gains()
    assert values["ratePIDs"]["ailerons"]["p"] == pytest.approx(1.123456, rel=1e-6)
    assert values["stabPIDs"]["elevator"] == {"p": 3.0, "i": 0.5, "d": 0.0}
    assert values["ratePIDs"]["rudder"] == rudder, "the two-axis form leaves the rudder"
    assert "1.12345" in (flight.folder / "config" / "pids.yml").read_text(encoding="utf-8")


def test_half_a_set_of_gains_is_refused_whole(flight):
    before = flight.gains()
    half = {"ratePIDs": {"ailerons": {"p": 1, "i": 0, "d": 0}}, "stabPIDs": {}}
    result = flight.ground("send", "--force", "arduino.pids.tunings", f"pids={json.dumps(half)}")
    assert result.returncode == 1
    assert "elevator is missing" in result.stdout + result.stderr
    assert flight.gains() == before


def test_nobody_on_the_ground_stops_the_program(flight):
    result = flight.ground("send", "--force", "up.system.stop")
    assert result.returncode == 1
    assert "forbidden" in result.stdout + result.stderr
    assert flight.telemetry(1)


def test_an_unknown_command_is_refused_by_name(flight):
    result = flight.ground("send", "--force", "up.loop.the.loop")
    assert result.returncode == 1
    assert "unknown" in result.stdout + result.stderr


def test_a_second_instance_says_which_port_is_taken(flight):
    result = subprocess.run(
        [sys.executable, str(ROOT / "main.py"), "--config", str(flight.folder / "config")],
        capture_output=True, text=True, timeout=LIMIT_S, check=False,
    )  # fmt: skip
    assert result.returncode == 1
    assert "port" in result.stderr and "in use" in result.stderr
    assert "Traceback" not in result.stderr
    assert flight.telemetry(1), "the first instance flies on"


def test_ctrl_c_stops_everything_and_leaves_nothing(tmp_path):
    showcase = Showcase(tmp_path).ready()
    group = [showcase.daemon_pid(), child_with(showcase.process.pid, "up_proxy.main"),
             child_with(showcase.process.pid, "up_simulator")]  # fmt: skip
    assert (tmp_path / "radio").is_socket()
    assert showcase.stop(signal.SIGINT) == 0
    assert "Everything is stopped." in showcase.said()
    assert not any(Path(f"/proc/{pid}").exists() for pid in group)
    assert not (tmp_path / "board").is_symlink()
    assert not (tmp_path / "radio").exists()
    assert "Traceback" not in showcase.said()


def test_a_terminal_that_closes_leaves_nothing(tmp_path):
    showcase = Showcase(tmp_path).ready()
    daemon = showcase.daemon_pid()
    assert showcase.stop(signal.SIGHUP) == 0
    assert not Path(f"/proc/{daemon}").exists()


def test_a_part_that_dies_is_told_with_its_log(tmp_path):
    showcase = Showcase(tmp_path).ready()
    os.kill(showcase.daemon_pid(), signal.SIGKILL)
    assert showcase.process.wait(20) == 1
    assert "raspilot ended by itself with signal 9" in showcase.said()


def test_a_showcase_that_is_killed_leaves_nothing(tmp_path):
    showcase = Showcase(tmp_path).ready()
    daemon = showcase.daemon_pid()
    showcase.stop(signal.SIGKILL)
    wait(lambda: not Path(f"/proc/{daemon}").exists(), "the daemon goes, too")


def test_a_recorded_flight_stands_in_where_there_is_no_flight_model(tmp_path):
    recorded = ROOT / "simulator" / "up_simulator" / "recorded_flight.csv.gz"
    showcase = Showcase(tmp_path, "--replay", str(recorded)).ready()
    try:
        assert "the servos have no effect" in showcase.said()
        frames = showcase.telemetry(10)
        assert len({frame["orientation"]["roll"] for frame in frames}) > 3
    finally:
        assert showcase.stop(signal.SIGTERM) == 0


def clone_with_nothing_built(folder):
    """What a user has who never could build the firmware."""
    ignored = shutil.ignore_patterns("__pycache__", "build", "build-*")
    for name in ("up", "raspilot", "simulator", "arduino"):
        shutil.copytree(ROOT / name, folder / name, ignore=ignored)
    shutil.copy(ROOT / "main.py", folder)
    return [folder, folder / "simulator", folder / "arduino" / "bench"]


def test_without_any_compiler_a_stand_in_flies_and_the_pi_holds_the_attitude(tmp_path):
    """Where neither avr-gcc nor g++ is found; the search path leads to Python alone."""
    tools = tmp_path / "bin"
    tools.mkdir()
    packages = clone_with_nothing_built(tmp_path / "clone")
    showcase = Showcase(
        tmp_path, path=str(tools), PYTHONPATH=os.pathsep.join(map(str, packages))
    ).ready()
    try:
        said = showcase.said()
        assert "no firmware aboard but a stand-in: " in said
        assert "so the attitude is held by Raspilot instead" in said
        # The stand-in takes Outputs only once its pilot has raised AUX2.
        wait(lambda: showcase.telemetry(1)[0]["armed"], "armed by AUX2")
        frames = showcase.telemetry(20)
    finally:
        assert showcase.stop(signal.SIGTERM) == 0
    assert all(frame["flight_mode"] == "OUTPUT" for frame in frames)
    assert steepest(frames) < 45


class Processes:
    """Programs of one test, with their output in files; ended with it."""

    def __init__(self, folder):
        self.folder = folder
        self.started = []

    def start(self, name, *command, **environment):
        path = self.folder / f"{name}.log"
        with path.open("wb") as output:
            process = subprocess.Popen(
                [sys.executable, *map(str, command)],
                stdout=output,
                stderr=subprocess.STDOUT,
                stdin=subprocess.DEVNULL,
                env={**os.environ, **environment},
            )
        self.started.append(process)
        return lambda: path.read_text(encoding="utf-8")

    def stop(self):
        for process in reversed(self.started):
            process.terminate()
        for process in self.started:
            process.wait(20)


@pytest.fixture
def processes(tmp_path):
    made = Processes(tmp_path)
    yield made
    made.stop()


def port_in(text, before):
    words = text.split(before, 1)[1].split()
    return words[0]


@pytest.fixture
def short_folder():
    """A folder whose path leaves room for the name of a Unix socket (107 bytes)."""
    with tempfile.TemporaryDirectory(prefix="up-") as folder:
        yield folder


def test_black_box_flight_through_runner_and_proxy(tmp_path, short_folder, processes):
    """Only the phone flies: it asks the runner, Raspilot is spawned, the ground sees it."""
    config = tmp_path / "config"
    black_box = config / "blackbox"
    black_box.mkdir(parents=True)
    (config / "proxy.yml").write_text("airborne port: 0\nground port: 0\nmetrics port: 0\n")
    proxy = processes.start("proxy", "-m", "up_proxy.main", "--config", config)
    wait(lambda: "ground side listens" in proxy(), "proxy")
    airborne = port_in(proxy(), "airborne side listens on port ")
    ground = port_in(proxy(), "ground side listens on port ")
    (black_box / "config.yml").write_text("mode: black box\n")
    (black_box / "mission_control.yml").write_text(
        f"remote_server: {{url: 127.0.0.1, port: {airborne}}}\n"
    )
    (config / "runner.yml").write_text(
        f"port: 0\nrun folder: {short_folder}\nstop instances on exit: true\n"
    )
    runner = processes.start("runner", "-m", "up_runner.main", "--config", config)
    wait(lambda: "listens on port" in runner(), "runner")
    port = port_in(runner(), "listens on port ")
    phone = processes.start(
        "phone", "-m", "up_simulator", "start", "--no-board", "--orientation", "tcp",
        "--runner", f"127.0.0.1:{port}", "--aircraft-name", "glider-7",
    )  # fmt: skip
    wait(lambda: "connected" in phone(), "phone")
    watch = [sys.executable, "-m", "up_ground.main", "--port", ground, "--aircraft", "glider-7",
             "watch", "--json", "--count", "5"]  # fmt: skip

    def frames():
        result = subprocess.run(watch, capture_output=True, text=True, timeout=LIMIT_S, check=True)
        return [json.loads(line)["data"] for line in result.stdout.splitlines()]

    wait(lambda: frames()[-1]["source"]["orientation"] == "android", "orientation by the phone")
    newest = frames()[-1]
    assert newest["mode"] == "black box"
    assert newest["flight_controller"] is None
    assert "arduino" not in newest
    assert newest["location"]["latitude"] == pytest.approx(50.0, abs=0.1)
    assert newest["age_ms"]["orientation"] < 1000
    assert newest["android"]["connected"]


def test_provisional_black_box_and_back(tmp_path, processes):
    """Without an Arduino the daemon says so after 5 s, and comes back when it answers."""
    board = tmp_path / "board"
    (tmp_path / "arduino.yml").write_text(f"port: {board}\n")
    (tmp_path / "android.yml").write_text("general port: 0\norientation port: 0\n")
    (tmp_path / "discovery.yml").write_text("port: 0\n")
    (tmp_path / "mission_control.yml").write_text("listener: {port: 0}\n")
    daemon = processes.start("daemon", ROOT / "main.py", "--config", tmp_path)
    wait(lambda: "provisionally in Black Box Mode" in daemon(), "provisional")
    processes.start(
        "board", "-m", "up_simulator", "start", "--no-phone", "--board", "stand-in",
        "--pty-link", board,
    )  # fmt: skip
    wait(lambda: "back in Flight Controller Mode" in daemon(), "back")
    assert "Traceback" not in daemon()


def test_without_any_port_there_is_nothing_to_run_for(tmp_path):
    import socket

    taken = socket.socket()
    taken.bind(("", 0))
    taken.listen()
    port = taken.getsockname()[1]
    (tmp_path / "arduino.yml").write_text(f"port: {tmp_path / 'nothing'}\n")
    (tmp_path / "android.yml").write_text(f"general port: {port}\norientation port: 0\n")
    (tmp_path / "discovery.yml").write_text("port: 0\n")
    result = subprocess.run(
        [sys.executable, str(ROOT / "main.py"), "--config", str(tmp_path)],
        capture_output=True, text=True, timeout=LIMIT_S, check=False,
    )  # fmt: skip
    taken.close()
    assert result.returncode == 1
    assert "neither" in result.stderr
    assert "Traceback" not in result.stderr


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("log level: loud\n", "config.yml:1:12: log level: must be one of"),
        ("log levle: info\n", "did you mean 'log level'"),
        ("mode: [\n", "config.yml:2:1"),
        ("flight controller: arduino\nflight controller: raspberry\n", "config.yml:2:1"),
        ("\x00", "config.yml:1:1"),
    ],
)
def test_a_wrong_configuration_is_one_sentence_and_status_2(tmp_path, text, says):
    (tmp_path / "config.yml").write_text(text)
    result = subprocess.run(
        [sys.executable, str(ROOT / "main.py"), "--config", str(tmp_path)],
        capture_output=True, text=True, timeout=LIMIT_S, check=False,
    )  # fmt: skip
    assert result.returncode == 2, result.stderr
    assert says in result.stderr.replace('"', "'")
    assert "Traceback" not in result.stderr
