// Figures of lines and points: what chart.hpp describes, drawn by Chart.js.
'use strict';

const MARKS = {circle: 'circle', triangle: 'triangle', square: 'rect', diamond: 'rectRot', cross: 'crossRot', star: 'star'};

/** The page's colours, as the style sheet has them for light, dark or paper. */
function themeColour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();
}

/** One of a few patterns of lines: a shading that can be told from others without its colour. */
function hatching(context, colour, pattern) {
  const tile = document.createElement('canvas');
  tile.width = tile.height = 8;
  const pen = tile.getContext('2d');
  pen.strokeStyle = colour;
  pen.globalAlpha = 0.45;
  pen.lineWidth = 1.5;
  const strokes = [[[-2, 2, 2, -2], [0, 8, 8, 0], [6, 10, 10, 6]], [[-2, 6, 2, 10], [0, 0, 8, 8], [6, -2, 10, 2]],
    [[1, 2, 3, 2], [5, 6, 7, 6]], [[0, 0, 8, 8], [8, 0, 0, 8]]];
  pen.beginPath();
  for (const [x0, y0, x1, y1] of strokes[pattern % strokes.length]) {
    pen.moveTo(x0, y0);
    pen.lineTo(x1, y1);
  }
  pen.stroke();
  return context.createPattern(tile, 'repeat');
}

/** Behind the data: a picture in the plane of the axes, and spans of x that are shaded. */
const underlay = {
  id: 'underlay',
  beforeDatasetsDraw(chart) {
    const {ctx, chartArea: area, scales: {x, y}} = chart;
    ctx.save();
    ctx.beginPath();
    ctx.rect(area.left, area.top, area.width, area.height);
    ctx.clip();
    const {spec, picture} = chart.report;
    if (picture && picture.complete) {
      const at = spec.picture;
      const left = x.getPixelForValue(at.left), top = y.getPixelForValue(at.top);
      ctx.globalAlpha = 0.75;
      ctx.drawImage(picture, left, top, x.getPixelForValue(at.right) - left, y.getPixelForValue(at.bottom) - top);
      ctx.globalAlpha = 1;
    }
    for (const [i, band] of spec.bands.entries()) {
      ctx.fillStyle = hatching(ctx, themeColour(band.colour), i);
      for (const [from, to] of band.spans) {
        const left = x.getPixelForValue(from), right = x.getPixelForValue(to);
        ctx.fillRect(left, area.top, Math.max(1, right - left), area.height);
      }
    }
    ctx.restore();
  }
};

/** Names written at the last point of a line that the legend leaves out. */
const endLabels = {
  id: 'endLabels',
  afterDatasetsDraw(chart) {
    const {ctx, chartArea: area} = chart;
    chart.report.spec.series.forEach((series, i) => {
      if (!series.label_at_end) return;
      const points = chart.getDatasetMeta(i).data;
      if (points.length === 0) return;
      const last = points[points.length - 1];
      ctx.save();
      ctx.fillStyle = themeColour('soft');
      ctx.font = '12px system-ui, sans-serif';
      ctx.textAlign = 'right';
      ctx.textBaseline = 'bottom';
      ctx.fillText(series.name, Math.min(last.x, area.right) - 4, Math.min(last.y, area.bottom) - 3);
      ctx.restore();
    });
  }
};

/** One value for the first and last point, another for those between. */
function atEnds(end, between, series) {
  return series.x.map((x, i) => (i === 0 || i === series.x.length - 1 ? end : between));
}

function dataset(series) {
  const colour = themeColour(series.colour);
  const points = series.x.map((x, i) => ({x, y: series.y[i] === null ? NaN : series.y[i]}));
  const size = series.mark ? series.size : 0;
  return {
    label: series.name,
    data: points,
    showLine: series.line,
    borderColor: colour,
    backgroundColor: series.hollow ? 'transparent' : colour,
    borderWidth: !series.line ? 1.5 : series.width,
    borderDash: series.dash,
    pointStyle: series.bar_ends ? atEnds('line', MARKS[series.mark], series) : MARKS[series.mark] || 'circle',
    pointRotation: series.bar_ends ? atEnds(90, 0, series) : 0,
    pointRadius: series.bar_ends ? atEnds(8, size, series) : size,
    pointHoverRadius: Math.max(size, 3.5) + 1.5,
    pointHitRadius: 6,
    pointBorderColor: colour,
    pointBackgroundColor: series.hollow ? 'transparent' : colour,
    clip: series.mark ? 8 : 1,
    spanGaps: false
  };
}

/** How a series looks, for the legend: its line with its dashes, and its mark. */
function legendGlyph(series) {
  const glyph = document.createElement('canvas');
  glyph.width = 34;
  glyph.height = 14;
  const pen = glyph.getContext('2d');
  pen.strokeStyle = pen.fillStyle = themeColour(series.colour);
  pen.lineWidth = !series.line ? 1.5 : Math.max(2, series.width);
  if (series.line) {
    pen.setLineDash(series.dash);
    pen.beginPath();
    pen.moveTo(0, 7);
    pen.lineTo(34, 7);
    pen.stroke();
    pen.setLineDash([]);
  }
  if (series.mark) {
    if (series.hollow) pen.fillStyle = 'transparent';
    Chart.helpers.drawPoint(pen, {pointStyle: MARKS[series.mark], radius: 5, borderWidth: 1.5}, 17, 7);
  }
  return glyph;
}

/** An entry of the legend for each kind of shading; it has no points. */
function bandDataset(band, i, context) {
  return {label: band.name, data: [], showLine: false, pointStyle: 'rect', pointRadius: 7,
    borderColor: themeColour(band.colour), backgroundColor: hatching(context, themeColour(band.colour), i)};
}

function axis(title, range) {
  return {
    type: 'linear',
    title: {display: true, text: title, color: themeColour('soft')},
    ticks: {color: themeColour('soft'), maxRotation: 0, includeBounds: false},
    grid: {color: themeColour('line'), borderColor: themeColour('soft')},
    min: range ? range[0] : undefined,
    max: range ? range[1] : undefined
  };
}

function tooltipLine(spec, item) {
  const series = spec.series[item.datasetIndex];
  const number = value => Number(value.toPrecision(5)).toLocaleString('en');
  const note = series.notes ? ` — ${series.notes[item.dataIndex]}` : '';
  return `${series.name}: ${spec.x_title} ${number(item.parsed.x)}, ${spec.y_title} ${number(item.parsed.y)}${note}`;
}

function configuration(spec, context) {
  return {
    type: 'scatter',
    data: {datasets: [...spec.series.map(dataset), ...spec.bands.map((band, i) => bandDataset(band, i, context))]},
    plugins: [underlay, endLabels],
    options: {
      animation: false,
      responsive: true,
      maintainAspectRatio: false,
      interaction: {mode: 'nearest', intersect: false},
      scales: {x: axis(spec.x_title, spec.x_range), y: axis(spec.y_title, spec.y_range)},
      plugins: {
        legend: {
          position: 'bottom',
          labels: {color: themeColour('ink'), usePointStyle: true, pointStyleWidth: 34, padding: 14,
            filter: item => !(spec.series[item.datasetIndex] || {}).label_at_end,
            generateLabels: chart => Chart.defaults.plugins.legend.labels.generateLabels(chart).map((label, i) =>
              (spec.series[i] ? {...label, pointStyle: legendGlyph(spec.series[i]), rotation: 0} : label))}
        },
        tooltip: {filter: item => Boolean(spec.series[item.datasetIndex]), callbacks: {title: () => '', label: item => tooltipLine(spec, item)}}
      }
    }
  };
}

/** Metres look alike along both axes. */
function makeEqual(chart, view) {
  const area = chart.chartArea;
  const scale = Math.max((view.x[1] - view.x[0]) / area.width, (view.y[1] - view.y[0]) / area.height) || 1;
  for (const [name, pixels] of [['x', area.width], ['y', area.height]]) {
    const middle = (view[name][0] + view[name][1]) / 2;
    chart.options.scales[name].min = middle - scale * pixels / 2;
    chart.options.scales[name].max = middle + scale * pixels / 2;
    chart.options.scales[name].ticks.precision = 0;
  }
}

function extent(spec, name) {
  const values = spec.series.flatMap(series => series[name]).filter(value => value !== null);
  if (spec.picture) values.push(...(name === 'x' ? [spec.picture.left, spec.picture.right] : [spec.picture.top, spec.picture.bottom]));
  const low = values.reduce((a, b) => Math.min(a, b), Infinity), high = values.reduce((a, b) => Math.max(a, b), -Infinity);
  if (!(high >= low)) return [0, 1];
  const margin = name === 'y' || spec.equal ? 0.04 * (high - low || 1) : high === low ? 0.5 : 0;
  return [low - margin, high + margin];
}

/** Names instead of numbers along y. */
function nameLines(axis, names) {
  axis.ticks.stepSize = 1;
  axis.ticks.callback = value => names[value - 1] || '';
}

/** Draws `figure`; returns what the page does with it: restyle() and, where it can be zoomed, zoom(). */
function drawChart(figure, spec) {
  const canvas = figure.querySelector('canvas');
  const whole = {x: spec.x_range || extent(spec, 'x'), y: spec.y_range || extent(spec, 'y')};
  let view = whole, chart = null, picture = null;

  function show() {
    figure.dataset.zoom = ((whole.x[1] - whole.x[0]) / (view.x[1] - view.x[0])).toFixed(2);
    if (spec.equal) {
      makeEqual(chart, view);
    } else {
      [chart.options.scales.x.min, chart.options.scales.x.max] = view.x;
    }
    chart.update('none');
  }
  function zoom(factor) {
    view = factor === 0 ? whole : {x: shrunk(view.x, factor, whole.x), y: spec.equal ? shrunk(view.y, factor, whole.y) : view.y};
    show();
  }
  function shrunk([low, high], factor, limit) {
    const half = Math.min((high - low) / factor, limit[1] - limit[0]) / 2;
    const middle = Math.min(Math.max((low + high) / 2, limit[0] + half), limit[1] - half);
    return [middle - half, middle + half];
  }
  function pan(share) {
    const width = view.x[1] - view.x[0];
    const low = Math.min(Math.max(view.x[0] + share * width, whole.x[0]), whole.x[1] - width);
    view = {x: [low, low + width], y: view.y};
    show();
  }
  function build() {
    if (chart) chart.destroy();
    const config = configuration(spec, canvas.getContext('2d'));
    if (spec.y_names) nameLines(config.options.scales.y, spec.y_names);
    config.options.onResize = () => { if (spec.equal && chart) setTimeout(show, 0); };
    config.plugins.unshift({id: 'report', beforeInit: made => { made.report = {spec, picture}; }});
    chart = new Chart(canvas, config);
    show();
  }
  if (spec.picture) {
    picture = new Image();
    picture.onload = build;
    picture.src = spec.picture.source;
  }
  build();
  readByKeys(figure, canvas, spec, () => chart, {zoom, pan});
  if (spec.zoomable) addZoomButtons(figure, {zoom, pan});
  return {restyle: build, zoom};
}

function addZoomButtons(figure, {zoom, pan}) {
  const tools = document.createElement('div');
  tools.className = 'tools';
  for (const [text, name, act] of [['+', 'zoom in', () => zoom(2)], ['−', 'zoom out', () => zoom(0.5)],
    ['◂', 'to the left', () => pan(-0.5)], ['▸', 'to the right', () => pan(0.5)], ['all', 'show all', () => zoom(0)]]) {
    const button = document.createElement('button');
    button.type = 'button';
    button.textContent = text;
    button.setAttribute('aria-label', name);
    button.onclick = act;
    tools.append(button);
  }
  figure.prepend(tools);
}

/** Arrows walk along the points and the series, and their values are read out; + - 0 zoom. */
function readByKeys(figure, canvas, spec, chartOf, {zoom, pan}) {
  const reading = document.createElement('div');
  reading.className = 'reading';
  reading.setAttribute('aria-live', 'polite');
  figure.querySelector('.plot').after(reading);
  let series = Math.max(0, spec.series.findIndex(one => one.x.length > 0)), point = -1;
  const show = () => {
    const chart = chartOf();
    const active = [{datasetIndex: series, index: point}];
    chart.setActiveElements(active);
    const element = chart.getDatasetMeta(series).data[point];
    chart.tooltip.setActiveElements(active, element ? {x: element.x, y: element.y} : {x: 0, y: 0});
    chart.update('none');
    const {x, y, name} = spec.series[series];
    reading.textContent = `${name}, point ${point + 1} of ${x.length}: ${spec.x_title} ${x[point]}, ${spec.y_title} ${y[point] ?? 'none'}`;
  };
  canvas.addEventListener('keydown', event => {
    if (spec.series.length === 0 && !'+-0='.includes(event.key)) return;
    const along = {ArrowRight: 1, ArrowLeft: -1, PageDown: 20, PageUp: -20}[event.key];
    const between = {ArrowDown: 1, ArrowUp: -1}[event.key];
    if (along && event.shiftKey && spec.zoomable) {
      pan(Math.sign(along) * 0.25);
    } else if (along) {
      const count = spec.series[series].x.length;
      if (count === 0) return;
      point = Math.min(Math.max(point + along, 0), count - 1);
      show();
    } else if (between) {
      const count = spec.series.length;
      let next = series;  // that has points: nothing may be accepted, or nothing refused
      do next = (next + between + count) % count; while (next !== series && spec.series[next].x.length === 0);
      if (spec.series[next].x.length === 0) return;
      series = next;
      point = Math.max(0, Math.min(point, spec.series[series].x.length - 1));
      show();
    } else if (spec.zoomable && '+-0='.includes(event.key)) {
      zoom({'+': 2, '=': 2, '-': 0.5, 0: 0}[event.key]);
    } else {
      return;
    }
    event.preventDefault();
  });
}
