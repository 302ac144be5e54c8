package org.raspilot.up.loop;

import java.util.concurrent.atomic.AtomicLong;

/** Runs calls so that an exception is reported and counted, and does not affect others. */
final class Guard {
    private final FaultListener listener;
    private final AtomicLong faults = new AtomicLong();

    Guard(FaultListener listener) {
        this.listener = listener;
    }

    /**
     * Runs the call. Errors are caught too: a class that this phone's system lacks must end one
     * provider, not the link to the aeroplane.
     */
    void run(Runnable call) {
        try {
            call.run();
        } catch (Throwable fault) {
            report(fault);
        }
    }

    /** Counts and reports a fault; an exception of the listener itself is counted too. */
    void report(Throwable fault) {
        faults.incrementAndGet();
        try {
            listener.onFault(fault);
        } catch (RuntimeException another) {
            faults.incrementAndGet();
        }
    }

    /** Returns the number of faults; may be called on any thread. */
    long faults() {
        return faults.get();
    }
}
