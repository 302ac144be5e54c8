package org.raspilot.up.loop;

import java.util.ArrayList;
import java.util.Collections;
import java.util.List;

/** Records the faults of a loop for a test. */
public final class Faults implements FaultListener {
    private final List<Throwable> all = Collections.synchronizedList(new ArrayList<>());

    @Override
    public void onFault(Throwable fault) {
        all.add(fault);
    }

    public List<Throwable> all() {
        return new ArrayList<>(all);
    }

    /** Returns and clears the faults so far: they were intended. */
    public List<Throwable> takeAll() {
        final List<Throwable> taken = all();
        all.clear();
        return taken;
    }

    /** Fails with the first fault as its cause when there was one. */
    public void mustBeNone() {
        if (!all.isEmpty()) {
            throw new AssertionError("a call threw", all.get(0));
        }
    }
}
