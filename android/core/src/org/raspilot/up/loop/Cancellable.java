package org.raspilot.up.loop;

/** Something that will happen once, unless it is cancelled before. Only on the loop. */
public interface Cancellable {
    /** Something that is over already. */
    Cancellable DONE = new Cancellable() {
        @Override
        public void cancel() {
        }

        @Override
        public boolean isPending() {
            return false;
        }
    };

    /** Cancels it; later calls have no effect. */
    void cancel();

    /** Returns whether it is still to happen: neither done nor cancelled. */
    boolean isPending();
}
