// What axe-core has against a page.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const AXE = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

/**
 * Return the faults of a page (WCAG 2 A and AA) that exclude users.
 * @returns {Promise<{rule: string, where: string[]}[]>}
 */
export async function seriousFaults(page) {
  const hasAxe = await page.evaluate(() => "axe" in window);
  if (!hasAxe) {
    // By the debugger: the page's own policy keeps every other script out.
    await page.evaluate(AXE);
  }
  const found = await page.evaluate(() =>
    window.axe.run(document, {
      runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa"],
      resultTypes: ["violations"],
    }),
  );
  return found.violations
    .filter((fault) => ["serious", "critical"].includes(fault.impact))
    .map((fault) => ({
      rule: fault.id,
      where: fault.nodes.slice(0, 3).map((node) => `${node.target.join(" ")}: ${node.failureSummary}`),
    }));
}
