package org.raspilot.app;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertNotNull;
import static org.junit.Assert.assertTrue;

import android.app.Fragment;
import android.content.ClipboardManager;
import android.content.Context;
import android.preference.Preference;
import android.text.Layout;
import android.view.View;
import android.view.ViewGroup;
import android.widget.TextView;
import org.junit.Test;
import org.robolectric.annotation.Config;
import org.robolectric.shadows.ShadowToast;

/** The window: its screens, turned, resized, and its settings. */
public final class WindowTest extends AppBench {
    private Screen chosen() {
        return (Screen) handset.window.get().getActionBar().getSelectedTab().getTag();
    }

    private Fragment part(Screen part) {
        return handset.window.get().getFragmentManager().findFragmentByTag(part.name());
    }

    private void mustBeSeen(Screen part) {
        assertNotNull(part + " is not there", part(part));
        assertFalse(part + " is detached", part(part).isDetached());
        assertNotNull(part + " has no view", part(part).getView());
        assertEquals(View.VISIBLE, find(part.pane).getVisibility());
    }

    @Test
    public void everyTabShowsItsScreenAlone() {
        handset.open();
        assertEquals(Screen.AIRBORNE, chosen());
        for (Screen screen : Screen.values()) {
            handset.choose(screen);
            for (Screen part : Screen.values()) {
                if (screen.shows(part, false)) {
                    mustBeSeen(part);
                } else if (part(part) != null) {
                    assertTrue(part + " beside " + screen, part(part).isDetached());
                }
            }
        }
    }

    @Test
    public void aTurnedPhoneKeepsItsScreenAndWhatWasWritten() {
        handset.open();
        handset.choose(Screen.COMMANDS);
        openCommand("up.telemetry.frequency");
        field().setText("250");
        become(LYING);
        assertEquals(Screen.COMMANDS, chosen());
        assertEquals("250", field().getText().toString());
        become(UPRIGHT);
        assertEquals(Screen.COMMANDS, chosen());
        assertEquals("250", field().getText().toString());
        handset.choose(Screen.LOG);
        become(LYING);
        assertEquals(Screen.LOG, chosen());
    }

    @Test
    @Config(qualifiers = TABLET)
    public void aTabletShowsGroundAndCommandsSideBySide() {
        handset.open();
        handset.choose(Screen.GROUND);
        mustBeSeen(Screen.GROUND);
        mustBeSeen(Screen.COMMANDS);
        assertEquals(Screen.values().length - 1,
                handset.window.get().getActionBar().getTabCount());
        handset.choose(Screen.AIRBORNE);
        assertEquals(View.GONE, find(R.id.pane_second).getVisibility());
    }

    @Test
    @Config(sdk = 29, qualifiers = "de-sw360dp-w360dp-h2400dp-port-xhdpi")
    public void germanTextsFitThePhone() {
        handset.open();
        assertEquals("Senden starten", text(R.id.run_switch));
        for (Screen screen : Screen.values()) {
            handset.choose(screen);
            mustFit();
        }
        handset.choose(Screen.COMMANDS);
        openCommand("up.arm");
        mustFit();
        find(R.id.commands_back).performClick();
        openCommand("arduino.pids.tunings");
        mustFit();
    }

    private void mustFit() {
        Drawing.of(handset.window.get());
        mustFit(handset.window.get().getWindow().getDecorView());
    }

    /** Fails where a text is cut off, or broken within a word. */
    private static void mustFit(View view) {
        if (view instanceof ViewGroup) {
            for (int at = 0; at < ((ViewGroup) view).getChildCount(); at++) {
                mustFit(((ViewGroup) view).getChildAt(at));
            }
        }
        TextView shown = view instanceof TextView && view.isShown() ? (TextView) view : null;
        Layout lines = shown == null ? null : shown.getLayout();
        for (int line = 0; lines != null && line < lines.getLineCount(); line++) {
            CharSequence text = lines.getText();
            int end = lines.getLineEnd(line);
            int widthPx = shown.getWidth() - shown.getTotalPaddingLeft() - shown.getTotalPaddingRight();
            assertTrue(text + " is cut off", lines.getEllipsisCount(line) == 0
                    && lines.getLineWidth(line) <= widthPx + 1);
            assertFalse(text + " is broken", end > 0 && end < text.length()
                    && Character.isLetter(text.charAt(end - 1))
                    && Character.isLetter(text.charAt(end)));
        }
    }

    @Test
    public void everyScreenBearsAWindowThatBecomesNarrowAndWide() {
        handset.open();
        for (Screen screen : new Screen[] {Screen.AIRBORNE, Screen.GROUND, Screen.SETTINGS,
            Screen.LOG}) {
            handset.choose(screen);
            become(TABLET);
            become(LYING);
            become(TABLET);
            become(UPRIGHT);
            assertEquals(screen, chosen());
        }
    }

    @Test
    public void theSettingsRefuseWhatIsNoneWithASentence() {
        handset.open();
        handset.choose(Screen.SETTINGS);
        refuse(R.string.key_general_port, "70000", R.string.rule_port);
        refuse(R.string.key_host, "a b", R.string.rule_host);
        refuse(R.string.key_aircraft, "", R.string.rule_aircraft);
        refuse(R.string.key_orientation_hz, "201", R.string.rule_rate);
        refuse(R.string.key_reference_pressure, "10", R.string.rule_pressure);
        assertTrue(isTaken(R.string.key_general_port, " 50011 "));
        assertTrue(isTaken(R.string.key_host, "raspberry.local"));
    }

    @Test
    public void theLogIsCopiedWithItsTimesAndHowOften() {
        handset.open();
        handset.choose(Screen.LOG);
        AppLog log = RaspilotApplication.of(handset.application).events();
        log.clear();
        log.add(3723000, "connected");
        log.add(3724000, "lost");
        log.add(3725000, "lost");
        find(R.id.log_copy).performClick();
        ClipboardManager clipboard = (ClipboardManager)
                handset.application.getSystemService(Context.CLIPBOARD_SERVICE);
        String[] lines = clipboard.getPrimaryClip().getItemAt(0).getText().toString().split("\n");
        assertEquals(2, lines.length);
        assertTrue(lines[0], lines[0].matches("..:..:03  connected"));
        assertTrue(lines[1], lines[1].matches("..:..:05  .*2.*"));
    }

    private void refuse(int key, String value, int sentence) {
        assertFalse(value, isTaken(key, value));
        assertEquals(handset.application.getString(sentence), ShadowToast.getTextOfLatestToast());
    }

    private boolean isTaken(int key, String value) {
        SettingsFragment settings = (SettingsFragment) part(Screen.SETTINGS);
        Preference preference = settings.findPreference(handset.application.getString(key));
        return settings.onPreferenceChange(preference, value);
    }
}
