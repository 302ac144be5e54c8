"""Scenario files: their values, and every problem with file, line and key."""

import re
from dataclasses import fields

import pytest
from arduino_cog.commands.arduino_status_command import ArduinoStatusCommand
from hypothesis import given
from hypothesis import strategies as st

from tests.simulator.scenario.minimal import EXPECT, HEAD, scenario
from up.commands.board_schema import FLIGHT_MODES
from up.config import ConfigErrors
from up_simulator.scenario.file import parse_scenario, read_scenario
from up_simulator.scenario.override import Override
from up_simulator.scenario.scenario import Scenario
from up_simulator.scenario.signals import values_of

IN_PROCESS = HEAD + "raspilot: {runs: in process}\nground: {role: pilot}\n"
RICH = """\
title: Everything
about: many words
tags: [a, b]
airframe: wing
seed: 7
duration_s: 20
start: {height_m: 80, roll_deg: -30, throttle: null}
weather:
  wind_m_s: 5
  turbulence: moderate
  gusts: [{at_s: 1, duration_s: 2, down_m_s: 3}]
imu: {gyro_bias_deg_s: [1, -1, 0.5], vibration_m_s2: 2}
switch: {middle: RATE, high: fbw}
profile: {fly_by_wire: {roll_deg: 40}}
gains: {rate: {ailerons: {p: 1.5}}}
raspilot:
  runs: in process
  config: {config.yml: {flight controller: raspberry}, load_guard.yml: {}}
phone: {orientation: udp}
ground: {role: operator, period_ms: 50}
link: {up: {delay_ms: 40, loss_percent: 2}}
sticks:
  - {at_s: 0, mode: rate, arm: yes, throttle: 0.4}
  - {at_s: 2, ailerons: -0.5, over_s: 1, aux1_us: 1500}
events:
  - {at_s: 3, name: frozen, imu: frozen}
  - {at_s: 4, serial_noise: {flipped_percent: 1}}
  - {at_s: 5, command: {name: up.arm, data: {a: [1, {b: null}], c: "no", d: 1.5}, answer: nack}}
expect:
  - {name: one, signal: truth.roll_deg, between: [-5, 5], from_s: 1, to_s: 3}
  - {name: two, signal: board.mode, is: RATE, after: frozen}
  - {name: three, signal: board.armed, becomes: yes, within_s: 1}
  - {name: four, signal: ground.counters.serial.dropped, grows_below: 3}
  - name: five
    signal: truth.roll_rate_deg_s
    step: {rise_time_s: 1, demand: demand.roll_rate_deg_s}
control: {mode: fbw, fails: [two]}
"""


def problems(text, *overrides):
    with pytest.raises(ConfigErrors) as caught:
        parse_scenario(text, "flight.yml", overrides)
    return caught.value.problems


def place_of(problem):
    key = re.match(r"([\w.\[\]]+):? ", problem.what)
    assert str(problem).startswith(f"flight.yml:{problem.line}:{problem.column}: ")
    return f"{problem.line} {key[1]}" if key and ":" in key[0] else str(problem.line)


def test_every_value_is_read():
    read = parse_scenario(RICH)
    assert (read.airframe, read.seed, read.tags) == ("wing", 7, ("a", "b"))
    assert read.switch.positions() == {"low": "ACRO", "middle": "RATE", "high": "FBW"}
    assert read.raspilot.config == {
        "config.yml": {"flight controller": "raspberry"},
        "load_guard.yml": {},
    }
    assert read.profile == {"fly_by_wire": {"roll_deg": 40}}
    assert read.events[2].command.data == {"a": [1, {"b": None}], "c": "no", "d": 1.5}
    assert [expectation.kind for expectation in read.expect] == [
        "between", "is_", "becomes", "grows_below", "step",
    ]  # fmt: skip
    assert read.link.down.delay_ms == 0 and read.link.up.loss_percent == 2


def test_a_short_file_has_defaults():
    short = scenario()
    assert (short.airframe, short.board, short.raspilot.runs) == ("glider", "auto", "no")
    assert short.phone is None and short.ground is None and not short.is_real


def test_all_problems_are_reported_together():
    text = (
        "title: x\n"
        "durations: 3\n"
        "weather: {turbulence: sever}\n"
        "sticks:\n"
        "  - {at_s: 0, ailerons: 2}\n"
        "  - {at_s: 1}\n"
        "events:\n"
        "  - {at_s: 1, imu: frozen, reset: power}\n"
        "expect:\n"
        "  - {name: a, signal: truth.rol_deg, below: 3}\n"
        "  - {name: b, signal: board.mode, below: 3}\n"
        "  - {name: c, signal: board.armed, is: 3}\n"
    )
    found = problems(text)
    assert [place_of(each) for each in found] == [
        "2", "3 weather.turbulence", "5 sticks[0].ailerons", "6 sticks[1].at_s",
        "8 events[0].reset", "10 expect[0].signal", "11 expect[1].below", "12 expect[2].is",
    ]  # fmt: skip
    assert "'duration_s'" in found[0].what and "'truth.roll_deg'" in found[5].what


@pytest.mark.parametrize(
    ("part", "place"),
    [
        ("airframe: glidr\n", "3 airframe"),
        ("sticks: [{at_s: 0, mode: RATE}]\n", "3 sticks[0].mode"),
        ("switch: {high: ACRO}\ncontrol: {mode: AUTO, fails: [It flies]}\n", "4 control.mode"),
        ("phone: {orientation: tcp}\n", "3 phone"),
        ("events: [{at_s: 1, serial: back}]\n", "3 events[0].serial"),
        ("events: [{at_s: 1, link: stall}]\n", "3 events[0].link"),
        ("events: [{at_s: 1, phone: back}]\n", "3 events[0].phone"),
        ("events: [{at_s: 9, imu: well}]\n", "3 events[0].at_s"),
        ("sticks: [{at_s: 9, mode: FBW}]\n", "3 sticks[0].at_s"),
        ("weather: {gusts: [{at_s: 9, down_m_s: 3}]}\n", "3 weather.gusts[0].at_s"),
        ("sticks: [{mode: FBW}]\n", "3 sticks[0]"),
        ("weather: {gusts: [{down_m_s: 3}]}\n", "3 weather.gusts[0]"),
        ("events: [{imu: well}]\n", "3 events[0]"),
        ("events: [{at_s: 1, raspilot: killed}]\n", "3 events[0].raspilot"),
        ("events: [{at_s: 1, mark: ''}]\n", "3 events[0].mark"),
        ("events: [{at_s: 1, mark: a, name: b}]\n", "3 events[0].name"),
        ("events: [{at_s: 1, mark: a, imu: well}]\n", "3 events[0].imu"),
        ("seed:\n", "3 seed"),
        ("weather: {turbulence: Light}\n", "3 weather.turbulence"),
        ("gains: {rate: {ailerons: {p: 99}}}\n", "3 gains.rate.ailerons.p"),
        ("gains: {rate: {aileron: {p: 1}}}\n", "3 gains.rate"),
        ("profile: {fly_by_wire: {rol_deg: 1}}\n", "3 profile.fly_by_wire"),
        ("profile: {fly_by_wire: {roll_deg: 100}}\n", "3 profile.fly_by_wire.roll_deg"),
        ("airframe: !!python/object/apply:os.system [ls]\n", "3"),
        ("board: direct\nevents: [{at_s: 1, imu: well}]\n", "4 events[0].imu"),
        ("raspilot: {runs: in process}\nevents: [{at_s: 1, proxy: killed}]\n",
         "4 events[0].proxy"),
        ("raspilot: {runs: in process}\nground: {through: proxy}\n", "4 ground.through"),
        ("raspilot: {runs: in process}\nevents: [{at_s: 1, raspilot: hung}]\n",
         "4 events[0].raspilot"),
        ("raspilot: {runs: real}\nground: {through: runner}\nphone: {orientation: udp}\n",
         "5 phone.orientation"),
        ("raspilot: {runs: in process}\nground: {}\nevents: [{at_s: 1, path: cut}]\n",
         "5 events[0].path"),
        ("raspilot: {runs: real}\nground: {through: two paths}\nevents: [{at_s: 1, link: stall}]\n",
         "5 events[0].link"),
        ("goggles: 50x18\n", "3 goggles"),
        ("raspilot: {runs: in process}\nevents: [{at_s: 1, mavlink: RTL}]\n",
         "4 events[0].mavlink"),
        ("raspilot: {config: {config.yml: {mod: auto}}}\n", "3 raspilot.config.config.yml"),
        ("raspilot: {config: {confg.yml: {}}}\n", "3 raspilot.config"),
        ("control: {mode: ACRO, fails: [It flys]}\n", "3 control.fails[0]"),
        ("control: {fails: [It flies]}\n", "3 control.about"),
        ("imu: {gyro_bias_deg_s: [1, 2]}\n", "3 imu.gyro_bias_deg_s"),
        ("sticks: [{at_s: 0, mode: FBW, aux1_us: 1500}]\n", "3 sticks[0].aux1_us"),
        ("raspilot: {runs: in process}\nground: {}\n"
         "events: [{at_s: 1, command: {name: a, data: {x: no}}}]\n",
         "5 events[0].command.data.x"),
    ],
)  # fmt: skip
def test_a_problem_has_its_place(part, place):
    (found,) = problems(HEAD + part + EXPECT)
    assert place_of(found) == place


@pytest.mark.parametrize("event", ["channel_lost: throttle", "imu: frozen", "reset: watchdog"])
def test_an_event_that_no_betaflight_board_carries_out_is_a_problem(event):
    betaflight = IN_PROCESS.replace("in process", "real") + "board: betaflight\n"
    text = f"{betaflight}events: [{{at_s: 1, {event}}}]\n{EXPECT}"
    assert [each.key for each in problems(text)] == ["events"]


@pytest.mark.parametrize(
    ("part", "suggestion"),
    [
        ("sticks: [{at_s: 0, mode: RATE}]\n", "switch: {low: RATE}"),
        ("sticks: [{at_s: 0, mode: ACRO}, {at_s: 1, mode: RATE}]\n", "{middle: RATE}"),
        ("sticks: [{at_s: 0, mode: ACRO}, {at_s: 1, mode: FBW}, {at_s: 2, mode: AUTO}]\n"
         "control: {mode: RATE, fails: [It flies]}\n", "all three"),
    ],
)  # fmt: skip
def test_a_mode_without_a_switch_position_gets_a_free_position_suggested(part, suggestion):
    (found,) = problems(HEAD + part + EXPECT)
    assert suggestion in found.what


@pytest.mark.parametrize(
    ("expectation", "key"),
    [
        ("signal: time_s, above: 0", "name"),
        ("name: a, above: 0", "signal"),
        ("name: a, signal: time_s", "name"),
        ("name: a, signal: time_s, above: 0, below: 3", "above"),
        ("name: a, signal: time_s, between: [3]", "between"),
        ("name: a, signal: time_s, between: [3, 1]", "between"),
        ("name: a, signal: time_s, becomes: 3", "becomes"),
        ("name: a, signal: time_s, above: 3, within_s: 1", "within_s"),
        ("name: a, signal: time_s, above: 3, from_s: 2, to_s: 1", "to_s"),
        ("name: a, signal: time_s, above: 3, from_s: 5", "from_s"),
        ("name: a, signal: time_s, above: 3, after: b", "after"),
        ("name: a, signal: ground.age_s, above: 3", "signal"),
        ("name: a, signal: time_s, step: {}", "step.rise_time_s"),
        ("name: a, signal: roll_deg, above: 0", "signal"),
        ("name: a, signal: board.mode, is: FBWW", "is"),
        ("name: a, signal: board.mode, is_not: fbw", "is_not"),
        ("name: a, signal: board.mode, is: 3", "is"),
        ("name: a, signal: board.mode, becomes: on, within_s: 1", "becomes"),
        ("name: a, signal: board.reset_cause, is: power watchdg", "is"),
    ],
)
def test_a_wrong_expectation_has_its_key(expectation, key):
    found = problems(HEAD + f"expect: [{{{expectation}}}]\n")
    assert f"3 expect[0].{key}" in [place_of(each) for each in found]


@pytest.mark.parametrize(
    ("expectation", "suggestion"),
    [
        ("signal: ground.mode, is: blackbox", "black box"),
        ("signal: ground.arduino.reset_cause, is: power", "power-on"),
        ("signal: ground.source.orientation, is: phone", "arduino, android"),
    ],
)
def test_an_impossible_value_gets_a_suggestion(expectation, suggestion):
    (found,) = problems(f"{IN_PROCESS}expect: [{{name: a, {expectation}}}]\n")
    assert suggestion in found.what


@pytest.mark.parametrize(
    "expectation",
    [
        "signal: board.mode, is: null",
        "signal: board.reset_cause, is: power-on brown-out",
        "signal: ground.arduino.reset_cause, is: 'watchdog, state restored'",
        "signal: ground.vetoes, is: any text",
    ],
)
def test_a_possible_value_is_accepted(expectation):
    assert parse_scenario(f"{IN_PROCESS}expect: [{{name: a, {expectation}}}]\n").expect


def test_the_possible_values_are_those_of_firmware_and_daemon():
    assert values_of("board.mode") == tuple(FLIGHT_MODES.values())
    assert values_of("board.reset_cause") == ("power-on", "external", "brown-out", "watchdog")
    every = ArduinoStatusCommand(*(0xFF for _ in fields(ArduinoStatusCommand))).reset_causes
    assert set(every.split(", ")) | {"unknown"} == set(values_of("ground.arduino.reset_cause"))


@pytest.mark.parametrize(
    "text", ["", "[]", "3", "title: [", "a: &x 1\nb: *x\n", "\0", "- title: a"]
)
def test_a_file_that_is_not_a_scenario_is_rejected(text):
    assert all(place_of(each) for each in problems(text))


def test_an_airframe_may_be_a_folder_here_or_beside_the_scenario(tmp_path, monkeypatch):
    (tmp_path / "big").mkdir()
    file = tmp_path / "flight.yml"
    file.write_text(f"{HEAD}airframe: big\n{EXPECT}")
    assert read_scenario(file).airframe == str(tmp_path / "big")
    monkeypatch.chdir(tmp_path)
    assert read_scenario("flight.yml").airframe == "big"
    (tmp_path / "big").rmdir()
    with pytest.raises(ConfigErrors, match=r"flight\.yml:3:11: airframe: "):
        read_scenario(file)


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(ConfigErrors, match=r"nowhere\.yml:1:1: "):
        read_scenario(tmp_path / "nowhere.yml")


OVERRIDDEN = HEAD + "sticks: [{at_s: 0, mode: FBW}, {at_s: 1, throttle: 0.3}]\n" + EXPECT


def overrides(*pairs):
    return [Override(f"--set {key}={value}", key, value) for key, value in pairs]


def test_options_replace_values_and_add_missing_ones():
    changed = parse_scenario(
        OVERRIDDEN,
        overrides=overrides(
            ("seed", "5"),
            ("duration_s", "9"),
            ("weather.turbulence", "severe"),
            ("sticks.1.throttle", "0.7"),
            ("start", "{roll_deg: 10}"),
        ),
    )
    assert (changed.seed, changed.duration_s, changed.weather.turbulence) == (5, 9, "severe")
    assert changed.sticks[1].throttle == 0.7 and changed.start.roll_deg == 10


@pytest.mark.parametrize(
    ("key", "value"),
    [("sed", "5"), ("seed", "x"), ("seed", ""), ("sticks.9.throttle", "1"), ("title.x", "1"),
     ("seed", "[")],
)  # fmt: skip
def test_a_problem_of_an_option_names_the_option(key, value):
    for found in problems(OVERRIDDEN, *overrides((key, value))):
        assert str(found).startswith(f"--set {key}={value}: ")


LINES = RICH.splitlines(keepends=True)
ODD = ["null", "[]", "{}", "-1", "1e400", ".nan", "~"]
WORDS = [*sorted(set(re.findall(r"[\w.]+", RICH))), *ODD]


@st.composite
def mutations(draw):
    """Return the rich scenario with bytes flipped, words exchanged, lines moved or cut."""
    text = RICH
    for _ in range(draw(st.integers(1, 4))):
        kind = draw(st.sampled_from(["byte", "word", "line", "cut", "insert"]))
        if not text:
            break
        at = draw(st.integers(0, len(text) - 1))
        if kind == "byte":
            text = text[:at] + draw(st.characters()) + text[at + 1 :]
        elif kind == "word":
            found = list(re.finditer(r"[\w.]+", text))
            if found:
                match = draw(st.sampled_from(found))
                text = text[: match.start()] + draw(st.sampled_from(WORDS)) + text[match.end() :]
        elif kind == "line":
            text = text + draw(st.sampled_from(LINES))
        elif kind == "cut":
            text = text[:at] + text[at + draw(st.integers(1, 40)) :]
        else:
            text = text[:at] + draw(st.text(max_size=8)) + text[at:]
    return text


@given(mutations() | st.binary(max_size=200), st.text(max_size=12), st.text(max_size=12))
def test_any_file_and_option_give_a_scenario_or_problems_with_places(text, key, value):
    data = text if isinstance(text, bytes) else text.encode("utf-8", "surrogatepass")
    for option in ((), overrides((key, value))):
        try:
            read = parse_scenario(data, "flight.yml", option)
        except ConfigErrors as errors:
            assert errors.problems
            for problem in errors.problems:
                assert problem.line >= 1 and problem.column >= 1 and problem.what
                assert "\n" not in str(problem)
        else:
            assert isinstance(read, Scenario)
