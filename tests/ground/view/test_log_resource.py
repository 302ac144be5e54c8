"""What the page of recorded flights asks for, of the real program over HTTP."""

import array
import json
import re
import subprocess
import sys

import pytest

from tests.flightlog.logbook import eventful, write_flight
from tests.ground.web.page import get
from tests.ground.web.test_site import check_headers
from up_flightlog.columns.column_file import ColumnFile


@pytest.fixture(scope="module")
def viewer(tmp_path_factory):
    folder = tmp_path_factory.mktemp("view")
    path = write_flight(folder / "flights", 1, eventful)
    other = write_flight(folder / "flights", 2, eventful)
    code = "import sys; from up.cli.main import main; sys.exit(main())"
    program = subprocess.Popen(
        [sys.executable, "-c", code, "log", "view", str(path), str(other)],
        stdout=subprocess.PIPE,
        text=True,
        env={"XDG_CACHE_HOME": str(folder / "cache"), "PATH": "/usr/bin:/bin", "HOME": str(folder)},
    )
    yield int(re.search(r":(\d+)/", program.stdout.readline())[1]), folder / "cache"
    program.terminate()
    assert program.wait(30) == 0
    program.stdout.close()


def index(port):
    return json.loads(get(port, "/log/index")[2])["flights"]


def test_the_page_and_the_index_come_with_the_headers_of_the_ground_station(viewer):
    port, _ = viewer
    for path, kind in (("/", "text/html; charset=utf-8"), ("/log/index", "application/json")):
        status, headers, _ = get(port, path)
        assert (status, headers["Content-Type"]) == (200, kind)
        check_headers(headers)
    assert get(port, "/log/index", Host="evil.example")[0] == 421
    assert [each["name"][:4] for each in index(port)] == ["0001", "0002"]
    assert not {"state", "levels"} & set(index(port)[0])


def test_a_window_is_what_the_columns_have(viewer):
    port, cache = viewer
    number, about = next(
        each
        for each in enumerate(index(port)[0]["columns"])
        if each[1]["name"] == "up.altitude.change.altitude"
    )
    query = f"flight=1&column={number}&begin=0&end=20"
    _, _, body = get(port, f"/log/window?{query}&pixels=8")
    count = len(body) // 12
    values = array.array("f", body[count * 8 :])
    assert about["unit"] == "m" and count <= 16
    assert (min(values), max(values)) == (300.0, 319.5)
    assert len(get(port, f"/log/samples?{query}")[2]) == 12 * about["count"]
    track = get(port, f"/log/track?flight=0&column={number}")[2]
    assert len(track) == 20 * 20
    files = list((cache / "raspilot" / "columns").iterdir())
    assert len(files) == 2 and all(ColumnFile(each).columns for each in files)


@pytest.mark.parametrize(
    "query",
    [
        "window?flight=0&column=0&begin=0&end=1",
        "window?flight=2&column=0&begin=0&end=1&pixels=10",
        "window?flight=0&column=99999&begin=0&end=1&pixels=10",
        "window?flight=0&column=0&begin=0&end=1&pixels=1000000",
        "window?flight=0&column=0&begin=1&end=1&pixels=10",
        "samples?flight=0&column=0&begin=nan&end=1",
        "samples?flight=0&flight=1&column=0&begin=0&end=1",
        "track?flight=-1&column=0",
    ],
)
def test_a_wrong_query_is_refused(viewer, query):
    status, headers, _ = get(viewer[0], f"/log/{query}")
    assert status == 400
    check_headers(headers)
