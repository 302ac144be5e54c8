package org.raspilot.up.providers;

import java.util.List;
import org.raspilot.up.loop.Loop;

/** Keeps the providers: registers, starts and stops them (thesis 4.5.2). */
public final class ProvidersController {
    /** Takes the loop on which everything happens. */
    public ProvidersController(Loop loop) {}

    /** Returns the Panic that all providers follow. */
    public Panic panic() {
        return null;
    }

    /** Registers a provider; while running it is started at once. Raises IllegalArgumentException. */
    public void register(UpProvider provider) {}

    /** Stops and forgets a provider; returns whether there was one of that name. */
    public boolean unregister(String name) {
        return false;
    }

    /** Returns the provider of that name, or null. */
    public UpProvider provider(String name) {
        return null;
    }

    /** Starts all in the order of their registration. */
    public void start(Outlet outlet) {}

    /** Stops all in reverse order. */
    public void stop() {}

    /** Starts one anew, as after a permission was given; returns whether there is one. */
    public boolean restart(String name) {
        return false;
    }

    /** Returns what each does now, in the order of their registration. */
    public List<ProviderStatus> statuses() {
        return null;
    }
}
