package org.raspilot.up.net;

import java.io.IOException;
import java.nio.charset.Charset;
import java.util.List;
import org.raspilot.up.loop.Cancellable;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.loop.UdpPort.UdpListener;
import org.raspilot.up.loop.UdpPort;
import org.raspilot.up.net.EndpointDiscovery.DiscoveryListener;

/** Finds the Raspberry Pi on the local network by Discovery (protocols 7). Only on the loop. */
public final class DiscoveryClient implements EndpointDiscovery {
    public static final int PORT = 3001;
    /** How long an answer is waited for, ms. */
    public static final int ANSWER_MS = 1500;
    /** After how long the question is repeated, ms: datagrams are lost. */
    public static final int REPEAT_MS = 400;
    private static final byte[] QUESTION =
            "Where is Raspilot?".getBytes(Charset.forName("US-ASCII"));

    private final Loop loop;
    private final BroadcastAddresses addresses;
    private final int port;
    private final int generalPort;
    private final int orientationPort;

    /** Asks at {@code port}; the found host listens at the other two, 0: not for orientation. */
    public DiscoveryClient(Loop loop, BroadcastAddresses addresses, int port, int generalPort,
            int orientationPort) {
        this.loop = loop;
        this.addresses = addresses;
        this.port = port;
        this.generalPort = generalPort;
        this.orientationPort = orientationPort;
    }

    @Override
    public Cancellable find(DiscoveryListener listener) {
        final Question question = new Question(listener);
        question.begin();
        return question;
    }

    private final class Question implements Cancellable, UdpListener {
        private final DiscoveryListener listener;
        private boolean isPending = true;
        private boolean wasSent;
        private UdpPort udp;
        private Cancellable repeat;
        private Cancellable limit;
        private String refused = "";

        Question(DiscoveryListener listener) {
            this.listener = listener;
        }

        void begin() {
            try {
                udp = loop.network().openUdp(this);
            } catch (IOException error) {
                isPending = false;
                listener.onNotFound("not_found",
                        "no socket to ask Discovery with: " + error.getMessage());
                return;
            }
            limit = loop.schedule(ANSWER_MS, () -> giveUp());
            ask();
        }

        @Override
        public void cancel() {
            if (isPending) {
                isPending = false;
                repeat.cancel();
                limit.cancel();
                udp.close();
            }
        }

        @Override
        public void onDatagram(byte[] bytes, int length, String host, int sourcePort) {
            final String found = sourcePort == port
                    ? DiscoveryAnswer.read(bytes, length, host) : null;
            if (found == null) {
                return;
            }
            if (!DiscoveryAnswer.isUsable(found, host)) {
                refused = "; refused " + found + " from " + host
                        + ": not the sender's own address in a private network";
                return;
            }
            cancel();
            listener.onFound(new Endpoint(found, generalPort, orientationPort));
        }

        private void ask() {
            repeat = loop.schedule(REPEAT_MS, () -> ask());
            for (String address : addresses.current()) {
                wasSent |= udp.send(QUESTION, address, port);
            }
        }

        private void giveUp() {
            cancel();
            final List<String> asked = addresses.current();
            final String where = asked + " port " + port;
            listener.onNotFound("not_found", wasSent
                    ? "no answer from Discovery at " + where + refused
                    : "no network to ask for Discovery in: " + where);
        }
    }

    /** The targets of Discovery, read for each request because a phone's networks change. */
    public interface BroadcastAddresses {
        /** Returns numeric IPv4 addresses, broadcast or of one host; empty without a network. */
        List<String> current();
    }
}
