package org.raspilot.up.providers;

/**
 * The source of a sensor that this device lacks.
 *
 * @param <R> what one reading would be
 */
public final class AbsentSource<R> implements SensorSource<R> {
    private final String name;

    public AbsentSource(String name) {
        this.name = name;
    }

    @Override
    public boolean isPresent() {
        return false;
    }

    @Override
    public String name() {
        return name;
    }

    @Override
    public void subscribe(long periodMs, SensorListener<R> listener) {
        throw new IllegalStateException("there is no " + name);
    }

    @Override
    public void unsubscribe() {}
}
