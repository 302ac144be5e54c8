"""Scenario files: their meaning, and every mistake at its place."""

import re
from dataclasses import fields
from pathlib import Path

import pytest
from arduino_cog.commands.arduino_status_command import ArduinoStatusCommand
from hypothesis import given, settings
from hypothesis import strategies as st

import up_simulator.scenario
from tests.simulator.scenario.minimal import EXPECT, HEAD, scenario
from up.config import ConfigErrors
from up_simulator.scenario.file import parse_scenario, read_scenario
from up_simulator.scenario.sampler import CAUSES, MODES
from up_simulator.scenario.scenario import Scenario
from up_simulator.scenario.signals import words_of
from up_simulator.verbs.catalogue import shipped_paths

ABOARD = HEAD + "raspilot: {runs: in process}\nground: {role: pilot}\n"
TEMPLATE = Path(up_simulator.scenario.__file__).with_name("template.yml")
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


def problems(text):
    with pytest.raises(ConfigErrors) as caught:
        parse_scenario(text, "flight.yml")
    return [str(problem) for problem in caught.value.problems]


def test_everything_that_a_file_may_say_is_read():
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
    assert read.link.down.delay_ms == 0 and read.link.up.settings().loss_percent == 2


def test_a_short_file_has_defaults():
    short = scenario()
    assert (short.airframe, short.board, short.raspilot.runs) == ("glider", "auto", "no")
    assert short.phone is None and short.ground is None and not short.is_real


@pytest.mark.parametrize("path", [*shipped_paths(), TEMPLATE], ids=lambda path: path.stem)
def test_what_is_shipped_has_no_mistake(path):
    shipped = read_scenario(path)
    assert shipped.title and shipped.about and shipped.tags


def test_all_mistakes_are_told_at_once_each_at_its_place():
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
    assert problems(text) == [
        "flight.yml:2:1: unknown key \"durations\", did you mean 'duration_s'?",
        'flight.yml:3:23: weather.turbulence: must be one of "none", "light", "moderate",'
        ' "severe", not "sever"',
        "flight.yml:5:25: sticks[0].ailerons: must be a number between -1 and 1 or null, not 2",
        "flight.yml:6:12: sticks[1].at_s: moves nothing: name a stick, 'mode' or 'arm'",
        "flight.yml:8:35: events[0].reset: 'imu' happens already: give 'reset' an event of its own",
        'flight.yml:10:23: expect[0].signal: "truth.rol_deg": there is no signal of that name,'
        " did you mean 'truth.roll_deg'?",
        "flight.yml:11:42: expect[1].below: needs a number, and board.mode is a word: use 'is' ...",
        "flight.yml:12:40: expect[2].is: must be true or false for this signal",
    ]


@pytest.mark.parametrize(
    ("part", "what"),
    [
        ("airframe: glidr\n", "there is no airframe 'glidr', did you mean 'glider'?"),
        ("sticks: [{at_s: 0, mode: RATE}]\n", "no position of the switch selects RATE"),
        ("phone: {orientation: tcp}\n", "needs 'raspilot: {runs: in process}'"),
        ("events: [{at_s: 1, serial: back}]\n", "needs a Raspberry Pi"),
        ("events: [{at_s: 1, link: stall}]\n", "needs a ground station"),
        ("events: [{at_s: 1, phone: back}]\n", "needs a phone"),
        ("events: [{at_s: 9, imu: well}]\n", "is after the flight's end at 4 s"),
        ("events: [{at_s: 9, imu: well}]\n", ": events[0].at_s: is after"),
        ("sticks: [{at_s: 9, mode: FBW}]\n", "sticks[0].at_s: is after the flight's end at 4 s"),
        ("weather: {gusts: [{at_s: 9, down_m_s: 3}]}\n", "weather.gusts[0].at_s: is after the"),
        ("sticks: [{mode: FBW}]\n", "flight.yml:3:10: sticks[0]: needs 'at_s': when"),
        ("weather: {gusts: [{down_m_s: 3}]}\n", "weather.gusts[0]: needs 'at_s': when"),
        ("events: [{imu: well}]\n", "events[0]: needs 'at_s': when"),
        ("events: [{at_s: 1, raspilot: killed}]\n", "events[0].raspilot: needs a Raspberry Pi"),
        ("seed:\n", "flight.yml:3:6: seed: must have a value"),
        ("weather: {turbulence: Light}\n", 'not "Light", did you mean "light"?'),
        ("gains: {rate: {ailerons: {p: 99}}}\n", ": gains.rate.ailerons.p: must be a number"),
        ("profile: {fly_by_wire: {rol_deg: 1}}\n", ": profile.fly_by_wire: unknown key"),
        ("airframe: !!python/object/apply:os.system [ls]\n", "tags (!!python/object/apply:os"),
        ("board: direct\nevents: [{at_s: 1, imu: well}]\n", "there is no flight computer"),
        ("raspilot: {runs: in process}\nevents: [{at_s: 1, proxy: killed}]\n", "real programs"),
        ("raspilot: {runs: in process}\nground: {through: proxy}\n", "is a real program"),
        ("raspilot: {config: {config.yml: {mod: auto}}}\n",
         "raspilot.config.config.yml: unknown key \"mod\", did you mean 'mode'?"),
        ("raspilot: {config: {confg.yml: {}}}\n", "did you mean 'config.yml'?"),
        ("profile: {fly_by_wire: {roll_deg: 100}}\n", "between 0 and 90"),
        ("gains: {rate: {aileron: {p: 1}}}\n", "did you mean 'ailerons'?"),
        ("control: {mode: ACRO, fails: [It flys]}\n", "did you mean 'It flies'?"),
        ("control: {fails: [It flies]}\n", "takes nothing away"),
        ("imu: {gyro_bias_deg_s: [1, 2]}\n", "must have three numbers"),
        ("sticks: [{at_s: 0, mode: FBW, aux1_us: 1500}]\n", "says again what 'mode' says"),
        ("raspilot: {runs: in process}\nground: {}\n"
         "events: [{at_s: 1, command: {name: a, data: {x: no}}}]\n", "can be read in two ways"),
    ],
)  # fmt: skip
def test_what_does_not_fit_together_is_told(part, what):
    found = problems(HEAD + part + EXPECT)
    assert len(found) == 1 and what in found[0]


@pytest.mark.parametrize(
    ("part", "place", "hint"),
    [
        ("sticks: [{at_s: 0, mode: RATE}]\n", "3:26", "add 'switch: {low: RATE}'"),
        ("sticks: [{at_s: 0, mode: ACRO}, {at_s: 1, mode: RATE}]\n", "3:49", "{middle: RATE}"),
        ("switch: {high: ACRO}\ncontrol: {mode: AUTO, fails: [It flies]}\n", "4:17",
         "{low: AUTO}"),
        ("sticks: [{at_s: 0, mode: ACRO}, {at_s: 1, mode: FBW}, {at_s: 2, mode: AUTO}]\n"
         "control: {mode: RATE, fails: [It flies]}\n", "4:17", "the flight uses all three"),
    ],
)  # fmt: skip
def test_a_mode_that_no_position_selects_is_told_with_a_position_that_is_free(part, place, hint):
    (found,) = problems(HEAD + part + EXPECT)
    assert re.match(rf"flight\.yml:{place}: \S+\.mode: no position of the switch selects ", found)
    assert hint in found


@pytest.mark.parametrize(
    ("event", "what"),
    [
        ("mark: ''", "must be a name"),
        ("mark: a, name: b", "is its name already"),
        ("mark: a, imu: well", "happens already"),
    ],
)
def test_a_mark_is_a_name_and_no_more(event, what):
    (found,) = problems(f"{HEAD}events: [{{at_s: 1, {event}}}]\n{EXPECT}")
    assert found.startswith("flight.yml:3:") and what in found


@pytest.mark.parametrize(
    ("expectation", "what"),
    [
        ("signal: time_s, above: 0", "must be a sentence"),
        ("name: a, above: 0", "must be the name of a signal"),
        ("name: a, signal: time_s", "expects nothing"),
        ("name: a, signal: time_s, above: 0, below: 3", "is expected already"),
        ("name: a, signal: time_s, between: [3]", "must be two numbers"),
        ("name: a, signal: time_s, between: [3, 1]", "the lower one first"),
        ("name: a, signal: time_s, becomes: 3", "needs 'within_s'"),
        ("name: a, signal: time_s, above: 3, within_s: 1", "belongs to 'becomes...'"),
        ("name: a, signal: time_s, above: 3, from_s: 2, to_s: 1", "must be after from_s"),
        ("name: a, signal: time_s, above: 3, from_s: 5", "before this window begins"),
        ("name: a, signal: time_s, above: 3, after: b", "no event is called 'b'"),
        ("name: a, signal: ground.age_s, above: 3", "needs a ground station"),
        ("name: a, signal: time_s, step: {}", "sets no limit"),
        ("name: a, signal: roll_deg, above: 0", "did you mean"),
    ],
)
def test_a_wrong_expectation_is_told(expectation, what):
    assert what in "\n".join(problems(HEAD + f"expect: [{{{expectation}}}]\n"))


@pytest.mark.parametrize(
    ("expectation", "what"),
    [
        ("signal: board.mode, is: FBWW", "board.mode is never \"FBWW\": did you mean 'FBW'?"),
        ("signal: board.mode, is_not: fbw", "did you mean 'FBW'?"),
        ("signal: board.mode, is: 3", "it has ACRO, RATE, FBW, SETPOINT, OUTPUT, RTH"),
        ("signal: board.mode, becomes: on, within_s: 1", 'is never "on"'),
        ("signal: board.reset_cause, is: power watchdg", "did you mean 'watchdog'?"),
        ("signal: ground.source.orientation, is: phone", "it has arduino, android"),
        ("signal: ground.mode, is: blackbox", "did you mean 'black box'?"),
        ("signal: ground.arduino.reset_cause, is: power", "did you mean 'power-on'?"),
    ],
)
def test_a_word_that_a_signal_never_has_is_told(expectation, what):
    text = f"{ABOARD}expect: [{{name: a, {expectation}}}]\n"
    (found,) = problems(text)
    assert what in found and ": expect[0]." in found


@pytest.mark.parametrize(
    "expectation",
    [
        "signal: board.mode, is: null",
        "signal: board.reset_cause, is: power brown-out",
        "signal: ground.arduino.reset_cause, is: 'watchdog, state restored'",
        "signal: ground.vetoes, is: any text",
    ],
)
def test_a_word_that_a_signal_has_is_taken(expectation):
    assert parse_scenario(f"{ABOARD}expect: [{{name: a, {expectation}}}]\n").expect


def test_the_words_are_those_that_the_flight_computer_and_the_daemon_say():
    assert words_of("board.mode") == tuple(MODES.values())
    assert words_of("board.reset_cause") == tuple(CAUSES.values())
    every = ArduinoStatusCommand(*(0xFF for _ in fields(ArduinoStatusCommand))).reset_causes
    assert set(every.split(", ")) | {"unknown"} == set(words_of("ground.arduino.reset_cause"))


@pytest.mark.parametrize(
    "text", ["", "[]", "3", "title: [", "a: &x 1\nb: *x\n", "\0", "- title: a"]
)
def test_what_is_no_scenario_is_refused_in_a_sentence(text):
    assert all(re.match(r"flight\.yml:\d+:\d+: .", line) for line in problems(text))


def test_an_airframe_may_be_a_folder_here_or_beside_the_scenario(tmp_path, monkeypatch):
    (tmp_path / "big").mkdir()
    file = tmp_path / "flight.yml"
    file.write_text(f"{HEAD}airframe: big\n{EXPECT}")
    assert read_scenario(file).airframe == str(tmp_path / "big")
    monkeypatch.chdir(tmp_path)
    assert read_scenario("flight.yml").airframe == "big"
    (tmp_path / "big").rmdir()
    with pytest.raises(ConfigErrors, match="there is no airframe 'big'"):
        read_scenario(file)


def test_a_missing_file_is_told(tmp_path):
    with pytest.raises(ConfigErrors, match=r"nowhere\.yml:1:1: there is no such file"):
        read_scenario(tmp_path / "nowhere.yml")


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


@settings(max_examples=400, deadline=None)
@given(mutations())
def test_any_mutation_is_a_scenario_or_mistakes_with_places(text):
    try:
        read = parse_scenario(text.encode("utf-8", "surrogatepass"), "flight.yml")
    except ConfigErrors as errors:
        assert errors.problems
        for problem in errors.problems:
            assert problem.line >= 1 and problem.column >= 1 and problem.what
            assert "\n" not in str(problem)
    else:
        assert isinstance(read, Scenario)


@given(st.binary(max_size=200))
def test_any_bytes_are_a_scenario_or_mistakes(data):
    with pytest.raises(ConfigErrors):
        parse_scenario(data)
