package org.raspilot.up.providers;

import java.util.Map;
import org.raspilot.up.commands.BaseCommand;

/**
 * A provider that converts each reading of one sensor to one Command: extend it for your own
 * sensor.
 *
 * @param <R> the type of one reading
 */
public abstract class SensorProvider<R> extends UpProvider {
    private final SensorSource<R> source;
    private final boolean isLevel;
    private R newest;
    private BaseCommand waiting;
    private Map<String, Object> last;

    /** Takes its name, its sensor, and how often it sends. */
    protected SensorProvider(String name, SensorSource<R> source, RatePolicy ratePolicy) {
        super(name, ratePolicy);
        this.source = source;
        this.isLevel = ratePolicy.isLevel();
    }

    /**
     * Returns the Command of a reading, or null to send none.
     *
     * @throws IllegalArgumentException when the reading cannot be used (a sentence for the user)
     */
    protected abstract BaseCommand read(R reading);

    /** Returns the newest reading that could be used since the start, or null. */
    public final R newest() {
        return newest;
    }

    @Override
    protected final boolean isPresent() {
        return source.isPresent();
    }

    @Override
    protected final String sensorName() {
        return source.name();
    }

    @Override
    protected final void subscribe(long periodMs) {
        newest = null;
        waiting = null;
        source.subscribe(periodMs, reading -> update(reading));
    }

    @Override
    protected final void unsubscribe() {
        source.unsubscribe();
        newest = null;
    }

    @Override
    protected final boolean transmit(MessageSink to) {
        boolean isTaken = to.sendNewest(name(), waiting);
        if (isTaken) {
            last = waiting.data();
        }
        return isTaken;
    }

    @Override
    protected final String lastText() {
        if (last == null) {
            return "";
        }
        StringBuilder text = new StringBuilder();
        for (Map.Entry<String, Object> field : last.entrySet()) {
            text.append(text.length() == 0 ? "" : ", ");
            text.append(field.getKey()).append(' ').append(field.getValue());
        }
        return text.toString();
    }

    private void update(R reading) {
        BaseCommand command;
        try {
            command = read(reading);
        } catch (RuntimeException fault) {
            // An invalid reading must not end the sensor's own thread or affect the others.
            reject("its reading cannot be used: " + sentence(fault));
            return;
        }
        if (command != null) {
            boolean isNew = !isLevel || waiting == null || !waiting.data().equals(command.data());
            newest = reading;
            waiting = command;
            offer(isNew);
        }
    }
}
