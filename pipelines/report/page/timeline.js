// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
// Draws the timeline: a bar for each action, in its lane. A canvas, for tens of thousands of bars.

const kLaneHeight = 22;
const kStageColors = {import: 'import', textures: 'textures', texels: 'textures', clusters: 'clusters', skinning: 'skinning', visibility: 'visibility',
                      bricks: 'light', receivers: 'light', specular: 'other', link: 'link'};

/** bars  {stage, subject, start, seconds, lane, why, failed, open} */
function makeTimeline(bars, total) {
  const lanes = bars.reduce((most, bar) => Math.max(most, bar.lane + 1), 1);
  const height = lanes * kLaneHeight + 24;
  const canvas = el('canvas', {height, role: 'img', 'data-bars': bars.length,
                               'aria-label': `${bars.length} actions in ${lanes} lanes over ${seconds(total)}; the table of assets has their times`});
  canvas.style.height = height + 'px';
  const left = 46;

  function draw() {
    const scale = devicePixelRatio || 1;
    const width = canvas.clientWidth;
    canvas.width = width * scale;
    canvas.height = height * scale;
    const paint = canvas.getContext('2d');
    const style = getComputedStyle(document.documentElement);
    const ink = name => style.getPropertyValue('--' + name).trim();
    paint.scale(scale, scale);
    paint.font = '11px system-ui, "DejaVu Sans", sans-serif';
    paint.fillStyle = ink('faint');
    const at = time => left + time / total * (width - left - 8);
    for (let lane = 0; lane < lanes; ++lane) paint.fillText('lane ' + (lane + 1), 0, lane * kLaneHeight + 14);
    const step = niceStep(total / 8);
    paint.textAlign = 'center';
    for (let time = 0; time <= total; time += step) {
      paint.fillStyle = ink('line');
      paint.fillRect(at(time), 0, 1, height - 18);
      paint.fillStyle = ink('faint');
      paint.fillText(+time.toPrecision(3) + ' s', Math.min(Math.max(at(time), 14), width - 20), height - 5);
    }
    paint.textAlign = 'left';
    for (const bar of bars) {
      const x = at(bar.start), w = Math.max(at(bar.start + bar.seconds) - x - 0.5, 0.7), y = bar.lane * kLaneHeight + 2;
      paint.fillStyle = ink(bar.failed ? 'bad' : kStageColors[bar.stage] || 'other');
      paint.fillRect(x, y, w, kLaneHeight - 5);
      if (w > 60) {
        paint.fillStyle = '#fff';
        paint.fillText(shorten(bar.stage + ' ' + nameOf(bar.subject), w - 6), x + 4, y + 12.5);
      }
    }
  }

  function barAt(event) {
    const box = canvas.getBoundingClientRect();
    const time = (event.clientX - box.left - left) / (box.width - left - 8) * total;
    const lane = Math.floor((event.clientY - box.top) / kLaneHeight);
    const slack = 2 * total / box.width;
    let found = null;
    for (const bar of bars)
      if (bar.lane === lane && time >= bar.start - slack && time <= bar.start + bar.seconds + slack &&
          (!found || Math.abs(time - bar.start - bar.seconds / 2) < Math.abs(time - found.start - found.seconds / 2))) found = bar;
    return found;
  }
  tip(canvas, event => {
    const bar = barAt(event);
    return bar && `${bar.stage} of ${bar.subject}\n${seconds(bar.seconds)}, from ${seconds(bar.start)} on\n${bar.why.join('\n')}`;
  });
  canvas.addEventListener('click', event => { const bar = barAt(event); if (bar && bar.open) bar.open(); });
  addEventListener('resize', draw);
  return {canvas, draw};
}

/** Rounds up to 1, 2 or 5 times a power of ten. */
function niceStep(wanted) {
  const power = 10 ** Math.floor(Math.log10(wanted));
  return [1, 2, 5, 10].map(k => k * power).find(step => step >= wanted) || wanted;
}
