package org.raspilot.up.commands;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertSame;
import static org.junit.Assert.assertTrue;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.UUID;
import org.junit.Test;

public final class CommandExecutorTest {
    private final HandlerFaults faults = new HandlerFaults();
    private final CommandExecutor executor =
            new CommandExecutor(CommandRegistry.builtin(), faults);
    private final List<String> order = new ArrayList<>();

    @Test
    public void handlersRunInTheOrderOfTheirRegistration() {
        executor.registerCommand(ArmCommand.NAME, noting("first"));
        executor.registerCommand(DisarmCommand.NAME, noting("other"));
        executor.registerCommand(ArmCommand.NAME, noting("second"));
        assertEquals(2, executor.executeCommand(new ArmCommand()));
        assertEquals(Arrays.asList("first up.arm", "second up.arm"), order);
    }

    @Test
    public void aCommandThatNobodyHandlesHarmsNothing() {
        assertEquals(0, executor.executeCommand(new ArmCommand()));
        assertFalse(executor.hasHandlers(ArmCommand.NAME));
    }

    @Test
    public void eachRegistrationEndsByItsOwnHandle() {
        BaseCommandHandler handler = noting("it");
        UUID one = executor.registerCommand(ArmCommand.NAME, handler);
        UUID two = executor.registerCommand(ArmCommand.NAME, handler);
        assertFalse(executor.unregisterCommand(DisarmCommand.NAME, one));
        assertTrue(executor.unregisterCommand(ArmCommand.NAME, one));
        assertFalse(executor.unregisterCommand(ArmCommand.NAME, one));
        assertEquals(1, executor.executeCommand(new ArmCommand()));
        assertTrue(executor.unregisterCommand(ArmCommand.NAME, two));
        assertEquals(0, executor.executeCommand(new ArmCommand()));
        assertEquals(Arrays.asList("it up.arm"), order);
    }

    @Test
    public void anAliasIsTheCommandItself() {
        UUID handle = executor.registerCommand(PanicCommand.ALIAS, noting("it"));
        assertEquals(1, executor.executeCommand(new PanicCommand(true, 150, null)));
        assertTrue(executor.unregisterCommand(PanicCommand.NAME, handle));
    }

    @Test
    public void aHandlerThatFailsHarmsNoOther() {
        Recorder failing = new Recorder();
        failing.fault = new IllegalStateException("broken");
        Recorder refusing = new Recorder();
        refusing.refusal = new CommandRefusedException("no");
        executor.registerCommand(ArmCommand.NAME, failing);
        executor.registerCommand(ArmCommand.NAME, new BaseCommandHandler() {
            @Override
            public void runAction(BaseCommand command) {
                throw new NoClassDefFoundError("android/media/Newer");
            }
        });
        executor.registerCommand(ArmCommand.NAME, refusing);
        executor.registerCommand(ArmCommand.NAME, noting("last"));
        assertEquals(4, executor.executeCommand(new ArmCommand()));
        assertEquals(Arrays.asList("last up.arm"), order);
        assertEquals(2, executor.failedHandlers());
        assertSame(failing.fault, faults.faults.get(0));
        assertEquals("android/media/Newer", faults.faults.get(1).getMessage());
    }

    @Test
    public void aCommandFromAHandlerWaitsUntilTheOthersAreDone() {
        executor.registerCommand(ArmCommand.NAME, new BaseCommandHandler() {
            @Override
            public void runAction(BaseCommand command) {
                assertEquals(1, executor.executeCommand(new DisarmCommand()));
                order.add("asked");
            }
        });
        executor.registerCommand(ArmCommand.NAME, noting("second"));
        executor.registerCommand(DisarmCommand.NAME, noting("later"));
        executor.executeCommand(new ArmCommand());
        assertEquals(Arrays.asList("asked", "second up.arm", "later up.disarm"), order);
    }

    @Test
    public void whoLeavesDuringADeliveryDisturbsNobody() {
        final UUID[] handle = new UUID[1];
        handle[0] = executor.registerCommand(ArmCommand.NAME, new BaseCommandHandler() {
            @Override
            public void runAction(BaseCommand command) {
                executor.unregisterCommand(ArmCommand.NAME, handle[0]);
                executor.registerCommand(ArmCommand.NAME, noting("new"));
            }
        });
        executor.registerCommand(ArmCommand.NAME, noting("second"));
        executor.executeCommand(new ArmCommand());
        assertEquals(Arrays.asList("second up.arm"), order);
        executor.executeCommand(new ArmCommand());
        assertEquals(Arrays.asList("second up.arm", "second up.arm", "new up.arm"), order);
    }

    private BaseCommandHandler noting(final String name) {
        return new BaseCommandHandler() {
            @Override
            public void runAction(BaseCommand command) {
                order.add(name + " " + command.name());
            }
        };
    }
}
