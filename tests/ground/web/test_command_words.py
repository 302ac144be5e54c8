"""Events of Commands, in words."""

import pytest

from up_ground.web.answers import Answer, in_words

ACK = Answer("ack", "", "")
NACK = Answer("nack", "forbidden", "not in flight")
BOARD = Answer("nack", "refused", "the Arduino refused: the throttle is not low")
BEFORE = {"ratePIDs": {"ailerons": {"p": 3.0, "i": 0.0, "d": 0.0}}}
AFTER = {"ratePIDs": {"ailerons": {"p": 2.4, "i": 0.0, "d": 0.0}}}


@pytest.mark.parametrize(
    ("name", "data", "answer", "kind", "text"),
    [
        ("up.arm", {}, ACK, "command", "page 2: Arm carried out"),
        ("up.arm", {}, NACK, "command", "page 2: Arm refused by the aircraft: not in flight"),
        (
            "up.disarm",
            {},
            BOARD,
            "command",
            "page 2: Disarm refused by the Arduino: the throttle is not low",
        ),
        (
            "up.telemetry.frequency",
            {"frequency": 100},
            ACK,
            "command",
            "page 2: Telemetry every 100 ms carried out",
        ),
        ("android.speak", {"text": "{0.x}_"}, ACK, "command", 'page 2: Echo "{0.x}_" carried out'),
        ("a.cog", {"text": 1}, ACK, "command", "page 2: a.cog carried out"),
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
            "page 2: gains (rate roll P 3 to 2.4) refused by the aircraft: not in flight",
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
            "page 2: Ask for the gains carried out",
        ),
        ("black_box.mark", {"text": "gust"}, ACK, "mark", "page 2 marks: gust"),
        (
            "black_box.mark",
            {"text": "gust"},
            NACK,
            "mark",
            "page 2: the mark gust refused by the aircraft: not in flight",
        ),
    ],
)
def test_words(name, data, answer, kind, text):
    assert in_words("page 2", name, data, BEFORE, answer) == (kind, text)
