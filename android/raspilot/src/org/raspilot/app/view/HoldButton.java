package org.raspilot.app.view;

import android.content.Context;
import android.graphics.Canvas;
import android.graphics.Paint;
import android.graphics.Rect;
import android.graphics.RectF;
import android.os.SystemClock;
import android.util.AttributeSet;
import android.view.KeyEvent;
import android.view.MotionEvent;
import android.view.View;
import android.widget.Button;

/**
 * A button that fires only after it is held for a second, and fills a ring during that time.
 *
 * <p>Letting go, sliding away, a second finger, or a window or focus change cancels the press. A
 * click without a finger (a screen reader, a switch) does not fire either; the listener is called
 * to show a confirmation.
 */
public final class HoldButton extends Button {
    private static final float SLOP_DP = 24;
    private static final float RING_DP = 15;

    /** Receives the result of a press; main thread. */
    public interface HoldListener {
        /** Takes a press that has lasted. */
        void onHeld(View button);

        /** Takes a click without a press: to be confirmed before anything is done. */
        void onClickedOnly(View button);

        /** Called when a press ended too early, to show that it must be held. */
        void onTooShort(View button);
    }

    private final HeldPress press = new HeldPress();
    private final Paint pen = new Paint(Paint.ANTI_ALIAS_FLAG);
    private final RectF ring = new RectF();
    private final float density;
    private final int ringColour;
    private final int trackColour;
    private final Runnable look = () -> checkTime();
    private HoldListener listener;
    private boolean isByKey;
    private float downX;
    private float downY;

    public HoldButton(Context context, AttributeSet attributes) {
        super(context, attributes);
        density = getResources().getDisplayMetrics().density;
        InstrumentColors colors = InstrumentColors.of(context);
        ringColour = colors.warning;
        trackColour = colors.line;
        pen.setStyle(Paint.Style.STROKE);
        pen.setStrokeWidth(4 * density);
        setClickable(true);
        setLongClickable(false);
        setFocusable(true);
        // A touch through a window on top of it must not count.
        setFilterTouchesWhenObscured(true);
        int room = Math.round((2 * RING_DP + 12) * density);
        setPadding(getPaddingLeft() + room, getPaddingTop(), getPaddingRight(),
                getPaddingBottom());
    }

    /** Sets the only listener; null: none, and a press in progress is cancelled. */
    public void setHoldListener(HoldListener newListener) {
        listener = newListener;
        cancel();
    }

    @Override
    public boolean onTouchEvent(MotionEvent event) {
        switch (event.getActionMasked()) {
            case MotionEvent.ACTION_DOWN:
                if (isEnabled()) {
                    // A finger that comes down is a new one, whatever became of the last.
                    if (!isByKey) {
                        press.release();
                    }
                    downX = event.getX();
                    downY = event.getY();
                    begin(false);
                }
                return true;
            case MotionEvent.ACTION_MOVE:
                float slop = SLOP_DP * density;
                if (Math.abs(event.getX() - downX) > slop || Math.abs(event.getY() - downY) > slop
                        || !isWithin(event.getX(), event.getY())) {
                    cancel();
                }
                return true;
            case MotionEvent.ACTION_POINTER_DOWN:
                cancel();
                return true;
            case MotionEvent.ACTION_UP:
                end(true);
                return true;
            case MotionEvent.ACTION_CANCEL:
                end(false);
                return true;
            default:
                return true;
        }
    }

    @Override
    public boolean onFilterTouchEventForSecurity(MotionEvent event) {
        boolean isTaken = super.onFilterTouchEventForSecurity(event);
        if (!isTaken) {
            // The finger may have gone unheard.
            cancel();
        }
        return isTaken;
    }

    @Override
    public boolean onKeyDown(int keyCode, KeyEvent event) {
        if (!isConfirmKey(keyCode) || !isEnabled()) {
            return super.onKeyDown(keyCode, event);
        }
        if (event.getRepeatCount() == 0) {
            begin(true);
        }
        return true;
    }

    @Override
    public boolean onKeyUp(int keyCode, KeyEvent event) {
        if (!isConfirmKey(keyCode)) {
            return super.onKeyUp(keyCode, event);
        }
        end(!event.isCanceled());
        return true;
    }

    @Override
    public boolean performClick() {
        if (isEnabled() && listener != null) {
            listener.onClickedOnly(this);
            return true;
        }
        return false;
    }

    @Override
    public void setEnabled(boolean isEnabled) {
        super.setEnabled(isEnabled);
        if (!isEnabled) {
            cancel();
        }
    }

    @Override
    public void onWindowFocusChanged(boolean hasFocus) {
        super.onWindowFocusChanged(hasFocus);
        if (!hasFocus) {
            cancel();
        }
    }

    @Override
    protected void onFocusChanged(boolean hasFocus, int direction, Rect from) {
        super.onFocusChanged(hasFocus, direction, from);
        if (!hasFocus) {
            cancel();
        }
    }

    @Override
    protected void onVisibilityChanged(View changed, int visibility) {
        super.onVisibilityChanged(changed, visibility);
        if (visibility != VISIBLE) {
            cancel();
        }
    }

    @Override
    protected void onDetachedFromWindow() {
        cancel();
        super.onDetachedFromWindow();
    }

    @Override
    protected void onDraw(Canvas canvas) {
        super.onDraw(canvas);
        float radius = Math.min(RING_DP * density, getHeight() / 2f - 6 * density);
        float x = getScrollX() + RING_DP * density + 12 * density;
        float y = getScrollY() + getHeight() / 2f;
        ring.set(x - radius, y - radius, x + radius, y + radius);
        pen.setColor(trackColour);
        canvas.drawArc(ring, 0, 360, false, pen);
        float share = press.progress(SystemClock.uptimeMillis());
        if (share > 0) {
            pen.setColor(ringColour);
            canvas.drawArc(ring, -90, 360 * share, false, pen);
        }
    }

    private void begin(boolean byKey) {
        if (press.state() != HeldPress.State.IDLE) {
            cancel();
            return;
        }
        isByKey = byKey;
        press.press(SystemClock.uptimeMillis());
        setPressed(true);
        if (getParent() != null) {
            getParent().requestDisallowInterceptTouchEvent(true);
        }
        postOnAnimation(look);
    }

    private void end(boolean wasLetGo) {
        boolean wasShort = wasLetGo && press.state() == HeldPress.State.PRESSED;
        press.release();
        setPressed(false);
        invalidate();
        if (wasShort && listener != null) {
            listener.onTooShort(this);
        }
    }

    /** Makes a press in progress void; after a focus change a key's release never arrives here. */
    private void cancel() {
        // Button's constructor calls setEnabled() and the like before the fields are there.
        if (press == null) {
            return;
        }
        press.cancel();
        if (isByKey) {
            press.release();
        }
        setPressed(false);
        invalidate();
    }

    private void checkTime() {
        boolean hasLasted = press.check(SystemClock.uptimeMillis());
        invalidate();
        if (hasLasted && listener != null && isEnabled()) {
            listener.onHeld(this);
        } else if (press.state() == HeldPress.State.PRESSED) {
            postOnAnimation(look);
        }
    }

    private boolean isWithin(float x, float y) {
        return x >= 0 && y >= 0 && x < getWidth() && y < getHeight();
    }

    private static boolean isConfirmKey(int keyCode) {
        return keyCode == KeyEvent.KEYCODE_ENTER || keyCode == KeyEvent.KEYCODE_DPAD_CENTER
                || keyCode == KeyEvent.KEYCODE_NUMPAD_ENTER || keyCode == KeyEvent.KEYCODE_SPACE;
    }
}
