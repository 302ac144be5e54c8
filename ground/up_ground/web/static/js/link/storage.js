/** Data that this tab keeps over a reload; without storage in the browser nothing is kept. */
export class Storage {
  #storage;
  #here = new Map();

  /** storage: sessionStorage or localStorage; null: memory alone. */
  constructor(storage) {
    this.#storage = storage;
  }

  get(key) {
    if (this.#here.has(key)) {
      return this.#here.get(key);
    }
    try {
      return this.#storage?.getItem(`up.${key}`) ?? null;
    } catch {
      return null;
    }
  }

  set(key, value) {
    this.#here.set(key, value);
    try {
      this.#storage?.setItem(`up.${key}`, value);
    } catch {
      // A full or forbidden storage: the value lives as long as the page.
    }
  }
}

export function storageOf(name) {
  try {
    return new Storage(globalThis[name] ?? null);
  } catch {
    return new Storage(null);
  }
}
