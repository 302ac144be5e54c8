"""Missing compilers in `make run`: installed if permitted, otherwise a replacement is reported."""

import subprocess
from pathlib import Path

import pytest

from tests.support.tools import need_tool

TOOLCHAIN = Path(__file__).parents[2] / "tools" / "toolchain"
NEEDED = [
    *("gcc-avr", "binutils-avr", "avr-libc", "arduino-core-avr", "libsimavr-dev", "libelf-dev"),
    *("gcc", "libc6-dev", "make"),
]
# A package has a file of its name in `packages`, which holds its status.
DPKG_QUERY = """\
echo "dpkg-query $*" >>"$STATE/calls"
for last; do :; done
[ -f "$STATE/packages/$last" ] || { echo "no packages found matching $last" >&2; exit 1; }
cat "$STATE/packages/$last"
"""
APT_GET = """\
words=
is_simulated=
while [ $# -gt 0 ]; do
    case "$1" in
        -o) shift ;;
        --simulate) is_simulated=yes ;;
        -*) ;;
        *) words="$words $1" ;;
    esac
    shift
done
echo "apt-get$words${is_simulated:+ (simulated)}" >>"$STATE/calls"
cat >/dev/null
set -- $words
case "$1" in
    update)
        [ -f "$STATE/offline" ] && { echo 'E: cannot resolve' >&2; exit 100; }
        rm -f "$STATE/unknown" "$STATE/old"
        echo 'Get:1 lists' ;;
    install)
        shift
        [ -f "$STATE/unknown" ] && { echo "E: Unable to locate package $1" >&2; exit 100; }
        [ -n "$is_simulated" ] && exit 0
        [ -f "$STATE/old" ] && { echo 'E: 404 Not Found' >&2; exit 100; }
        [ -f "$STATE/broken" ] && { echo 'E: no space left' >&2; exit 100; }
        for package; do
            echo "Setting up $package ..."
            printf installed >"$STATE/packages/$package"
        done ;;
esac
"""


class Machine:
    """A Debian of which nothing but these programs is seen."""

    def __init__(self, folder):
        self.state = folder / "state"
        self.programs = folder / "bin"
        (self.state / "packages").mkdir(parents=True)
        self.programs.mkdir()
        for name in ("cat", "rm"):
            (self.programs / name).symlink_to(need_tool(name))
        self.add("dpkg-query", DPKG_QUERY)
        self.add("apt-get", APT_GET)
        self.add("g++", "exit 0\n")
        self.be(0)

    def add(self, name, text):
        program = self.programs / name
        program.write_text(f"#!{need_tool('sh')}\n{text}")
        program.chmod(0o755)

    def remove(self, name):
        (self.programs / name).unlink()

    def be(self, user):
        self.add("id", f"echo {user}\n")

    def has(self, *packages, status="installed"):
        for package in packages:
            (self.state / "packages" / package).write_text(status)

    def let(self, name):
        """Let something be wrong: offline, unknown, old, broken."""
        (self.state / name).touch()

    def run(self):
        """Return the output of both streams; it always succeeds."""
        done = subprocess.run(
            [TOOLCHAIN],
            env={"PATH": str(self.programs), "STATE": str(self.state)},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=60,
            check=False,
        )
        assert done.returncode == 0, done.stdout
        return done.stdout

    @property
    def apt_calls(self):
        calls = (self.state / "calls").read_text().splitlines()
        return [call for call in calls if call.startswith("apt-get")]


@pytest.fixture
def machine(tmp_path):
    return Machine(tmp_path)


def test_where_all_is_there_one_line_says_so_and_nothing_is_installed(machine):
    machine.has(*NEEDED)
    assert machine.run().count("\n") == 1
    assert machine.apt_calls == []


def test_root_gets_exactly_what_is_missing_and_sees_it_come(machine):
    machine.has(*NEEDED[2:])
    machine.has("avr-libc", status="config-files")
    said = machine.run()
    assert " gcc-avr binutils-avr avr-libc\n" in said, "the packages are announced"
    assert said.count("gcc-avr") == 2, "and apt-get's own output is shown"
    assert machine.apt_calls == [
        "apt-get install gcc-avr binutils-avr avr-libc (simulated)",
        "apt-get install gcc-avr binutils-avr avr-libc",
    ]
    again = machine.run()
    assert again.count("\n") == 1
    assert len(machine.apt_calls) == 2


@pytest.mark.parametrize("wrong", ["unknown", "old"])
def test_lists_are_fetched_only_where_they_do_not_do(machine, wrong):
    machine.has(*NEEDED[1:])
    machine.let(wrong)
    said = machine.run()
    assert machine.apt_calls.count("apt-get update") == 1
    assert "Get:1 lists" in said and "gcc-avr" not in said.splitlines()[-1]


def test_who_is_not_root_is_told_what_to_install_and_what_flies(machine):
    machine.has(*NEEDED[3:])
    machine.be(1000)
    said = machine.run()
    assert "apt-get install gcc-avr binutils-avr avr-libc; " in said and said.count("\n") == 1
    assert "g++" not in said, "the same sources fly, built by it"
    assert machine.apt_calls == []


def test_without_a_compiler_for_this_computer_that_is_named_too(machine):
    machine.be(1000)
    machine.remove("g++")
    said = machine.run()
    assert said.count("\n") == 1
    assert "g++" in said
    machine.add("clang++", "exit 0\n")
    assert "g++" not in machine.run()


@pytest.mark.parametrize("wrong", ["offline", "broken"])
def test_what_cannot_be_installed_stops_nothing(machine, wrong):
    machine.let("unknown")
    machine.let(wrong)
    said = machine.run()
    assert "apt-get install " + " ".join(NEEDED) in said.splitlines()[-1]


def test_root_without_apt_get_is_told_too(machine):
    machine.remove("apt-get")
    said = machine.run()
    assert said.count("\n") == 1 and "apt-get install" in said


def test_where_there_is_no_debian_the_compiler_itself_is_looked_for(machine):
    machine.remove("dpkg-query")
    said = machine.run()
    assert " ".join(NEEDED) in said and said.count("\n") == 1
    machine.add("avr-g++", "exit 0\n")
    assert machine.run() == ""
