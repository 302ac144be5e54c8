from types import SimpleNamespace

import pytest
from serial_cog import port_opener
from serial_cog.port_opener import PortOpener, UsbId, find

from up.protocols.serial_port import SerialPortError


def port(device, vid=None, pid=0x1, serial=None):
    return SimpleNamespace(device=device, vid=vid, pid=pid, serial_number=serial)


UNO = port("/dev/ttyACM0", 0x2341, 0x43, "A")
NANO = port("/dev/ttyUSB3", 0x1A86, 0x7523)
FTDI = port("/dev/ttyUSB1", 0x0403, 0x6001, "F")
ORG = port("/dev/ttyACM7", 0x2A03, 0x43, "O")
UART = port("/dev/ttyAMA0")
MODEM = port("/dev/ttyUSB0", 0x12D1, 0x1506, "M")


def opener(ports, *, refuses=(), port_name=""):
    opened = []

    def open_port(path, baud):
        if path in refuses:
            raise SerialPortError(f"{path} is taken", "port_in_use")
        opened.append(path)
        return len(opened)

    made = PortOpener(port_name, 115200, lambda: list(ports), open_port)
    return made, opened


def test_every_known_vendor_is_found_and_nothing_else():
    found = find([MODEM, UART, FTDI, NANO, UNO, ORG], None)
    assert found == [UNO, ORG, FTDI, NANO]


def test_the_device_that_was_used_before_comes_first():
    assert find([UNO, NANO], UsbId.of(NANO)) == [NANO, UNO]


def test_two_of_a_kind_are_told_apart_by_their_serial_number():
    other = port("/dev/ttyACM1", 0x2341, 0x43, "B")
    assert find([UNO, other], UsbId.of(other)) == [other, UNO]


def test_without_an_arduino_it_says_what_it_looks_for():
    made, _ = opener([MODEM, UART])
    with pytest.raises(SerialPortError) as error:
        made()
    assert error.value.code == "port_missing"


def test_a_device_that_came_back_under_another_name_is_opened_again():
    ports = [UNO, FTDI]
    made, opened = opener(ports)
    made()
    ports[:] = [port("/dev/ttyACM5", 0x2341, 0x43, "A"), FTDI]
    made()
    assert opened == ["/dev/ttyACM0", "/dev/ttyACM5"]


@pytest.mark.parametrize(
    ("renamed", "then"),
    [([port("/dev/ttyUSB91", 0x1A86, 0x7523)], "/dev/ttyUSB91"), ([], "/dev/ttyUSB90")],
)
def test_a_configured_port_is_found_by_its_id_and_never_exchanged(renamed, then):
    ports = [port("/dev/ttyUSB90", 0x1A86, 0x7523)]
    made, opened = opener(ports, port_name="/dev/ttyUSB90")
    made()
    ports[:] = [UNO, *renamed]
    made()
    assert opened == ["/dev/ttyUSB90", then]
    assert not made.has_another()


def test_a_port_in_use_is_left_for_the_next_one():
    made, opened = opener([UNO, NANO], refuses={"/dev/ttyACM0"})
    made()
    assert opened == ["/dev/ttyUSB3"]
    with pytest.raises(SerialPortError) as caught:
        opener([UNO], refuses={"/dev/ttyACM0"})[0]()
    assert caught.value.code == "port_in_use"


def test_silent_ports_are_passed_over_in_turn():
    made, opened = opener([UNO, NANO])
    for _ in range(4):
        made()
        assert made.has_another()
        made.pass_over()
    assert opened == ["/dev/ttyACM0", "/dev/ttyUSB3", "/dev/ttyACM0", "/dev/ttyUSB3"]


def test_a_single_port_is_kept_however_silent():
    made, _ = opener([UNO])
    made()
    assert not made.has_another()


def test_without_anything_at_usb_the_ports_are_not_listed(tmp_path, monkeypatch):
    (tmp_path / "ttyS0").touch()
    monkeypatch.setattr(port_opener, "TTYS", tmp_path)
    asked = []
    monkeypatch.setattr("serial.tools.list_ports.comports", lambda: asked.append(1) or [UNO])
    assert list(port_opener.list_ports()) == []
    assert not asked
    for name in ("ttyACM0", "ttyUSB0"):
        (tmp_path / name).touch()
        assert list(port_opener.list_ports()) == [UNO]
        (tmp_path / name).unlink()
    monkeypatch.setattr(port_opener, "TTYS", tmp_path / "a system without it")
    assert list(port_opener.list_ports()) == [UNO]
