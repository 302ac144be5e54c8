import fcntl
import os
import pty
import select
import struct
import termios

import pytest

from up.protocols.serial_port import SerialPortError, close_serial, open_serial


@pytest.fixture
def port():
    """Return a master and the path of its slave, on which HUPCL and echo are set."""
    master, slave = pty.openpty()
    attributes = termios.tcgetattr(slave)
    attributes[2] |= termios.HUPCL | termios.CRTSCTS
    termios.tcsetattr(slave, termios.TCSANOW, attributes)
    yield master, os.ttyname(slave)
    os.close(slave)
    os.close(master)


def refused(code, path, baud=9600):
    with pytest.raises(SerialPortError) as error:
        open_serial(str(path), baud)
    assert error.value.code == code


@pytest.mark.parametrize(("baud", "speed"), [(9600, termios.B9600), (115200, termios.B115200)])
def test_the_port_is_raw_8n1_without_flow_control_and_hupcl(port, baud, speed):
    descriptor = open_serial(port[1], baud)
    try:
        iflag, oflag, cflag, lflag, ispeed, ospeed, cc = termios.tcgetattr(descriptor)
        assert not cflag & termios.HUPCL
        assert not cflag & (termios.CRTSCTS | termios.PARENB | termios.CSTOPB)
        assert cflag & termios.CSIZE == termios.CS8
        assert cflag & termios.CREAD
        assert cflag & termios.CLOCAL
        assert not lflag & (termios.ECHO | termios.ICANON | termios.ISIG | termios.IEXTEN)
        assert not iflag & (termios.IXON | termios.IXOFF | termios.ICRNL | termios.ISTRIP)
        assert not oflag & termios.OPOST
        assert (ispeed, ospeed) == (speed, speed)
        assert (cc[termios.VMIN], cc[termios.VTIME]) in ((1, 0), (b"\x01", b"\x00"))
        assert not os.get_blocking(descriptor)
        assert not os.get_inheritable(descriptor)
    finally:
        close_serial(descriptor)


def test_every_byte_passes_unchanged_both_ways(port):
    master, path = port
    descriptor = open_serial(path, 115200)
    try:
        every = bytes(range(256))
        os.write(master, every)
        assert read(descriptor, 256) == every
        os.write(descriptor, every)
        assert read(master, 256) == every
    finally:
        close_serial(descriptor)


def test_bytes_from_before_opening_are_thrown_away(port):
    master, path = port
    close_serial(open_serial(path, 115200))
    os.write(master, b"old\n")
    descriptor = open_serial(path, 115200)
    try:
        os.write(master, b"new")
        assert read(descriptor, 3) == b"new"
    finally:
        close_serial(descriptor)


def read(descriptor, size):
    data = b""
    while len(data) < size:
        assert select.select([descriptor], [], [], 10)[0]
        data += os.read(descriptor, size - len(data))
    return data


def test_a_port_in_use_is_refused_and_free_again_after_closing(port):
    descriptor = open_serial(port[1], 9600)
    refused("port_in_use", port[1])
    close_serial(descriptor)
    close_serial(open_serial(port[1], 9600))


def test_a_missing_port_is_refused(tmp_path):
    refused("port_missing", tmp_path / "ttyUSB9")


def test_what_is_no_port_is_refused(tmp_path):
    path = tmp_path / "file"
    path.write_bytes(b"")
    before = len(os.listdir("/proc/self/fd"))  # noqa: PTH208
    refused("not_a_port", path)
    refused("port_unusable", tmp_path)
    refused("port_unusable", "with\0zero")
    assert len(os.listdir("/proc/self/fd")) == before  # noqa: PTH208


def test_a_speed_that_is_none_is_refused(port):
    for baud in (0, -1, 1 << 32):
        refused("speed_unsupported", port[1], baud)


def test_a_speed_without_a_name_is_set(port):
    descriptor = open_serial(port[1], 420000)
    try:
        found = fcntl.ioctl(descriptor, 0x802C542A, bytes(44))
        assert struct.unpack("=2I", found[36:]) == (420000, 420000)
        assert termios.tcgetattr(descriptor)[3] == 0, "it stays raw"
    finally:
        close_serial(descriptor)


def test_a_port_without_permission_names_the_group(tmp_path):
    path = tmp_path / "ttyACM0"
    path.touch(mode=0)
    is_root = os.geteuid() == 0
    if is_root:
        os.seteuid(65534)
    try:
        refused("permission_denied", path)
    finally:
        if is_root:
            os.seteuid(0)
