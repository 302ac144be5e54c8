// A page's own record of what it shows, by its own clock.

/**
 * Record every change of some attributes and texts of a page, by a MutationObserver.
 * `wanted` names what: {name: {selector, attribute}}, or {name: {selector}} for its text.
 * @param {import("playwright-core").Page} page
 * @returns {Promise<{read: () => Promise<{name: string, unix_ms: number, value: string}[]>}>} all of
 *   it so far, the oldest first; `unix_ms` is of the clock that every process of a machine shares
 */
export async function record(page, wanted) {
  const number = await page.evaluate((wanted) => {
    const found = [];
    const last = {};
    const look = () => {
      const unix_ms = performance.timeOrigin + performance.now();
      for (const [name, { selector, attribute }] of Object.entries(wanted)) {
        const element = document.querySelector(selector);
        const value = attribute ? element?.getAttribute(attribute) : element?.textContent;
        if (value !== undefined && value !== null && value !== last[name]) {
          last[name] = value;
          found.push({ name, unix_ms, value });
        }
      }
    };
    look();
    new MutationObserver(look).observe(document.documentElement, {
      attributes: true,
      characterData: true,
      childList: true,
      subtree: true,
    });
    window.testRecords ??= [];
    window.testRecords.push(found);
    return window.testRecords.length - 1;
  }, wanted);
  return { read: () => page.evaluate((number) => window.testRecords[number], number) };
}

/** The values of one name in a record, as numbers. */
export function series(records, name) {
  return records
    .filter((each) => each.name === name)
    .map(({ unix_ms, value }) => ({ unix_s: unix_ms / 1000, value: Number(value) }));
}
