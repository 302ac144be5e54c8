package org.raspilot.up;

import static org.junit.Assert.assertEquals;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.List;
import org.junit.Test;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.BaseCommandHandler;
import org.raspilot.up.commands.CommandFields;
import org.raspilot.up.commands.CommandReceiver.AnswerSink;
import org.raspilot.up.commands.CommandRefusedException;
import org.raspilot.up.commands.CommandRegistry.CommandReader;
import org.raspilot.up.loop.ManualLoop;
import org.raspilot.up.providers.MessageSink;
import org.raspilot.up.providers.RatePolicy;
import org.raspilot.up.providers.SensorListener;
import org.raspilot.up.providers.SensorProvider;
import org.raspilot.up.providers.SensorSource;
import org.raspilot.up.wire.GeneralMessage;
import org.raspilot.up.wire.OrientationFrame;
import org.raspilot.up.wire.Vectors;

/**
 * Your own application: a camera that is released from the ground, and a sensor for light.
 *
 * <p>It serves as an example: a Command, a handler and a provider are one class and one
 * registration each, and the Up Library has no code for them.
 */
public final class OwnApplicationTest {
    /** A Command: its name, its fields with their bounds. */
    static final class ReleaseCommand extends BaseCommand {
        static final String NAME = "camera.release";
        static final CommandReader READER = message -> new ReleaseCommand(message);

        final long pictures;

        ReleaseCommand(GeneralMessage message) {
            super(NAME, message);
            pictures = new CommandFields(message.data).whole("pictures", 1, 10);
        }
    }

    /** A handler: the action of a Command. */
    static final class ReleaseHandler extends BaseCommandHandler {
        long roomFor = 5;

        @Override
        public void runAction(BaseCommand command) throws CommandRefusedException {
            long pictures = ((ReleaseCommand) command).pictures;
            if (pictures > roomFor) {
                throw new CommandRefusedException("there is room for " + roomFor + " pictures");
            }
            roomFor -= pictures;
        }
    }

    /** A provider: what a sensor's reading is as a Command. */
    static final class LightProvider extends SensorProvider<Double> {
        LightProvider(SensorSource<Double> sensor) {
            super("light", sensor, RatePolicy.stream(200, 2000));
        }

        @Override
        protected BaseCommand read(Double lux) {
            return new BaseCommand("camera.light", Collections.singletonMap("lux", lux));
        }
    }

    private final ManualLoop loop = new ManualLoop(null, fault -> {
        throw new AssertionError(fault);
    });
    private final Up up = new Up(loop, (handler, command, fault) -> {
        throw new AssertionError(fault);
    });
    private final List<String> lines = new ArrayList<>();

    @Test
    public void aCommandAndItsHandlerAreOneRegistrationEach() {
        ReleaseHandler handler = new ReleaseHandler();
        up.commandRegistry().register(ReleaseCommand.NAME, ReleaseCommand.READER);
        up.commandExecutor().registerCommand(ReleaseCommand.NAME, handler);

        receive("{\"name\": \"camera.release\", \"data\": {\"pictures\": 3}, \"id\": \"1\"}");
        receive("{\"name\": \"camera.release\", \"data\": {\"pictures\": 4}, \"id\": \"2\"}");
        receive("{\"name\": \"camera.release\", \"data\": {\"pictures\": 11}, \"id\": \"3\"}");

        assertEquals(2, handler.roomFor);
        assertEquals(Arrays.asList(
                "{\"name\": \"up.ack\", \"data\": {\"id\": \"1\"}, \"id\": null}",
                "{\"name\": \"up.nack\", \"data\": {\"id\": \"2\", \"code\": \"refused\","
                        + " \"reason\": \"there is room for 2 pictures\"}, \"id\": null}",
                "{\"name\": \"up.nack\", \"data\": {\"id\": \"3\", \"code\": \"invalid\","
                        + " \"reason\": \"camera.release: pictures must be a whole number between"
                        + " 1 and 10, not 11\"}, \"id\": null}"), lines);
    }

    @Test
    public void aHandlerAloneMakesANameKnown() {
        final List<Object> heard = new ArrayList<>();
        up.commandExecutor().registerCommand("camera.zoom", command ->
                heard.add(command.data().get("factor")));

        receive("{\"name\": \"camera.zoom\", \"data\": {\"factor\": 2.5}, \"id\": \"1\"}");

        assertEquals(Arrays.<Object>asList(2.5), heard);
        assertEquals(1, lines.size());
    }

    @Test
    public void aProviderIsOneRegistration() {
        LightSensor sensor = new LightSensor();
        up.providersController().register(new LightProvider(sensor));
        up.providersController().start(new Link());

        sensor.measure(320.5);
        loop.advance(1000);

        assertEquals(Arrays.asList(
                "{\"name\": \"camera.light\", \"data\": {\"lux\": 320.5}, \"id\": null}"), lines);
    }

    private void receive(String line) {
        byte[] bytes = Vectors.bytes(line);
        up.commandReceiver().receiveLine(bytes, bytes.length, answers);
    }

    private final AnswerSink answers = answer -> lines.add(Vectors.text(answer.toLine()).trim());

    /** The link to the Raspberry Pi, as far as a provider sees it. */
    private final class Link implements MessageSink {
        @Override
        public boolean sendNewest(String key, BaseCommand command) {
            return lines.add(Vectors.text(command.toMessage().toLine()).trim());
        }

        @Override
        public boolean sendOrientation(OrientationFrame frame) {
            return false;
        }

        @Override
        public boolean isOpen() {
            return true;
        }

        @Override
        public boolean isOrientationOpen() {
            return false;
        }
    }

    /** A sensor that measures on request. */
    private static final class LightSensor implements SensorSource<Double> {
        private SensorListener<Double> listener;

        void measure(double lux) {
            listener.onReading(lux);
        }

        @Override
        public boolean isPresent() {
            return true;
        }

        @Override
        public String name() {
            return "light sensor";
        }

        @Override
        public void subscribe(long periodMs, SensorListener<Double> to) {
            listener = to;
        }

        @Override
        public void unsubscribe() {
            listener = null;
        }
    }
}
