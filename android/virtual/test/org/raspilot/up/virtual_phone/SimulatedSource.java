package org.raspilot.up.virtual_phone;

import java.util.Map;
import org.raspilot.up.providers.SensorListener;
import org.raspilot.up.providers.SensorSource;

/**
 * A sensor whose readings come from a simulator, which receives the wanted period.
 *
 * @param <R> the type of one reading
 */
final class SimulatedSource<R> implements SensorSource<R> {
    private final String key;
    private final EventWriter words;
    private SensorListener<R> listener;

    /** Takes the sensor's name in the simulator's lines. */
    SimulatedSource(String key, EventWriter words) {
        this.key = key;
        this.words = words;
    }

    @Override
    public boolean isPresent() {
        return true;
    }

    @Override
    public String name() {
        return "simulated " + key;
    }

    @Override
    public void subscribe(long periodMs, SensorListener<R> who) {
        listener = who;
        reportPeriod(periodMs);
    }

    @Override
    public void unsubscribe() {
        if (listener != null) {
            listener = null;
            reportPeriod(0);
        }
    }

    /** Delivers a reading to the subscriber; on the loop. */
    void deliver(R reading) {
        if (listener != null) {
            listener.onReading(reading);
        }
    }

    private void reportPeriod(long periodMs) {
        Map<String, Object> wants = EventWriter.event("wants", "sensor", key);
        wants.put("period_ms", periodMs);
        words.write(wants);
    }
}
