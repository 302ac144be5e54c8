from up_simulator.scenario.file import parse_scenario
from up_simulator.scenario.log import FlightLog

HEAD = "title: A test\nduration_s: 4\n"
EXPECT = "expect: [{name: It flies, signal: time_s, above: 0}]\n"


def scenario(text="", expect=EXPECT):
    return parse_scenario(HEAD + text + expect)


def log_of(columns, count=None):
    log = FlightLog(["time_s", *columns, "event"])
    count = count or max(len(each) for each in columns.values() if not callable(each))
    for at in range(count):
        values = {
            name: each(at * 0.02) if callable(each) else each[at] for name, each in columns.items()
        }
        log.append({"time_s": at * 0.02, **values})
    return log
