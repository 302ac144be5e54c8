package org.raspilot.up.commands;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertSame;
import static org.junit.Assert.assertTrue;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
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
        executor.executeCommand(new BaseCommand(Commands.ARM));
        assertEquals(Arrays.asList("first up.arm", "second up.arm"), order);
    }

    @Test
    public void anAliasIsTheCommandItself() {
        executor.registerCommand(Commands.PANIC_ALIAS, noting("it"));
        executor.executeCommand(new BaseCommand(Commands.PANIC));
        assertEquals(Arrays.asList("it up.panic"), order);
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
        executor.executeCommand(new BaseCommand(Commands.ARM));
        assertEquals(Arrays.asList("last up.arm"), order);
        assertEquals(2, faults.faults.size());
        assertSame(failing.fault, faults.faults.get(0));
        assertEquals("android/media/Newer", faults.faults.get(1).getMessage());
    }

    @Test
    public void aCommandFromAHandlerWaitsUntilTheOthersAreDone() {
        executor.registerCommand(Commands.ARM, command -> {
            executor.executeCommand(new BaseCommand(Commands.DISARM));
            order.add("asked");
        });
        executor.registerCommand(Commands.ARM, noting("second"));
        executor.registerCommand(Commands.DISARM, noting("later"));
        executor.executeCommand(new BaseCommand(Commands.ARM));
        assertEquals(Arrays.asList("asked", "second up.arm", "later up.disarm"), order);
    }

    @Test
    public void whoComesDuringADeliveryIsCalledFromTheNextOneOn() {
        executor.registerCommand(Commands.ARM, command ->
                executor.registerCommand(Commands.ARM, noting("new")));
        executor.executeCommand(new BaseCommand(Commands.ARM));
        assertTrue(order.isEmpty());
        executor.executeCommand(new BaseCommand(Commands.ARM));
        assertEquals(Arrays.asList("new up.arm"), order);
    }

    private CommandHandler noting(final String name) {
        return command -> order.add(name + " " + command.name());
    }
}
