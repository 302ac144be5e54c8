package org.raspilot.up.loop;

/** Something that will happen once, unless it is cancelled before. Only on the loop. */
public interface Cancellable {
    /** Cancels it; later calls have no effect. */
    void cancel();

    /** Returns whether it is still to happen: neither done nor cancelled. */
    boolean isPending();
}
