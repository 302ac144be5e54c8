"""The Up Library reads and writes General Messages and Commands as Python does."""

from __future__ import annotations

import dataclasses
import json
import subprocess
import typing
from pathlib import Path

import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from tests.support.java import JARS, java_program
from tests.support.tools import need_tool
from tests.support.waiting import HANG_S
from up.commands.command import InvalidCommandError, constraint_of, wire_fields
from up.protocols.general_message import MalformedMessage, decode, encode
from up_ground.catalogue import Catalogue

ANDROID = Path(__file__).parents[2] / "android"
WIRE_TESTS = ANDROID / "core" / "test" / "org" / "raspilot" / "up" / "wire"
MAIN = "org.raspilot.up.wire.JsonEcho"
LONG = 2**63
TYPED = (
    "android.battery",
    "android.speak",
    "arduino.pids.tunings",
    "black_box.mark",
    "black_box.record",
    "load_guard.panic",
    "up.ack",
    "up.altitude.change",
    "up.arm",
    "up.disarm",
    "up.flight_mode.set",
    "up.heading.change",
    "up.location.change",
    "up.location.update",
    "up.nack",
    "up.panic",
    "up.telemetry.frequency",
)
"""Commands that both sides know with the same fields."""
ANY_DATA = settings(
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
)


class Echo:
    """A JVM that prints how the Up Library parses a line."""

    def __init__(self, command):
        self._jvm = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)

    def ask(self, line):
        """Return the answer to the bytes of a line."""
        self._jvm.stdin.write(line.hex().encode() + b"\n")
        self._jvm.stdin.flush()
        answer = self._jvm.stdout.readline()
        assert answer, f"the JVM ended on {line!r}"
        return json.loads(answer)

    def close(self):
        """End the JVM."""
        self._jvm.stdin.close()
        self._jvm.stdout.close()
        assert self._jvm.wait(60) == 0


@pytest.fixture(scope="module")
def echo(tmp_path_factory):
    """Return one JVM for all the lines of this file."""
    need_tool("javac", "default-jdk-headless")
    program = java_program()
    core = ANDROID / "build" / JARS[0]
    classes = tmp_path_factory.mktemp("echo")
    sources = [str(WIRE_TESTS / f"{name}.java") for name in ("JsonEcho", "Vectors")]
    javac = [str(ANDROID / "tools" / "javac"), "-cp", str(core), "-d", str(classes), *sources]
    done = subprocess.run(javac, capture_output=True, text=True, timeout=HANG_S)
    assert done.returncode == 0, done.stderr
    echo = Echo([program.java, "-Xshare:auto", "-Xmx128m", "-cp", f"{classes}:{core}", MAIN])
    yield echo
    echo.close()


def check(echo, line):
    """Compare the Up Library's result for a line with Python's."""
    said = echo.ask(line)
    try:
        message = decode(line)
    except MalformedMessage as malformed:
        assert "malformed" in said, f"Python refuses {line!r}: {malformed.reason}"
        assert said["id"] == malformed.id
        return None
    if message.beacon is not None and not -LONG <= message.beacon < LONG:
        # The one difference: a phone counts beacons in 64 bits.
        assert said["id"] == message.id
        assert said["malformed"] == "beacon"
        return None
    assert "malformed" not in said, f"Python reads {line!r}; Java: {said['malformed']}"
    try:
        wanted = encode(message.name, message.data, message.id, message.beacon).decode("ascii")
    except ValueError:
        wanted = None
    assert said["line"] == wanted
    return message, said["invalid"]


# Numbers as they are written, not as they are held: the many forms are what differs.
NUMBERS = st.one_of(
    st.integers().map(str),
    st.integers(-(2**70), 2**70).map(str),
    st.floats(allow_nan=False, allow_infinity=False).map(repr),
    st.from_regex(r"-?(0|[1-9][0-9]{0,24})(\.[0-9]{1,25})?([eE][+-]?[0-9]{1,3})?", fullmatch=True),
    st.sampled_from(["-0", "-0.0", "NaN", "-Infinity", "1e999", "01", "1.", ".5", "-", "0x1"]),
)
QUOTED = st.one_of(
    st.text(max_size=20).map(json.dumps),
    st.text(max_size=20).map(lambda text: json.dumps(text, ensure_ascii=False)),
    st.lists(
        st.sampled_from(
            ["\\ud83d", "\\uDE00", "\\n", "\\/", "\\x", "\\u00", "a", "\x7f", "\t", "č"]
        ),
        max_size=6,
    ).map(lambda pieces: f'"{"".join(pieces)}"'),
)
SPACE = st.sampled_from(["", "", "", " ", "\t", "\n", "\r", "\u00a0"])
SCALARS = st.one_of(NUMBERS, QUOTED, st.sampled_from(["null", "true", "false", "nul", "True"]))
VALUES = st.recursive(
    SCALARS,
    lambda inner: st.one_of(
        st.lists(inner, max_size=4).map(lambda items: f"[{','.join(items)}]"),
        st.lists(st.tuples(QUOTED, SPACE, inner), max_size=4).map(
            lambda pairs: "{" + ",".join(f"{k}{s}:{s}{v}" for k, s, v in pairs) + "}"
        ),
    ),
    max_leaves=12,
)
FIELD_NAMES = st.sampled_from(['"name"', '"data"', '"id"', '"beacon"', '"\\u0069d"', '"extra"'])
LINES = st.one_of(
    # Mostly whole messages, then messages of any fields, then anything.
    st.builds(
        '{{"name": {}, "data": {{"x": {}}}, "id": {}, "beacon": {}}}'.format,
        QUOTED,
        VALUES,
        st.one_of(QUOTED, NUMBERS, st.just("null")),
        st.one_of(st.integers().map(str), st.just("null")),
    ),
    st.lists(st.tuples(FIELD_NAMES, VALUES), max_size=6).map(
        lambda pairs: "{" + ", ".join(f"{key}: {value}" for key, value in pairs) + "}"
    ),
    VALUES,
    st.lists(st.sampled_from([*'{}[],:"\\-.0e', '"id":', "1", "null", " ", "\x00"])).map("".join),
)
# A text with a lone surrogate has no UTF-8 form: as bytes it has.
BYTES = st.one_of(LINES.map(lambda text: text.encode("utf-8", "surrogatepass")), st.binary())


@ANY_DATA
@given(line=BYTES)
@example(b"")
@example(b'\xef\xbb\xbf{"name": "a"}')
@example(b'{"name": "a", "id": 1e16, "data": NaN}')
@example(b'{"name": "\x7f\\u0000\\b\\f\\/\xc2\x80\xe2\x80\xa8\\ud83d\\ude00", "id": -0.0}')
@example(b'{"name": "a", "data": {"x": ' + b"[" * 30 + b"]" * 30 + b"}}")
@example(b'{"name": "a", "data": {"x": ' + b"[" * 31 + b"]" * 31 + b"}, " + b'"id": 7}')
@example(b'{"name": "a", "data": {"x": "' + "\U0001f600".encode() * 4000 + b'"}}')
@example(b'{"name": "a"}' + b" " * 16371)
@example(b'{"name": "a"}' + b" " * 16372)
def test_a_line_is_the_same_message_or_none(echo, line):
    check(echo, line)


@ANY_DATA
@given(line=BYTES, at=st.integers(0, 200), cut=st.integers(0, 3), piece=st.binary(max_size=3))
def test_a_damaged_line_is_the_same_message_or_none(echo, line, at, cut, piece):
    check(echo, line[:at] + piece + line[at + cut :])


@settings(ANY_DATA)
@given(number=st.floats(allow_nan=False, allow_infinity=False))
@example(5e-324)
@example(2**-1074 * 3)
@example(2.0**60)
@example(9007199254740993.0)
@example(2.2250738585072014e-308)
def test_a_number_is_written_the_same(echo, number):
    read = check(echo, encode("n", {"x": number, "above": _next(number)}))
    assert read is not None


def _next(number):
    """Return a number beside it, where the shortest digits change."""
    return number * (1 + 2**-52) if abs(number) < 1e300 else 0.0


CATALOGUE = Catalogue.installed()


@st.composite
def commands(draw):
    """Return a name of TYPED and data that are right, or wrong in one field or two."""
    name = draw(st.sampled_from(TYPED))
    if name == "arduino.pids.tunings":
        return name, draw(pid_tunings())
    constraints = constraints_of(name)
    wrong = draw(st.sets(st.sampled_from(list(constraints)), max_size=2)) if constraints else set()
    data = {}
    for key, constraint in constraints.items():
        if key not in wrong:
            data[key] = draw(st.sampled_from(right_values(constraint)))
        elif draw(st.booleans()):
            data[key] = draw(st.sampled_from(other_values(constraint)) | st.text(max_size=8))
    return name, data


def constraints_of(name):
    """Return the rule of each field of a Command, by its name on the wire."""
    cls = CATALOGUE.get(name)
    hints = typing.get_type_hints(cls)
    constraints = {field.name: constraint_of(field, hints) for field in dataclasses.fields(cls)}
    return {key: constraints[attribute] for attribute, key, _ in wire_fields(cls)}


def right_values(constraint):
    """Return values that a field takes, its bounds above all; the first suits any Command."""
    if constraint.choices is not None:
        return constraint.choices
    if constraint.type_ in (int, float):
        low = -1e6 if constraint.minimum is None else constraint.minimum
        high = 1e6 if constraint.maximum is None else constraint.maximum
        middle = [low, high, int(low) + 1, *([low + 0.5] if constraint.type_ is float else [])]
        return [*middle, *([None] if constraint.nullable else [])]
    if constraint.type_ is str:
        length = constraint.max_length or 1
        return ["a.b", "a" * length, "\U0001f600" * length, "companion.air_1"]
    return [True, False] if constraint.type_ is bool else [{}, {"a": [1]}]


def other_values(constraint):
    """Return values just beyond the bounds of a field, and of other types."""
    bounds = [b for b in (constraint.minimum, constraint.maximum) if b is not None]
    length = (constraint.max_length or 5) + 1
    beside = [b + by for b in bounds for by in (-1, 1, -1e-9, 1e-9, 0.0)]
    types = [None, True, False, "", " ", "\u2003\x1c", [], {}, {"a": 1}, 0, 7.5, 2**64, -(2**63)]
    return [*beside, *types, "a" * length, "\U0001f600" * length, "A.b", "a.", "fbw", "-1"]


def pid_tunings():
    """Return data of the Command that sets gains."""
    gain = st.sampled_from([0, 50, 1.5, 50.01, -1e-9, None, "1", True])
    good = st.sampled_from([0, 50, 1.5])
    gains = st.one_of(
        st.fixed_dictionaries({"p": good, "i": good, "d": good}),
        st.fixed_dictionaries({"p": good, "i": good, "d": good}),
        st.dictionaries(st.sampled_from(["p", "i", "d", "x"]), gain),
    )
    loop = st.one_of(
        st.fixed_dictionaries({"ailerons": gains, "elevator": gains}),
        st.fixed_dictionaries({"ailerons": gains, "elevator": gains, "rudder": gains}),
        st.dictionaries(st.sampled_from(["ailerons", "elevator", "rudder", "x"]), gains),
        st.sampled_from([None, 1]),
    )
    pids = st.one_of(
        st.fixed_dictionaries({"ratePIDs": loop, "stabPIDs": loop}),
        st.fixed_dictionaries({"ratePIDs": loop, "stabPIDs": loop, "navPIDs": loop}),
        st.dictionaries(st.sampled_from(["ratePIDs", "stabPIDs", "x"]), loop),
    )
    flag = st.sampled_from([True, False, None, 1])
    return st.one_of(
        st.fixed_dictionaries({"pids": pids}),
        st.fixed_dictionaries({"request": flag}),
        st.fixed_dictionaries({"request": flag, "pids": pids}),
    )


def check_command(echo, name, data):
    """Hold the Up Library's judgment of a Command's data against Python's."""
    message, complaint = check(echo, encode(name, data))
    try:
        CATALOGUE.get(name).from_data(message.data)
    except InvalidCommandError as error:
        # The phone accepts a longer or shorter delay of Panic Mode, as an older Raspberry Pi sends
        # it.
        if "panic" in name and str(error).startswith("delay_ms"):
            return
        assert complaint is not None, f"Python refuses {name} {data}: {error}"
        return
    assert complaint is None, f"Python takes {name} {data}"


@settings(ANY_DATA)
@given(command=commands())
def test_a_command_is_valid_on_both_sides_or_on_none(echo, command):
    check_command(echo, *command)


@pytest.mark.parametrize("name", [name for name in TYPED if name != "arduino.pids.tunings"])
def test_the_bounds_of_every_field_are_the_same(echo, name):
    constraints = constraints_of(name)
    right = {key: right_values(constraint)[0] for key, constraint in constraints.items()}
    check_command(echo, name, right)
    for key, constraint in constraints.items():
        for value in (*right_values(constraint), *other_values(constraint)):
            check_command(echo, name, {**right, key: value})
        check_command(echo, name, {other: right[other] for other in right if other != key})


def test_every_typed_command_is_typed_in_java(echo):
    for name in TYPED:
        # Wrong for every Command that has fields; one that was not known would be taken.
        _, complaint = check(echo, encode(name, {"mode": 5}))
        assert (complaint is None) == (not wire_fields(CATALOGUE.get(name))), name
