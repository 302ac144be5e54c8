"""An image with the partitions of Raspberry Pi OS, prepared and read back; it is not booted."""

import struct
import subprocess

import pytest

from tests.support.tools import need_tool
from tools.pi_image import HOOK, SECTOR, UART, main, pre_shared_key

BOOT, BOOT_SECTORS, ROOT_SECTORS = 2048, 8192, 8192
COMMAND = "console=serial0,115200 console=tty1 root=PARTUUID=4e639091-02 rootwait quiet\n"
CONFIG = "dtparam=audio=on\n[cm4]\notg_mode=1\n"
KEY = "ssh-ed25519 AAAAC3NzaC1lZDI1NTE5AAAAIBeUo+0zUQ pilot@field"


def entry(kind, begin, size):
    return struct.pack("<B3xB3xII", 0, kind, begin, size)


@pytest.fixture
def image(tmp_path):
    for tool in ("mformat", "mcopy", "mtype", "mdir", "mmd", "mdeltree"):
        need_tool(tool, "mtools")
    path = tmp_path / "pi.img"
    root = BOOT + BOOT_SECTORS
    with path.open("wb") as file:
        file.truncate((root + ROOT_SECTORS) * SECTOR)
        file.seek(446)
        file.write(entry(0x0C, BOOT, BOOT_SECTORS) + entry(0x83, root, ROOT_SECTORS) + bytes(32))
        file.write(b"\x55\xaa")
    drive = f"{path}@@{BOOT * SECTOR}"
    subprocess.run(["mformat", "-i", drive, "-T", str(BOOT_SECTORS), "::"], check=True)
    offset = f"offset={root * SECTOR}"
    size = f"{ROOT_SECTORS // 2}k"
    subprocess.run([need_tool("mke2fs", "e2fsprogs"), "-q", "-t", "ext4", "-E", offset, path, size],
                   check=True)  # fmt: skip
    for name, text in (("cmdline.txt", COMMAND), ("config.txt", CONFIG)):
        (tmp_path / name).write_text(text)
        subprocess.run(["mcopy", "-i", drive, tmp_path / name, f"::{name}"], check=True)
    (tmp_path / "key.pub").write_text(KEY + "\n")
    (tmp_path / "password").write_text("a long password\n")
    (tmp_path / "raspilot_0.1.0_arm64.deb").write_bytes(bytes(range(256)) * 40)
    return path


def prepared(image, *words):
    folder = image.parent
    return main([str(image), "--key", str(folder / "key.pub"), *map(str, words)])


def read(image, name):
    command = ["mtype", "-i", f"{image}@@{BOOT * SECTOR}", f"::{name}"]
    return subprocess.run(command, capture_output=True, check=True).stdout


def test_the_boot_partition_has_everything_and_the_root_is_untouched(image):
    folder, before = image.parent, image.read_bytes()
    package = folder / "raspilot_0.1.0_arm64.deb"
    words = ("--hostname", "plane", "--user", "pilot", "--deb", package, "--wifi", "Air field",
             "--wifi-password-file", folder / "password", "--country", "CZ")  # fmt: skip
    assert prepared(image, *words) == 0
    assert prepared(image, *words) == 0, "a second run replaces the first"
    after = image.read_bytes()
    assert after[: BOOT * SECTOR] == before[: BOOT * SECTOR]
    assert after[(BOOT + BOOT_SECTORS) * SECTOR :] == before[(BOOT + BOOT_SECTORS) * SECTOR :]
    command = read(image, "cmdline.txt").decode()
    assert command == f"console=tty1 root=PARTUUID=4e639091-02 rootwait quiet {HOOK}\n"
    config = read(image, "config.txt").decode()
    assert config.startswith(CONFIG) and all(config.count(line) == 1 for line in UART)
    assert read(image, f"raspilot/{package.name}") == package.read_bytes()
    script = read(image, "firstrun.sh").decode()
    assert KEY in script and "a long password" not in script
    subprocess.run(["sh", "-n"], input=script, text=True, check=True)
    # The line that writes the network, run for real.
    (line,) = (each for each in script.splitlines() if "nmconnection" in each)
    line = line.replace("/etc/NetworkManager/system-connections", str(folder))
    subprocess.run(["sh", "-c", line], check=True)
    network = folder / "raspilot.nmconnection"
    assert network.stat().st_mode & 0o777 == 0o600
    lines = network.read_text().splitlines()
    assert "ssid=Air field" in lines
    assert f"psk={pre_shared_key('Air field', 'a long password')}" in lines


def test_the_hook_is_removed_by_the_line_of_the_script(image):
    assert prepared(image) == 0
    script = read(image, "firstrun.sh").decode()
    (line,) = (each for each in script.splitlines() if "cmdline.txt" in each)
    file = image.parent / "cmdline.txt"
    file.write_bytes(read(image, "cmdline.txt"))
    subprocess.run(["sh", "-c", line.replace("/boot/firmware", str(image.parent))], check=True)
    assert file.read_text() == "console=tty1 root=PARTUUID=4e639091-02 rootwait quiet\n"


def test_the_key_of_the_network_is_that_of_the_standard():
    """IEEE 802.11i, H.4.1."""
    found = "f42c6fc52df0ebef9ebb4b90b38a5f902e83fe1b135a70e23aed762e9710a12e"
    assert pre_shared_key("IEEE", "password") == found


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (("--user", "Pi; reboot"), "--user"),
        (("--hostname", "plane one"), "--hostname"),
        (("--wifi", "field"), "--wifi-password-file"),
        (("--deb", "missing.deb"), "missing.deb"),
    ],
)
def test_a_wrong_setting_is_named_and_the_image_is_unchanged(image, capsys, words, named):
    before = image.read_bytes()
    assert prepared(image, *words) == 2
    error = capsys.readouterr().err
    assert named in error and error.count("\n") == 1
    assert image.read_bytes() == before


@pytest.mark.parametrize(
    ("change", "code"),
    [
        (lambda data: data[:100], "not_an_image"),
        (lambda data: b"\xfd7zXZ\x00" + data[6:510] + bytes(2), "not_an_image"),
        (lambda data: data[:450] + b"\x83" + data[451:], "wrong_partitions"),
        (lambda data: data[: 3000 * SECTOR], "cut_image"),
        (lambda data: data[: BOOT * SECTOR] + bytes(len(data) - BOOT * SECTOR), "boot_partition"),
    ],
)
def test_a_file_that_is_no_image_is_refused(image, monkeypatch, change, code):
    errors = []
    monkeypatch.setattr("tools.pi_image.print_problems", errors.extend)
    image.write_bytes(change(image.read_bytes()))
    before = image.read_bytes()
    assert prepared(image) == 2
    assert [each.code for each in errors] == [code]
    assert str(image) in str(errors[0])
    assert image.read_bytes() == before
