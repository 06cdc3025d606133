// The strip of alarms: what holds now, and what is over but should be seen.
import {h} from './dom.js';
import {clock} from './format.js';

const titles = {
  contact: 'Contact',
  deadlock: 'Deadlock',
  proxy_silent: 'Robot silent',
  planner_silent: 'Planner silent',
  controller_fault: 'Controller fault',
  other_cell: 'Other cell file',
};
const shownOver = 4; // of those that are over

export class Alarms {
  constructor(root) {
    this.root = root;
  }

  draw(picture) {
    const holding = picture.alarms.filter((alarm) => alarm.ended === null);
    const over = picture.alarms.filter((alarm) => alarm.ended !== null).slice(-shownOver);
    this.root.replaceChildren(
      ...[...holding, ...over.reverse()].map((alarm) =>
        h(
          'p',
          {class: alarm.ended === null ? 'alarm' : 'alarm over', dataset: {kind: alarm.kind}},
          h('strong', {text: titles[alarm.kind] ?? alarm.kind}),
          ` ${alarm.text} `,
          h('small', {text: alarm.ended === null ? `since ${clock(alarm.since)}` : `at ${clock(alarm.since)}, over`}),
        ),
      ),
    );
  }
}
