package org.raspilot.up.loop;

/** Something that will happen once, unless it is cancelled before. Only on the loop. */
public interface Cancellable {
    /** Something that is over already. */
    Cancellable DONE = () -> { };

    /** Cancels it; later calls have no effect. */
    void cancel();
}
