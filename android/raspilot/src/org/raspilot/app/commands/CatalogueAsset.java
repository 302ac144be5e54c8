package org.raspilot.app.commands;

import android.content.Context;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.InputStream;
import java.nio.charset.Charset;
import org.raspilot.up.commands.CommandCatalogue;
import org.raspilot.up.wire.MalformedException;

/** The catalogue of Commands that came with the app. */
public final class CatalogueAsset {
    private static final String NAME = "commands.json";

    private CatalogueAsset() {
    }

    /**
     * Returns the catalogue.
     *
     * @throws IOException when the app's package cannot be read or lacks a catalogue
     */
    public static CommandCatalogue read(Context context) throws IOException {
        InputStream input = context.getAssets().open(NAME);
        try {
            ByteArrayOutputStream all = new ByteArrayOutputStream();
            byte[] part = new byte[8192];
            for (int length = input.read(part); length >= 0; length = input.read(part)) {
                all.write(part, 0, length);
            }
            String text = new String(all.toByteArray(), Charset.forName("UTF-8"));
            return CommandCatalogue.read(text);
        } catch (MalformedException wrong) {
            throw new IOException(NAME + ": " + wrong.getMessage());
        } finally {
            input.close();
        }
    }
}
