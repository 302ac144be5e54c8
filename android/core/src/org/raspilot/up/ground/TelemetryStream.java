package org.raspilot.up.ground;

import org.raspilot.up.wire.GeneralMessage;

/**
 * Makes frames of messages and tracks the stream: missing frames and delay.
 *
 * <p>The transit time of a frame is half of the shortest round trip to the proxy, plus its delay
 * relative to the fastest frame by the aircraft's own clock ({@code system.clock_ms}); with a
 * protected session, all of it by that clock.
 */
final class TelemetryStream {
    private static final long MAX_GAP = 1000;
    /** Beacons of one life of an aircraft are nearer: each life draws its first at random. */
    private static final long ONE_LIFE = 1000000;
    private static final int TIMES = 32;
    private static final long STOPPED_MS = 10000;

    private final OneWayDelay delay = new OneWayDelay();
    private final long[] timesMs = new long[TIMES];
    private Telemetry newest = Telemetry.EMPTY;
    private long frames;
    private long lost;
    private double leftOut;
    private double roundTripMs;
    private Double minRoundTripMs;

    Telemetry newest() {
        return newest;
    }

    long frames() {
        return frames;
    }

    long lost() {
        return lost;
    }

    /** Takes a message of that name and returns it as a frame. */
    Telemetry receive(GeneralMessage message, long nowMs) {
        final Long beacon = message.beacon;
        final Telemetry bare = Telemetry.of(message.data, beacon, nowMs, 0);
        final Double told = bare.number("uplink.left_out");
        final double leftOutNow = told == null ? 0 : told;
        if (beacon != null && newest.beacon != null) {
            // Beacons are the peer's: their difference may not fit a long.
            final double gap = (double) beacon - (double) newest.beacon;
            // The aircraft left some out itself: because of its data budget.
            final double missing = gap - 1 - Math.max(0, leftOutNow - leftOut);
            if (missing > 0 && missing <= MAX_GAP) {
                lost += (long) missing;
            }
            if (Math.abs(gap) > ONE_LIFE) {
                delay.reset();
            }
        }
        leftOut = leftOutNow;
        final Double delayMs = delay.update(bare.number("system.clock_ms"), nowMs);
        if (delay.isReset()) {
            minRoundTripMs = roundTripMs > 0 ? Double.valueOf(roundTripMs) : null;
        }
        newest = bare.withTransit(Math.round(wayMs(delayMs)));
        timesMs[(int) (frames % TIMES)] = nowMs;
        frames++;
        return newest;
    }

    /** Takes how long it is to the other side and back now. */
    void onRoundTrip(Double tookMs) {
        roundTripMs = tookMs == null ? 0 : tookMs;
        if (tookMs != null && (minRoundTripMs == null || tookMs < minRoundTripMs)) {
            minRoundTripMs = tookMs;
        }
    }

    /** Takes the aircraft's clock as a protected session reports it. */
    void onClock(double clockMs, long fromMs, long toMs) {
        delay.trust(clockMs, fromMs, toMs);
    }

    /** Discards the newest frame: the link is restarted. */
    void reset() {
        newest = Telemetry.EMPTY;
    }

    Telemetry onLost() {
        newest = newest.withLostLink();
        return newest;
    }

    /** Returns how many frames come a second; null: too few came, or they stopped. */
    Double rateHz(long nowMs) {
        final int count = (int) Math.min(frames, TIMES);
        if (count < 3) {
            return null;
        }
        final long lastMs = timesMs[(int) ((frames - 1) % TIMES)];
        final long firstMs = timesMs[(int) ((frames - count) % TIMES)];
        if (lastMs <= firstMs || nowMs - lastMs > STOPPED_MS) {
            return null;
        }
        return (count - 1) * 1000.0 / (Math.max(nowMs, lastMs) - firstMs);
    }

    private double wayMs(Double delayMs) {
        if (delayMs == null) {
            return roundTripMs / 2;
        }
        if (delay.isTrusted()) {
            // By a clock that was compared: the whole way.
            return Math.max(delayMs, roundTripMs / 2);
        }
        // Queueing on the way to the proxy is delay: the minimum is the transit time itself.
        return (minRoundTripMs == null ? roundTripMs : minRoundTripMs) / 2 + delayMs;
    }
}
