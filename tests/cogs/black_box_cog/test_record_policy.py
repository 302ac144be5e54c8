import pytest
from black_box_cog.commands.black_box_commands import MarkCommand, RecordCommand
from black_box_cog.ingest_queue import Recorded
from black_box_cog.record_policy import MAX_A_SECOND, MAX_BYTES, TOPICS_LIMIT, RecordPolicy
from hypothesis import given
from hypothesis import strategies as st
from twisted.internet.task import Clock

from up.commands.builtin import BUILTIN_COMMANDS
from up.commands.command import InvalidCommandError
from up.commands.command_registry import CommandRegistry
from up.commands.refusal import CommandRefusedError


@pytest.fixture
def policy():
    return RecordPolicy(CommandRegistry((*BUILTIN_COMMANDS, MarkCommand, RecordCommand)), Clock())


def test_an_object_is_recorded_under_its_topic(policy):
    command = RecordCommand.from_data({"topic": "companion.air", "content": {"speed": 12.5}})
    assert policy.checked(command) == Recorded("companion.air", '{"speed":12.5}')
    assert policy.checked(RecordCommand("a.b", {"x": float("nan")})).text == '{"x":null}'


@pytest.mark.parametrize(
    "topic",
    [
        "",
        "log",
        "Log.x",
        "a",
        "a..b",
        ".a.b",
        "a.b.",
        "/location",
        "a b.c",
        "ä.b",
        "a.b\n",
        "x." * 40,
    ],
)
def test_invalid_topics(topic):
    with pytest.raises(InvalidCommandError):
        RecordCommand.from_data({"topic": topic, "content": {}})


@pytest.mark.parametrize("topic", ["black_box.mark", "load_guard.panic", "up.rx.update", "up.new"])
def test_the_topic_of_a_command_stays_its_own(policy, topic):
    with pytest.raises(CommandRefusedError):
        policy.checked(RecordCommand(topic, {}))


def test_content_is_bounded(policy):
    with pytest.raises(CommandRefusedError):
        policy.checked(RecordCommand("a.b", {"x": "y" * MAX_BYTES}))
    with pytest.raises(CommandRefusedError):
        policy.checked(RecordCommand("a.b", {"_origin": "internal"}))
    deep = {}
    for _ in range(100_000):
        deep = {"x": deep}
    with pytest.raises(CommandRefusedError):
        policy.checked(RecordCommand("a.b", deep))


def test_topics_are_bounded(policy):
    for number in range(TOPICS_LIMIT):
        policy.checked(RecordCommand(f"a.b{number}", {}))
    with pytest.raises(CommandRefusedError):
        policy.checked(RecordCommand("a.more", {}))
    policy.checked(RecordCommand("a.b0", {}))


def test_the_rate_is_bounded():
    clock = Clock()
    policy = RecordPolicy(CommandRegistry(BUILTIN_COMMANDS), clock)
    for _ in range(MAX_A_SECOND):
        policy.checked(RecordCommand("a.b", {}))
    with pytest.raises(CommandRefusedError):
        policy.checked(RecordCommand("a.b", {}))
    clock.advance(1)
    policy.checked(RecordCommand("a.b", {}))


JSON = st.recursive(
    st.one_of(st.none(), st.booleans(), st.integers(), st.floats(), st.text()),
    lambda inner: st.one_of(st.lists(inner), st.dictionaries(st.text(), inner)),
    max_leaves=20,
)


@given(st.text(max_size=80), st.dictionaries(st.text(), JSON))
def test_any_record_is_taken_or_refused_in_a_sentence(topic, content):
    policy = RecordPolicy(CommandRegistry(BUILTIN_COMMANDS), Clock())
    try:
        taken = policy.checked(RecordCommand.from_data({"topic": topic, "content": content}))
    except (InvalidCommandError, CommandRefusedError) as error:
        assert str(error)
    else:
        assert taken.topic == topic and taken.text.startswith("{")


@pytest.mark.parametrize("text", ["", "   ", "\n"])
def test_a_mark_needs_a_text(text):
    with pytest.raises(InvalidCommandError):
        MarkCommand.from_data({"text": text})
