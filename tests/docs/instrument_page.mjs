// What an instrument shows: node instrument_page.mjs ADDRESS ID
import { LAPTOP, startBrowser } from "../browser/support/browser.mjs";
import { GroundPage } from "../browser/support/ground_page.mjs";

const [address, id] = process.argv.slice(2);
const browser = await startBrowser();
try {
  const ground = await (await GroundPage.open(browser, address, LAPTOP)).isLive();
  const isLive = (id) => document.querySelector(`#${id} [data-freshness=live]`) !== null;
  await ground.until(isLive, "a live value", id);
  console.log(await ground.text(`#${id}`));
  ground.assertClean();
} finally {
  await browser.close();
}
