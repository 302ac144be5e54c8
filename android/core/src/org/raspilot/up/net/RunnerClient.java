package org.raspilot.up.net;

import java.io.ByteArrayOutputStream;
import java.nio.charset.Charset;
import org.raspilot.up.loop.Cancellable;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.loop.TcpConnection.TcpListener;
import org.raspilot.up.loop.TcpConnection;
import org.raspilot.up.net.EndpointDiscovery.DiscoveryListener;
import org.raspilot.up.security.EnvelopeException;
import org.raspilot.up.security.RunnerSession;
import org.raspilot.up.tls.TlsConnection;
import org.raspilot.up.tls.TlsIdentity;

/**
 * Requests an instance from a runner and finds its address (protocols 8). With a key only an
 * authentic answer counts. Only on the loop.
 */
public final class RunnerClient implements EndpointDiscovery {
    public static final int PORT = 3002;
    /** How long connecting may take, ms. */
    public static final int CONNECT_MS = 2000;
    /** How long the runner may take from there, ms: it starts a whole program. */
    public static final int ANSWER_MS = 20000;
    public static final int MAX_ANSWER_BYTES = 65536;

    private static final Charset UTF_8 = Charset.forName("UTF-8");

    private final Loop loop;
    private final String host;
    private final int port;
    private final TlsIdentity tls;
    private final RunnerRequest request;
    private RunnerAnswer lastAnswer;

    /** Creates a client of a runner; {@code tls} null: plain TCP. */
    public RunnerClient(Loop loop, String host, int port, TlsIdentity tls,
            RunnerRequest request) {
        this.loop = loop;
        this.host = host;
        this.port = port;
        this.tls = tls;
        this.request = request;
    }

    @Override
    public Cancellable find(DiscoveryListener listener) {
        final Request asked = new Request(listener);
        asked.connection = TlsConnection.open(loop, tls, host, port, CONNECT_MS, asked);
        return asked;
    }

    /** Returns the newest answer with an address; null: none so far. */
    public RunnerAnswer lastAnswer() {
        return lastAnswer;
    }

    private final class Request implements Cancellable, TcpListener {
        private final DiscoveryListener listener;
        private final RunnerSession session =
                request.pairing == null ? null : new RunnerSession(request.pairing);
        private byte[] line =
                (session == null ? request.json + "\n" : session.hello()).getBytes(UTF_8);
        private boolean isAsked = session == null;
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
        public void onConnected() {
            limit = loop.schedule(ANSWER_MS, () ->
                    fail("no_answer",
                            "the runner did not answer within " + ANSWER_MS / 1000 + " s"));
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
                fail("not_understood",
                        "the runner's answer is longer than " + MAX_ANSWER_BYTES + " bytes");
                return;
            }
            answer.write(bytes, 0, end);
            if (end < length) {
                final String said = new String(answer.toByteArray(), UTF_8);
                answer.reset();
                read(said);
            }
        }

        @Override
        public void onClosed(String code, String reason) {
            fail(code, limit == null ? "no runner: " + reason
                    : "the runner hung up without an answer: " + reason);
        }

        private void read(String said) {
            final RunnerAnswer read;
            try {
                if (!isAsked) {
                    isAsked = true;
                    line = session.request(said, request.json).getBytes(UTF_8);
                    written = 0;
                    onWritable();
                    return;
                }
                read = RunnerAnswer.read(session == null ? said : session.result(said), host);
            } catch (RunnerAnswer.RefusedException refusal) {
                fail(refusal.code, refusal.getMessage());
                return;
            } catch (EnvelopeException refusal) {
                fail(refusal.code, "the runner gives no protected answer to the key "
                        + request.pairing + ": " + refusal.code);
                return;
            }
            lastAnswer = read;
            cancel();
            listener.onFound(read.endpoint);
        }

        private void fail(String code, String reason) {
            cancel();
            listener.onNotFound(code, reason);
        }
    }
}
