package org.raspilot.up.ground;

/** What a {@link GroundListener} was told last: it hears what is news, and its figures each s. */
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

    /** Tells a status. */
    void tell(GroundStatus status, long nowMs) {
        toldMs = nowMs;
        wasSilent = status.isSilent();
        wasLate = status.isLate();
        listener.onStatus(status);
    }

    /** Says whether the status is to be told again for its figures. */
    boolean isDue(long nowMs) {
        return nowMs - toldMs >= STATUS_MS;
    }

    /** Says whether a frame changes what was told about its age. */
    boolean isNews(Telemetry frame, long nowMs) {
        return wasSilent != frame.isSilent(nowMs) || wasLate != frame.age().isLate(nowMs);
    }

    /** Tells that something changed when the sum of all versions, which only rise, has risen. */
    void tellChanged(long versions) {
        if (versions != toldVersions) {
            toldVersions = versions;
            listener.onChanged();
        }
    }
}
