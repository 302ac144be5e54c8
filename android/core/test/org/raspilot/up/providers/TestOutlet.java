package org.raspilot.up.providers;

import java.util.ArrayList;
import java.util.List;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.wire.OrientationFrame;

/** A link that records messages with their times. */
public final class TestOutlet implements MessageSink {
    public final List<BaseCommand> commands = new ArrayList<>();
    public final List<OrientationFrame> frames = new ArrayList<>();
    public final List<Long> timesMs = new ArrayList<>();
    public boolean isOpen = true;
    private final Loop loop;

    public TestOutlet(Loop loop) {
        this.loop = loop;
    }

    @Override
    public boolean sendNewest(String key, BaseCommand command) {
        if (isOpen) {
            commands.add(command);
            timesMs.add(loop.nowMs());
        }
        return isOpen;
    }

    @Override
    public boolean sendOrientation(OrientationFrame frame) {
        if (isOpen) {
            frames.add(frame);
            timesMs.add(loop.nowMs());
        }
        return isOpen;
    }

    @Override
    public boolean isOpen() {
        return isOpen;
    }

    @Override
    public boolean isOrientationOpen() {
        return isOpen;
    }

    /** Returns the newest Command as text. */
    public String last() {
        return commands.isEmpty() ? "" : commands.get(commands.size() - 1).toString();
    }
}
