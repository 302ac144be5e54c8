package org.raspilot.up.net;

/** A runner's answer that says where an instance runs (protocols 8). */
public final class RunnerAnswer {
    RunnerAnswer() {
    }

    /** Returns the runner's words; null: none. */
    public String message() {
        return null;
    }

    /** Returns what is wrong although an instance runs; null: nothing. */
    public String error() {
        return null;
    }

    /** Returns whether this request started it. */
    public boolean isSpawned() {
        return false;
    }

    /** Returns the instance's name; null: not told. */
    public String instance() {
        return null;
    }

    /** Returns where the instance listens. */
    public Place place() {
        return null;
    }

    /** Returns the proxy's host for grounds of this aircraft; null: not told. */
    public String proxyHost() {
        return null;
    }

    /** Returns the proxy's port for grounds; 0: not told. */
    public int proxyGroundPort() {
        return 0;
    }
}
