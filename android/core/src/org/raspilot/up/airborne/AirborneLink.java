package org.raspilot.up.airborne;

import java.util.Random;
import org.raspilot.up.Up;
import org.raspilot.up.airborne.AirborneSettings.OrientationTransport;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.CommandReceiver.AnswerSink;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.net.DiscoveryClient.BroadcastAddresses;
import org.raspilot.up.net.DiscoveryClient;
import org.raspilot.up.net.Endpoint;
import org.raspilot.up.net.EndpointDiscovery;
import org.raspilot.up.net.FixedEndpoint;
import org.raspilot.up.net.InterfaceBroadcasts;
import org.raspilot.up.net.LastEndpoint;
import org.raspilot.up.net.OrientationSender;
import org.raspilot.up.net.RunnerClient;
import org.raspilot.up.net.RunnerRequest;
import org.raspilot.up.net.UpSocket;
import org.raspilot.up.net.UpSocketListener;
import org.raspilot.up.net.UpSocketSettings;
import org.raspilot.up.net.UpSocketStatus;
import org.raspilot.up.providers.MessageSink;
import org.raspilot.up.wire.GeneralMessage;
import org.raspilot.up.wire.OrientationFrame;

/** The two links to the Raspberry Pi: one for Commands and, if enabled, one for orientation. */
final class AirborneLink implements MessageSink, AnswerSink, UpSocketListener {
    /** The name that nameless clients of a runner share (protocols 8). */
    private static final String NAMELESS = "default";
    private static final String DEAD = "the Raspberry Pi stopped answering";

    private final Up up;
    private final AirborneListener listener;
    private final LastEndpoint known;
    private final UpSocket socket;
    private final OrientationSender orientation;
    private final LinkWatchdog watch;
    private String reported = "";
    private boolean wasLost;

    AirborneLink(Loop loop, AirborneSettings settings, Random random, Up up,
            AirborneListener listener) {
        this.up = up;
        this.listener = listener;
        known = new LastEndpoint(discovery(loop, settings));
        socket = new UpSocket(loop, known, this, UpSocketSettings.lines(), random);
        OrientationTransport transport = settings.orientationTransport();
        orientation = transport == OrientationTransport.OFF ? null
                : new OrientationSender(loop, known, transport == OrientationTransport.UDP, random);
        watch = new LinkWatchdog(loop, Integer.toHexString(random.nextInt()) + ".", () ->
                socket.drop("silent", DEAD));
    }

    void start() {
        reported = "";
        wasLost = false;
        socket.start();
        if (orientation != null) {
            orientation.start();
        }
    }

    void stop() {
        if (orientation != null) {
            orientation.stop();
        }
        socket.stop();
    }

    /** Retries immediately instead of after the wait. */
    void reconnectNow() {
        socket.reconnectNow();
        if (orientation != null) {
            orientation.reconnectNow();
        }
    }

    void onAnswer(String id) {
        watch.onAnswer(id);
    }

    UpSocketStatus status() {
        return socket.status();
    }

    long connections() {
        return socket.connects();
    }

    @Override
    public boolean sendNewest(String key, BaseCommand command) {
        return socket.isConnected()
                && socket.sendNewest(key, command.toMessage(watch.nextId(), null).toLine());
    }

    @Override
    public boolean sendOrientation(OrientationFrame frame) {
        return orientation != null && orientation.send(frame.toBytes());
    }

    @Override
    public boolean isOpen() {
        return socket.isConnected();
    }

    @Override
    public boolean isOrientationOpen() {
        return orientation != null && orientation.isReady();
    }

    @Override
    public void answer(GeneralMessage answer) {
        socket.send(answer.toLine());
    }

    @Override
    public void onConnected() {
        reported = "";
        watch.opened();
        if (orientation != null && wasLost) {
            // The other connection may be as dead as this one was, and would not show it for long.
            orientation.replaceConnection("the link for Commands had been lost");
        } else if (orientation != null) {
            orientation.reconnectNow();
        }
        wasLost = false;
        listener.onConnected(socket.status().endpoint);
        up.providersController().linkOpened();
    }

    @Override
    public void onReceived(byte[] bytes, int length) {
        watch.onLine();
        up.commandReceiver().receiveLine(bytes, length, this);
    }

    @Override
    public void onLost(String reason) {
        watch.closed();
        wasLost = true;
        reported = socket.status().sentence;
        up.providersController().linkClosed();
        listener.onDisconnected(socket.status().code, reason);
    }

    @Override
    public void onStatus() {
        UpSocketStatus status = socket.status();
        boolean isTrouble = status.state == UpSocketStatus.State.WAITING;
        if (isTrouble && !status.sentence.equals(reported)) {
            reported = status.sentence;
            listener.onEvent(status.code, reported);
        }
    }

    /** Returns the runner in Black Box Mode, otherwise the configured host, otherwise Discovery. */
    private static EndpointDiscovery discovery(Loop loop, final AirborneSettings settings) {
        if (settings.isByRunner()) {
            RunnerRequest request = new RunnerRequest(
                    settings.aircraft.isEmpty() ? NAMELESS : settings.aircraft,
                    settings.profile, settings.pairing);
            return new RunnerClient(loop, settings.runnerHost, settings.runnerPort,
                    settings.runnerTls, request);
        }
        if (!settings.host.isEmpty()) {
            return new FixedEndpoint(new Endpoint(
                    settings.host, settings.generalPort, settings.orientationPort));
        }
        return new DiscoveryClient(loop, asked(settings), settings.discoveryPort,
                settings.generalPort, settings.orientationPort);
    }

    private static BroadcastAddresses asked(final AirborneSettings settings) {
        if (settings.discoveryHosts.isEmpty()) {
            return new InterfaceBroadcasts();
        }
        return () -> settings.discoveryHosts;
    }
}
