package org.raspilot.up.android;

import org.raspilot.up.net.RunnerAnswer;

/** The result of a spawn request. Immutable. */
public final class SpawnResult {
    /** The place of the instance and its proxy; null: nothing runs. */
    public final RunnerAnswer answer;
    /** Why nothing runs, as a program reads it; empty: something runs. */
    public final String code;
    /** The runner's message, or why nothing runs, without a full stop. */
    public final String sentence;

    SpawnResult(RunnerAnswer answer, String code, String sentence) {
        this.answer = answer;
        this.code = code;
        this.sentence = sentence == null ? "" : sentence;
    }
}
