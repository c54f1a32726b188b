// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
// Plots the error of a texture over its bytes, in each format that the search looked at: the error of all texels, or that of smooth areas where
// it takes more of its target.

function makeRates(texture, width, height) {
  const {role, candidates, ...encoding} = texture.encoding;
  const isSmooth = encoding.targetSmooth !== null && errorShare(role, encoding.smooth, encoding.targetSmooth) > errorShare(role, encoding.error, encoding.target);
  const error = isSmooth ? encoding.smooth : encoding.error, target = isSmooth ? encoding.targetSmooth : encoding.target;
  const upwards = role !== 'normal' && role !== 'light'; // decibels: more is better
  const points = candidates.filter(candidate => candidate[0] !== texture.format && candidate[isSmooth ? 3 : 2] !== null)
    .map(([name, size, all, smooth]) => ({name, size, value: isSmooth ? smooth : all, on: false}));
  if (error !== null) points.push({name: texture.format, size: texture.memory, value: error, on: true});
  if (points.length === 0) return el('p.empty', {}, 'There is no error.');
  const values = [...points.map(point => point.value), target], sizes = points.map(point => point.size);
  const left = 52, right = width - 14, top = 12, bottom = height - 34;
  // a scale of round steps that has all values, and room for names at both ends
  const span = Math.max(Math.max(...values) - Math.min(...values), upwards ? 4 : target / 2);
  const step = [0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20].find(size => span / size <= 6) || 50;
  const y0 = Math.floor(Math.min(...values) / step - 0.7) * step, y1 = Math.ceil(Math.max(...values) / step + 0.25) * step;
  const x0 = Math.log2(Math.min(...sizes)) - 0.4, x1 = Math.log2(Math.max(...sizes)) + 0.4;
  const px = size => left + (Math.log2(size) - x0) / (x1 - x0) * (right - left);
  const py = value => { const part = (value - y0) / (y1 - y0); return upwards ? bottom - part * (bottom - top) : top + part * (bottom - top); };
  const image = svg('svg', {viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': 'Error over bytes'});
  const axis = svg('g.axis');
  for (let value = Math.max(y0, 0); value <= y1 + step / 2; value += step)
    axis.append(svg('line', {x1: left, x2: right, y1: py(value), y2: py(value)}),
                svg('text', {x: left - 6, y: py(value) + 4, 'text-anchor': 'end'}, String(+value.toFixed(3)) + (role === 'normal' ? '°' : '')));
  for (let k = Math.ceil(x0); k <= x1; ++k)
    axis.append(svg('line', {x1: px(2 ** k), x2: px(2 ** k), y1: top, y2: bottom}),
                svg('text', {x: px(2 ** k), y: bottom + 14, 'text-anchor': 'middle'}, bytes(2 ** k)));
  axis.append(svg('text', {x: (left + right) / 2, y: height - 4, 'text-anchor': 'middle'}, 'bytes on the GPU'),
              svg('text', {x: 12, y: (top + bottom) / 2, 'text-anchor': 'middle', transform: `rotate(-90 12 ${(top + bottom) / 2})`}, isSmooth ? 'error of smooth areas, dB' : upwards ? 'error, dB' : role === 'normal' ? 'error' : 'stops'));
  image.append(axis, svg('line.target', {x1: left, x2: right, y1: py(target), y2: py(target)}),
               svg('text', {x: right - 4, y: py(target) - 4, 'text-anchor': 'end', style: 'fill: var(--good)'}, 'target'));
  const shortName = name => name.replace(/-(srgb|unorm|ufloat|float)$/, '');
  for (const {name, size, value, on} of points) {
    const middle = Math.min(Math.max(px(size), left + 34), right - 34);
    image.append(tip(svg('circle.' + (on ? 'on' : 'off'), {cx: px(size), cy: py(value), r: on ? 5 : 4}),
                     `${name}\n${bytes(size)}\n${errorText(role, value)}${on ? '' : ', estimated'}`),
                 svg('text', {x: middle, y: py(value) + (on ? -9 : 16), 'text-anchor': 'middle', style: on ? 'font-weight: 600' : ''}, shortName(name)));
  }
  return image;
}
