package org.raspilot.up.android;

import android.app.IntentService;
import android.content.Context;
import android.content.Intent;
import android.os.Message;
import android.os.Messenger;
import android.os.RemoteException;
import android.util.Log;
import java.io.IOException;
import java.util.concurrent.ArrayBlockingQueue;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.TimeUnit;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.loop.SelectorLoop;
import org.raspilot.up.net.Endpoint;
import org.raspilot.up.net.EndpointDiscovery.DiscoveryListener;
import org.raspilot.up.net.RunnerAnswer;
import org.raspilot.up.net.RunnerClient;
import org.raspilot.up.net.RunnerRequest;
import org.raspilot.up.security.Pairing;
import org.raspilot.up.tls.TlsIdentity;

/**
 * Requests an instance from a runner and ends (thesis 3.5.1, "Intent Service"): requests run one
 * after the other on its own thread. When an instance runs, the messenger receives the result, and
 * the application starts its {@link BaseUpService}, which connects to the address from the runner.
 */
public final class SpawnService extends IntentService {
    public static final String KEY_UNREADABLE = "key_unreadable";
    public static final String CERTIFICATES_UNREADABLE = "certificates_unreadable";

    private static final String TAG = "Up";
    /** Longer than the runner's own 20 s. */
    private static final long MAX_S = 30;
    private static final String HOST = "host";
    private static final String PORT = "port";
    private static final String AIRCRAFT = "aircraft";
    private static final String PROFILE = "profile";
    private static final String IS_TLS = "tls";
    private static final String ANSWER = "answer";

    public SpawnService() {
        super("up spawn");
        // A request that the system interrupted is not repeated behind the user's back.
        setIntentRedelivery(false);
    }

    /**
     * Sends a request, signed by this phone's key of the aircraft if there is one. A key that is
     * kept and cannot be read is the end of the request, with the code {@link #KEY_UNREADABLE}.
     *
     * @param isTls by TLS with this phone's certificates, or plain
     * @param aircraft the aircraft's name
     * @param profile a ready-made configuration of the runner; empty: none
     * @param answer receives one message with {@link #result}
     */
    public static void request(Context context, String host, int port, boolean isTls,
            String aircraft, String profile, Messenger answer) {
        context.startService(new Intent(context, SpawnService.class)
                .putExtra(HOST, host)
                .putExtra(PORT, port)
                .putExtra(IS_TLS, isTls)
                .putExtra(AIRCRAFT, aircraft)
                .putExtra(PROFILE, profile)
                .putExtra(ANSWER, answer));
    }

    public static SpawnResult result(Message message) {
        return (SpawnResult) message.obj;
    }

    @Override
    protected void onHandleIntent(Intent intent) {
        if (intent == null) {
            return;
        }
        Messenger answer = intent.getParcelableExtra(ANSWER);
        reply(answer, run(intent));
    }

    private SpawnResult run(Intent intent) {
        SelectorLoop loop = new SelectorLoop("up spawn loop", fault ->
                Log.e(TAG, "up spawn failed in a call", fault), new SleepClock());
        BlockingQueue<SpawnResult> results = new ArrayBlockingQueue<>(1);
        try {
            loop.start();
            loop.post(() -> send(intent, loop, results));
            SpawnResult result = results.poll(MAX_S, TimeUnit.SECONDS);
            return result != null ? result
                    : new SpawnResult(null, "no_answer", "the runner does not answer");
        } catch (IOException failure) {
            return new SpawnResult(null, "no_loop", failure.getMessage());
        } catch (InterruptedException interruption) {
            Thread.currentThread().interrupt();
            return new SpawnResult(null, "interrupted", "the request was interrupted");
        } finally {
            loop.stop();
        }
    }

    private void send(Intent intent, Loop loop, BlockingQueue<SpawnResult> results) {
        final RunnerClient client;
        String fault = CERTIFICATES_UNREADABLE;
        try {
            String aircraft = intent.getStringExtra(AIRCRAFT);
            PairingStore keys = new PairingStore(this);
            // Secrets do not travel in an intent.
            boolean isTls = intent.getBooleanExtra(IS_TLS, false);
            TlsIdentity identity = isTls ? keys.certificates() : null;
            if (isTls && identity == null) {
                throw new IllegalArgumentException("the certificates for TLS are gone");
            }
            fault = KEY_UNREADABLE;
            Pairing key = keys.get(aircraft);
            fault = "request_invalid";
            client = new RunnerClient(loop, intent.getStringExtra(HOST),
                    intent.getIntExtra(PORT, 0), identity,
                    new RunnerRequest(aircraft, intent.getStringExtra(PROFILE), key));
        } catch (IllegalArgumentException wrong) {
            results.add(new SpawnResult(null, fault, wrong.getMessage()));
            return;
        }
        client.find(new DiscoveryListener() {
            @Override
            public void onFound(Endpoint place) {
                RunnerAnswer answer = client.lastAnswer();
                results.add(new SpawnResult(answer, "", answer.error == null ? answer.message
                        : answer.message + ": " + answer.error));
            }

            @Override
            public void onNotFound(String code, String reason) {
                results.add(new SpawnResult(null, code, reason));
            }
        });
    }

    private static void reply(Messenger answer, SpawnResult result) {
        Message message = Message.obtain();
        // In this process: the object itself arrives.
        message.obj = result;
        try {
            answer.send(message);
        } catch (RemoteException gone) {
            Log.w(TAG, "the requester of the runner's answer is gone", gone);
        }
    }
}
