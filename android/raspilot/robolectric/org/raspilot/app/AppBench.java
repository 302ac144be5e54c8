package org.raspilot.app;

import static org.junit.Assert.assertTrue;

import android.view.View;
import android.view.ViewGroup;
import android.widget.ListView;
import android.widget.TextView;
import org.junit.After;
import org.junit.runner.RunWith;
import org.raspilot.up.commands.CommandForm;
import org.robolectric.RobolectricTestRunner;
import org.robolectric.RuntimeEnvironment;
import org.robolectric.annotation.Config;
import org.robolectric.annotation.GraphicsMode;

/** What the tests of the application have in common: a phone of Android 4.1 and one of 10. */
@RunWith(RobolectricTestRunner.class)
@Config(sdk = {16, 29}, qualifiers = AppBench.UPRIGHT)
@GraphicsMode(GraphicsMode.Mode.NATIVE)
public abstract class AppBench {
    static final String UPRIGHT = "sw360dp-w360dp-h640dp-port-xhdpi";
    static final String LYING = "sw360dp-w640dp-h360dp-land-xhdpi";
    static final String TABLET = "sw800dp-w1280dp-h800dp-land-mdpi";

    final TestPhone handset = new TestPhone();

    @After
    public final void putAway() throws Exception {
        handset.close();
    }

    final View find(int id) {
        return handset.window.get().findViewById(id);
    }

    final String text(int id) {
        return ((TextView) find(id)).getText().toString();
    }

    /** Turns or resizes the window: the system recreates it. */
    final void become(String qualifiers) {
        RuntimeEnvironment.setQualifiers(qualifiers);
        handset.window.recreate();
        Wait.pass(0);
    }

    /** Opens the page of a Command. */
    final void openCommand(String command) {
        ListView list = (ListView) find(R.id.commands_list);
        for (int at = 0; at < list.getAdapter().getCount(); at++) {
            Object item = list.getAdapter().getItem(at);
            if (item instanceof CommandForm && ((CommandForm) item).name.equals(command)) {
                list.performItemClick(null, at, at);
                return;
            }
        }
        throw new AssertionError("the list has no " + command);
    }

    /** Returns the view in which a form's only field is written. */
    final TextView field() {
        return (TextView) ((ViewGroup) find(R.id.field_input)).getChildAt(0);
    }

    /** Fails unless a screen shows a text. */
    static void mustSay(String wanted, String said) {
        assertTrue("said: " + said, said.contains(wanted));
    }
}
