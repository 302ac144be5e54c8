from twisted.internet.task import Clock

from up.system.token_bucket import TokenBucket


def test_a_token_bucket_has_a_burst_and_a_rate():
    clock = Clock()
    bucket = TokenBucket(clock, rate_hz=2, burst=3)
    assert [bucket.take() for _ in range(5)] == [True] * 3 + [False] * 2
    clock.advance(1)
    assert [bucket.take() for _ in range(3)] == [True, True, False]
    clock.advance(100)
    assert [bucket.take() for _ in range(4)] == [True] * 3 + [False]
    assert bucket.refused == 4
