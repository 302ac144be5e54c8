package org.raspilot.up.providers;

import org.raspilot.up.loop.Loop;
import org.raspilot.up.providers.ProviderStatus.ProviderState;
import org.raspilot.up.providers.ProvidersController.ProvidersListener;

/**
 * Reads a sensor, converts its readings for the Raspberry Pi, and sends them (thesis 3.5.2).
 *
 * <p>For a provider of one sensor and one Command extend {@link SensorProvider}. An exception of a
 * hook is reported as the provider's problem and does not affect other providers. Only on the loop.
 */
public abstract class UpProvider {
    private final String name;
    private final RatePolicy ratePolicy;
    private Stream stream;
    private Loop loop;
    private ProvidersListener listener;
    private MessageSink sink;
    private String sensorName = "";
    private boolean isThere;
    private boolean isStarted;
    private long startedMs;
    private String problem = "";

    /** Takes the name under which it is registered and shown, and how often it sends. */
    protected UpProvider(String name, RatePolicy ratePolicy) {
        this.name = name;
        this.ratePolicy = ratePolicy;
    }

    protected abstract boolean isPresent();

    /** Returns the sensor's own name; called at each start, together with isPresent. */
    protected abstract String sensorName();

    /** Starts to read the sensor with the period of periodMs; each reading leads to offer. */
    protected abstract void subscribe(long periodMs);

    protected abstract void unsubscribe();

    /** Sends the newest reading; returns whether the link took it. */
    protected abstract boolean transmit(MessageSink to);

    /** Returns what left last, as text for the screen; empty: nothing. */
    protected abstract String lastText();

    /** Returns whether the link is there on which it sends; by default the one for Commands. */
    protected boolean isOpen(MessageSink to) {
        return to.isOpen();
    }

    /** Notes a new, stored reading; it is sent when the cadence allows, if it is news. */
    protected final void offer(boolean isNew) {
        if (isStarted) {
            setProblem("");
            stream.offer(isNew);
        }
    }

    /** Notes an unusable reading with its reason; it does not count as a reading. */
    protected final void reject(String sentence) {
        setProblem(sentence);
    }

    public final String name() {
        return name;
    }

    /** Gives it its surroundings; {@link ProvidersController} does so when it is registered. */
    final void attach(Loop onLoop, Panic panic, ProvidersListener told) {
        if (stream != null) {
            throw new IllegalStateException("the provider '" + name + "' was registered before");
        }
        loop = onLoop;
        listener = told;
        stream = new Stream(onLoop, panic, ratePolicy, this);
        detect();
    }

    /** Starts to read the sensor and to send; an absent sensor is reported by its name. */
    final void start(MessageSink to) {
        if (isStarted) {
            return;
        }
        sink = to;
        detect();
        if (!isThere) {
            listener.onProvider(name, sensorName);
            return;
        }
        isStarted = true;
        startedMs = loop.nowMs();
        stream.begin();
        try {
            subscribe((long) ratePolicy.periodMs);
        } catch (RuntimeException fault) {
            // A sensor may refuse (a permission is missing): the others go on.
            stop();
            setProblem("the sensor cannot be read: " + sentence(fault));
        }
    }

    final void stop() {
        if (!isStarted) {
            return;
        }
        isStarted = false;
        stream.end();
        try {
            unsubscribe();
        } catch (RuntimeException fault) {
            // The others are still to be stopped.
            setProblem("the sensor cannot be left: " + sentence(fault));
        }
    }

    final void linkOpened() {
        if (isStarted) {
            stream.reopen();
        }
    }

    public final ProviderState state() {
        if (!isThere) {
            return ProviderState.ABSENT;
        }
        if (!isStarted) {
            return ProviderState.STOPPED;
        }
        if (isSilent()) {
            return ProviderState.SILENT;
        }
        boolean sends = stream.newestMs() >= 0 && isOpen(sink);
        return sends ? ProviderState.SENDING : ProviderState.WAITING;
    }

    /** Returns what the screen shows; only of a provider that is registered. */
    public final ProviderStatus status() {
        long newestMs = stream.newestMs();
        return new ProviderStatus(name, sensorName, state(), stream.hz(),
                newestMs < 0 ? -1 : loop.nowMs() - newestMs, lastText(), problem);
    }

    private boolean isSilent() {
        long newestMs = stream.newestMs();
        if (ratePolicy.isLevel() && newestMs >= 0) {
            return false;
        }
        return loop.nowMs() - Math.max(startedMs, newestMs) > ratePolicy.silenceLimitMs;
    }

    private void detect() {
        isThere = false;
        try {
            boolean isFound = isPresent();
            // Cached, because the query may be slow.
            String said = sensorName();
            sensorName = said == null ? "" : said;
            isThere = isFound;
        } catch (RuntimeException fault) {
            // As above; a sensor whose query fails is absent.
            setProblem("the sensor cannot be looked for: " + sentence(fault));
        }
    }

    final boolean isOpen() {
        return isOpen(sink);
    }

    /** Sends the newest reading; returns whether it left. */
    final boolean transmit() {
        try {
            return transmit(sink);
        } catch (RuntimeException fault) {
            // A failure in one provider does not affect the others.
            setProblem("its reading cannot be sent: " + sentence(fault));
            return false;
        }
    }

    private void setProblem(String sentence) {
        if (!sentence.equals(problem)) {
            problem = sentence;
            if (!sentence.isEmpty()) {
                listener.onProvider(name, sentence);
            }
        }
    }

    /** Returns the message of an exception, or its class name without one. */
    static String sentence(RuntimeException fault) {
        return fault.getMessage() == null ? fault.getClass().getSimpleName() : fault.getMessage();
    }
}
