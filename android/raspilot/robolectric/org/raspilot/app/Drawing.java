package org.raspilot.app;

import static org.junit.Assert.assertTrue;

import android.app.Activity;
import android.graphics.Bitmap;
import android.graphics.Canvas;
import android.view.View;
import java.io.File;
import java.io.FileOutputStream;
import java.io.IOException;
import java.io.OutputStream;
import java.util.HashSet;
import java.util.Set;

/** What a window shows, drawn by the system's graphics library. */
final class Drawing {
    private final Bitmap bitmap;

    private Drawing(Bitmap bitmap) {
        this.bitmap = bitmap;
    }

    /** Lays the window out for its display and draws it. */
    static Drawing of(Activity activity) {
        int width = activity.getResources().getDisplayMetrics().widthPixels;
        int height = activity.getResources().getDisplayMetrics().heightPixels;
        View root = activity.getWindow().getDecorView();
        Wait.pass(1);
        // Views that the first layout showed or hid need the second.
        for (int again = 0; again < 2; again++) {
            root.measure(View.MeasureSpec.makeMeasureSpec(width, View.MeasureSpec.EXACTLY),
                    View.MeasureSpec.makeMeasureSpec(height, View.MeasureSpec.EXACTLY));
            root.layout(0, 0, width, height);
        }
        root.jumpDrawablesToCurrentState();
        Bitmap bitmap = Bitmap.createBitmap(width, height, Bitmap.Config.ARGB_8888);
        root.draw(new Canvas(bitmap));
        return new Drawing(bitmap);
    }

    /** Returns the number of colours, at most that many. */
    int colours(int most) {
        Set<Integer> seen = new HashSet<>();
        int[] row = new int[bitmap.getWidth()];
        for (int y = 0; y < bitmap.getHeight() && seen.size() < most; y++) {
            bitmap.getPixels(row, 0, row.length, 0, y, row.length, 1);
            for (int colour : row) {
                seen.add(colour);
            }
        }
        return seen.size();
    }

    /** Writes it as PNG; a picture of nothing fails. */
    File save(File file) throws IOException {
        assertTrue(file + " is empty", colours(20) >= 20);
        OutputStream out = new FileOutputStream(file);
        try {
            bitmap.compress(Bitmap.CompressFormat.PNG, 100, out);
        } finally {
            out.close();
        }
        return file;
    }
}
