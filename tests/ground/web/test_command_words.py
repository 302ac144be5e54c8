"""Events of Commands, in words."""

import pytest

from up_ground.web.answers import Answer
from up_ground.web.command_words import in_words

ACK = Answer("ack", "", "")
NACK = Answer("nack", "forbidden", "not in flight")
BEFORE = {"ratePIDs": {"ailerons": {"p": 3.0, "i": 0.0, "d": 0.0}}}
AFTER = {"ratePIDs": {"ailerons": {"p": 2.4, "i": 0.0, "d": 0.0}}}


@pytest.mark.parametrize(
    ("name", "data", "answer", "kind", "text"),
    [
        ("up.arm", {}, ACK, "command", "page 2: up.arm carried out"),
        ("up.arm", {}, NACK, "command", "page 2: up.arm refused: not in flight (forbidden)"),
        (
            "arduino.pids.tunings",
            {"pids": AFTER},
            ACK,
            "gains",
            "page 2 changed gains: rate roll P 3 to 2.4",
        ),
        (
            "arduino.pids.tunings",
            {"pids": AFTER},
            NACK,
            "gains",
            "page 2: gains (rate roll P 3 to 2.4) refused: not in flight (forbidden)",
        ),
        (
            "arduino.pids.tunings",
            {"pids": BEFORE},
            ACK,
            "gains",
            "page 2 changed gains: nothing differs",
        ),
        (
            "arduino.pids.tunings",
            {"request": True},
            ACK,
            "command",
            "page 2: arduino.pids.tunings carried out",
        ),
        ("black_box.mark", {"text": "gust"}, ACK, "mark", "page 2 marks: gust"),
        (
            "black_box.mark",
            {"text": "gust"},
            NACK,
            "mark",
            "page 2: the mark gust refused: not in flight (forbidden)",
        ),
    ],
)
def test_words(name, data, answer, kind, text):
    assert in_words("page 2", name, data, BEFORE, answer) == (kind, text)
