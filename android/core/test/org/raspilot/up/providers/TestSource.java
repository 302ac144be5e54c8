package org.raspilot.up.providers;

import java.util.ArrayList;
import java.util.List;

/** A sensor with the test's readings. */
public final class TestSource<R> implements SensorSource<R> {
    public String name;
    public int namesAsked;
    public boolean isPresent = true;
    public RuntimeException fault;
    public final List<Long> periodsMs = new ArrayList<>();
    public SensorListener<R> listener;

    public TestSource(String name) {
        this.name = name;
    }

    @Override
    public boolean isPresent() {
        return isPresent;
    }

    @Override
    public String name() {
        namesAsked++;
        return name;
    }

    @Override
    public void subscribe(long periodMs, SensorListener<R> who) {
        if (fault != null) {
            throw fault;
        }
        if (listener != null) {
            throw new AssertionError(name + " is read twice");
        }
        periodsMs.add(periodMs);
        listener = who;
    }

    @Override
    public void unsubscribe() {
        listener = null;
    }

    /** Delivers a reading to the subscriber. */
    public void give(R reading) {
        if (listener != null) {
            listener.onReading(reading);
        }
    }
}
