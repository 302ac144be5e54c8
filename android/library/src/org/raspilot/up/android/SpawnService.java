package org.raspilot.up.android;

import android.app.IntentService;
import android.content.Context;
import android.content.Intent;
import android.os.Message;
import android.os.Messenger;
import android.os.RemoteException;
import android.util.Log;
import java.io.IOException;
import org.raspilot.up.loop.SelectorLoop;

/**
 * Requests an instance from a runner and ends (thesis 3.5.1, "Intent Service"): requests run one
 * after the other on its own thread. When an instance runs, the messenger receives the result, and
 * the application starts its {@link BaseUpService}, which connects to the address from the runner.
 */
public final class SpawnService extends IntentService {
    private static final String TAG = "Up";
    private static final String HOST = "host";
    private static final String PORT = "port";
    private static final String AIRCRAFT = "aircraft";
    private static final String PROFILE = "profile";
    private static final String ANSWER = "answer";

    public SpawnService() {
        super("up spawn");
        // A request that the system interrupted is not repeated behind the user's back.
        setIntentRedelivery(false);
    }

    /**
     * Sends a request.
     *
     * @param aircraft the aircraft's name
     * @param profile a ready-made configuration of the runner; empty: none
     * @param answer receives one message with {@link #result}
     */
    public static void request(Context context, String host, int port, String aircraft,
            String profile, Messenger answer) {
        context.startService(new Intent(context, SpawnService.class)
                .putExtra(HOST, host)
                .putExtra(PORT, port)
                .putExtra(AIRCRAFT, aircraft)
                .putExtra(PROFILE, profile)
                .putExtra(ANSWER, answer));
    }

    /** Returns the result in a message to the messenger. */
    public static SpawnResult result(Message message) {
        return SpawnResult.of(message.getData());
    }

    @Override
    protected void onHandleIntent(Intent intent) {
        if (intent == null) {
            return;
        }
        SpawnRequest request = new SpawnRequest(intent.getStringExtra(HOST),
                intent.getIntExtra(PORT, 0), intent.getStringExtra(AIRCRAFT),
                intent.getStringExtra(PROFILE));
        Messenger answer = intent.getParcelableExtra(ANSWER);
        reply(answer, run(request));
    }

    private static SpawnResult run(SpawnRequest request) {
        SelectorLoop loop = new SelectorLoop("up spawn loop", new Faults("up spawn"),
                new SleepClock());
        try {
            loop.start();
            return request.run(loop);
        } catch (IOException failure) {
            return SpawnResult.refused(failure.getMessage());
        } finally {
            loop.stop();
        }
    }

    private static void reply(Messenger answer, SpawnResult result) {
        Message message = Message.obtain();
        message.setData(result.toBundle());
        try {
            answer.send(message);
        } catch (RemoteException gone) {
            Log.w(TAG, "the requester of the runner's answer is gone", gone);
        }
    }
}
