package org.raspilot.up.loop;

/** Receives exceptions of calls on the loop. Called on the loop; must not throw. */
public interface FaultListener {
    void onFault(Throwable fault);
}
