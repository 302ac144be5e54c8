package org.raspilot.up.ground;

/** The last state sent to a {@link GroundListener}: changes immediately, figures each s. */
final class Bulletin {
    private static final long STATUS_MS = 1000;

    private final GroundListener listener;
    private boolean wasSilent = true;
    private boolean wasLate;
    private long toldMs;
    private long toldVersions;

    Bulletin(GroundListener listener) {
        this.listener = listener;
    }

    void tell(GroundStatus status, long nowMs) {
        toldMs = nowMs;
        wasSilent = status.isSilent;
        wasLate = status.isLate;
        listener.onStatus(status);
    }

    /** Returns whether the status is due again for its figures. */
    boolean isDue(long nowMs) {
        return nowMs - toldMs >= STATUS_MS;
    }

    /** Returns whether a frame changes the reported age. */
    boolean isNews(Telemetry frame, long nowMs) {
        return wasSilent != frame.isSilent(nowMs) || wasLate != frame.age.isLate(nowMs);
    }

    /** Reports a change when the sum of all versions, which only increase, has increased. */
    void tellChanged(long versions) {
        if (versions != toldVersions) {
            toldVersions = versions;
            listener.onChanged();
        }
    }
}
