from pathlib import Path

import pytest
from serial_cog.config import ARDUINO, SerialConfig, odd_speed

from up.config import ConfigErrors


def test_the_prototypes_file_is_read():
    values = ARDUINO.parse("port: /dev/ttyAMA0\nbaud_rate: 9600\n", Path("arduino.yml"))
    assert (values.port, values.baud_rate, values.framing) == ("/dev/ttyAMA0", 9600, "checked")


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("framing: bare\n", "framing"),
        ("baud_rate: 1200\n", "baud_rate"),
        ("wait_for_arduino: true\n", "wait_for_arduino"),
        ("prot: /dev/ttyUSB0\n", "prot"),
    ],
)
def test_mistakes_are_named(text, says):
    with pytest.raises(ConfigErrors, match=says):
        ARDUINO.parse(text, Path("arduino.yml"))


def test_framings_and_speeds_that_seldom_go_together_are_said():
    assert odd_speed(SerialConfig(framing="thesis"))
    assert odd_speed(SerialConfig(baud_rate=9600))
    assert not odd_speed(SerialConfig())
    assert not odd_speed(SerialConfig(framing="thesis", baud_rate=9600))
