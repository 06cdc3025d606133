// Puts the parts of the page together: frames come in, the picture changes, panels draw what concerns them.
import {Alarms} from './alarms.js';
import {latestDelay} from './bars.js';
import {Chart} from './chart.js';
import {CommandTable} from './command_table.js';
import {Connection} from './connection.js';
import {Curves} from './curves.js';
import {h, setText, throttled} from './dom.js';
import {MapPanel} from './map_panel.js';
import {Player} from './player.js';
import {RobotCards} from './robot_cards.js';
import {Scene} from './scene.js';
import {apply, emptyState} from './store.js';

const staleAfter = 1.5; // [s]
const picture = emptyState();
const byId = (id) => document.getElementById(id);
let selected = null; // id of the command whose map is shown

const scene = new Scene(byId('canvas'), byId('labels'), byId('views'), byId('scene-legend'));
const cards = new RobotCards(byId('robots'));
const chart = new Chart(byId('chart'), byId('chart-legend'), choose);
const curves = new Curves(byId('curves'), byId('curves-legend'));
const map = new MapPanel(byId('map'), byId('map-about'), byId('map-legend'));
const table = new CommandTable(byId('commands'), choose);
const alarms = new Alarms(byId('alarms'));

const connection = new Connection(`${location.protocol === 'https:' ? 'wss' : 'ws'}://${location.host}/live`, {
  onFrame: (frame) => changed(apply(picture, frame)),
  onChange: () => showConnection(),
});

const player = new Player(byId('player'), (request) => connection.send(request));

function show(id) {
  if (id === selected) return;
  selected = id;
  askForMap();
  drawCommands();
}

/** Somebody picked a command. */
function choose(id) {
  byId('follow').checked = false;
  show(id);
}

const askForMap = throttled(() => {
  if (selected) connection.send({type: 'map', command: selected});
}, 400);

const drawCommands = throttled(() => {
  if (!picture.cell) return;
  if (byId('follow').checked) {
    const latest = latestDelay(picture.commands.values());
    if (latest) show(latest.id);
  }
  chart.draw(picture, selected);
  table.draw(picture, selected);
}, 250);

const drawCurves = throttled(() => curves.draw(picture), 250);

const drawState = throttled(() => {
  if (!picture.state) return;
  cards.draw(picture);
  map.draw(picture, selected);
  setText(byId('cell'), picture.cell.cell);
  document.title = `${picture.cell.cell} – Interlace`;
  const {planner} = picture.state;
  const facts = [
    ['planner', planner.heard ? 'heard' : 'silent'],
    ['strategy', planner.strategy ?? '–'],
    ['completed', planner.completed === undefined ? '–' : `${planner.completed} of ${planner.accepted}`],
    ['contacts', `${picture.state.contacts}`],
  ];
  byId('facts').replaceChildren(...facts.map(([name, value]) => h('span', {}, h('small', {text: name}), value)));
  const skipped = picture.skipped > 0 ? `${picture.skipped} frames were skipped because this page could not keep up.` : '';
  setText(byId('quality'), `${scene.framesPerSecond()} pictures per second. ${skipped}`);
}, 200);

function changed(kind) {
  if (!picture.cell || kind === null) return;
  if (kind === 'player' || kind === 'snapshot') player.draw(picture);
  if (kind === 'snapshot') {
    scene.build(picture);
    curves.build(picture);
    alarms.draw(picture);
    askForMap();
  }
  if (kind === 'bodies') scene.build(picture);
  if (kind === 'motion' || kind === 'motion_over' || kind === 'snapshot') scene.drawGhosts(picture);
  if (kind === 'pose' || kind === 'snapshot') {
    scene.draw(picture);
    drawCurves();
  }
  if (kind === 'alarms') alarms.draw(picture);
  if (kind === 'map') map.draw(picture, selected);
  if (kind === 'command') {
    if (selected && picture.commands.get(selected)?.t === picture.t) askForMap();
  }
  if (kind === 'state') {
    const state = selected ? picture.commands.get(selected)?.state : null;
    if (state === 'waiting') askForMap(); // what it waits for may have changed
  }
  if (kind !== 'pose') {
    drawCommands();
    drawState();
  }
}

/** Whether what is shown is of now, in words and for the looks. */
function showConnection() {
  const open = connection.socket?.readyState === WebSocket.OPEN;
  const silence = connection.silence();
  const stale = !open || silence > staleAfter;
  const state = open ? (stale ? 'stale' : 'live') : 'lost';
  document.documentElement.dataset.connection = state;
  setText(byId('connection'), {live: picture.cell?.source === 'recording' ? 'recording' : 'live', stale: 'no news', lost: 'no connection, trying again'}[state]);
  byId('stale').hidden = !stale;
  if (stale) setText(byId('stale'), picture.cell ? `What you see is ${silence.toFixed(0)} s old` : 'Waiting for the first picture');
}

byId('follow').addEventListener('change', drawCommands);
setInterval(showConnection, 250);
