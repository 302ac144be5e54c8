package org.raspilot.up.android;

/** Reports the unreadable readings of a sensor: only the first one, since many may follow. */
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
