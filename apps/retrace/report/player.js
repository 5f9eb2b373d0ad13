// A walk as it was followed, to play: the route, where the walker is on it, and the two pictures.
'use strict';

const STATE_TEXTS = {searching: 'searching', on_route: 'on the route', off_route: 'off the route'};
const PLAYER_MARGIN_PX = 24;
const KEPT_LIVE = 1800;  // moments, at most ten a second

/** The scale and shift that bring points into a canvas, the same in both directions. */
function fitted(points, width, height) {
  let low = [Infinity, Infinity], high = [-Infinity, -Infinity];
  for (const point of points) {
    low = low.map((value, i) => Math.min(value, point[i]));
    high = high.map((value, i) => Math.max(value, point[i]));
  }
  const span = high.map((value, i) => Math.max(value - low[i], 1));
  const scale = Math.min((width - 2 * PLAYER_MARGIN_PX) / span[0], (height - 2 * PLAYER_MARGIN_PX) / span[1]);
  const middle = high.map((value, i) => (value + low[i]) / 2);
  return {scale, at: ([x, y]) => [width / 2 + (x - middle[0]) * scale, height / 2 - (y - middle[1]) * scale]};
}

/** The canvas's pen in CSS pixels, on an empty ground. */
function clearedPen(canvas, height) {
  const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth;
  canvas.style.height = `${height}px`;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const pen = canvas.getContext('2d');
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.fillStyle = themeColour('raised');
  pen.fillRect(0, 0, width, height);
  return pen;
}

/** What the follower announced, in words. */
function announcement(said) {
  const metres = value => `${Math.max(0, value).toFixed(0)} m`;
  switch (said.event) {
    case 'found': return 'found on the route';
    case 'left_route': return 'left the route';
    case 'back_on_route': return 'back on the route';
    case 'turn_ahead':
      return `in ${metres(said.distance_m)} a turn of ${Math.abs(said.turn_deg).toFixed(0)}° to the ${said.turn_deg < 0 ? 'left' : 'right'}`;
    case 'passing': return `passing ${said.name}`;
    case 'end_of_route': return `the route ends in ${metres(said.distance_m)}`;
    default: return '';
  }
}

/** Fills `figure`. A live walk's moments come from the server that the page is from. Without poses, the route is a straight line of its keyframes. */
function drawPlayer(figure, spec) {
  const make = (tag, properties, ...children) => {
    const element = Object.assign(document.createElement(tag), properties);
    element.append(...children);
    return element;
  };
  const canvas = make('canvas', {tabIndex: 0});
  canvas.setAttribute('role', 'img');
  canvas.setAttribute('aria-label', 'the route and the place on it; space plays, arrows go on and back');
  const reading = make('p', {className: 'reading'});
  const play = make('button', {type: 'button', textContent: '▶ play'});
  const slider = make('input', {type: 'range', min: 0, max: Math.max(0, spec.samples.length - 1), value: 0});
  slider.setAttribute('aria-label', 'moment of the walk');
  const picture = text => make('figure', {}, make('img', {alt: text}), make('figcaption', {textContent: text}));
  const query = picture('what the walker sees'), reference = picture('the place on the route');
  const status = make('p', {className: 'status'});
  status.setAttribute('role', 'status');  // read out as it changes
  figure.prepend(...(spec.live ? [status] : []), make('div', {className: 'pair'}, query, reference),
    make('div', {className: 'tools'}, play, slider), reading, canvas);

  let index = 0, timer = null;
  const poses = spec.traverses.some(traverse => traverse.x.some(x => x !== null));
  const longest = Math.max(2, ...spec.traverses.map(traverse => traverse.x.length));
  const point = (t, k) => {
    if (!poses) return [k / longest * 100, -12 * t];
    const {x, y} = spec.traverses[t];
    return x[k] === null ? null : [x[k], y[k]];
  };
  const lines = spec.traverses.map((traverse, t) => traverse.x.map((_, k) => point(t, k)));
  const where = sample => (sample.traverse === undefined ? null
    : poses && sample.x !== undefined ? [sample.x, sample.y] : point(sample.traverse, sample.keyframe));

  function draw() {
    if (canvas.clientWidth === 0) return;
    const height = Math.round(poses ? Math.min(0.8 * canvas.clientWidth, 420) : 90);
    const pen = clearedPen(canvas, height);
    const {scale, at} = fitted(lines.flat().filter(Boolean), canvas.clientWidth, height);
    pen.lineWidth = 3;
    pen.strokeStyle = themeColour('blue');
    for (const line of lines) {
      pen.beginPath();
      let drawing = false;
      for (const place of line) {
        if (place) pen[drawing ? 'lineTo' : 'moveTo'](...at(place));
        drawing = place !== null;
      }
      pen.stroke();
    }
    pen.fillStyle = themeColour('ink');
    pen.font = '12px system-ui, sans-serif';
    for (const named of spec.places) {
      const place = point(named.traverse, named.keyframe);
      if (!place) continue;
      const [x, y] = at(place);
      pen.fillRect(x - 3, y - 3, 6, 6);
      pen.textAlign = x > canvas.clientWidth / 2 ? 'right' : 'left';
      const right = pen.textAlign === 'right';
      pen.fillText(named.name, x + (right ? -7 : 7), y - 5, (right ? x : canvas.clientWidth - x) - 12);
    }
    const sample = spec.samples[index], place = sample && where(sample);
    if (!place) return;
    const [x, y] = at(place);
    const sd = poses ? sample.sd_m ?? 0 : sample.sd_keyframes / longest * 100;
    pen.fillStyle = themeColour('orange');
    pen.globalAlpha = 0.3;
    pen.beginPath();
    pen.arc(x, y, Math.max(1.64 * sd * scale, 8), 0, 2 * Math.PI);  // 90 %
    pen.fill();
    pen.globalAlpha = 1;
    pen.beginPath();
    pen.arc(x, y, 5, 0, 2 * Math.PI);
    pen.fill();
  }
  function put(box, url) {
    const image = box.querySelector('img');
    if (url) image.src = url; else image.removeAttribute('src');
    box.classList.toggle('empty', !url);
  }
  function show(next) {
    index = Math.min(Math.max(next, 0), spec.samples.length - 1);
    const sample = spec.samples[index];
    if (!sample) return;
    slider.value = index;
    figure.dataset.frame = sample.frame;
    const parts = [`${sample.time_s.toFixed(1)} s, frame ${sample.frame}: ${STATE_TEXTS[sample.state]}`];
    if (sample.distance_m !== undefined) parts.push(`at ${sample.distance_m.toFixed(1)} m ± ${(1.64 * (sample.sd_m ?? 0)).toFixed(1)} m (90 %)`);
    if (sample.probability !== undefined) parts.push(`probability ${sample.probability.toFixed(2)}`);
    if (sample.traverse !== undefined) parts.push(`reference ${spec.traverses[sample.traverse].name}, frame ${sample.reference_frame}`);
    reading.textContent = parts.join('; ');
    put(query, sample.query);
    put(reference, sample.reference === undefined ? null : spec.live ? sample.reference : spec.references[sample.reference]);
    draw();
  }
  function stop() {
    clearTimeout(timer);
    timer = null;
    play.textContent = '▶ play';
    delete figure.dataset.playing;
  }
  function step() {
    if (index + 1 >= spec.samples.length) { stop(); return; }
    const wait_s = spec.samples[index + 1].time_s - spec.samples[index].time_s;
    timer = setTimeout(() => { show(index + 1); step(); }, 1000 * Math.min(wait_s, 2) / spec.speed);
  }
  function toggle() {
    if (timer !== null) { stop(); return; }
    if (index + 1 >= spec.samples.length) show(0);
    play.textContent = '❚❚ pause';
    figure.dataset.playing = 'true';
    step();
  }
  function say(text) {
    if (status.textContent !== text) status.textContent = text;
  }
  /** Takes moments as they come, and shows the newest unless an earlier one is looked at. */
  function listen() {
    const events = new EventSource('events');
    const turn = (state, text) => { figure.dataset.live = state; say(text); };
    turn('waiting', 'waiting for the walk');
    events.onopen = () => turn('open', 'live');
    events.onerror = () =>
      turn('lost', events.readyState === EventSource.CLOSED ? 'no connection' : 'no connection; trying again');
    events.addEventListener('end', () => { events.close(); turn('ended', 'the walk has ended'); });
    events.onmessage = message => {
      const newest = index >= spec.samples.length - 1, sample = JSON.parse(message.data);
      spec.samples.push(sample);
      if (spec.samples.length > KEPT_LIVE) {
        spec.samples.shift();
        index = Math.max(0, index - 1);
      }
      slider.max = spec.samples.length - 1;
      slider.value = index;
      if (newest && timer === null) show(spec.samples.length - 1);
      say(sample.said ? announcement(sample.said) : 'live');
    };
  }
  play.onclick = toggle;
  slider.oninput = () => show(Number(slider.value));
  canvas.addEventListener('keydown', event => {
    const act = {' ': toggle, ArrowRight: () => show(index + 1), ArrowLeft: () => show(index - 1), Home: () => show(0),
      End: () => show(spec.samples.length - 1)}[event.key];
    if (!act) return;
    act();
    event.preventDefault();
  });
  window.addEventListener('resize', draw);
  show(0);
  draw();
  if (spec.live) listen();
  return {restyle: draw};
}
