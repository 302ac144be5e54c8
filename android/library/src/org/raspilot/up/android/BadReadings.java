package org.raspilot.up.android;

/** Tells of a sensor's readings that cannot be read: of the first one, since many may follow. */
final class BadReadings {
    private final ProblemListener problems;
    private final String refusal;
    private boolean isTold;

    /** Takes what is told, without the sensor's name. */
    BadReadings(ProblemListener problems, String refusal) {
        this.problems = problems;
        this.refusal = refusal;
    }

    /** Takes what was wrong with a reading, which is dropped; on any thread. */
    void add(String sensor, RuntimeException fault) {
        synchronized (this) {
            if (isTold) {
                return;
            }
            isTold = true;
        }
        problems.onProblem(refusal + ": " + sensor + ": " + fault);
    }
}
