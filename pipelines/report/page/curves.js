// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
// Plots the error of each level over its triangles, both logarithmic; other meshes are faint.

const kMaxFaint = 300; // largest meshes drawn faintly: more become a grey area and take as long as the rest of the page

/** levels  [triangles, error] of levels with an error; level 0 has none: not on a logarithmic axis. */
const errorPoints = mesh => mesh.levels.filter(level => level[2] > 0 && level[1] > 0).map(level => [level[1], level[2]]);

function makeCurves(meshes, width, height) {
  const largest = [...meshes].sort((a, b) => b.triangles - a.triangles).slice(0, kMaxFaint);
  const left = 74, right = width - 22, top = 8, bottom = height - 34;
  const image = svg('svg', {viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': 'Error over triangles, logarithmic'});
  const all = largest.flatMap(errorPoints);
  if (all.length === 0) return {image: el('p.empty', {}, 'No mesh has a coarser level.'), show() {}};
  const range = k => {
    let least = Infinity, most = 0;
    for (const point of all) { least = Math.min(least, point[k]); most = Math.max(most, point[k]); }
    return [Math.floor(Math.log10(least)), Math.max(Math.ceil(Math.log10(most)), Math.floor(Math.log10(least)) + 1)];
  };
  const [x0, x1] = range(0), [y0, y1] = range(1);
  const px = triangles => left + (Math.log10(triangles) - x0) / (x1 - x0) * (right - left);
  const py = error => bottom - (Math.log10(error) - y0) / (y1 - y0) * (bottom - top);
  const path = mesh => 'M' + errorPoints(mesh).map(point => px(point[0]).toFixed(1) + ',' + py(point[1]).toFixed(1)).join('L');

  const axis = svg('g.axis');
  for (let k = x0; k <= x1; ++k)
    axis.append(svg('line', {x1: px(10 ** k), x2: px(10 ** k), y1: top, y2: bottom}),
                svg('text', {x: px(10 ** k), y: bottom + 14, 'text-anchor': 'middle'}, count(10 ** k)));
  for (let k = y0; k <= y1; ++k)
    axis.append(svg('line', {x1: left, x2: right, y1: py(10 ** k), y2: py(10 ** k)}),
                svg('text', {x: left - 6, y: py(10 ** k) + 4, 'text-anchor': 'end'}, metres(+('1e' + k))));
  axis.append(svg('text', {x: (left + right) / 2, y: height - 4, 'text-anchor': 'middle'}, 'triangles of the level'),
              svg('text', {x: 12, y: (top + bottom) / 2, 'text-anchor': 'middle', transform: `rotate(-90 12 ${(top + bottom) / 2})`}, 'largest error'));
  const faint = svg('g');
  for (const mesh of largest) if (errorPoints(mesh).length > 1) faint.append(svg('path.curve', {d: path(mesh)}));
  const chosen = svg('g');
  image.append(axis, faint, chosen);

  function show(mesh) {
    const points = errorPoints(mesh);
    chosen.replaceChildren();
    if (points.length === 0) return;
    chosen.append(svg('path.curve.on', {d: path(mesh)}));
    for (const [triangles, error] of points)
      chosen.append(tip(svg('circle.on', {cx: px(triangles), cy: py(error), r: 4}), `${count(triangles)} triangles\n${metres(error)} off at most`));
  }
  return {image, show};
}
