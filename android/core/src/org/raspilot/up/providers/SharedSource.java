package org.raspilot.up.providers;

import java.util.ArrayList;
import java.util.List;

/**
 * Shares one sensor between several providers: each takes a branch, the fastest sets the period.
 *
 * @param <R> the type of one reading
 */
public final class SharedSource<R> {
    private final SensorSource<R> source;
    private final List<Branch> subscribed = new ArrayList<>();
    private final SensorListener<R> distributor = reading -> {
        for (Branch branch : new ArrayList<>(subscribed)) {
            branch.listener.onReading(reading);
        }
    };
    private long periodMs;

    public SharedSource(SensorSource<R> source) {
        this.source = source;
    }

    /** Returns a source of the same readings, with its own subscription. */
    public SensorSource<R> branch() {
        return new Branch();
    }

    private void adapt() {
        long wantedMs = 0;
        for (Branch branch : subscribed) {
            boolean isQuickest = wantedMs == 0 || branch.wantedMs < wantedMs;
            wantedMs = isQuickest ? branch.wantedMs : wantedMs;
        }
        if (wantedMs == periodMs) {
            return;
        }
        if (periodMs != 0) {
            periodMs = 0;
            source.unsubscribe();
        }
        if (wantedMs != 0) {
            source.subscribe(wantedMs, distributor);
            periodMs = wantedMs;
        }
    }

    private final class Branch implements SensorSource<R> {
        private SensorListener<R> listener;
        private long wantedMs;

        @Override
        public boolean isPresent() {
            return source.isPresent();
        }

        @Override
        public String name() {
            return source.name();
        }

        @Override
        public void subscribe(long ms, SensorListener<R> who) {
            listener = who;
            wantedMs = ms;
            subscribed.remove(this);
            subscribed.add(this);
            adapt();
        }

        @Override
        public void unsubscribe() {
            if (subscribed.remove(this)) {
                adapt();
            }
        }
    }
}
