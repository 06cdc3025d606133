// One card per robot: what it does, and when it stands although it has work, why: as a sentence and as data.
import {h, setText} from './dom.js';
import {commandName, mm, place, seconds} from './format.js';
import {robotColour} from './palette.js';

/** What a robot does, in a word or two. */
export function activity(robot) {
  if (!robot.heard) return 'silent';
  if (robot.moving) return 'moving';
  if (robot.waiting) return 'waiting';
  if (!robot.ready) return 'not ready';
  return robot.queued ? 'about to start' : 'standing by';
}

function conflictRow(conflict, now) {
  const until = conflict.until === null ? 'no end known' : conflict.until > now ? `in ${seconds(conflict.until - now)}` : 'now';
  const cells = [conflict.blocker, conflict.blocker_link ?? '–', conflict.link ?? '–', mm(conflict.clearance_m, 1), place(conflict.place_m), until];
  return h('tr', {}, ...cells.map((text) => h('td', {text})));
}

class Card {
  constructor(name, index) {
    this.activity = h('span', {class: 'activity'});
    this.current = h('p', {class: 'current'});
    this.sentence = h('p', {class: 'sentence'});
    this.rows = h('tbody');
    this.raw = h('pre');
    const heads = ['who', 'its link', 'own link', 'clearance', 'where', 'free'];
    this.data = h(
      'details',
      {},
      h('summary', {text: `why ${name} waits, as data`}),
      h(
        'div',
        {class: 'scroll', tabindex: '0', role: 'region', 'aria-label': `Why ${name} waits, as data`},
        h('table', {}, h('thead', {}, h('tr', {}, ...heads.map((text) => h('th', {scope: 'col', text})))), this.rows),
        this.raw,
      ),
    );
    this.swatch = h('span', {class: 'swatch', 'aria-hidden': 'true'});
    this.swatch.style.background = robotColour(index);
    this.root = h(
      'article',
      {class: 'card', dataset: {robot: name}, 'aria-label': name},
      h('h3', {}, this.swatch, name, ' ', this.activity),
      this.current,
      this.sentence,
      this.data,
    );
  }

  draw(robot, picture) {
    const doing = activity(robot);
    setText(this.activity, doing);
    this.root.dataset.activity = doing.replace(/ /g, '-');
    const pose = picture.pose?.robots[picture.cell.robots.findIndex((each) => each.name === robot.name)];
    const command = picture.commands.get(robot.motion ?? robot.waiting?.command ?? '');
    const parts = [
      command ? commandName(command) : null,
      command?.serves && picture.commands.has(command.serves) ? `for ${commandName(picture.commands.get(command.serves))}` : null,
      robot.queued ? `${robot.queued} more in its queue` : null,
      robot.holds.length > 0 ? `holds ${robot.holds.join(', ')}` : null,
      pose ? `TCP at ${place(pose.tcp)}` : null,
    ];
    setText(this.current, parts.filter(Boolean).join(' · '));
    const {waiting} = robot;
    setText(this.sentence, waiting?.sentence ?? '');
    this.sentence.hidden = this.data.hidden = !waiting;
    if (!waiting) return;
    this.rows.replaceChildren(...waiting.conflicts.map((conflict) => conflictRow(conflict, picture.t)));
    if (this.data.open) setText(this.raw, JSON.stringify(waiting, null, 1));
  }
}

export class RobotCards {
  constructor(root) {
    this.root = root;
    this.cards = new Map();
  }

  draw(picture) {
    const names = picture.cell.robots.map((robot) => robot.name);
    if (names.join() !== [...this.cards.keys()].join()) {
      this.cards = new Map(names.map((name, index) => [name, new Card(name, index)]));
      this.root.replaceChildren(...[...this.cards.values()].map((card) => card.root));
    }
    for (const robot of picture.state.robots) this.cards.get(robot.name)?.draw(robot, picture);
  }
}
