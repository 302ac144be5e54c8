// The documentation behind the page's link, as JSON: node docs_page.mjs ADDRESS
import { LAPTOP, openPage, outsideRequests, startBrowser } from "../browser/support/browser.mjs";

/** What a script of the documentation gets of the page that the same server serves. */
async function tryTheServer() {
  const asked = async (path, options) => {
    try {
      return (await fetch(path, options)).status;
    } catch {
      return "refused";
    }
  };
  const link = new Promise((done) => {
    const socket = new WebSocket(`ws://${location.host}/link`);
    socket.onopen = () => done("open");
    socket.onerror = () => done("refused");
  });
  let cookie = "refused";
  try {
    cookie = document.cookie;
  } catch {
    // A sandbox has none.
  }
  const session = await asked("/session", { method: "POST" });
  return { cookie, session, page: await asked("/"), link: await link, opener: window.opener };
}

const [address] = process.argv.slice(2);
const browser = await startBrowser();
try {
  const page = await openPage(browser, `${address}/docs/index.html`, LAPTOP);
  await page.click("label[for=__palette_1]");
  await page.click("label[for=__palette_2]");
  await page.click(".md-nav__link[href='guide.html']");
  await page.waitForURL("**/guide.html");
  const scheme = await page.getAttribute("body", "data-md-color-scheme");
  await page.click(".md-search__input");
  await page.keyboard.type("brown-out");
  await page.waitForSelector(".md-search-result__item");
  const found = await page.locator(".md-search-result__item").count();
  const [errors, violations] = [[...page.seen.errors], [...page.seen.violations]];
  const outside = outsideRequests(page);
  const reached = await page.evaluate(tryTheServer);
  console.log(JSON.stringify({ scheme, found, errors, violations, outside, ...reached }));
} finally {
  await browser.close();
}
