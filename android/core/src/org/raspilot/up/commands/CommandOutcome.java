package org.raspilot.up.commands;

/** Receives the outcome of one Command on the bus. */
interface CommandOutcome {
    /**
     * Called when the handlers have finished, on the loop thread.
     *
     * @param handlers the number of handlers
     * @param fault the first exception that a handler threw, or null
     */
    void onDone(int handlers, Throwable fault);
}
