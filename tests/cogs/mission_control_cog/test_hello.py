"""The first line to the proxy and its answer."""

import json
from pathlib import Path

from hypothesis import given
from hypothesis import strategies as st
from mission_control_cog.hello import HelloAnswer, hello_line, parse_answer

TOKEN = "0123456789abcdef" * 2


def test_the_line_says_who_and_the_token_of_the_last_link():
    assert hello_line("glider-1", "") == b"UP1 aircraft=glider-1\n"
    assert hello_line("g", TOKEN) == f"UP1 aircraft=g token={TOKEN}\n".encode()


def test_the_answers_are_understood():
    ok = f"UP1 ok aircraft=g seat=air token={TOKEN}".encode()
    assert parse_answer(ok) == HelloAnswer(token=TOKEN)
    assert parse_answer(ok + b"\r") == HelloAnswer(token=TOKEN)
    assert parse_answer(b"UP1 ok aircraft=g seat=air") == HelloAnswer()
    assert parse_answer(b"UP1 ok token=zz") == HelloAnswer()
    refused = parse_answer(b'UP1 error code=taken reason="an aircraft is there"')
    assert refused == HelloAnswer(error="taken", reason="an aircraft is there")
    for other in (b"", b"{}", b"UP1", b"UP1 okay", b"UP1 seat listen", b"UP1 error code=x"):
        assert parse_answer(other) is None


@given(st.binary(max_size=600))
def test_whatever_comes_is_an_answer_or_none(line):
    for each in (line, b"UP1 ok " + line, b"UP1 error code=a reason=" + line):
        answer = parse_answer(each)
        assert answer is None or isinstance(answer, HelloAnswer)
        if answer is not None and answer.token:
            assert set(answer.token) <= set("0123456789abcdef")


def test_the_golden_lines_of_the_airborne_side():
    path = Path(__file__).parents[2] / "vectors" / "proxy_hello.json"
    vectors = json.loads(path.read_text(encoding="utf-8"))["vectors"]
    mine = [each for each in vectors if each["side"] == "air" and "error" not in each]
    assert mine
    for each in mine:
        assert hello_line(each["aircraft"], each["token"] or "") == each["line"].encode()
