import os
import subprocess
import sys
from dataclasses import dataclass

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.up.config.samples import Gains
from up.config import ConfigFile, PersistedFile, atomic_writer, section


@dataclass(frozen=True, slots=True)
class Pids:
    """Gains that were tuned in flight."""

    ailerons: Gains = section(Gains)
    elevator: Gains = section(Gains)


PIDS = ConfigFile("pids.yml", Pids)
TUNED = Pids(Gains(1.5, 0.25), Gains(2.0, 0.0))
LATER = Pids(Gains(3.5, 0.25), Gains(4.0, 0.0))


@pytest.fixture
def learned(tmp_path):
    return PersistedFile(tmp_path / "pids.yml", PIDS)


def test_nothing_learned_yet_is_the_defaults_and_no_problem(learned):
    assert learned.load() == (Pids(), None)


def test_what_is_saved_is_loaded(learned):
    learned.save(TUNED)
    assert learned.load() == (TUNED, None)
    learned.save(LATER)
    assert learned.load() == (LATER, None)
    assert sorted(path.name for path in learned.path.parent.iterdir()) == [
        "pids.yml",
        "pids.yml.good",
    ]


@pytest.mark.parametrize(
    "spoiled",
    [
        b"",
        b"\x00" * 300,
        b"ailerons: null\nelevator: null\n",
        b"ailerons: {p: 1}\n",
        b"ailerons: {p: .nan, i: 0}\n",
        b"ailerons: {p: 51, i: 0}\n",
        b"\xff\xfe",
        b"ailerons: [",
    ],
)
def test_a_corrupt_or_partial_file_gives_the_last_good_copy(learned, spoiled):
    learned.save(TUNED)
    learned.path.write_bytes(spoiled)
    values, problem = learned.load()
    assert values == TUNED
    assert (problem.fields["line"], problem.fields["used"]) == (1, "good_copy")
    assert "\n" not in str(problem)


def test_a_lost_file_gives_the_last_good_copy(learned):
    learned.save(TUNED)
    learned.path.unlink()
    values, problem = learned.load()
    assert values == TUNED
    assert (problem.code, problem.fields["used"]) == ("file_missing", "good_copy")


def test_when_both_are_corrupt_the_defaults_are_used_and_said(learned):
    learned.save(TUNED)
    learned.path.write_bytes(b"x")
    learned.good_path.write_bytes(b"x")
    values, problem = learned.load()
    assert values == Pids()
    assert problem.fields["used"] == "defaults"


def test_a_corrupt_good_copy_alone_is_a_problem_too(learned):
    learned.good_path.write_bytes(b"x")
    values, problem = learned.load()
    assert values == Pids()
    assert problem.fields["file"] == str(learned.good_path)


def test_a_file_that_was_edited_by_hand_becomes_the_good_copy(learned):
    learned.save(TUNED)
    learned.path.write_text(PIDS.render(LATER))
    assert learned.load() == (LATER, None)
    learned.path.write_bytes(b"x")
    assert learned.load()[0] == LATER


def test_loading_alone_writes_nothing(learned):
    """A configuration that people wrote and keep under version control is not changed."""
    learned.path.write_text("ailerons: {p: 1, i: 0}\nelevator: {p: 2, i: 0}\n")
    assert learned.load() == (Pids(Gains(1, 0), Gains(2, 0)), None)
    assert list(learned.path.parent.iterdir()) == [learned.path]


def test_what_a_killed_write_leaves_is_removed_and_a_running_one_goes_on(learned, tmp_path):
    program = (
        "import os, sys, time, pathlib; from up.config import atomic_writer;"
        "os.fsync = lambda _: (print('written', flush=True), time.sleep(60));"
        "atomic_writer.write_atomically(pathlib.Path(sys.argv[1]), b'half')"
    )
    with subprocess.Popen(
        [sys.executable, "-c", program, str(learned.path)], stdout=subprocess.PIPE
    ) as writer:
        try:
            assert writer.stdout.readline() == b"written\n"
            (temporary,) = tmp_path.iterdir()
            atomic_writer.remove_unfinished(tmp_path)
            assert temporary.exists(), "its program runs"
        finally:
            writer.kill()
    other = tmp_path / ".notes.tmp"
    other.touch()
    atomic_writer.remove_unfinished(tmp_path)
    assert list(tmp_path.iterdir()) == [other]


def test_a_section_of_the_file_may_not_be_absent(learned):
    learned.path.write_text("ailerons: {p: 2, i: 0}\n")
    values, problem = learned.load()
    assert values == Pids()
    assert (problem.code, problem.fields["key"]) == ("key_missing", "elevator")


@dataclass(frozen=True, slots=True)
class Loop:
    """A loop with axes."""

    rate: Pids = section(Pids)


def test_an_axis_within_a_section_may_be_absent_as_old_files_have_it(tmp_path):
    learned = PersistedFile(tmp_path / "loop.yml", ConfigFile("loop.yml", Loop))
    learned.path.write_text("rate: {ailerons: {p: 2, i: 0}}\n")
    assert learned.load() == (Loop(Pids(ailerons=Gains(2.0, 0.0))), None)


def test_values_that_could_not_be_read_back_are_not_saved(learned):
    learned.save(TUNED)
    for wrong in (Gains(p=51.0), Gains(p=float("nan"))):
        with pytest.raises(ValueError):
            learned.save(Pids(ailerons=wrong))
    assert learned.load() == (TUNED, None)


@pytest.mark.parametrize("fails_at", range(1, 7))
def test_a_disk_that_fails_at_any_step_leaves_the_old_or_the_new_values(
    learned, monkeypatch, fails_at
):
    learned.save(TUNED)
    steps = 0

    def failing(original):
        def step(*arguments):
            nonlocal steps
            steps += 1
            if steps == fails_at:
                raise OSError(28, "No space left on device")
            return original(*arguments)

        return step

    with monkeypatch.context() as patch:
        patch.setattr(atomic_writer.os, "write", failing(os.write))
        patch.setattr(atomic_writer.os, "fsync", failing(os.fsync))
        try:
            learned.save(LATER)
        except OSError as error:
            assert error.errno == 28
    values, problem = learned.load()
    assert problem is None
    assert values in (TUNED, LATER)
    assert not [path for path in learned.path.parent.iterdir() if path.suffix == ".tmp"]


def test_loading_from_a_read_only_place_raises_nothing(learned, monkeypatch):
    learned.save(TUNED)
    learned.path.write_text(PIDS.render(LATER))

    def read_only(path, data):
        raise OSError(30, "Read-only file system")

    monkeypatch.setattr("up.config.persisted.write_atomically", read_only)
    assert learned.load() == (LATER, None)
    with pytest.raises(OSError):
        learned.save(TUNED)


@settings(deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(position=st.integers(0, 10_000), data=st.binary(max_size=8), cut=st.booleans())
def test_any_corruption_gives_some_values_and_never_a_partial_set(learned, position, data, cut):
    learned.save(TUNED)
    good = learned.path.read_bytes()
    position %= len(good)
    learned.path.write_bytes(good[:position] + data + (b"" if cut else good[position + 1 :]))
    values, problem = learned.load()
    assert isinstance(values, Pids)
    if problem is not None:
        assert values == TUNED
    elif cut and position < len(good) - 1:
        assert data


def test_a_file_cut_at_any_byte_gives_the_last_good_copy(learned):
    learned.save(TUNED)
    whole = learned.path.read_bytes()
    learned.good_path.write_text(PIDS.render(LATER))
    for length in range(len(whole) - 1):
        learned.path.write_bytes(whole[:length])
        values, problem = learned.load()
        assert (length, values) == (length, LATER)
        assert problem is not None
    # Only the last line feed may go.
    learned.path.write_bytes(whole[:-1])
    assert learned.load() == (TUNED, None)
