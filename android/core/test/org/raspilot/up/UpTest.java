package org.raspilot.up;

import static org.junit.Assert.assertSame;
import static org.junit.Assert.assertThrows;

import org.junit.After;
import org.junit.Test;
import org.raspilot.up.loop.ManualLoop;

public final class UpTest {
    private final ManualLoop loop = new ManualLoop(null, fault -> {
        throw new AssertionError(fault);
    });

    @After
    public void takeAway() {
        Up.setInstance(null);
    }

    @Test
    public void aProcessHasOneUp() {
        Up up = newUp();
        Up.setInstance(up);
        assertSame(up, Up.getInstance());
        Up.setInstance(up);
        assertThrows(IllegalStateException.class, () -> Up.setInstance(newUp()));
        assertSame(up, Up.getInstance());
    }

    @Test
    public void beforeItIsSetUpThereIsNone() {
        assertThrows(IllegalStateException.class, () -> Up.getInstance());
    }

    private Up newUp() {
        return new Up(loop, (handler, command, fault) -> {
            throw new AssertionError(fault);
        });
    }
}
