package org.raspilot.app;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;
import static org.robolectric.Shadows.shadowOf;

import android.app.Activity;
import android.app.AlertDialog;
import android.content.Context;
import android.content.Intent;
import android.content.SharedPreferences;
import android.net.Uri;
import android.os.Build;
import android.preference.Preference;
import android.preference.PreferenceCategory;
import java.io.ByteArrayInputStream;
import java.nio.file.Files;
import java.nio.file.Paths;
import java.security.Security;
import org.junit.After;
import org.junit.Before;
import org.junit.Test;
import org.raspilot.up.android.PairingStore;
import org.raspilot.up.ground.GroundSettings;
import org.robolectric.annotation.Config;
import org.robolectric.shadows.ShadowAlertDialog;
import org.robolectric.shadows.ShadowToast;

/** Pair, list and forget, with the keystore of Android 6 and later and without. */
public final class KeySettingsTest extends AppBench {
    private static final String SECRET =
            "000102030405060708090a0b0c0d0e0f101112131415161718191a1b1c1d1e1f";
    static final String TEXT = "upkey:1:glider-1:0001020304050607:" + SECRET
            + ":pilot:tablet";

    private SettingsFragment settings;

    @Before
    public void addKeystore() {
        if (Build.VERSION.SDK_INT >= 23) {
            Security.addProvider(new TestKeystore());
        }
        handset.set(R.string.key_ground_host, "192.0.2.1");
    }

    private void openSettings() {
        handset.open();
        handset.choose(Screen.SETTINGS);
        settings = (SettingsFragment) handset.window.get().getFragmentManager()
                .findFragmentByTag(Screen.SETTINGS.name());
    }

    @After
    public void removeKeystore() {
        Security.removeProvider("AndroidKeyStore");
        TestKeystore.KEYS.clear();
    }

    private Preference preference(int key) {
        return settings.findPreference(handset.application.getString(key));
    }

    private boolean paste(String text) {
        Preference pairing = preference(R.string.key_pairing);
        return pairing.getOnPreferenceChangeListener().onPreferenceChange(pairing, text);
    }

    private PreferenceCategory keys() {
        return (PreferenceCategory) preference(R.string.key_keys);
    }

    private GroundSettings ground() {
        return new AppSettings(handset.application).ground();
    }

    private SharedPreferences file() {
        return handset.application.getSharedPreferences("up_keys", Context.MODE_PRIVATE);
    }

    @Test
    public void aPastedTextPairsAndItsSecretIsNotInTheSettings() {
        openSettings();
        assertFalse("the settings must not keep it", paste(" " + TEXT + "\n"));
        assertEquals("glider-1", ground().aircraft);
        assertEquals("tablet (pilot)", ground().pairing.toString());
        assertEquals(TEXT, ground().pairing.toText());
        assertFalse(handset.preferences().getAll().toString().contains(SECRET));
        boolean isPlain = file().getAll().toString().contains(SECRET);
        assertEquals(Build.VERSION.SDK_INT < 23, isPlain);
        Preference shown = keys().getPreference(3);
        assertEquals("glider-1", shown.getTitle());
        mustSay("tablet (pilot)", shown.getSummary().toString());
    }

    @Test
    @Config(sdk = 29)
    public void twoAircraftHaveTwoKeysAndANewOneReplacesTheOld() {
        openSettings();
        paste(TEXT);
        paste(TEXT.replace("glider-1", "glider-2"));
        paste(TEXT.replace(":pilot:", ":observer:"));
        assertEquals(5, keys().getPreferenceCount());
        assertEquals("observer", new PairingStore(handset.application).get("glider-1").role);
        assertEquals("pilot", new PairingStore(handset.application).get("glider-2").role);
    }

    @Test
    @Config(sdk = 29)
    public void whatDoesNotPairIsSaid() {
        openSettings();
        paste("upkey:1:glider-1");
        assertEquals(handset.application.getString(R.string.pairing_invalid),
                ShadowToast.getTextOfLatestToast());
        shadowOf(handset.application).checkActivities(true);
        Preference scan = keys().getPreference(2);
        scan.getOnPreferenceClickListener().onPreferenceClick(scan);
        assertEquals(handset.application.getString(R.string.scan_none),
                ShadowToast.getTextOfLatestToast());
        assertEquals(3, keys().getPreferenceCount());
        assertNull(ground().pairing);
    }

    @Test
    @Config(sdk = 29)
    public void aKeyIsForgottenAfterAQuestion() {
        openSettings();
        paste(TEXT);
        Preference shown = keys().getPreference(3);
        shown.getOnPreferenceClickListener().onPreferenceClick(shown);
        assertEquals("tablet", ground().pairing.name);
        ShadowAlertDialog.getLatestAlertDialog().getButton(AlertDialog.BUTTON_POSITIVE)
                .performClick();
        Wait.pass(0);
        assertNull(ground().pairing);
        assertEquals(3, keys().getPreferenceCount());
        assertTrue(file().getAll().isEmpty());
    }

    @Test
    public void aKeyThatCannotBeReadClosesTheLinkAndMakesItNotPlain() {
        openSettings();
        paste(TEXT);
        String kept = file().getString("glider-1", "");
        file().edit().putString("glider-1", kept.substring(0, kept.length() - 8)).commit();
        assertThrows(IllegalArgumentException.class, () -> ground());
        handset.ground().reload();
        mustSay("glider-1", handset.ground().fault());
        handset.choose(Screen.GROUND);
        mustSay("glider-1", text(R.id.control_link));
        file().edit().putString("glider-1", "keystore AAAA").commit();
        assertThrows(IllegalArgumentException.class, () -> ground());
        String other = TEXT.replace("glider-1", "glider-2");
        file().edit().putString("glider-1", other).commit();
        assertThrows(IllegalArgumentException.class, () -> ground());
    }

    @Test
    public void aKeyOfAnOlderSystemIsEncryptedWhereTheNewOneCan() {
        file().edit().putString("glider-1", TEXT).commit();
        assertEquals("pilot", new PairingStore(handset.application).get("glider-1").role);
        boolean isPlain = file().getAll().toString().contains(SECRET);
        assertEquals(Build.VERSION.SDK_INT < 23, isPlain);
        assertEquals(TEXT, new PairingStore(handset.application).get("glider-1").toText());
    }

    @Test
    @Config(sdk = 29)
    public void tlsNeedsTheCertificatesOfAFileAndIsNeverPlain() throws Exception {
        handset.preferences().edit().putBoolean("ground_tls", true).commit();
        assertThrows(IllegalArgumentException.class, () -> ground());
        openSettings();
        Preference shown = preference(R.string.key_certificates);
        shown.getOnPreferenceClickListener().onPreferenceClick(shown);
        assertEquals(Intent.ACTION_GET_CONTENT, shadowOf((Activity) handset.window.get())
                .getNextStartedActivityForResult().intent.getAction());
        choose("-----BEGIN NOTHING-----");
        mustSay("not used", ShadowToast.getTextOfLatestToast());
        assertThrows(IllegalArgumentException.class, () -> ground());
        String text = new String(Files.readAllBytes(
                Paths.get(System.getProperty("vectors"), "tls.pem")), "US-ASCII");
        choose(text);
        mustSay("CN=relay", ground().tls.toString());
        mustSay("CN=relay", shown.getSummary().toString());
        assertFalse(file().getAll().toString().contains("BEGIN"));
        assertEquals(3, keys().getPreferenceCount());
        shown.getOnPreferenceClickListener().onPreferenceClick(shown);
        ShadowAlertDialog.getLatestAlertDialog().getButton(AlertDialog.BUTTON_POSITIVE)
                .performClick();
        Wait.pass(0);
        assertThrows(IllegalArgumentException.class, () -> ground());
    }

    private void choose(String text) throws Exception {
        Uri file = Uri.parse("content://files/" + text.length());
        shadowOf(handset.application.getContentResolver()).registerInputStream(file,
                new ByteArrayInputStream(text.getBytes("US-ASCII")));
        settings.onActivityResult(KeySettings.FILE, Activity.RESULT_OK,
                new Intent().setData(file));
    }

    @Test
    @Config(sdk = 29)
    public void aScannerPairs() {
        openSettings();
        Preference scan = keys().getPreference(2);
        scan.getOnPreferenceClickListener().onPreferenceClick(scan);
        Intent wish = shadowOf((Activity) handset.window.get())
                .getNextStartedActivityForResult().intent;
        assertEquals("com.google.zxing.client.android.SCAN", wish.getAction());
        settings.onActivityResult(KeySettings.SCAN, Activity.RESULT_CANCELED, null);
        assertNull(ground().pairing);
        settings.onActivityResult(KeySettings.SCAN, Activity.RESULT_OK,
                new Intent().putExtra("SCAN_RESULT", TEXT));
        assertEquals("tablet", ground().pairing.name);
    }
}
