import json

from hypothesis import example, given, settings
from hypothesis import strategies as st

from up.flight_log.json_message import decode, decode_all

VALUES = st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5)
OBJECTS = st.dictionaries(
    st.text(max_size=4),
    VALUES | st.lists(VALUES, max_size=2) | st.dictionaries(st.text(max_size=3), VALUES),
)
FRAGMENTS = st.sampled_from(
    [
        b"",
        b"{",
        b"}",
        b'{"a":1},{"b":2}',
        b'{"a":',
        b"1}",
        b'{"a":1e999}',
        b'{"a":"\\ud800"}',
        b"[]",
        b"1",
        b"\xff",
    ]
)


@settings(deadline=None)
@given(st.lists(OBJECTS.map(lambda each: json.dumps(each).encode()) | FRAGMENTS, max_size=6))
@example([b'{"a":1},{"b":2}', b'{"c":', b"3}"])
@example([b'{"a":1},{"b":2', b"}"])
@example([b'{"a":"', b'"}'])
def test_messages_together_are_as_each_alone(messages):
    for message, found in zip(messages, decode_all(messages), strict=True):
        try:
            alone = decode(message)
        except ValueError as error:
            assert (type(found), str(found)) == (ValueError, str(error))
        else:
            assert found == alone
