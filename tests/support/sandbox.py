"""Runs a command under the system call filter of a systemd unit: UNIT COMMAND...

The unit's SystemCallFilter, MemoryDenyWriteExecute and NoNewPrivileges, without systemd: a call
that is not in the filter ends the process by SIGSYS, as under systemd.
"""

import configparser
import ctypes
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
SCMP_ACT_KILL_PROCESS, SCMP_ACT_ALLOW = 0x80000000, 0x7FFF0000
PR_SET_NO_NEW_PRIVS, PR_SET_MDWE, PR_MDWE_REFUSE_EXEC_GAIN = 38, 65, 1


def under(unit):
    """Return the start of a command that runs under the filter of a unit of the tree."""
    return sys.executable, str(Path(__file__)), unit


def service(unit):
    """Return the [Service] section."""
    parser = configparser.ConfigParser(strict=True)
    parser.optionxform = str
    parser.read(ROOT / unit)
    return parser["Service"]


def verify(unit, program, folder):
    """Let systemd verify a unit of the tree, with the program that is installed here."""
    text = (ROOT / unit).read_text(encoding="utf-8")
    installed = text.replace(f"/opt/raspilot/bin/{Path(program).name}", str(program))
    assert f"ExecStart={program}" in installed
    path = folder / Path(unit).name
    path.write_text(installed, encoding="utf-8")
    verified = subprocess.run(
        ["systemd-analyze", "verify", str(path)], capture_output=True, text=True
    )
    assert (verified.returncode, verified.stderr) == (0, "")


def calls(filter_set):
    """Return the names of the system calls in a set such as @network-io."""
    command = ["systemd-analyze", "syscall-filter", "--no-pager", filter_set]
    shown = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    found = set()
    for word in shown.split("\n")[1:]:
        word = word.strip()
        if word.startswith("@"):
            found |= calls(word)
        elif word and not word.startswith("#"):
            found.add(word)
    return found


def enter(unit):
    """Put this process under the unit's filter."""
    options = service(unit)
    seccomp = ctypes.CDLL("libseccomp.so.2", use_errno=True)
    seccomp.seccomp_init.restype = ctypes.c_void_p
    context = ctypes.c_void_p(seccomp.seccomp_init(ctypes.c_uint32(SCMP_ACT_KILL_PROCESS)))
    for name in calls("@default") | calls(options["SystemCallFilter"]):
        number = seccomp.seccomp_syscall_resolve_name(name.encode())
        # Negative: a call of other machines.
        if number >= 0:
            seccomp.seccomp_rule_add(context, ctypes.c_uint32(SCMP_ACT_ALLOW), number, 0)
    libc = ctypes.CDLL(None, use_errno=True)
    assert libc.prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0
    if options.get("MemoryDenyWriteExecute") == "yes":
        # Linux 6.3 or later; systemd itself does it by a filter.
        libc.prctl(PR_SET_MDWE, PR_MDWE_REFUSE_EXEC_GAIN, 0, 0, 0)
    assert seccomp.seccomp_load(context) == 0


if __name__ == "__main__":
    enter(sys.argv[1])
    os.execvp(sys.argv[2], sys.argv[2:])
