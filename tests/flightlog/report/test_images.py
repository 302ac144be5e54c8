import subprocess
import sys

from tests.support.waiting import is_running, until

DRAWING = """
import multiprocessing, os, time
from concurrent.futures import ProcessPoolExecutor
from up_flightlog.report import images

fork = multiprocessing.get_context("fork")
pool = ProcessPoolExecutor(2, fork, images._begin, (None, os.getpid()))
found = [pool.submit(os.getpid).result()]
pool.submit(time.sleep, 600)
pool.submit(time.sleep, 600)
print(*pool._processes, flush=True)
time.sleep(600)
"""


def test_they_end_with_a_report_that_is_killed():
    with subprocess.Popen([sys.executable, "-c", DRAWING], stdout=subprocess.PIPE) as report:
        workers = [int(each) for each in report.stdout.readline().split()]
        assert workers and all(map(is_running, workers))
        report.kill()
    until(lambda: not any(map(is_running, workers)), "the end of the workers")
