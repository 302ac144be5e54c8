"""A Black Box flight of the Java phone: the runner spawns Raspilot, the Java ground sees it."""

import time
from ast import literal_eval
from pathlib import Path

import pytest

from tests.android.console_program import ConsoleProgram, number_in
from tests.android.phone_program import FIX, PhoneProgram
from tests.android.real_daemon import GUARDS
from tests.proxy.program import Program
from tests.runner.runners import RunnerProcess
from tests.support.certificates import Certificates
from up.config.keys_file import add_key
from up.protocols.pairing import Pairing

AIRCRAFT = "glider-9"
ROOT = Path(__file__).parents[2]
STALE_S = 1.5
VALUES = (
    "mode", "flight_controller", "android.connected", "source.orientation", "age_ms.orientation",
    "age_ms.location", "location.latitude", "android.batteryLevel",
)  # fmt: skip


@pytest.fixture
def proxy(tmp_path):
    with Program(tmp_path / "proxy") as program:
        yield program


@pytest.fixture
def own(tmp_path):
    made = Certificates(tmp_path)
    made.server("runner")
    made.client("phone")
    return made


@pytest.fixture
def runner(short_path, proxy, own):
    made = RunnerProcess(
        short_path / "runner",
        **{"application root": str(ROOT), "script path": "main.py", "security": "require"},
        tls=str(own.authority.folder / "runner"),
    )
    made.write("blackbox/config.yml", {"mode": "black box"})
    server = {"url": "127.0.0.1", "port": proxy.airborne_port}
    made.write("blackbox/mission_control.yml", {"remote_server": server})
    made.write("blackbox/disabled_modules.yml", {"disabled modules": list(GUARDS)})
    made.start()
    yield made
    made.clean()


def test_a_black_box_flight_and_the_death_of_its_phone(runner, proxy, own):
    key_id, key = add_key(runner.config_folder, "phone", "pilot", "", AIRCRAFT)
    place = ("--runner", f"127.0.0.1:{runner.port}", "--aircraft", AIRCRAFT)
    place += ("--tls", own.authority.folder / "phone")
    with PhoneProgram(*place) as unpaired:
        unpaired.until(lambda: unpaired.all("notice"), "the refusal")
        assert {each["code"] for each in unpaired.all("notice")} == {"unprotected"}
    place += ("--pairing", Pairing(AIRCRAFT, key_id, key.secret, key.role, key.name).encode())
    ground = ("--proxy", f"127.0.0.1:{proxy.ground_port}", "--aircraft", AIRCRAFT)
    with (
        PhoneProgram(*place, "--orientation", "tcp") as phone,
        ConsoleProgram(*ground, values=VALUES) as console,
    ):
        there = phone.connected()
        asked = runner.logs("request", device="phone")
        assert (asked["action"], asked["aircraft"]) == ("spawn", AIRCRAFT)
        ports = {name: there[name] for name in ("general", "orientation")}
        assert literal_eval(runner.logs("running")["ports"]) == ports
        console.sees("the flight", mode="black box", source__orientation="android")
        console.sees("the location", location__latitude=FIX["latitude"], android__batteryLevel=87)
        assert console.at("flight_controller") is None
        seen = [number_in(frame) for frame in console.frames]
        moved = {number for number in seen if number is not None}
        console.until(lambda: console.number() not in moved, "the attitude moves")
        killed_s = time.monotonic()
        phone.kill()
        console.until(lambda: console.at("android.connected") is False, "the phone is missed")
        missed_s = time.monotonic() - killed_s

        def is_stale():
            age_ms = console.at("age_ms.orientation")
            return age_ms is None or age_ms > 900

        console.until(is_stale, "the attitude is stale")
        stale_s = time.monotonic() - killed_s
        first = next(
            time_s for time_s, said in list(console.events)
            if said["event"] == "telemetry" and time_s > killed_s
            and said["values"]["android.connected"] is False
        )  # fmt: skip
        assert first - killed_s < STALE_S
        assert stale_s < STALE_S + 0.5
        print(f"black box: missed after {missed_s:.2f} s, attitude stale after {stale_s:.2f} s")
