// What the browser tests share: the installed Chromium, errors that must not happen, and waits that end.
import {chromium} from 'playwright-core';

export const patience = 40_000; // [ms]: nothing takes this long when all is well

/** A page on `url` in a browser of its own, with everything it complained of. Software draws it: there may be no graphics card. */
export async function openPage(executablePath, options) {
  const browser = await chromium.launch({executablePath, args: ['--no-sandbox', '--disable-gpu', '--enable-unsafe-swiftshader']});
  const page = await browser.newPage({viewport: {width: 1440, height: 1130}, colorScheme: 'light', ...options});
  const complaints = [];
  page.on('console', (message) => message.type() === 'error' && complaints.push(message.text()));
  page.on('pageerror', (error) => complaints.push(error.stack));
  page.setDefaultTimeout(patience);
  return {browser, page, complaints};
}

/** Seconds of processor time that the page has taken since its browser began with it. */
export async function processorTime(page) {
  const session = await page.context().newCDPSession(page);
  await session.send('Performance.enable', {timeDomain: 'threadTicks'});
  const {metrics} = await session.send('Performance.getMetrics');
  await session.detach();
  return metrics.find((metric) => metric.name === 'ProcessTime').value;
}

/** The faults axe finds that are serious or worse, one line each; by all of its rules or some. */
export async function seriousFaults(page, axeSource, rules) {
  if (!(await page.evaluate(() => 'axe' in globalThis))) await page.evaluate(axeSource);
  const options = {resultTypes: ['violations'], ...(rules && {runOnly: {type: 'rule', values: rules}})};
  const results = await page.evaluate((choice) => globalThis.axe.run(document, choice), options);
  return results.violations
    .filter((violation) => violation.impact === 'serious' || violation.impact === 'critical')
    .map((violation) => `${violation.id} (${violation.impact}): ${violation.nodes.map((node) => `${node.target} ${node.failureSummary}`).join(' | ')}`);
}
