package org.raspilot.up;

import static org.junit.Assert.assertNotSame;
import static org.junit.Assert.assertSame;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.fail;

import org.junit.After;
import org.junit.Test;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.Commands;
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

    @Test
    public void twoUpsShareNothing() {
        Up one = newUp();
        Up two = newUp();
        one.commandExecutor().registerCommand(Commands.ARM, command ->
                fail("delivered to the other"));
        two.commandExecutor().executeCommand(new BaseCommand(Commands.ARM));
        assertNotSame(one.commandRegistry(), two.commandRegistry());
        assertNotSame(one.providersController(), two.providersController());
    }

    private Up newUp() {
        return new Up(loop, (handler, command, fault) -> {
            throw new AssertionError(fault);
        });
    }
}
