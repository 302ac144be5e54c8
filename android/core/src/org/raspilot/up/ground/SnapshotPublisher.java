package org.raspilot.up.ground;

/** The last state sent to a {@link GroundListener}: changes immediately, figures each s. */
final class SnapshotPublisher {
    private static final long STATUS_MS = 1000;

    private final GroundListener listener;
    private boolean wasSilent = true;
    private boolean wasLate;
    private long reportedMs;
    private long reportedVersions;

    SnapshotPublisher(GroundListener listener) {
        this.listener = listener;
    }

    void reportStatus(GroundStatus status, long nowMs) {
        reportedMs = nowMs;
        wasSilent = status.isSilent;
        wasLate = status.isLate;
        listener.onStatus(status);
    }

    /** Returns whether the status is due again for its figures. */
    boolean isDue(long nowMs) {
        return nowMs - reportedMs >= STATUS_MS;
    }

    /** Returns whether a frame changes the reported age. */
    boolean isChanged(Telemetry frame, long nowMs) {
        return wasSilent != frame.isSilent(nowMs) || wasLate != frame.age.isLate(nowMs);
    }

    /** Reports a change when the sum of all versions, which only increase, has increased. */
    void reportChanges(long versions) {
        if (versions != reportedVersions) {
            reportedVersions = versions;
            listener.onChanged();
        }
    }
}
