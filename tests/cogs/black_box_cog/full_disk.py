"""A flight on its own small file system: ``python -m tests...full_disk FOLDER READ_ONLY``.

Prints the result as JSON. To be run in a mount namespace where FOLDER is a few hundred KB.
"""

import json
import os
import struct
import sys
from pathlib import Path

from mcap.exceptions import McapError

from tests.cogs.black_box_cog.flights import Flight, codes_in, numbers_in, summary_of
from tests.up.commands.samples import Log

HOG_BYTES = 500_000


def status_of(flight, log):
    errors = [each for each in log.events if each["log_level"].name == "error"]
    return {
        "recording": flight.status.recording,
        "problem": flight.status.problem,
        "dropped": flight.status.dropped,
        "errors": [each.get("code") for each in errors],
    }


def fly(folder):
    """Fill the disk in flight, make room, go on."""
    hog = folder / "hog"
    hog.write_bytes(os.urandom(HOG_BYTES))
    flight = Flight(folder)
    told = {}
    with Log() as log:
        said = flight.fly(400)
    told["full"] = status_of(flight, log)
    told["free_when_full"] = flight.disk.free_bytes(folder)
    hog.unlink()
    with Log() as log:
        flight.fly(90, first=said)
    told["later"] = status_of(flight, log)
    flight.recorder.finish()
    told["files"] = [path.name for path in flight.files]
    told["numbers"] = [numbers_in(path) for path in flight.files]
    told["whole"] = ends_with_whole_records(flight.files[0])
    told["complete"] = [is_complete(path) for path in flight.files]
    told["codes"] = [code for path in flight.files for code in codes_in(path)]
    return told


def fly_read_only(folder):
    """Try to record where nothing can be written."""
    flight = Flight(folder)
    with Log() as log:
        flight.fly(200)
    told = {"read_only": status_of(flight, log), "files": [each.name for each in flight.files]}
    flight.recorder.finish()
    return told


def ends_with_whole_records(path):
    data = path.read_bytes()
    place = 8
    while place < len(data):
        place += 9 + int.from_bytes(data[place + 1 : place + 9], "little")
    return place == len(data)


def is_complete(path):
    try:
        return summary_of(path) is not None
    except (McapError, struct.error):
        return False


if __name__ == "__main__":
    what = fly_read_only if sys.argv[2:] == ["read-only"] else fly
    print(json.dumps(what(Path(sys.argv[1]))))
