package org.raspilot.up.android;

/**
 * Chooses between the GPS and the network's location: the GPS always; the network's only while
 * the GPS has been silent for {@link #GPS_SILENT_MS}. On any thread.
 */
final class FixChoice {
    /** A GPS that said nothing for so long, ms, is replaced. */
    static final long GPS_SILENT_MS = 10000;

    private boolean hasGps;
    private long gpsMs;

    /** Says whether a fix that comes now is the one to send. */
    synchronized boolean takes(boolean isGps, long nowMs) {
        if (isGps) {
            hasGps = true;
            gpsMs = nowMs;
            return true;
        }
        return !hasGps || nowMs - gpsMs > GPS_SILENT_MS;
    }

    /** Forgets what was heard. */
    synchronized void forget() {
        hasGps = false;
    }
}
