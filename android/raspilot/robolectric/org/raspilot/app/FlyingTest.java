package org.raspilot.app;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertTrue;

import android.app.AlertDialog;
import android.content.DialogInterface;
import android.view.ViewGroup;
import android.widget.Button;
import android.widget.EditText;
import java.util.ArrayList;
import java.util.List;
import org.junit.After;
import org.junit.Before;
import org.junit.Test;
import org.raspilot.app.view.TrackView;
import org.raspilot.up.ground.FlightModes;
import org.robolectric.shadows.ShadowAlertDialog;
import org.robolectric.util.ReflectionHelpers;

/** Flight modes by the aircraft's list, and a place on the track to fly to. */
public final class FlyingTest extends AppBench {
    private PlayedProxy proxy;

    @Before
    public void fly() throws Exception {
        proxy = new PlayedProxy();
        handset.set(R.string.key_ground_host, "127.0.0.1");
        handset.set(R.string.key_ground_port, Integer.toString(proxy.port()));
        handset.open();
        handset.choose(Screen.GROUND);
        proxy.setFlying(true);
    }

    @After
    public void land() throws Exception {
        proxy.close();
    }

    private void untilEnabled(int button) throws Exception {
        Wait.until("the button", () -> find(button).isEnabled());
    }

    /** Returns the Commands of this test that the aircraft received. */
    private List<String> commands() {
        List<String> all = new ArrayList<>();
        for (String line : proxy.heard()) {
            if (line.contains("up.flight_mode.set") || line.contains("up.navigation.target")
                    || line.contains("up.home.set")) {
                all.add(line);
            }
        }
        return all;
    }

    private void confirm() {
        AlertDialog asked = ShadowAlertDialog.getLatestAlertDialog();
        assertTrue(asked.isShowing());
        // Only values that were seen are commanded.
        Drawing.of(handset.window.get());
        asked.getButton(DialogInterface.BUTTON_POSITIVE).performClick();
        Wait.pass(0);
    }

    /** Taps until the question is there: telemetry of a busy machine can be too old for it. */
    private void tap(double northM, double eastM) throws Exception {
        TrackView.TapListener listener =
                ReflectionHelpers.getField(find(R.id.ground_track), "tapListener");
        Wait.until("the question", () -> {
            listener.onTap(northM, eastM);
            return ShadowAlertDialog.getLatestAlertDialog() != null;
        });
    }

    @Test
    public void loiterIsSentAfterAQuestionAndReturnIsNotOfferedWithoutTheMode() throws Exception {
        untilEnabled(R.id.ground_loiter);
        Button home = (Button) find(R.id.ground_return);
        assertFalse(home.isEnabled());
        mustSay(FlightModes.reason("mode_unknown"), home.getText().toString());
        find(R.id.ground_loiter).performClick();
        assertEquals(0, commands().size());
        confirm();
        Wait.until("the Commands", () -> commands().size() == 1);
        mustSay("\"up.flight_mode.set\"", commands().get(0));
        mustSay("{\"mode\": \"LOITER\"}", commands().get(0));
    }

    @Test
    public void aTapSendsATargetAboveHomeAndThenGuided() throws Exception {
        untilEnabled(R.id.ground_loiter);
        tap(1000, 0);
        AlertDialog asked = ShadowAlertDialog.getLatestAlertDialog();
        EditText height = (EditText) asked.findViewById(R.id.ground_height);
        assertEquals("80", height.getText().toString());
        height.setText("95");
        confirm();
        Wait.until("the Commands", () -> commands().size() == 2);
        mustSay("\"up.navigation.target\"", commands().get(0));
        mustSay("\"height\": 95", commands().get(0));
        mustSay("{\"mode\": \"GUIDED\"}", commands().get(1));
    }

    @Test
    public void aTapSetsHomeAfterASecondQuestion() throws Exception {
        untilEnabled(R.id.ground_loiter);
        tap(1000, 0);
        ShadowAlertDialog.getLatestAlertDialog().getButton(DialogInterface.BUTTON_NEUTRAL)
                .performClick();
        Wait.pass(0);
        assertEquals(0, commands().size());
        confirm();
        Wait.until("the Command", () -> commands().size() == 1);
        mustSay("\"up.home.set\"", commands().get(0));
        mustSay("\"latitude\": ", commands().get(0));
        assertFalse(commands().get(0).contains("altitude"));
    }

    @Test
    public void aHeightThatIsNoneSendsNothing() throws Exception {
        untilEnabled(R.id.ground_loiter);
        tap(100, 0);
        ((EditText) ShadowAlertDialog.getLatestAlertDialog().findViewById(R.id.ground_height))
                .setText("-5");
        confirm();
        assertEquals(0, commands().size());
    }

    @Test
    public void aQuestionGoesWithItsScreen() throws Exception {
        untilEnabled(R.id.ground_loiter);
        find(R.id.ground_loiter).performClick();
        AlertDialog asked = ShadowAlertDialog.getLatestAlertDialog();
        assertTrue(asked.isShowing());
        handset.window.pause().stop();
        assertFalse(asked.isShowing());
        handset.window.start().resume();
    }

    @Test
    public void theCommandsScreenHasAButtonForEachModeOfTheAircraft() throws Exception {
        untilEnabled(R.id.ground_loiter);
        handset.choose(Screen.COMMANDS);
        openCommand("up.flight_mode.set");
        ViewGroup list = (ViewGroup) find(R.id.modes_list);
        Wait.until("the modes", () -> list.getChildCount() == 6);
        List<String> offered = new ArrayList<>();
        for (int each = 0; each < list.getChildCount(); each++) {
            Button button = (Button) list.getChildAt(each);
            if (button.isEnabled()) {
                offered.add(button.getText().toString());
            }
        }
        assertEquals("[LOITER, AUTO, FBW, RATE]", offered.toString());
    }
}
