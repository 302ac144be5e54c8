package org.raspilot.up.android.api23;

import android.security.keystore.KeyGenParameterSpec;
import android.security.keystore.KeyProperties;
import java.io.IOException;
import java.security.GeneralSecurityException;
import java.security.Key;
import java.security.KeyStore;
import javax.crypto.Cipher;
import javax.crypto.KeyGenerator;
import javax.crypto.spec.GCMParameterSpec;

/** Encrypts by a key that does not leave the system's keystore: AES-GCM. */
public final class KeystoreCipher {
    private static final String STORE = "AndroidKeyStore";
    private static final String ALIAS = "up_keys";
    private static final String CIPHER = "AES/GCM/NoPadding";
    private static final int IV_BYTES = 12;
    private static final int TAG_BITS = 128;

    private KeystoreCipher() {
    }

    /** Returns the IV and the encrypted data. */
    public static byte[] encrypt(byte[] data) throws GeneralSecurityException, IOException {
        Cipher cipher = Cipher.getInstance(CIPHER);
        cipher.init(Cipher.ENCRYPT_MODE, key());
        byte[] encrypted = cipher.doFinal(data);
        byte[] all = new byte[IV_BYTES + encrypted.length];
        System.arraycopy(cipher.getIV(), 0, all, 0, IV_BYTES);
        System.arraycopy(encrypted, 0, all, IV_BYTES, encrypted.length);
        return all;
    }

    /** Returns the data; throws GeneralSecurityException for those of another key. */
    public static byte[] decrypt(byte[] all) throws GeneralSecurityException, IOException {
        if (all.length < IV_BYTES) {
            throw new GeneralSecurityException("too short");
        }
        Cipher cipher = Cipher.getInstance(CIPHER);
        cipher.init(Cipher.DECRYPT_MODE, key(), new GCMParameterSpec(TAG_BITS, all, 0, IV_BYTES));
        return cipher.doFinal(all, IV_BYTES, all.length - IV_BYTES);
    }

    private static Key key() throws GeneralSecurityException, IOException {
        KeyStore store = KeyStore.getInstance(STORE);
        store.load(null);
        Key known = store.getKey(ALIAS, null);
        if (known != null) {
            return known;
        }
        KeyGenerator generator = KeyGenerator.getInstance(KeyProperties.KEY_ALGORITHM_AES, STORE);
        generator.init(new KeyGenParameterSpec.Builder(ALIAS,
                KeyProperties.PURPOSE_ENCRYPT | KeyProperties.PURPOSE_DECRYPT)
                .setBlockModes(KeyProperties.BLOCK_MODE_GCM)
                .setEncryptionPaddings(KeyProperties.ENCRYPTION_PADDING_NONE).build());
        return generator.generateKey();
    }
}
