package org.raspilot.up.providers;

import java.util.ArrayList;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import org.raspilot.up.loop.Loop;

/** Manages the providers: registers, starts and stops them (thesis 4.5.2). Only on the loop. */
public final class ProvidersController {
    private final Loop loop;
    private final Panic panic = new Panic();
    private final Map<String, UpProvider> providers = new LinkedHashMap<>();
    private ProvidersListener listener = (name, sentence) -> { };
    private MessageSink sink;

    /** Takes the loop on which everything happens. */
    public ProvidersController(Loop loop) {
        this.loop = loop;
    }

    public Panic panic() {
        return panic;
    }

    public void setListener(ProvidersListener listener) {
        this.listener = listener;
    }

    /**
     * Registers a provider; if the others run, it is started immediately.
     *
     * @throws IllegalArgumentException when one of that name is registered
     * @throws IllegalStateException when this provider was registered before
     */
    public void register(UpProvider provider) {
        if (providers.containsKey(provider.name())) {
            throw new IllegalArgumentException(
                    "a provider '" + provider.name() + "' is registered already");
        }
        provider.attach(loop, panic, (name, sentence) -> listener.onProvider(name, sentence));
        providers.put(provider.name(), provider);
        if (sink != null) {
            provider.start(sink);
        }
    }

    /** Starts all in the order of their registration; they send into the outlet. */
    public void start(MessageSink to) {
        sink = to;
        for (UpProvider provider : all()) {
            provider.start(to);
        }
    }

    public void stop() {
        sink = null;
        List<UpProvider> reversed = all();
        Collections.reverse(reversed);
        for (UpProvider provider : reversed) {
            provider.stop();
        }
    }

    /** Restarts one, as after a permission was granted; returns whether it is running. */
    public boolean restart(String name) {
        UpProvider provider = providers.get(name);
        if (provider == null || sink == null) {
            return false;
        }
        provider.stop();
        provider.start(sink);
        return true;
    }

    /** Notes a new link: each provider immediately sends its known and fresh values. */
    public void linkOpened() {
        for (UpProvider provider : all()) {
            provider.linkOpened();
        }
    }

    /** Notes that the link is lost: its requests are discarded. */
    public void linkClosed() {
        panic.clear();
    }

    /** Returns what each does now, in the order of their registration. */
    public List<ProviderStatus> statuses() {
        List<ProviderStatus> statuses = new ArrayList<>();
        for (UpProvider provider : all()) {
            statuses.add(provider.status());
        }
        return Collections.unmodifiableList(statuses);
    }

    private List<UpProvider> all() {
        return new ArrayList<>(providers.values());
    }

    /** Receives the problems of providers, on the loop. */
    public interface ProvidersListener {
        /**
         * Called with a problem of a provider in a sentence, once until it changes; for an absent
         * sensor with the sensor's name, at each start.
         */
        void onProvider(String name, String sentence);
    }
}
