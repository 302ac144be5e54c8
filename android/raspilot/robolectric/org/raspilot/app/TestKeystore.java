package org.raspilot.app;

import android.security.keystore.KeyGenParameterSpec;
import java.io.InputStream;
import java.io.OutputStream;
import java.security.InvalidAlgorithmParameterException;
import java.security.Key;
import java.security.KeyStoreSpi;
import java.security.NoSuchAlgorithmException;
import java.security.Provider;
import java.security.SecureRandom;
import java.security.cert.Certificate;
import java.security.spec.AlgorithmParameterSpec;
import java.util.Collections;
import java.util.Date;
import java.util.Enumeration;
import java.util.HashMap;
import java.util.Map;
import javax.crypto.KeyGenerator;
import javax.crypto.KeyGeneratorSpi;
import javax.crypto.SecretKey;

/** The keystore of Android 6 and later, which Robolectric lacks: it keeps keys in memory. */
public final class TestKeystore extends Provider {
    static final Map<String, Key> KEYS = new HashMap<>();
    private static final String NAME = "AndroidKeyStore";
    private static final long serialVersionUID = 1L;

    TestKeystore() {
        super(NAME, 1, "for tests");
        put("KeyStore." + NAME, Store.class.getName());
        put("KeyGenerator.AES", Generator.class.getName());
    }

    /** Makes AES keys for an alias. */
    public static final class Generator extends KeyGeneratorSpi {
        private String alias;

        @Override
        protected void engineInit(AlgorithmParameterSpec given, SecureRandom random)
                throws InvalidAlgorithmParameterException {
            KeyGenParameterSpec wanted = (KeyGenParameterSpec) given;
            if (!"GCM".equals(String.join(" ", wanted.getBlockModes()))
                    || !wanted.isRandomizedEncryptionRequired()) {
                throw new InvalidAlgorithmParameterException("not GCM");
            }
            alias = wanted.getKeystoreAlias();
        }

        @Override
        protected void engineInit(SecureRandom random) {
        }

        @Override
        protected void engineInit(int size, SecureRandom random) {
        }

        @Override
        protected SecretKey engineGenerateKey() {
            try {
                KeyGenerator generator = KeyGenerator.getInstance("AES", "SunJCE");
                generator.init(256);
                SecretKey made = generator.generateKey();
                KEYS.put(alias, made);
                return made;
            } catch (java.security.GeneralSecurityException fault) {
                throw new AssertionError(fault);
            }
        }
    }

    /** Returns the keys. */
    public static final class Store extends KeyStoreSpi {
        @Override
        public Key engineGetKey(String alias, char[] password) throws NoSuchAlgorithmException {
            return KEYS.get(alias);
        }

        @Override
        public Certificate[] engineGetCertificateChain(String alias) {
            return null;
        }

        @Override
        public Certificate engineGetCertificate(String alias) {
            return null;
        }

        @Override
        public Date engineGetCreationDate(String alias) {
            return null;
        }

        @Override
        public void engineSetKeyEntry(String alias, Key key, char[] password,
                Certificate[] chain) {
        }

        @Override
        public void engineSetKeyEntry(String alias, byte[] key, Certificate[] chain) {
        }

        @Override
        public void engineSetCertificateEntry(String alias, Certificate certificate) {
        }

        @Override
        public void engineDeleteEntry(String alias) {
            KEYS.remove(alias);
        }

        @Override
        public Enumeration<String> engineAliases() {
            return Collections.enumeration(KEYS.keySet());
        }

        @Override
        public boolean engineContainsAlias(String alias) {
            return KEYS.containsKey(alias);
        }

        @Override
        public int engineSize() {
            return KEYS.size();
        }

        @Override
        public boolean engineIsKeyEntry(String alias) {
            return KEYS.containsKey(alias);
        }

        @Override
        public boolean engineIsCertificateEntry(String alias) {
            return false;
        }

        @Override
        public String engineGetCertificateAlias(Certificate certificate) {
            return null;
        }

        @Override
        public void engineStore(OutputStream stream, char[] password) {
        }

        @Override
        public void engineLoad(InputStream stream, char[] password) {
        }
    }
}
