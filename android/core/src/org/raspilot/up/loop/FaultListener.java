package org.raspilot.up.loop;

/** Hears of exceptions that calls on the loop threw. Called on the loop; must not throw. */
public interface FaultListener {
    /** Takes the exception that a call threw. */
    void onFault(Throwable fault);
}
