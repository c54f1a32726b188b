// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
// Squarified treemap that shows bytes as areas, in two levels (M. Bruls, K. Huizing, J. van Wijk,
// "Squarified Treemaps", 2000).

const kMinCellArea = 60; // square pixels: smaller items are merged into one cell

/** Lays out items {bytes} in a rectangle; calls place(item, x, y, w, h). */
function squarify(items, x, y, w, h, place) {
  let total = items.reduce((sum, item) => sum + item.bytes, 0);
  let begin = 0;
  while (begin < items.length && w > 0 && h > 0) {
    const side = Math.min(w, h);
    const scale = w * h / total;
    const worst = (sum, least, most) => Math.max(side * side * most / (sum * sum), sum * sum / (side * side * least));
    let end = begin, sum = 0, best = Infinity;
    while (end < items.length) {
      const next = sum + items[end].bytes * scale;
      const ratio = worst(next, items[end].bytes * scale, items[begin].bytes * scale);
      if (ratio > best) break;
      best = ratio; sum = next; ++end;
    }
    const thickness = sum / side;
    let at = 0;
    for (let i = begin; i < end; ++i) {
      const length = items[i].bytes * scale / thickness;
      if (w < h) place(items[i], x + at, y, length, thickness);
      else place(items[i], x, y + at, thickness, length);
      at += length;
      total -= items[i].bytes;
    }
    if (w < h) { y += thickness; h -= thickness; } else { x += thickness; w -= thickness; }
    begin = end;
  }
}

/** Returns the items that are large enough for a cell, largest first, and the rest merged into one. */
function mergeSmall(items, area) {
  const sorted = items.filter(item => item.bytes > 0).sort((a, b) => b.bytes - a.bytes);
  const total = sorted.reduce((sum, item) => sum + item.bytes, 0);
  const cut = sorted.findIndex((item, i) => i >= 400 || item.bytes / total * area < kMinCellArea);
  if (cut < 0 || cut === sorted.length - 1) return sorted;
  const rest = sorted.slice(cut);
  const sum = rest.reduce((all, item) => all + item.bytes, 0);
  return [...sorted.slice(0, cut), {name: count(rest.length) + ' smaller', bytes: sum, color: rest[0].color}];
}

/** groups  {name, color, items: [{name, bytes, color, open}]} */
function makeTreemap(groups, width, height) {
  const total = groups.reduce((sum, group) => sum + group.items.reduce((all, item) => all + item.bytes, 0), 0);
  const image = svg('svg.treemap', {viewBox: `0 0 ${width} ${height}`, role: 'group', 'aria-label': 'Bytes of the pack as areas'});
  const sized = groups.map(group => ({...group, bytes: group.items.reduce((all, item) => all + item.bytes, 0)}));
  squarify(mergeSmall(sized, width * height), 0, 0, width, height, (group, x, y, w, h) => {
    const title = group.items && w > 70 && h > 34 ? 17 : 0;
    if (title) image.append(svg('text.title', {x: x + 3, y: y + 12.5},
                                  shorten(`${group.name}  ${bytes(group.bytes)} · ${percent(group.bytes / total)}`, w - 6)));
    const items = mergeSmall(group.items || [group], w * (h - title));
    squarify(items, x, y + title, w - 2, h - title - 2, (item, cx, cy, cw, ch) => {
      const cell = svg('g.cell', {tabindex: item.open ? 0 : undefined, role: item.open ? 'button' : undefined,
                                  'aria-label': `${item.name}, ${bytes(item.bytes)}`, onclick: item.open,
                                  onkeydown: event => { if (event.key === 'Enter' && item.open) item.open(); }},
                       svg('rect', {x: cx, y: cy, width: cw, height: ch, fill: color(item.color || group.color)}));
      if (cw > 44 && ch > 15) cell.append(svg('text', {x: cx + 4, y: cy + 12}, shorten(nameOf(item.name), cw - 8)));
      if (cw > 52 && ch > 30) cell.append(svg('text', {x: cx + 4, y: cy + 25, 'fill-opacity': .8}, shorten(bytes(item.bytes), cw - 8)));
      image.append(tip(cell, `${item.name}\n${bytes(item.bytes)}, ${percent(item.bytes / total)} of the pack`));
    });
  });
  return image;
}

/** Shortens a text to about the available width; characters are 6 pixels wide. */
function shorten(text, width) {
  const most = Math.floor(width / 6.1);
  return text.length <= most ? text : most < 3 ? '' : text.slice(0, most - 1) + '…';
}
