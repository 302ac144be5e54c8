package org.raspilot.up.loop;

/** Runs calls so that what one throws is told and counted, and harms no other. */
final class Guard {
    private final FaultListener listener;
    private volatile long faults;

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
            tell(fault);
        }
    }

    /** Counts and tells a fault; an exception of the listener itself is a fault that is counted. */
    void tell(Throwable fault) {
        faults++;
        try {
            listener.onFault(fault);
        } catch (RuntimeException another) {
            faults++;
        }
    }

    /** Returns how many there were; may be asked on any thread. */
    long faults() {
        return faults;
    }
}
