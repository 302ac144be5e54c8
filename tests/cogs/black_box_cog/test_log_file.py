import errno

import pytest
from black_box_cog.disk import Disk
from black_box_cog.log_file import LogFile

from tests.cogs.black_box_cog.flights import HalfFullDisk

RECORDS = [b"a" * 10, b"b" * 20, b"c" * 30]


def opened(path, disk):
    return LogFile(disk, path, disk.create(path))


def test_records_are_written_together_and_in_order(tmp_path):
    file = opened(tmp_path / "f", Disk())
    for record in RECORDS:
        file.put(record)
    assert (tmp_path / "f").read_bytes() == b""
    file.flush()
    file.sync()
    assert (tmp_path / "f").read_bytes() == b"".join(RECORDS)
    assert (file.size, file.lost, file.is_synced) == (60, 0, True)
    file.close()
    file.close()


@pytest.mark.parametrize("room", range(60))
def test_of_a_disk_that_fills_up_at_any_byte_whole_records_stay(tmp_path, room):
    disk = HalfFullDisk()
    file = opened(tmp_path / "f", disk)
    disk.room = room
    for record in RECORDS:
        file.put(record)
    with pytest.raises(OSError) as error:
        file.flush()
    assert error.value.errno == errno.ENOSPC
    whole = sum(len(each) for each in RECORDS[: 0 if room < 10 else 1 if room < 30 else 2])
    assert (tmp_path / "f").read_bytes() == b"".join(RECORDS)[:whole]
    assert file.size == whole
    assert file.lost == (3 if room < 10 else 2 if room < 30 else 1)


def test_one_whose_name_went_is_known(tmp_path):
    file = opened(tmp_path / "f", Disk())
    assert file.is_linked
    (tmp_path / "f").unlink()
    assert not file.is_linked
    file.close()
