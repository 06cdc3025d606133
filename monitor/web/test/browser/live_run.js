// Looks on at experiment 6.2 as a person would and says what is wrong with what is shown. tests/e2e/monitor_page_test.cpp runs the cell:
// node live_run.js CHROMIUM URL FOLDER. "page loaded" on stderr asks for the program to start; stdout is one line of JSON: what was seen.
import assert from 'node:assert/strict';
import {mkdirSync, readFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {openPage, patience, processorTime, seriousFaults} from './browser.js';

const [, , chromium, url, folder] = process.argv;
const axeSource = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const loadLimit = 2; // [s] on a machine with nothing else to do
const workLimit = 5; // [s] of the page's own work where others slow it down: they also cost it caches and clock
const seen = {};

mkdirSync(folder, {recursive: true});
const {browser, page, complaints} = await openPage(chromium);
const shot = (name, options) => page.screenshot({path: `${folder}/${name}.png`, ...options});
const began = performance.now();
const step = (name) => console.error(`${((performance.now() - began) / 1000).toFixed(1)} s: ${name}`);
const positions = () => page.locator('.card .current').evaluateAll((all) => all.map((each) => /TCP at (.*)$/.exec(each.textContent)?.[1]));

try {
  // It loads: the arms are drawn. On a busy machine the clock counts others' work too; then what the page itself computed counts.
  await page.goto(url);
  await page.waitForFunction(() => document.documentElement.dataset.drawn);
  seen.load_s = Number(await page.evaluate(() => document.documentElement.dataset.drawn)) / 1000;
  seen.load_processor_s = await processorTime(page);
  assert.ok(seen.load_s < loadLimit || seen.load_processor_s < workLimit, `loaded in ${seen.load_s} s, ${seen.load_processor_s} s of work`);
  await page.waitForFunction(() => document.querySelectorAll('.card').length === 4);
  assert.equal(await page.locator('html').getAttribute('data-connection'), 'live');
  const before = await positions();
  console.error('page loaded');

  step('four arms move');
  // Four arms move, in words and in the picture.
  await page.waitForFunction(
    (old) => [...document.querySelectorAll('.card .current')].every((each, i) => /TCP at (.*)$/.exec(each.textContent)?.[1] !== old[i]),
    before,
  );
  const first = await page.locator('#stage').screenshot();
  await page.waitForFunction((n) => performance.now() > n, (await page.evaluate(() => performance.now())) + 400);
  assert.ok(!first.equals(await page.locator('#stage').screenshot()), 'the arms in 3D move');

  step('a robot waits');
  // A robot waits: the sentence names whom it waits for and the links, and the data say the same.
  const card = page.locator('.card[data-activity="waiting"]').first();
  await card.waitFor();
  const waiting = await page.waitForFunction(() => {
    const found = document.querySelector('.card[data-activity="waiting"]');
    const cells = [...(found?.querySelectorAll('tbody tr:first-child td') ?? [])].map((cell) => cell.textContent);
    return cells.length === 6 ? {robot: found.dataset.robot, sentence: found.querySelector('.sentence').textContent, cells} : null;
  });
  await page.waitForFunction(() => document.querySelector('#map svg[data-start]'));
  await shot('waiting-light');
  const {robot, sentence, cells} = await waiting.jsonValue();
  const [blocker, blockerLink, ownLink] = cells;
  seen.waiting = {robot, sentence, blocker, blocker_link: blockerLink, link: ownLink};
  assert.ok(sentence.startsWith(`${robot} `) && sentence.includes(`${blocker}'s ${blockerLink} in the way of ${ownLink}`), sentence);

  step('the chart');
  // The chart shows it.
  seen.bars = await page.waitForFunction(() => document.querySelector('#chart [data-kind="waiting"], #chart [data-kind="delayed"]')?.dataset.kind).then((handle) => handle.jsonValue());
  assert.deepEqual(await seriousFaults(page, axeSource), []);

  step('night and narrow');
  // By night, and narrow.
  await page.emulateMedia({colorScheme: 'dark'});
  assert.deepEqual(await seriousFaults(page, axeSource, ['color-contrast']), []);
  step('picture by night');
  await shot('waiting-dark', {fullPage: true});
  step('narrow');
  await page.setViewportSize({width: 800, height: 1000});
  const wide = () => document.documentElement.scrollWidth <= innerWidth;
  await page.waitForFunction(wide);
  await shot('narrow-dark', {fullPage: true});
  await page.emulateMedia({colorScheme: 'light'});
  await page.setViewportSize({width: 1440, height: 1130});

  step('the chosen start');
  // A start was chosen later than it could have been: its map shows it, inside a start window. The row of the table is the way there.
  const late = await page.waitForFunction(() => {
    const rows = [...document.querySelectorAll('#commands tr')];
    return rows.find((row) => parseFloat(row.querySelector('.delay').textContent) > 1 && row.dataset.state !== 'waiting')?.dataset.command;
  });
  await page.locator(`#commands tr[data-command="${await late.jsonValue()}"] button`).click();
  const chosen = await page.waitForFunction(() => {
    const map = document.querySelector('#map svg[data-start]');
    return map && Number(map.dataset.start) > 1 && map.querySelector('[data-line="chosen"]') ? {start: Number(map.dataset.start), window: map.dataset.window} : null;
  });
  seen.map = await chosen.jsonValue();
  const [from, until] = seen.map.window.split(' ').map(Number);
  assert.ok(seen.map.window !== '' && from <= seen.map.start + 0.01 && seen.map.start <= until + 0.01, JSON.stringify(seen.map));
  seen.about = await page.locator('#map-about').textContent();

  step('pointing');
  // Pointing at an area tells whose links would meet there, and when.
  const area = page.locator('#map path.area').filter({hasNot: page.locator('[d=""]')});
  await page.locator('#map').scrollIntoViewIfNeeded();
  const middles = await area.evaluateAll((all) =>
    all.map((each) => each.getBoundingClientRect()).filter((box) => box.width > 5).map((box) => ({x: box.x + box.width / 2, y: box.y + box.height / 3})),
  );
  assert.ok(middles.length > 0, 'the map has an area');
  await page.mouse.move(middles[0].x, middles[0].y);
  await page.locator('#map .tip').waitFor({state: 'visible'});
  seen.tip = await page.locator('#map .tip').textContent();
  assert.match(seen.tip, /^its (base|link1|link2|eef) and r\d's (base|link1|link2|eef), .*(deep|near)$/);
  await page.mouse.move(5, 5);
  await shot('chosen-light', {fullPage: true});

  step('the keyboard');
  // The keyboard reaches everything: the camera, and a command's map.
  await page.locator('#canvas').focus();
  for (const key of ['ArrowLeft', 'ArrowUp', '+', 'Home']) await page.keyboard.press(key);
  const other = await page.locator('#commands tr[data-state="completed"]:has(button[aria-pressed="false"])').first().getAttribute('data-command');
  const button = page.locator(`#commands tr[data-command="${other}"] button`);
  const name = await button.textContent();
  await button.focus();
  await page.keyboard.press('Enter');
  await page.waitForFunction((text) => document.getElementById('map-about').textContent.startsWith(`${text} `), name);
  assert.equal(await page.locator('#follow').isChecked(), false, 'a choice is kept');

  seen.pictures_per_second = Number(/(\d+) pictures/.exec(await page.locator('#quality').textContent())[1]);
  assert.equal(await page.locator('.alarm').count(), 0, 'no alarm in a run without contact');
  assert.deepEqual(complaints, []);
  console.log(JSON.stringify(seen));
} catch (error) {
  await shot('failure', {fullPage: true, timeout: patience}).catch(() => {});
  console.error(error, JSON.stringify(seen), complaints);
  process.exitCode = 1;
} finally {
  await browser.close();
}
