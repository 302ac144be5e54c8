package org.raspilot.up.providers;

import org.raspilot.up.loop.Loop;

/**
 * Reads one sensor, makes of its readings what the Raspberry Pi wants, and sends it (thesis 3.5.2).
 */
public abstract class UpProvider {
    private final String name;

    /** Takes the name under which it is registered and shown. */
    protected UpProvider(String name) {
        this.name = name;
    }

    /** Returns the name. */
    public final String name() {
        return name;
    }

    /** Gives it its surroundings; {@link ProvidersController} calls it once at registration. */
    final void attach(Loop loop, Panic panic) {}

    /** Begins to read the sensor and to send into the outlet. */
    public final void start(Outlet outlet) {}

    /** Ends what {@link #start} began. */
    public final void stop() {}

    /** Returns what it does now. */
    public final ProviderState state() {
        return ProviderState.STOPPED;
    }

    /** Returns what the screen shows. */
    public final ProviderStatus status() {
        return null;
    }
}
