import tracemalloc

from up.flight_log.series import Series

COUNT = 50_000


def test_an_hour_of_numbers_does_not_take_what_pythons_floats_would():
    series = Series()
    tracemalloc.start()
    for number in range(COUNT):
        series.add(number / 300, number / 7)
    taken, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    # Two numbers of eight bytes, and the reserve of a growing array.
    assert taken / COUNT < 24
    assert series.at(10.0, 1.0) == 3000 / 7
