// The commands, newest first, each a button that shows its collision map: the way there for keyboards and screen readers.
import {h, setText} from './dom.js';
import {clock, commandName, reasons, seconds} from './format.js';
import {robotColour} from './palette.js';
import {robotIndex} from './store.js';

const shown = 60;
const final = new Set(['completed', 'rejected', 'cancelled', 'failed']);

/** Those in work first, each robot's in their order; then the finished ones, the latest first. */
export function ordered(commands) {
  const all = [...commands];
  const open = all.filter((command) => !final.has(command.state));
  const rank = {started: 0, scheduled: 1, waiting: 1, queued: 2};
  open.sort((a, b) => rank[a.state] - rank[b.state] || a.number - b.number || a.robot.localeCompare(b.robot));
  const done = all.filter((command) => final.has(command.state)).sort((a, b) => (b.end ?? b.submitted) - (a.end ?? a.submitted));
  return [...open, ...done].slice(0, shown);
}

class Row {
  constructor(command, colour, choose) {
    this.name = h('button', {type: 'button', click: () => choose(command.id), title: command.id});
    const swatch = h('span', {class: 'swatch', 'aria-hidden': 'true'});
    swatch.style.background = colour;
    this.cells = ['state', 'start', 'delay', 'why'].map((name) => h('td', {class: name}));
    this.root = h('tr', {dataset: {command: command.id}}, h('th', {scope: 'row'}, swatch, this.name), ...this.cells);
    setText(this.name, commandName(command));
  }

  draw(command, picture, chosen) {
    this.name.setAttribute('aria-pressed', chosen ? 'true' : 'false');
    this.root.dataset.state = command.state;
    const serves = command.serves ? picture.commands.get(command.serves) : null;
    const why = serves ? `makes room for ${commandName(serves)}` : reasons[command.reason] ?? command.reason;
    const texts = [command.state, clock(command.start), command.delay > 0.005 ? seconds(command.delay) : '–', why];
    texts.forEach((text, i) => setText(this.cells[i], text));
    if (this.cells[3].title !== command.text) this.cells[3].title = command.text;
  }
}

export class CommandTable {
  constructor(body, choose) {
    this.body = body;
    this.choose = choose;
    this.rows = new Map();
  }

  draw(picture, selected) {
    const commands = ordered(picture.commands.values());
    const rows = new Map();
    for (const command of commands) {
      const row = this.rows.get(command.id) ?? new Row(command, robotColour(robotIndex(picture, command.robot)), this.choose);
      row.draw(command, picture, command.id === selected);
      rows.set(command.id, row);
    }
    const order = commands.map((command) => command.id).join();
    if (order !== this.order) {
      const focused = document.activeElement;
      this.body.replaceChildren(...[...rows.values()].map((row) => row.root));
      if (focused && this.body.contains(focused)) focused.focus();
      this.order = order;
    }
    this.rows = rows;
  }
}
