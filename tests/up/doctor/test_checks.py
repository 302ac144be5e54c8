"""What the doctor finds on a machine: a folder in place of the root, and fixed system calls."""

import json

import pytest

from up.doctor import checks, verb
from up.doctor.machine import Machine
from up.version import BUILT_S


class OtherMachine(Machine):
    """A healthy machine; a test makes it ill."""

    def __init__(self, root):
        super().__init__(root)
        self.root = root
        self.closed, self.limit, self.synchronised = (), 50, True
        self.free, self.now_s, self.said = 10**10, BUILT_S + 1, ""

    def write(self, path, text):
        (self.root / path).parent.mkdir(parents=True, exist_ok=True)
        (self.root / path).write_text(text)
        return self

    def pi(self):
        return self.write("proc/device-tree/model", "Raspberry Pi 4 Model B Rev 1.4\0")

    def can_open(self, path):
        return path.name not in self.closed

    def group_of(self, path):
        return "dialout"

    def realtime_limit(self):
        return self.limit

    def is_clock_synchronised(self):
        return self.synchronised

    def free_bytes(self, folder):
        return self.free

    def wall_clock_s(self):
        return self.now_s

    def output(self, command):
        return self.said if command == ["vcgencmd", "get_throttled"] else ""


@pytest.fixture
def machine(tmp_path):
    return OtherMachine(tmp_path).write("dev/ttyUSB0", "")


def states(machine, *names):
    rows = [row for row in checks.examine(machine) if not names or row.code in names]
    assert all(row.remedy for row in rows if row.state in ("warning", "error"))
    return {row.code: row.state for row in rows}


def test_a_machine_that_is_not_a_pi(machine):
    machine.write("proc/cmdline", "console=ttyS0,115200")
    found = states(machine)
    assert set(found.values()) == {"ok", "not applicable"}
    assert [code for code, state in found.items() if state == "not applicable"] == [
        "serial_console",
        "power",
    ]


def test_serial_ports(machine):
    machine.closed = ("ttyUSB0",)
    (row,) = (row for row in checks.examine(machine) if row.code == "serial_port")
    assert row.state == "error" and "dialout" in row.remedy
    machine.write("dev/serial0", "")
    rows = [row.state for row in checks.examine(machine) if row.code == "serial_port"]
    assert sorted(rows) == ["error", "ok"]
    (machine.root / "dev/ttyUSB0").unlink()
    (machine.root / "dev/serial0").unlink()
    assert states(machine, "serial_port") == {"serial_port": "warning"}


@pytest.mark.parametrize(
    ("line", "state"),
    [
        ("console=serial0,115200 console=tty1 root=PARTUUID=1", "error"),
        ("console=ttyAMA0 quiet", "error"),
        ("console=tty1 quiet", "ok"),
    ],
)
def test_the_login_console_on_the_uart(machine, line, state):
    machine.pi().write("proc/cmdline", line)
    assert states(machine, "serial_console") == {"serial_console": state}


@pytest.mark.parametrize(
    ("said", "state"),
    [
        ("throttled=0x0", "ok"),
        ("throttled=0x50000", "warning"),
        ("throttled=0x50005", "error"),
        ("", "warning"),
        ("VCHI initialization failed", "warning"),
    ],
)
def test_power(machine, said, state):
    machine.pi().said = said
    assert states(machine, "power") == {"power": state}


def test_the_kernels_own_file_of_throttling_comes_first(machine):
    machine.pi().write("sys/devices/platform/soc/soc:firmware/get_throttled", "50005\n")
    assert states(machine, "power") == {"power": "error"}


@pytest.mark.parametrize(
    ("attribute", "value", "code", "state"),
    [
        ("synchronised", False, "clock", "warning"),
        ("now_s", BUILT_S - 1, "clock", "error"),
        ("limit", 0, "realtime", "warning"),
        ("free", checks.LOW_FREE_BYTES - 1, "disk", "warning"),
        ("free", checks.MIN_FREE_BYTES - 1, "disk", "error"),
    ],
)
def test_clock_priority_and_disk(machine, attribute, value, code, state):
    setattr(machine, attribute, value)
    assert states(machine, code) == {code: state}


def test_a_package_that_is_missing_or_too_old(machine, monkeypatch):
    wanted = ["twisted>=99", "up-nowhere>=1", 'autobahn>=999; extra == "ground"']
    monkeypatch.setattr(checks.importlib.metadata, "requires", lambda name: wanted)
    (row,) = (row for row in checks.examine(machine) if row.code == "packages")
    assert row.state == "error"
    assert "twisted" in row.text and "up-nowhere" in row.text and "autobahn" not in row.text


def test_the_verb(machine, monkeypatch, capsys):
    from up.cli.main import main

    monkeypatch.setattr(verb, "Machine", lambda: machine)
    assert main(["doctor"]) == 0 and "serial_port" in capsys.readouterr().out
    machine.closed = ("ttyUSB0",)
    assert main(["doctor", "--json"]) == 1
    rows = json.loads(capsys.readouterr().out)
    assert {"code", "state", "text", "remedy"} == set(rows[0])
    assert [row["code"] for row in rows if row["state"] == "error"] == ["serial_port"]
    with pytest.raises(SystemExit) as end:
        main(["doctor", "--jsn"])
    assert end.value.code == 2


def test_this_machine(tmp_path):
    """The real system calls."""
    machine = Machine()
    assert isinstance(machine.is_clock_synchronised(), bool)
    assert machine.free_bytes(tmp_path / "not" / "there") > 0
    assert 0 <= machine.realtime_limit() <= 99
    assert machine.output(["/nonexistent"]) == "" and machine.read("nonexistent") == ""
    assert machine.output(["echo", "yes"]) == "yes"
