"""docs/simulator.md: its commands work as stated, and it lists every option."""

import re
import shlex

import pytest

from tests.docs.flying import lines_of, options_of
from tests.simulator.program import Program
from tests.simulator.scenarios.shipped import ALONE
from tests.support.firmware import build_firmware
from tests.support.virtual_environment import REPOSITORY
from up_simulator.cli import VERBS, main
from up_simulator.demo.main import read_options as read_demo_options
from up_simulator.harness.start_options import read_options
from up_simulator.scenario.event import EVENT_KINDS

PAGE = "simulator.md"
SHIPPED_FLIGHT = "level-flight-in-gusts"
TEXT = (REPOSITORY / "docs" / PAGE).read_text(encoding="utf-8")
WORDS = {
    "imu": "frozen, unplugged, holding its bus, garbage",
    "imu_errors": "noise, bias, drift while it warms up, vibration",
    "receiver": "lost and back",
    "gps": "outage of the GPS",
    "gps_receiver": "no fix",
    "crsf": "a link that receives nothing",
    "i2c": "every transfer fails",
    "channel_lost": "one wire",
    "channel_back": "one wire",
    "reset": "reset by watchdog, power, button or brown-out",
    "serial": "unplugged",
    "serial_noise": "bits flipped, bytes lost or inserted",
    "phone": "unplugged; battery low",
    "phone_battery": "battery low",
    "link": "stall, then a burst; blackout",
    "link_settings": "delay, jitter, loss, rate",
    "raspilot": "daemon killed, stopped, hung",
    "proxy": "the proxy killed",
    "path": "one of two paths cut",
    "mavlink": "silent, with its connection open",
    "cpu_load_percent": "processor load",
    "command": "",
    "mark": "",
    "motor": "motor stopped",
    "flight_battery": "flight battery low",
    "throw": "",
}
"""The page's words for each kind of event; a Command, a mark and a throw are no fault."""


def test_its_commands_work(tmp_path, monkeypatch, capsys):
    build_firmware()
    monkeypatch.chdir(tmp_path)
    for line in lines_of(PAGE, "up-sim"):
        program, *arguments = line.split()
        assert program == "up-sim"
        if arguments[0] == "fly":
            # tests/simulator/scenarios/test_shipped.py flies it to its end.
            assert arguments[1:] == [SHIPPED_FLIGHT] and SHIPPED_FLIGHT in ALONE
        else:
            assert main(arguments) == 0, (line, capsys.readouterr())


@pytest.mark.parametrize("line", lines_of(PAGE, "start"))
def test_what_starts_the_aircraft_is_understood(line):
    program, verb, *arguments = shlex.split(line)
    assert (program, verb) == ("up-sim", "start")
    read_options(arguments)


def test_the_aircraft_starts_for_a_raspilot(tmp_path):
    build_firmware()
    *_, line = lines_of(PAGE, "start")
    link = str(tmp_path / "board")
    arguments = [link if word == "/tmp/board" else word for word in shlex.split(line)[2:]]
    with Program(*arguments, "--no-phone") as program:
        program.wait_for("board_ready", path=link)
        assert program.end()[0] == 0


@pytest.mark.parametrize("line", re.findall(r"^    (make run.*?)(?:   |$)", TEXT, re.MULTILINE))
def test_make_run_accepts_the_options_of_the_page(line):
    read_demo_options(options_of(line))


def test_every_verb_is_on_the_page():
    assert all(f"`up-sim {verb}`" in TEXT for verb in VERBS)


def test_every_kind_of_event_is_on_the_page():
    assert set(WORDS) == set(EVENT_KINDS)
    table = TEXT.partition("## What can go wrong")[2].partition("\n## ")[0]
    assert all(words in table for words in WORDS.values())
