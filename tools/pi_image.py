"""Prepares a Raspberry Pi OS image: ``python -m tools.pi_image IMAGE --user NAME --key FILE ...``.

Only the boot partition (FAT) is written, with mtools, so neither root nor loop devices are needed.
The system itself makes the user, the network and the packages at its first start, by the hook that
Raspberry Pi Imager uses (``systemd.run`` in cmdline.txt). The image is changed in place; a second
run replaces the settings of the first.
"""

from __future__ import annotations

import argparse
import hashlib
import re
import shlex
import shutil
import struct
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

from up.errors import UserError
from up.output import print_problems

SECTOR = 512
FAT_TYPES, LINUX_TYPE = (0x0B, 0x0C, 0x0E), 0x83
FOLDER, SCRIPT = "raspilot", "firstrun.sh"
HOOK = (
    f"systemd.run=/boot/firmware/{SCRIPT} systemd.run_success_action=reboot"
    " systemd.unit=kernel-command-line.target"
)
CONSOLE = r"console=(serial0|ttyAMA0|ttyS0),\d+"
UART = ("[all]", "enable_uart=1", "dtoverlay=disable-bt", "dtparam=i2c_arm=on")
"""The UART at the pins without console and Bluetooth, and the I2C bus."""
_NAME = re.compile(r"[a-z][a-z0-9-]{0,30}")
_KEY = re.compile(r"(ssh-|ecdsa-|sk-)\S+ [A-Za-z0-9+/=]+( .*)?")


class ImageError(UserError):
    """An image or a setting cannot be used; ``status`` is the exit status."""

    status = 2


def boot_offset(image: Path) -> int:
    """Return where the boot partition begins, bytes. Raises ``ImageError``."""
    try:
        with image.open("rb") as file:
            head = file.read(SECTOR)
    except OSError as error:
        raise ImageError(f"{image}: {error.strerror}", "not_readable") from error
    if len(head) < SECTOR or head[510:] != b"\x55\xaa":
        what = "is not a disk image with a partition table; unpack an .xz file first"
        raise ImageError(f"{image}: {what}", "not_an_image")
    rows = [struct.unpack_from("<4xB3xII", head, 446 + 16 * at) for at in range(2)]
    (kind, begin, size), (second, _, _) = rows
    if kind not in FAT_TYPES or second != LINUX_TYPE:
        what = f"has partitions of types {kind:#x} and {second:#x}, not FAT and Linux"
        raise ImageError(f"{image}: {what}", "wrong_partitions")
    if image.stat().st_size < (begin + size) * SECTOR:
        raise ImageError(f"{image}: ends within its boot partition", "cut_image")
    return int(begin) * SECTOR


class BootPartition:
    """The files of an image's boot partition. Raises ``ImageError``."""

    def __init__(self, image: Path) -> None:
        self._drive = f"{image}@@{boot_offset(image)}"

    def read(self, name: str) -> str:
        return self._run("mtype", f"::{name}").decode("utf-8")

    def write(self, name: str, text: str) -> None:
        with tempfile.NamedTemporaryFile() as file:
            file.write(text.encode())
            file.flush()
            self.copy(Path(file.name), name)

    def copy(self, source: Path, name: str) -> None:
        self._run("mcopy", "-o", str(source), f"::{name}")

    def make_empty(self, folder: str) -> None:
        if folder in self._run("mdir", "-b", "::").decode().replace("/", " ").split():
            self._run("mdeltree", f"::{folder}")
        self._run("mmd", f"::{folder}")

    def _run(self, tool: str, *words: str) -> bytes:
        if shutil.which(tool) is None:
            raise ImageError(f"{tool} is missing: apt-get install mtools", "tool_missing")
        done = subprocess.run(
            [tool, "-i", self._drive, *words], capture_output=True, stdin=subprocess.DEVNULL,
            check=False,
        )  # fmt: skip
        if done.returncode:
            why = " ".join(done.stderr.decode(errors="replace").split())
            raise ImageError(f"{self._drive}: {tool}: {why}", "boot_partition")
        return done.stdout


def command_line(text: str) -> str:
    """Return cmdline.txt with the hook and without a console on the UART."""
    kept = [
        word
        for word in text.split()
        if not re.fullmatch(CONSOLE, word) and not word.startswith("systemd.")
    ]
    return " ".join([*kept, HOOK]) + "\n"


def hardware(text: str) -> str:
    """Return config.txt with the settings of the UART and the I2C bus at its end."""
    block = "\n".join(["# raspilot", *UART, ""])
    return text.replace(block, "").rstrip("\n") + "\n" + block


def pre_shared_key(name: str, password: str) -> str:
    """Return the key of a WPA network (IEEE 802.11i, PBKDF2), hexadecimal."""
    return hashlib.pbkdf2_hmac("sha1", password.encode(), name.encode(), 4096, 32).hex()


def first_run(options: argparse.Namespace, key: str, password: str) -> str:
    """Return the script of the first start; it removes itself and its hook."""
    user, host = options.user, options.hostname
    lines = [
        "#!/bin/sh",
        "# Written by tools/pi_image.py; its output is in /var/log/raspilot-firstrun.log.",
        "exec >>/var/log/raspilot-firstrun.log 2>&1",
        "set -x",
        f"echo {host} >/etc/hostname",
        f"sed -i 's/^127.0.1.1.*/127.0.1.1\\t{host}/' /etc/hosts",
        # Its password is locked: the key alone opens it.
        f"[ -x /usr/lib/userconf-pi/userconf ] && /usr/lib/userconf-pi/userconf {user} '*'",
        f"id {user} || useradd --create-home --shell /bin/bash {user}",
        f"for group in sudo dialout i2c gpio; do usermod -aG $group {user}; done",
        f"home=$(getent passwd {user} | cut -d: -f6)",
        f"install -d -m 700 -o {user} -g {user} $home/.ssh",
        f"echo {shlex.quote(key)} >$home/.ssh/authorized_keys",
        f"chown {user}:{user} $home/.ssh/authorized_keys",
        "chmod 600 $home/.ssh/authorized_keys",
        "systemctl enable ssh",
    ]
    if options.wifi:
        folder = "/etc/NetworkManager/system-connections"
        network = [
            "[connection]", "id=raspilot", "type=wifi", "[wifi]", f"ssid={options.wifi}",
            "[wifi-security]", "key-mgmt=wpa-psk", f"psk={pre_shared_key(options.wifi, password)}",
            "[ipv4]", "method=auto",
        ]  # fmt: skip
        words = " ".join(map(shlex.quote, network))
        lines += [
            f"raspi-config nonint do_wifi_country {options.country}",
            f"(umask 077; printf '%s\\n' {words} >{folder}/raspilot.nmconnection)",
        ]
    return "\n".join(
        [
            *lines,
            *([f"dpkg --install /boot/firmware/{FOLDER}/*.deb"] if options.deb else []),
            "sed -i 's/ systemd\\.[^ ]*//g' /boot/firmware/cmdline.txt",
            f"rm -f /boot/firmware/{SCRIPT}",
            "exit 0",
            "",
        ]
    )


def prepare(options: argparse.Namespace) -> None:
    """Write the settings into the image. Raises ``ImageError``."""
    key, password = _text(options.key, "--key"), ""
    if not _KEY.fullmatch(key):
        raise ImageError(f"--key {options.key}: is not one public key of SSH", "not_a_key")
    for option, name in (("--user", options.user), ("--hostname", options.hostname)):
        if not _NAME.fullmatch(name):
            raise ImageError(f"{option} {name}: a-z first, then a-z, 0-9 and -", "bad_name")
    if options.wifi:
        password = _text(options.wifi_password_file, "--wifi-password-file")
        if not 8 <= len(password) <= 63 or not password.isprintable():
            raise ImageError("--wifi-password-file: needs 8 to 63 characters", "bad_password")
        if not options.wifi.isprintable() or not re.fullmatch("[A-Z]{2}", options.country):
            raise ImageError("--wifi, --country: a printable name, two letters", "bad_network")
    for package in options.deb:
        if not package.is_file():
            raise ImageError(f"--deb {package}: no such file", "not_readable")
    boot = BootPartition(options.image)
    command, config = command_line(boot.read("cmdline.txt")), hardware(boot.read("config.txt"))
    boot.make_empty(FOLDER)
    for package in options.deb:
        boot.copy(package, f"{FOLDER}/{package.name}")
    boot.write(SCRIPT, first_run(options, key, password))
    boot.write("config.txt", config)
    # Last: an image that could not be written is not started with half of its settings.
    boot.write("cmdline.txt", command)


def _text(path: Path | None, option: str) -> str:
    if path is None:
        raise ImageError(f"{option}: is missing", "missing_option")
    try:
        return path.read_text(encoding="utf-8").strip()
    except (OSError, UnicodeDecodeError) as error:
        raise ImageError(f"{option} {path}: cannot be read: {error}", "not_readable") from error


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(prog="tools.pi_image", description=str(__doc__).split("\n")[0])
    parser.add_argument("image", type=Path, help="Raspberry Pi OS 12, unpacked; changed in place")
    parser.add_argument("--user", default="pi", help="default %(default)s; its password is locked")
    parser.add_argument("--key", type=Path, required=True, help="the user's public key of SSH")
    parser.add_argument("--hostname", default="raspilot", help="default %(default)s")
    parser.add_argument("--wifi", default="", metavar="NAME", help="a WPA network")
    parser.add_argument("--wifi-password-file", type=Path, metavar="FILE")
    parser.add_argument("--country", default="", metavar="CC", help="of the Wi-Fi channels: CZ")
    parser.add_argument(
        "--deb", type=Path, action="append", default=[], help="a package of make deb to install"
    )
    try:
        prepare(parser.parse_args(arguments))
    except ImageError as error:
        print_problems([error])
        return error.status
    return 0


if __name__ == "__main__":
    sys.exit(main())
