package org.raspilot.app;

import static org.junit.Assert.assertEquals;

import android.os.SystemClock;
import android.view.LayoutInflater;
import android.view.MotionEvent;
import android.view.View;
import org.junit.Test;
import org.raspilot.app.view.HoldButton;

/** Fingers on the page that arms, and a comma where a number is written. */
public final class TouchTest extends AppBench {
    private static final int WIDTH = 700;
    private static final int HEIGHT = 1200;

    private final StringBuilder held = new StringBuilder();
    private View page;
    private HoldButton arm;
    private HoldButton disarm;

    private void showPage() {
        page = LayoutInflater.from(handset.open()).inflate(R.layout.page_arm, null);
        handset.window.get().setContentView(page);
        page.measure(View.MeasureSpec.makeMeasureSpec(WIDTH, View.MeasureSpec.EXACTLY),
                View.MeasureSpec.makeMeasureSpec(HEIGHT, View.MeasureSpec.AT_MOST));
        page.layout(0, 0, WIDTH, page.getMeasuredHeight());
        arm = button(R.id.arm_button, "arm ");
        disarm = button(R.id.disarm_button, "disarm ");
    }

    private HoldButton button(int id, String name) {
        HoldButton button = page.findViewById(id);
        button.setEnabled(true);
        button.setHoldListener(new HoldButton.HoldListener() {
            @Override
            public void onHeld(View view) {
                held.append(name);
            }

            @Override
            public void onClickedOnly(View view) {
            }

            @Override
            public void onTooShort(View view) {
            }
        });
        return button;
    }

    /** Puts fingers on the middles of buttons, the last one newly down. */
    private void touch(HoldButton... under) {
        MotionEvent.PointerProperties[] fingers = new MotionEvent.PointerProperties[under.length];
        MotionEvent.PointerCoords[] places = new MotionEvent.PointerCoords[under.length];
        for (int at = 0; at < under.length; at++) {
            fingers[at] = new MotionEvent.PointerProperties();
            fingers[at].id = at;
            places[at] = new MotionEvent.PointerCoords();
            places[at].x = under[at].getLeft() + under[at].getWidth() / 2f;
            places[at].y = under[at].getTop() + under[at].getHeight() / 2f;
        }
        int newest = under.length - 1;
        int action = newest == 0 ? MotionEvent.ACTION_DOWN : MotionEvent.ACTION_POINTER_DOWN
                | newest << MotionEvent.ACTION_POINTER_INDEX_SHIFT;
        long now = SystemClock.uptimeMillis();
        page.dispatchTouchEvent(MotionEvent.obtain(now, now, action, under.length, fingers,
                places, 0, 0, 1, 1, 0, 0, 0, 0));
    }

    private void hold() {
        // Draws as a screen does: a press is void when the screen hangs during it.
        for (int frame = 0; frame < 100; frame++) {
            Wait.pass(16);
        }
    }

    @Test
    public void aFingerThatHoldsArms() {
        showPage();
        touch(arm);
        hold();
        assertEquals("arm ", held.toString());
    }

    @Test
    public void aSecondFingerOnTheOtherButtonEndsThePress() {
        showPage();
        touch(arm);
        touch(arm, disarm);
        hold();
        assertEquals("", held.toString());
    }

    @Test
    public void aPressureWithACommaIsOne() {
        handset.set(R.string.key_reference_pressure, "1002,5");
        assertEquals(1002.5, new AppSettings(handset.application).referencePressureHPa(), 0);
    }

    @Test
    public void aNumberTakesAComma() {
        handset.open();
        handset.choose(Screen.COMMANDS);
        openCommand("up.telemetry.frequency");
        field().append("12,5");
        assertEquals("12,5", field().getText().toString());
    }
}
