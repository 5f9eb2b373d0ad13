// Cost matrices with the matches over them, to zoom into.
'use strict';

const MATRIX_MARGIN = {left: 52, right: 10, top: 10, bottom: 40};

/** A round step, about `room` pixels wide at `scale` pixels a unit. */
function roundStep(scale, room) {
  const least = room / scale;
  const power = 10 ** Math.floor(Math.log10(least));
  return Math.max(1, [1, 2, 5, 10].map(m => m * power).find(step => step >= least));
}

/** Draws `figure`. Query keyframes run to the right, reference keyframes upwards. */
function drawMatrix(figure, spec) {
  const canvas = figure.querySelector('canvas');
  const pictures = {};
  const shown = {picture: 'enhanced', truth: true, found: true, accepted: true, refused: true};
  const view = {query: spec.queries / 2, reference: spec.references / 2, zoom: 1};
  const reading = document.createElement('div');
  reading.className = 'reading';
  reading.setAttribute('aria-live', 'polite');

  const room = () => ({width: canvas.clientWidth - MATRIX_MARGIN.left - MATRIX_MARGIN.right,
    height: canvas.clientHeight - MATRIX_MARGIN.top - MATRIX_MARGIN.bottom});
  const scale = () => view.zoom * Math.min(room().width / spec.queries, room().height / spec.references);
  const toX = query => MATRIX_MARGIN.left + room().width / 2 + (query - view.query) * scale();
  const toY = reference => MATRIX_MARGIN.top + room().height / 2 - (reference - view.reference) * scale();
  const toQuery = x => (x - MATRIX_MARGIN.left - room().width / 2) / scale() + view.query;
  const toReference = y => view.reference - (y - MATRIX_MARGIN.top - room().height / 2) / scale();

  function line(pen, points, colour, width, dash) {
    pen.setLineDash(dash);
    for (const [ink, extra] of [['#fff', 2.5], [colour, 0]]) {  // on a light rim, to be seen on any grey
      pen.strokeStyle = ink;
      pen.lineWidth = width + extra;
      pen.beginPath();
      let drawing = false;
      for (const point of points) {
        if (!point) { drawing = false; continue; }
        if (drawing) pen.lineTo(toX(point[0]), toY(point[1])); else pen.moveTo(toX(point[0]), toY(point[1]));
        drawing = true;
      }
      pen.stroke();
    }
    pen.setLineDash([]);
  }
  function marks(pen, accepted) {
    const radius = Math.min(Math.max(0.4 * scale(), 2.5), 6);
    for (const match of spec.matches) {
      if (match.reference === null || match.accepted !== accepted) continue;
      const x = toX(match.query + 0.5), y = toY(match.reference + 0.5);
      pen.beginPath();
      if (accepted) {
        pen.arc(x, y, radius, 0, 2 * Math.PI);
        pen.fillStyle = '#ff7f0e';
        pen.fill();
        pen.strokeStyle = '#5a2600';
      } else {
        pen.rect(x - radius, y - radius, 2 * radius, 2 * radius);
        pen.strokeStyle = '#1f8fff';
      }
      pen.lineWidth = accepted ? 1 : 2;
      pen.stroke();
    }
  }
  function axes(pen) {
    pen.fillStyle = themeColour('soft');
    pen.strokeStyle = themeColour('soft');
    pen.lineWidth = 1;
    pen.font = '12px system-ui, sans-serif';
    const {width, height} = room(), bottom = MATRIX_MARGIN.top + height, left = MATRIX_MARGIN.left;
    pen.strokeRect(left + 0.5, MATRIX_MARGIN.top + 0.5, width, height);
    pen.textAlign = 'center';
    pen.textBaseline = 'top';
    for (let q = 0, step = roundStep(scale(), 70); q < spec.queries; q += step) {
      const x = toX(q + 0.5);
      if (x >= left && x <= left + width) pen.fillText(q, x, bottom + 4);
    }
    pen.fillText('query keyframe', left + width / 2, bottom + 22);
    pen.textAlign = 'right';
    pen.textBaseline = 'middle';
    for (let r = 0, step = roundStep(scale(), 50); r < spec.references; r += step) {
      const y = toY(r + 0.5);
      if (y >= MATRIX_MARGIN.top && y <= bottom) pen.fillText(r, left - 5, y);
    }
    pen.save();
    pen.translate(12, MATRIX_MARGIN.top + height / 2);
    pen.rotate(-Math.PI / 2);
    pen.textAlign = 'center';
    pen.fillText('reference keyframe', 0, 0);
    pen.restore();
  }
  function draw() {
    const width = canvas.clientWidth;
    if (width === 0) return;
    const ideal = (width - 62) * spec.references / spec.queries + 50;
    canvas.style.height = `${Math.round(Math.min(Math.max(ideal, 260), 0.95 * width, 760))}px`;
    const ratio = window.devicePixelRatio || 1;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(canvas.clientHeight * ratio);
    const pen = canvas.getContext('2d');
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.fillStyle = themeColour('raised');
    pen.fillRect(0, 0, width, canvas.clientHeight);
    pen.save();
    pen.beginPath();
    pen.rect(MATRIX_MARGIN.left, MATRIX_MARGIN.top, room().width, room().height);
    pen.clip();
    const picture = pictures[shown.picture];
    if (picture && picture.complete) {
      pen.imageSmoothingEnabled = picture.width > 1.2 * spec.queries * scale() * ratio;
      pen.drawImage(picture, toX(0), toY(spec.references), spec.queries * scale(), spec.references * scale());
    }
    if (shown.found) line(pen, spec.matches.map(m => (m.accepted && m.reference !== null ? [m.query + 0.5, m.reference + 0.5] : null)), '#ff7f0e', 1.2, []);
    if (shown.refused) marks(pen, false);
    if (shown.accepted) marks(pen, true);
    if (shown.truth && spec.truth) line(pen, spec.truth.map((r, q) => (r === null ? null : [q + 0.5, r + 0.5])), '#007a3d', 2, [7, 5]);
    pen.restore();
    axes(pen);
    figure.dataset.zoom = view.zoom.toFixed(2);
    figure.dataset.picture = shown.picture;
  }
  function keepInside() {
    const half = {query: room().width / scale() / 2, reference: room().height / scale() / 2};
    for (const [name, count] of [['query', spec.queries], ['reference', spec.references]]) {
      view[name] = 2 * half[name] >= count ? count / 2 : Math.min(Math.max(view[name], half[name]), count - half[name]);
    }
  }
  function zoom(factor, x = canvas.clientWidth / 2, y = canvas.clientHeight / 2) {
    const query = toQuery(x), reference = toReference(y);
    view.zoom = factor === 0 ? 1 : Math.min(Math.max(view.zoom * factor, 1), 64);
    view.query += query - toQuery(x);
    view.reference += reference - toReference(y);
    keepInside();
    draw();
  }
  function pan(right, up) {
    view.query += right / scale();
    view.reference += up / scale();
    keepInside();
    draw();
  }
  function tell(x, y) {
    const q = Math.floor(toQuery(x)), r = Math.floor(toReference(y));
    const match = spec.matches[q];
    if (!match || r < 0 || r >= spec.references) { reading.textContent = ''; return; }
    const found = match.reference === null ? 'matched with nothing here'
      : `found at reference keyframe ${match.reference}, score ${match.score}, ${match.accepted ? 'accepted' : 'refused'}`;
    reading.textContent = `query keyframe ${q} (frame ${match.frame}, ${match.time_s} s), reference keyframe ${r} (frame ${spec.reference_frames[r]}): ${found}`;
  }

  const tools = document.createElement('div');
  tools.className = 'tools';
  const choice = (type, group, name, text, checked, change) => {
    const label = document.createElement('label');
    const input = Object.assign(document.createElement('input'), {type, name: `${figure.id}-${group}`, value: name, checked});
    input.onchange = () => { change(input); draw(); };
    label.append(input, ' ', text);
    return label;
  };
  const fieldset = (title, ...labels) => {
    const set = document.createElement('fieldset'), legend = document.createElement('legend');
    legend.textContent = title;
    set.append(legend, ...labels);
    return set;
  };
  tools.append(fieldset('Cost', ...Object.keys(spec.pictures).map(name =>
    choice('radio', 'picture', name, name, name === shown.picture, input => { shown.picture = input.value; }))));
  tools.append(fieldset('Over it', ...[['truth', '╌ true path'], ['found', '— found path'], ['accepted', '● accepted'], ['refused', '□ refused']]
    .filter(([name]) => name !== 'truth' || spec.truth)
    .map(([name, text]) => choice('checkbox', 'layer', name, text, true, input => { shown[name] = input.checked; }))));
  for (const [text, name, act] of [['+', 'zoom in', () => zoom(2)], ['−', 'zoom out', () => zoom(0.5)], ['all', 'show all', () => zoom(0)]]) {
    const button = Object.assign(document.createElement('button'), {type: 'button', textContent: text, onclick: act});
    button.setAttribute('aria-label', name);
    tools.append(button);
  }
  figure.prepend(tools);
  canvas.after(reading);

  canvas.addEventListener('wheel', event => {
    if (!event.ctrlKey && document.activeElement !== canvas) return;  // the wheel scrolls the page until one is in here
    event.preventDefault();
    zoom(event.deltaY < 0 ? 1.25 : 0.8, event.offsetX, event.offsetY);
  }, {passive: false});
  let last = null;
  canvas.addEventListener('pointerdown', event => { last = event; canvas.setPointerCapture(event.pointerId); });
  canvas.addEventListener('pointerup', () => { last = null; });
  canvas.addEventListener('pointermove', event => {
    tell(event.offsetX, event.offsetY);
    if (!last) return;
    pan(last.clientX - event.clientX, event.clientY - last.clientY);
    last = event;
  });
  canvas.addEventListener('keydown', event => {
    const step = 60;
    const act = {'+': () => zoom(2), '=': () => zoom(2), '-': () => zoom(0.5), 0: () => zoom(0), ArrowLeft: () => pan(-step, 0),
      ArrowRight: () => pan(step, 0), ArrowUp: () => pan(0, step), ArrowDown: () => pan(0, -step)}[event.key];
    if (!act) return;
    act();
    tell(canvas.clientWidth / 2, canvas.clientHeight / 2);
    event.preventDefault();
  });
  window.addEventListener('resize', draw);
  for (const [name, source] of Object.entries(spec.pictures)) {
    pictures[name] = Object.assign(new Image(), {onload: draw, src: source});
  }
  if (!(shown.picture in spec.pictures)) shown.picture = Object.keys(spec.pictures)[0];
  draw();
  return {restyle: draw, zoom};
}
