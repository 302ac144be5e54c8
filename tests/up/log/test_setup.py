import io
import json
import os
import subprocess
import sys
import warnings
from pathlib import Path

import pytest
from twisted.logger import LogBeginner, Logger, LogPublisher

from up.log import start_logging

PROGRAM = """
import sys
from pathlib import Path
from up.log import UpLogger, start_logging
log = UpLogger.get_logger("app")
log.info("early")
logging = start_logging(sys.argv[1], json_path=Path(sys.argv[2]) if sys.argv[2:] else None)
log.debug("detail")
log.info("hello {name}", name="pilot")
log.error("trouble")
logging.stop()
log.info("late")
"""


@pytest.fixture
def begin():
    """Start logging on a publisher of the test's own."""
    running = []

    def begin(level="info", **arguments):
        publisher = LogPublisher()
        stream = io.StringIO()
        beginner = LogBeginner(publisher, io.StringIO(), sys, warnings)
        logging = start_logging(level, stream, beginner=beginner, publisher=publisher, **arguments)
        running.append(logging)
        return Logger(namespace="app", observer=publisher), stream, logging

    showwarning = warnings.showwarning
    yield begin
    warnings.showwarning = showwarning
    for logging in running:
        logging.stop()


def run(*arguments, **environment):
    return subprocess.run(
        [sys.executable, "-W", "error", "-c", PROGRAM, *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=60,
        env={**os.environ, **environment},
    )


def test_a_program_logs_to_stderr_and_to_a_file_what_was_said_early_too(tmp_path):
    done = run("info", tmp_path / "logs" / "app.jsonl")
    assert (done.returncode, done.stdout) == (0, "")
    assert [line.split(" ", 1)[1] for line in done.stderr.splitlines()] == [
        "INFO     app: early",
        "INFO     app: hello pilot",
        "ERROR    app: trouble",
    ]
    lines = (tmp_path / "logs" / "app.jsonl").read_text().splitlines()
    assert [json.loads(line)["text"] for line in lines] == ["early", "hello pilot", "trouble"]


def test_a_program_in_the_journal_writes_priorities(tmp_path):
    with (tmp_path / "journal").open("w") as journal:
        status = os.fstat(journal.fileno())
        subprocess.run(
            [sys.executable, "-c", PROGRAM, "error"],
            stderr=journal,
            timeout=60,
            check=True,
            env={**os.environ, "JOURNAL_STREAM": f"{status.st_dev}:{status.st_ino}"},
        )
    assert (tmp_path / "journal").read_text() == "<3>app: trouble\n"


def test_a_closed_stderr_does_no_harm(tmp_path):
    path = tmp_path / "app.jsonl"
    done = subprocess.run(
        ["/bin/sh", "-c", 'exec "$0" -c "$1" info "$2" 2>&-', sys.executable, PROGRAM, path],
        timeout=60,
    )
    assert done.returncode == 0
    # Twisted would log about an observer that raises.
    texts = [json.loads(line)["text"] for line in path.read_text().splitlines()]
    assert texts == ["early", "hello pilot", "trouble"]


def test_an_unknown_level_is_refused(begin):
    with pytest.raises(ValueError, match="loud"):
        begin("loud")


@pytest.mark.parametrize("path", ["/dev/full", "/"])
def test_a_file_that_cannot_be_written_is_said_once_on_the_stream(begin, path):
    log, stream, _ = begin(json_path=Path(path), environ={"UP_LOG_FORMAT": "json"})
    log.info("one")
    log.info("two")
    events = [json.loads(line) for line in stream.getvalue().splitlines()]
    codes = [each.get("fields", {}).get("code") for each in events]
    assert sorted(map(str, codes)) == ["None", "None", "log_file_failed"]
    assert [each["text"] for each in events if "fields" not in each] == ["one", "two"]


def test_after_stop_nothing_is_logged(begin):
    log, stream, logging = begin()
    logging.stop()
    log.info("late")
    assert stream.getvalue() == ""


def test_a_program_that_reads_the_log_gets_json_with_codes(begin):
    log, stream, _ = begin(environ={"UP_LOG_FORMAT": "json"})
    log.warn("port {port} is in use", code="port_in_use", port=3003)
    record = json.loads(stream.getvalue())
    assert record["fields"] == {"code": "port_in_use", "port": 3003}
    assert (record["level"], record["source"]) == ("warning", "app")
