/**
 * Data that this tab keeps over a reload; without storage in the browser nothing is kept.
 */
export class Keepsake {
  #storage;
  #here = new Map();

  /** @param {Storage|null} storage sessionStorage or localStorage; null: memory alone */
  constructor(storage) {
    this.#storage = storage;
  }

  /**
   * @param {string} key
   * @returns {string|null}
   */
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

  /**
   * @param {string} key
   * @param {string} value
   */
  set(key, value) {
    this.#here.set(key, value);
    try {
      this.#storage?.setItem(`up.${key}`, value);
    } catch {
      // A full or forbidden storage: the value lives as long as the page.
    }
  }
}

/**
 * @param {"sessionStorage"|"localStorage"} name
 * @returns {Keepsake}
 */
export function keepsakeOf(name) {
  try {
    return new Keepsake(globalThis[name] ?? null);
  } catch {
    return new Keepsake(null);
  }
}
