package org.raspilot.up.net;

import java.io.ByteArrayOutputStream;
import java.nio.charset.Charset;
import org.raspilot.up.loop.Cancellable;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.loop.TcpConnection.TcpListener;
import org.raspilot.up.loop.TcpConnection;
import org.raspilot.up.net.EndpointDiscovery.DiscoveryListener;

/** Requests an instance from a runner and finds its address (protocols 8). Only on the loop. */
public final class RunnerClient implements EndpointDiscovery {
    /** The TCP port of a runner. */
    public static final int PORT = 3002;
    /** How long connecting may take, ms. */
    public static final int CONNECT_MS = 2000;
    /** How long the runner may take from there, ms: it starts a whole program. */
    public static final int ANSWER_MS = 20000;
    /** Bytes of the longest answer. */
    public static final int MAX_ANSWER_BYTES = 65536;

    private final Loop loop;
    private final String host;
    private final int port;
    private final RunnerRequest request;
    private RunnerAnswer lastAnswer;

    /**
     * Creates a client.
     *
     * @param host the runner's name or address
     * @param port its port, {@link #PORT} unless configured
     */
    public RunnerClient(Loop loop, String host, int port, RunnerRequest request) {
        this.loop = loop;
        this.host = host;
        this.port = port;
        this.request = request;
    }

    @Override
    public Cancellable find(DiscoveryListener listener) {
        final Request asked = new Request(listener);
        asked.connection = loop.network().connectTcp(host, port, CONNECT_MS, asked);
        return asked;
    }

    /** Returns the newest answer with an address; null: none so far. */
    public RunnerAnswer lastAnswer() {
        return lastAnswer;
    }

    private final class Request implements Cancellable, TcpListener {
        private final DiscoveryListener listener;
        private final byte[] line = request.toLine();
        private final ByteArrayOutputStream answer = new ByteArrayOutputStream();
        private TcpConnection connection;
        private Cancellable limit;
        private int written;
        private boolean isPending = true;

        Request(DiscoveryListener listener) {
            this.listener = listener;
        }

        @Override
        public void cancel() {
            if (isPending) {
                isPending = false;
                if (limit != null) {
                    limit.cancel();
                }
                connection.close();
            }
        }

        @Override
        public boolean isPending() {
            return isPending;
        }

        @Override
        public void onConnected() {
            limit = loop.schedule(ANSWER_MS, () ->
                    fail("the runner did not answer within " + ANSWER_MS / 1000 + " s"));
            onWritable();
        }

        @Override
        public void onWritable() {
            written += connection.write(line, written, line.length - written);
        }

        @Override
        public void onBytes(byte[] bytes, int length) {
            int end = 0;
            while (end < length && bytes[end] != '\n') {
                end++;
            }
            if (answer.size() + end > MAX_ANSWER_BYTES) {
                fail("the runner's answer is longer than " + MAX_ANSWER_BYTES + " bytes");
                return;
            }
            answer.write(bytes, 0, end);
            if (end < length) {
                read(new String(answer.toByteArray(), Charset.forName("UTF-8")));
            }
        }

        @Override
        public void onClosed(String reason) {
            fail(limit == null ? "no runner: " + reason
                    : "the runner hung up without an answer: " + reason);
        }

        private void read(String text) {
            final RunnerAnswer read;
            try {
                read = RunnerAnswer.read(text, host);
            } catch (RunnerAnswer.RefusedException refusal) {
                fail(refusal.getMessage());
                return;
            }
            lastAnswer = read;
            cancel();
            listener.onFound(read.endpoint);
        }

        private void fail(String reason) {
            cancel();
            listener.onNotFound(reason);
        }
    }
}
