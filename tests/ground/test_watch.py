import json
import os
import signal
import subprocess
import sys

from tests.ground.aircraft import (
    UP_GROUND,
    Aircraft,
    Ground,
    codes,
    environment,
    frame,
    ground,
    until,
)
from tests.proxy.program import Program
from up.version import VERSION


def test_one_picture(proxy, tmp_path):
    with Aircraft(proxy.airborne_port):
        status, said, stderr = ground(tmp_path, proxy.ground_port, "watch", "--once")
    assert (status, stderr) == (0, "")
    for text in ("roll    +12.5 deg", "flight mode FBW", "50.075500", "battery 83 %", "disarmed"):
        assert text in said
    assert "\x1b" not in said


def test_a_line_a_second_without_a_terminal(proxy, tmp_path):
    with Aircraft(proxy.airborne_port):
        status, said, _ = ground(tmp_path, proxy.ground_port, "watch", "--count", "2")
    assert status == 0
    first, second = said.splitlines()
    assert "roll +12.5 pitch -3.2 yaw 271.0" in second
    assert "control free" in first


def test_json_is_the_messages(proxy, tmp_path):
    with Aircraft(proxy.airborne_port, data=frame(vetoes=["\x1b[2J\x7f\x9b"])):
        status, said, _ = ground(tmp_path, proxy.ground_port, "watch", "--json", "--count", "3")
    assert status == 0
    messages = [json.loads(line) for line in said.splitlines()]
    assert [each["data"]["altitude"] for each in messages] == [311.4] * 3
    beacons = [each["beacon"] for each in messages]
    assert beacons == list(range(beacons[0], beacons[0] + 3))
    assert messages[0]["data"]["vetoes"] == ["\x1b[2J\x7f\x9b"]
    assert said.replace("\n", "").isprintable()


def test_it_ends_when_the_time_is_over(proxy, tmp_path):
    status, said, _ = ground(tmp_path, proxy.ground_port, "watch", "--for", "1.5")
    assert status == 0
    assert "silent" in said


def test_nothing_to_picture_is_told(proxy, tmp_path):
    status, said, stderr = ground(tmp_path, proxy.ground_port, "watch", "--once", "--for", "1")
    assert (status, said, codes(stderr)) == (3, "", ["aircraft_offline"])


def test_a_restarted_proxy_is_found_again_and_the_seat_with_it(tmp_path):
    with Program(tmp_path / "a", "metrics: false\n") as first:
        ports = first.airborne_port, first.ground_port, None
        with Ground(tmp_path, first.ground_port, "watch", "--seat", "command") as watching:
            watching.expect("control ours")
            first.end()
            watching.expect("link down for")
            with (
                Program(tmp_path / "b", "metrics: false\n", ports=ports) as second,
                Aircraft(second.airborne_port),
            ):
                seen = len(watching.said)
                until(lambda: "control ours" in watching.said[seen:], "control again")
                until(lambda: "roll +12.5" in watching.said[seen:], "telemetry again")


def test_an_interrupt_ends_it_without_a_word(proxy, tmp_path):
    with Ground(tmp_path, proxy.ground_port, "watch") as watching:
        watching.expect("link connected")
        watching.process.terminate()
        assert watching.wait() == 130
        assert watching.stderr == ""


def test_under_nohup_a_closed_terminal_does_not_end_it(proxy, tmp_path):
    with subprocess.Popen(
        ["nohup", str(UP_GROUND), "watch", "--count", "3"],
        env=environment(tmp_path, proxy.ground_port),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
    ) as process:
        assert process.stdout.readline()
        process.send_signal(signal.SIGHUP)
        assert process.stdout.read().count(b"\n") == 2
    assert process.returncode == 0


def test_a_reader_that_has_seen_enough_ends_it(proxy, tmp_path):
    with Aircraft(proxy.airborne_port):
        reading, writing = os.pipe()
        process = subprocess.Popen(
            [str(UP_GROUND), "watch", "--json"],
            env=environment(tmp_path, proxy.ground_port),
            stdout=writing,
            stderr=subprocess.PIPE,
        )
        os.close(writing)
        assert os.read(reading, 20)
        os.close(reading)
        with process.stderr as pipe:
            assert pipe.read() == b""
        assert process.wait(30) == 0


def test_the_environment_stands_for_the_options(proxy, tmp_path):
    with Aircraft(proxy.airborne_port, hello=b"UP1 aircraft=glider-1\n"):
        status, said, _ = ground(
            tmp_path, proxy.ground_port, "watch", "--once", UP_GROUND_AIRCRAFT="glider-1"
        )
    assert status == 0
    assert "glider-1 at 127.0.0.1" in said


def test_mistakes_in_the_command_line_are_one_sentence(tmp_path):
    for arguments, environ in (
        (["--port", "70000", "watch"], {}),
        (["--aircraft", "../x", "watch"], {}),
        (["watch", "--count", "0"], {}),
        (["watch", "--for", "nan"], {}),
        (["watch"], {"UP_GROUND_PORT": "many"}),
    ):
        status, said, stderr = ground(tmp_path, 1, *arguments, **environ)
        assert (status, said, codes(stderr)) == (2, "", ["usage"])


def test_help_teaches(tmp_path):
    status, said, _ = ground(tmp_path, 1, "--help")
    assert status == 0
    assert "up-ground send up.flight_mode.set mode=RETURN" in said
    assert "exit status" in ground(tmp_path, 1, "send", "--help")[1]
    listed = ground(tmp_path, 1, "commands", UP_LOG_FORMAT="text")[1]
    assert "up.arm   [pilot" in listed
    assert "``" not in listed
    (arm,) = json.loads(ground(tmp_path, 1, "commands", "up.arm", "--json")[1])
    assert (arm["name"], arm["role"], arm["needs_beacon"]) == ("up.arm", "pilot", True)
    assert ground(tmp_path, 1)[0] == 2


def test_a_closed_stdout_is_one_sentence(tmp_path):
    shell = ["sh", "-c", '"$0" watch --for 2 >&-', str(UP_GROUND)]
    done = subprocess.run(
        shell, env=environment(tmp_path, 1), stderr=subprocess.PIPE, text=True, timeout=60
    )
    assert done.returncode == 2
    assert codes(done.stderr) == ["stdout_closed"]


def test_a_full_disk_and_a_closed_pipe_are_no_traceback(tmp_path):
    for shell, status, expected in (
        ('"$0" commands >/dev/full', 1, ["os_error"]),
        ('set -o pipefail; "$0" commands nope 2>&1 | head -c 1 >/dev/null', 0, []),
    ):
        done = subprocess.run(
            ["bash", "-c", shell, str(UP_GROUND)],
            env=environment(tmp_path, 1), stderr=subprocess.PIPE, text=True, timeout=60,
        )  # fmt: skip
        assert (codes(done.stderr), "Traceback" in done.stderr) == (expected, False)
        assert done.returncode in (status, 2)


def test_it_is_a_module_that_runs():
    shown = subprocess.run([sys.executable, "-m", "up_ground", "--version"], capture_output=True)
    assert shown.stdout.decode() == f"up-ground {VERSION}\n"
