package org.raspilot.up.commands;

import java.util.Map;
import org.raspilot.up.wire.GeneralMessage;

/**
 * A named message between the parts of the system; subclasses give it types (thesis 4.1.4).
 *
 * <p>An application's own Command is a subclass with a constructor from a GeneralMessage and one
 * registration of its {@link CommandReader}; it may as well be a plain BaseCommand.
 */
public class BaseCommand {
    private final GeneralMessage message;

    /** Creates a Command without fields. */
    public BaseCommand(String name) {
        this(new GeneralMessage(name, null));
    }

    /** Creates a Command without an id or a beacon. */
    public BaseCommand(String name, Map<String, ?> data) {
        this(new GeneralMessage(name, data));
    }

    /** Creates the Command of a message; its fields are not validated. */
    public BaseCommand(GeneralMessage message) {
        this.message = message;
    }

    /** Creates the Command of a message, under its current name. */
    protected BaseCommand(String name, GeneralMessage message) {
        this(name.equals(message.name) ? message
                : message.with(name, message.id, message.beacon));
    }

    public final String name() {
        return message.name;
    }

    /** Returns the fields under their names on the wire, as JSON values; unmodifiable. */
    public final Map<String, Object> data() {
        return message.data;
    }

    /** Returns the id for the requested answer, or null. */
    public final String id() {
        return message.id;
    }

    public final GeneralMessage toMessage() {
        return message;
    }

    /** Returns the message to send under another id and beacon; either may be null. */
    public final GeneralMessage toMessage(String id, Long beacon) {
        return message.with(name(), id, beacon);
    }

    @Override
    public String toString() {
        return name() + " " + data();
    }
}
