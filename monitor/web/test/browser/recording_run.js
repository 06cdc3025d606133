// Watches a recording as a person would. tests/e2e/monitor_page_test.cpp serves one: node recording_run.js CHROMIUM URL FOLDER.
import assert from 'node:assert/strict';
import {mkdirSync, readFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {openPage, seriousFaults} from './browser.js';

const [, , chromium, url, folder] = process.argv;
const axeSource = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

mkdirSync(folder, {recursive: true});
const {browser, page, complaints} = await openPage(chromium);
const slider = page.locator('#player input');
const button = page.locator('#player button');
const place = async () => Number(await slider.inputValue());
const until = (condition, argument) => page.waitForFunction(condition, argument);

try {
  // It plays as soon as somebody looks on.
  await page.goto(url);
  await until(() => document.documentElement.dataset.drawn && document.querySelectorAll('.card').length === 2);
  await until(() => Number(document.querySelector('#player input').value) > 1);
  assert.equal(await page.locator('#connection').textContent(), 'recording');
  assert.equal(await button.textContent(), 'Pause');

  // It pauses: nothing moves, and the page does not take that for silence.
  await button.click();
  await until(() => document.querySelector('#player button').textContent === 'Play');
  await until((since) => performance.now() > since + 1000, await page.evaluate(() => performance.now()));
  const paused = await place();
  await until((since) => performance.now() > since + 2000, await page.evaluate(() => performance.now()));
  assert.equal(await place(), paused);
  assert.equal(await page.locator('html').getAttribute('data-connection'), 'live');

  // Any place by the slider, also with the keyboard, forth and back: what is known then is shown.
  await slider.evaluate((input) => {
    input.value = input.max / 2;
    input.dispatchEvent(new Event('input'));
  });
  await until(() => document.querySelectorAll('#commands tr[data-state="completed"]').length > 2);
  assert.deepEqual(await seriousFaults(page, axeSource), []);
  await page.screenshot({path: `${folder}/recording-light.png`});
  await slider.focus();
  await page.keyboard.press('Home');
  await until(() => document.querySelectorAll('#commands tr[data-state="completed"]').length === 0);

  // Faster, to its end.
  await page.locator('#player select').selectOption('16');
  await button.click();
  await until(() => {
    const {value, max} = document.querySelector('#player input');
    return value === max && document.querySelector('#player button').textContent === 'Play';
  });
  assert.equal(await page.locator('.alarm').count(), 0, 'no alarm in a run without contact');
  assert.deepEqual(complaints, []);
} catch (error) {
  await page.screenshot({path: `${folder}/failure-recording.png`, fullPage: true}).catch(() => {});
  console.error(error, complaints);
  process.exitCode = 1;
} finally {
  await browser.close();
}
