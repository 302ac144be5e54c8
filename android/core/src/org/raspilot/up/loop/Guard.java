package org.raspilot.up.loop;

/** Runs calls so that an exception is reported and does not affect others. */
final class Guard {
    private final FaultListener listener;

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

    /** Reports a fault; an exception of the listener itself is dropped. */
    void report(Throwable fault) {
        try {
            listener.onFault(fault);
        } catch (RuntimeException another) {
            return; // Nobody is left to report it to.
        }
    }
}
