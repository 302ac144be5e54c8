package org.raspilot.app;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertTrue;
import static org.robolectric.Shadows.shadowOf;

import android.content.Context;
import android.content.Intent;
import android.content.SharedPreferences;
import java.io.IOException;
import org.junit.After;
import org.junit.Before;
import org.junit.Test;
import org.raspilot.up.android.PairingStore;
import org.raspilot.up.android.SpawnService;
import org.raspilot.up.security.Pairing;
import org.robolectric.Robolectric;
import org.robolectric.annotation.Config;

/** Black Box Mode: start first sends a request to the runner, by the intent service. */
public final class SpawnTest extends AppBench {
    private Peer runner;
    private String answer;

    @Before
    public void listen() throws IOException {
        runner = new Peer() {
            @Override
            void onLine(String line) {
                say(answer);
            }
        };
        handset.set(R.string.key_mode, handset.application.getString(R.string.mode_black_box));
        handset.set(R.string.key_runner_host, "127.0.0.1");
        handset.set(R.string.key_runner_port, "" + runner.port());
        handset.set(R.string.key_aircraft, "glider-5");
        handset.fitSensors();
    }

    @After
    public void close() throws IOException {
        runner.close();
    }

    private Intent wish() {
        handset.open();
        find(R.id.run_switch).performClick();
        Intent wish = shadowOf(handset.application).getNextStartedService();
        assertEquals(SpawnService.class.getName(), wish.getComponent().getClassName());
        assertTrue(RaspilotApplication.of(handset.application).spawning().isAsking());
        assertEquals(handset.application.getString(R.string.cancel), text(R.id.run_switch));
        return wish;
    }

    private void ask() throws Exception {
        Intent wish = wish();
        Robolectric.buildService(SpawnService.class, wish).create().startCommand(0, 1);
        Wait.until("the answer",
                () -> !RaspilotApplication.of(handset.application).spawning().isAsking());
        assertEquals(1, runner.heard().size());
    }

    @Test
    public void aRefusalIsALineOfTheLogAndStartsNothing() throws Exception {
        answer = "{\"message\": \"Raspilot not running\", \"spawned\": false, "
                + "\"error\": \"Unknown profile.\", \"running\": false, "
                + "\"pid\": null, \"instance\": \"glider-5\", \"ports\": null, \"proxy\": null, "
                + "\"myAddress\": \"127.0.0.1\"}";
        ask();
        mustSay("\"aircraft\": \"glider-5\"", runner.heard().get(0));
        assertFalse(handset.startWished());
        mustSay("Unknown profile", text(R.id.run_link));
    }

    /** The person who has paired expects a refusal, and no request that any relay can change. */
    @Test
    @Config(sdk = 16)
    public void withAKeyThatIsGoneOrUnreadableNothingIsAsked() throws Exception {
        PairingStore keys = new PairingStore(handset.application);
        keys.put(Pairing.parse(KeySettingsTest.TEXT.replace("glider-1", "glider-5")));
        SharedPreferences file =
                handset.application.getSharedPreferences("up_keys", Context.MODE_PRIVATE);
        for (Boolean isDamaged : new Boolean[] {true, false}) {
            Intent wish = wish();
            // After the request, before its service runs. A file of the system's that it cannot
            // read is an empty one.
            if (isDamaged) {
                file.edit().putString("glider-5", "keystore AAAA").commit();
            } else {
                file.edit().clear().commit();
            }
            Robolectric.buildService(SpawnService.class, wish).create().startCommand(0, 1);
            Wait.until("the answer",
                    () -> !RaspilotApplication.of(handset.application).spawning().isAsking());
            assertTrue(runner.heard().isEmpty());
            assertFalse(handset.startWished());
            mustSay("(" + SpawnService.KEY_UNREADABLE + ")", text(R.id.run_link));
            assertTrue(keys.aircraft().contains("glider-5"));
            keys.put(Pairing.parse(KeySettingsTest.TEXT.replace("glider-1", "glider-5")));
        }
        keys.forget("glider-5");
        assertNull(keys.get("glider-5"));
    }

    @Test
    @Config(sdk = 16)
    public void withTheAircraftsKeyTheRequestIsSignedAndAPlainAnswerStartsNothing()
            throws Exception {
        new PairingStore(handset.application).put(
                Pairing.parse(KeySettingsTest.TEXT.replace("glider-1", "glider-5")));
        answer = "{\"running\": true, \"ports\": {\"general\": 1, \"orientation\": 1}}";
        ask();
        mustSay("\"protected\"", runner.heard().get(0));
        assertFalse(handset.startWished());
        mustSay(": unprotected", text(R.id.run_link));
    }

    @Test
    public void anInstanceThatRunsIsConnectedTo() throws Exception {
        PlayedBoard board = new PlayedBoard();
        try {
            answer = "{\"message\": \"Raspilot spawned\", \"spawned\": true, \"error\": null, "
                    + "\"running\": true, \"pid\": 1, \"instance\": \"glider-5\", \"ports\": "
                    + "{\"general\": " + board.port() + ", \"orientation\": " + board.port()
                    + "}, \"proxy\": null, \"myAddress\": \"127.0.0.1\"}";
            ask();
            assertTrue(handset.startWished());
            Wait.until("the instance", board::isConnected);
        } finally {
            board.close();
        }
    }
}
