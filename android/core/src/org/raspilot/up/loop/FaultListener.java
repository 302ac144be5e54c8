package org.raspilot.up.loop;

/** Receives exceptions of calls on the loop. Called on the loop; must not throw. */
public interface FaultListener {
    /** Takes the exception that a call threw. */
    void onFault(Throwable fault);
}
