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
        executor.registerCommand(Commands.ARM, noting("first"));
        executor.registerCommand(Commands.DISARM, noting("other"));
        executor.registerCommand(Commands.ARM, noting("second"));
        assertEquals(2, executor.executeCommand(new BaseCommand(Commands.ARM)));
        assertEquals(Arrays.asList("first up.arm", "second up.arm"), order);
    }

    @Test
    public void aCommandThatNobodyHandlesHarmsNothing() {
        assertEquals(0, executor.executeCommand(new BaseCommand(Commands.ARM)));
        assertFalse(executor.hasHandlers(Commands.ARM));
    }

    @Test
    public void eachRegistrationEndsByItsOwnHandle() {
        CommandHandler handler = noting("it");
        UUID one = executor.registerCommand(Commands.ARM, handler);
        UUID two = executor.registerCommand(Commands.ARM, handler);
        assertFalse(executor.unregisterCommand(Commands.DISARM, one));
        assertTrue(executor.unregisterCommand(Commands.ARM, one));
        assertFalse(executor.unregisterCommand(Commands.ARM, one));
        assertEquals(1, executor.executeCommand(new BaseCommand(Commands.ARM)));
        assertTrue(executor.unregisterCommand(Commands.ARM, two));
        assertEquals(0, executor.executeCommand(new BaseCommand(Commands.ARM)));
        assertEquals(Arrays.asList("it up.arm"), order);
    }

    @Test
    public void anAliasIsTheCommandItself() {
        UUID handle = executor.registerCommand(Commands.PANIC_ALIAS, noting("it"));
        assertEquals(1, executor.executeCommand(new BaseCommand(Commands.PANIC)));
        assertTrue(executor.unregisterCommand(Commands.PANIC, handle));
    }

    @Test
    public void aHandlerThatFailsHarmsNoOther() {
        Recorder failing = new Recorder();
        failing.fault = new IllegalStateException("broken");
        Recorder refusing = new Recorder();
        refusing.refusal = new CommandRefusedException("no");
        executor.registerCommand(Commands.ARM, failing);
        executor.registerCommand(Commands.ARM, command -> {
            throw new NoClassDefFoundError("android/media/Newer");
        });
        executor.registerCommand(Commands.ARM, refusing);
        executor.registerCommand(Commands.ARM, noting("last"));
        assertEquals(4, executor.executeCommand(new BaseCommand(Commands.ARM)));
        assertEquals(Arrays.asList("last up.arm"), order);
        assertEquals(2, faults.faults.size());
        assertSame(failing.fault, faults.faults.get(0));
        assertEquals("android/media/Newer", faults.faults.get(1).getMessage());
    }

    @Test
    public void aCommandFromAHandlerWaitsUntilTheOthersAreDone() {
        executor.registerCommand(Commands.ARM, command -> {
            assertEquals(1, executor.executeCommand(new BaseCommand(Commands.DISARM)));
            order.add("asked");
        });
        executor.registerCommand(Commands.ARM, noting("second"));
        executor.registerCommand(Commands.DISARM, noting("later"));
        executor.executeCommand(new BaseCommand(Commands.ARM));
        assertEquals(Arrays.asList("asked", "second up.arm", "later up.disarm"), order);
    }

    @Test
    public void whoLeavesDuringADeliveryDisturbsNobody() {
        final UUID[] handle = new UUID[1];
        handle[0] = executor.registerCommand(Commands.ARM, command -> {
            executor.unregisterCommand(Commands.ARM, handle[0]);
            executor.registerCommand(Commands.ARM, noting("new"));
        });
        executor.registerCommand(Commands.ARM, noting("second"));
        executor.executeCommand(new BaseCommand(Commands.ARM));
        assertEquals(Arrays.asList("second up.arm"), order);
        executor.executeCommand(new BaseCommand(Commands.ARM));
        assertEquals(Arrays.asList("second up.arm", "second up.arm", "new up.arm"), order);
    }

    private CommandHandler noting(final String name) {
        return command -> order.add(name + " " + command.name());
    }
}
