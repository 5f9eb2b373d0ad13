// Draws the page's figures from the data beside each of them.
'use strict';

(() => {
  const drawing = {chart: drawChart, matrix: drawMatrix, strip: drawStrip, player: drawPlayer};
  const drawn = [];
  for (const figure of document.querySelectorAll('figure[data-kind]')) {
    const spec = JSON.parse(figure.querySelector('script[type="application/json"]').textContent);
    drawn.push(drawing[figure.dataset.kind](figure, spec));
    figure.dataset.drawn = 'true';
  }
  // What scrolls sideways can be reached by keys.
  const scrollers = () => document.querySelectorAll('.scroll').forEach(box => {
    if (box.scrollWidth > box.clientWidth) box.tabIndex = 0; else box.removeAttribute('tabindex');
  });
  scrollers();
  window.addEventListener('resize', scrollers);
  const restyle = () => drawn.forEach(figure => figure.restyle());
  window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', restyle);
  window.matchMedia('print').addEventListener('change', restyle);
})();
