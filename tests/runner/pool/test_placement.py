from collections import Counter

from up_runner.pool.placement import RunnerInfo, ranking


def runner(name, free, *labels):
    return RunnerInfo(name, f"{name}.example", free, frozenset(labels))


def test_instances_spread_in_proportion_to_the_free_places():
    runners = [runner("a", 30), runner("b", 10), runner("full", 0)]
    firsts = Counter(ranking(f"glider-{n}", (), runners)[0] for n in range(4000))
    assert 0.72 < firsts["a"] / 4000 < 0.78 and firsts["full"] == 0


def test_every_runner_computes_the_same_order_of_those_that_have_the_labels():
    runners = [runner("a", 5, "eu"), runner("b", 5, "eu", "gpu"), runner("c", 5, "us")]
    order = ranking("glider-1", ["eu"], runners)
    assert sorted(order) == ["a", "b"]
    assert ranking("glider-1", ["eu"], runners[::-1]) == order
    assert ranking("glider-1", ["eu", "gpu"], runners) == ["b"]
    assert ranking("glider-1", ["eu", "us"], runners) == []


def test_the_order_of_the_others_stays_when_a_runner_leaves():
    runners = [runner(name, 5) for name in "abcd"]
    order = ranking("glider-1", (), runners)
    rest = [each for each in runners if each.id != order[0]]
    assert ranking("glider-1", (), rest) == order[1:]
