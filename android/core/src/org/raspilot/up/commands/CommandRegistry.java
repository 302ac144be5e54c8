package org.raspilot.up.commands;

import java.util.HashMap;
import java.util.Map;
import org.raspilot.up.wire.GeneralMessage;

/** Which Commands are read into which classes, by name and by alias. */
public final class CommandRegistry {
    private final Map<String, CommandReader> readers = new HashMap<>();
    private final Map<String, String> primaryNames = new HashMap<>();

    /** Creates an empty registry. */
    public CommandRegistry() {
    }

    /** Returns a registry with the Commands of the Up Library. */
    public static CommandRegistry builtin() {
        CommandRegistry registry = new CommandRegistry();
        registry.register(AckCommand.NAME, AckCommand.READER);
        registry.register(AltitudeCommand.NAME, AltitudeCommand.READER);
        registry.register(ArmCommand.NAME, ArmCommand.READER);
        registry.register(BatteryCommand.NAME, BatteryCommand.READER);
        registry.register(DisarmCommand.NAME, DisarmCommand.READER);
        registry.register(FlightModeCommand.NAME, FlightModeCommand.READER);
        registry.register(HeadingCommand.NAME, HeadingCommand.READER);
        registry.register(LocationCommand.NAME, LocationCommand.READER, LocationCommand.ALIAS);
        registry.register(MarkCommand.NAME, MarkCommand.READER);
        registry.register(NackCommand.NAME, NackCommand.READER);
        registry.register(PanicCommand.NAME, PanicCommand.READER, PanicCommand.ALIAS);
        registry.register(PidTuningsCommand.NAME, PidTuningsCommand.READER);
        registry.register(RecordCommand.NAME, RecordCommand.READER);
        registry.register(SpeakCommand.NAME, SpeakCommand.READER);
        registry.register(TelemetryCommand.NAME, TelemetryCommand.READER);
        registry.register(TelemetryFrequencyCommand.NAME, TelemetryFrequencyCommand.READER);
        return registry;
    }

    /**
     * Registers the reader of a Command name, and older names as aliases.
     *
     * @throws IllegalArgumentException when a name is taken
     */
    public void register(String name, CommandReader reader, String... aliases) {
        claim(name, name);
        for (String alias : aliases) {
            claim(alias, name);
        }
        readers.put(name, reader);
    }

    /** Returns whether a name or alias is known. */
    public boolean knows(String name) {
        return primaryNames.containsKey(name);
    }

    /** Returns the name that the Command has today; an unknown name is returned unchanged. */
    public String primaryName(String name) {
        String primary = primaryNames.get(name);
        return primary == null ? name : primary;
    }

    /**
     * Returns the Command that a message is; of an unknown name a plain {@link BaseCommand}.
     *
     * @throws InvalidCommandException with one sentence that names the field
     */
    public BaseCommand read(GeneralMessage message) {
        CommandReader reader = readers.get(primaryName(message.name));
        return reader == null ? new BaseCommand(message) : reader.read(message);
    }

    private void claim(String name, String primary) {
        if (primaryNames.containsKey(name)) {
            throw new IllegalArgumentException("the Command " + name + " is registered already");
        }
        primaryNames.put(name, primary);
    }
}
