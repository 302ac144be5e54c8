package org.raspilot.up.android;

/** Tells of a sensor's readings that cannot be read: of the first one, since many may follow. */
final class BadReadings {
    private final ProblemListener problems;
    private final String refusal;
    private boolean isTold;

    /** Takes the receiver of the problems, which do not name the sensor. */
    BadReadings(ProblemListener problems, String refusal) {
        this.problems = problems;
        this.refusal = refusal;
    }

    /** Takes the problem of a reading that is dropped; on any thread. */
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
