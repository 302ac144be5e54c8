package org.raspilot.up.commands;

/** Told what became of one Command on the bus. */
interface CommandOutcome {
    /**
     * Hears that the handlers are done, on the loop thread.
     *
     * @param handlers how many there were
     * @param fault what the first of them threw that threw something, or null
     */
    void onDone(int handlers, Throwable fault);
}
