// Pairs of query and reference frames side by side, to look through.
'use strict';

const short = number => Number(number.toPrecision(3));

const STRIP_FILTERS = [
  ['all', 'all, along the walk', () => true, (a, b) => a.time_s - b.time_s],
  ['best', 'surest first', pair => pair.accepted, (a, b) => b.score - a.score],
  ['accepted', 'worst accepted', pair => pair.accepted, (a, b) => a.score - b.score],
  ['refused', 'worst refused', pair => !pair.accepted, (a, b) => a.score - b.score],
  ['wrong', 'largest error', pair => pair.error !== undefined && !pair.right, (a, b) => b.error - a.error]
];

function stripItem(pair, spec) {
  const item = document.createElement('li');
  item.className = pair.accepted ? 'accepted' : 'refused';
  for (const [picture, text] of [[pair.query, `query frame ${pair.query_frame}`], [pair.reference, `reference frame ${pair.reference_frame}`]]) {
    if (!picture) continue;
    item.append(Object.assign(document.createElement('img'), {src: picture, alt: text, loading: 'lazy', decoding: 'async'}));
  }
  const lines = [`${pair.accepted ? '● accepted' : '□ refused'}, score ${short(pair.score)}`,
    `query ${pair.time_s.toFixed(1)} s, frame ${pair.query_frame}`, `found at ${pair.reference_time_s.toFixed(1)} s, frame ${pair.reference_frame}`];
  if (pair.error !== undefined) lines.push(`${pair.right ? '✓ right' : '✗ wrong'}: ${short(pair.error)} ${spec.unit} off`);
  for (const line of lines) item.append(Object.assign(document.createElement('p'), {textContent: line}));
  return item;
}

/** Fills `figure` with a list and the buttons that choose what is in it, and in which order. */
function drawStrip(figure, spec) {
  const list = document.createElement('ol');
  list.tabIndex = 0;
  list.setAttribute('aria-label', 'pairs of frames, query above reference');
  const tools = document.createElement('div');
  tools.className = 'tools';
  const count = document.createElement('span');
  count.className = 'reading';
  count.setAttribute('aria-live', 'polite');
  const buttons = STRIP_FILTERS.filter(([, , keep]) => spec.pairs.some(keep)).map(([name, text, keep, order]) => {
    const button = Object.assign(document.createElement('button'), {type: 'button', textContent: text});
    button.dataset.filter = name;
    button.onclick = () => {
      buttons.forEach(other => other.setAttribute('aria-pressed', other === button));
      const pairs = spec.pairs.filter(keep).sort(order);
      list.replaceChildren(...pairs.map(pair => stripItem(pair, spec)));
      list.scrollLeft = 0;
      count.textContent = `${pairs.length} of ${spec.pairs.length} pairs`;
    };
    return button;
  });
  tools.append(...buttons, count);
  figure.prepend(tools, list);
  if (buttons.length > 0) buttons[0].click();
  return {restyle() {}};
}
