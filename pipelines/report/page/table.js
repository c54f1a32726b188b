// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
// Virtualized table with sorting and filtering: creates visible rows only, so its length does not matter.

const kRowHeight = 30;
const kRowsAtOnce = 14;
const kMaxPrintedRows = 500; // maximum of printed rows
const kColumnGap = 12; // as in report.css
const kRowPadding = 20;

const columnWidth = column => column.width || (column.number ? '84px' : 'minmax(120px, 1fr)');
const minColumnWidth = column => parseInt(columnWidth(column).match(/\d+(?=px)/)[0]);
const minTableWidth = columns => columns.reduce((sum, column) => sum + minColumnWidth(column) + kColumnGap, kRowPadding - kColumnGap);

/** Returns the columns that fit: the largest `drop` is left out first, columns without one stay. */
function columnsThatFit(columns, width) {
  const fitting = [...columns];
  const droppable = columns.filter(column => column.drop).sort((a, b) => b.drop - a.drop);
  for (const column of droppable) {
    if (minTableWidth(fitting) <= width) break;
    fitting.splice(fitting.indexOf(column), 1);
  }
  return fitting;
}

const kLayoutCallbacks = []; // layout functions of all tables, called when the width of the page is known
addEventListener('resize', () => kLayoutCallbacks.forEach(fit => fit()));

/**
 * columns   {name, of: row => value, show: row => text or element, width, number, tip, drop: rank of removal when space is short}
 * options   select: called with the chosen row; sort: index of the column, negative values first where it begins with '-'
 */
function makeTable(label, rows, columns, options = {}) {
  let visible = columns;
  let shown = rows;
  let sorted = {column: options.sort ?? -1, down: options.down ?? true};
  let selected = null;

  const names = el('div.row.names', {role: 'row'});
  const body = el('div.body', {role: 'rowgroup', tabindex: 0, 'aria-label': label + ', rows'});
  const grid = el('div.table', {role: 'table', 'aria-label': label, 'aria-rowcount': rows.length + 1}, names, body);
  const dropped = el('p.note', {hidden: true});
  const table = el('div', {}, grid, dropped);
  const heads = columns.map((column, i) => el('div' + (column.number ? '.num' : ''), {role: 'columnheader', title: column.tip},
                                              el('button', {type: 'button', onclick: () => sortBy(i)}, column.name)));

  function layOut() {
    names.replaceChildren(...visible.map(column => heads[columns.indexOf(column)]));
    grid.style.setProperty('--columns', visible.map(columnWidth).join(' '));
    grid.style.setProperty('--width', minTableWidth(visible) + 'px');
    const missing = columns.filter(column => !visible.includes(column) && column.name).map(column => column.name);
    dropped.hidden = missing.length === 0;
    dropped.textContent = missing.length ? `No room for: ${missing.join(', ')}.` : '';
  }

  function fit() {
    const fitting = columnsThatFit(columns, grid.clientWidth);
    if (fitting.length === visible.length) return;
    visible = fitting;
    layOut();
    draw();
  }

  function sortBy(column) {
    sorted = {column, down: sorted.column === column ? !sorted.down : !!columns[column].number};
    update();
  }

  function order() {
    heads.forEach((head, i) => i === sorted.column
      ? head.setAttribute('aria-sort', sorted.down ? 'descending' : 'ascending') : head.removeAttribute('aria-sort'));
    if (sorted.column < 0) return;
    const of = columns[sorted.column].of;
    const sign = sorted.down ? -1 : 1;
    const keyed = shown.map((row, i) => [of(row), i, row]);
    keyed.sort((a, b) => (a[0] < b[0] ? -sign : a[0] > b[0] ? sign : a[1] - b[1]));
    shown = keyed.map(item => item[2]);
  }

  function rowAt(i) {
    const row = shown[i];
    const element = el('div.row' + (options.select ? '.can' : ''), {
      role: 'row', 'aria-rowindex': i + 2, 'aria-selected': options.select ? String(row === selected) : undefined,
      style: `top:${i * kRowHeight}px`, onclick: () => choose(row)});
    for (const column of visible)
      element.append(el('div' + (column.number ? '.num' : ''), {role: 'cell'}, column.show ? column.show(row) : String(column.of(row))));
    return element;
  }

  let printing = false;
  function draw() {
    const first = printing ? 0 : Math.max(0, Math.floor(body.scrollTop / kRowHeight) - 4);
    const last = Math.min(shown.length, printing ? kMaxPrintedRows : first + kRowsAtOnce + 9);
    const space = el('div', {style: `height:${(printing ? last : shown.length) * kRowHeight}px`});
    const elements = [space];
    for (let i = first; i < last; ++i) elements.push(rowAt(i));
    if (shown.length === 0) elements.push(el('div.empty', {}, rows.length ? 'No row has that.' : 'None.'));
    body.replaceChildren(...elements);
  }

  function update() {
    order();
    body.style.height = Math.min(Math.max(shown.length, 1.4), kRowsAtOnce) * kRowHeight + 'px';
    body.scrollTop = 0;
    draw();
  }

  function choose(row, scroll) {
    if (!options.select || row === undefined) return;
    selected = row;
    const at = shown.indexOf(row);
    if (scroll && at >= 0 && (at * kRowHeight < body.scrollTop || (at + 1) * kRowHeight > body.scrollTop + body.clientHeight))
      body.scrollTop = (at - 2) * kRowHeight;
    draw();
    options.select(row);
  }

  body.addEventListener('scroll', draw, {passive: true});
  body.addEventListener('keydown', event => {
    const step = {ArrowDown: 1, ArrowUp: -1, PageDown: kRowsAtOnce, PageUp: -kRowsAtOnce, Home: -Infinity, End: Infinity}[event.key];
    if (step === undefined || !options.select) return;
    event.preventDefault();
    choose(shown[Math.max(0, Math.min(shown.length - 1, shown.indexOf(selected) + step))], true);
  });
  addEventListener('beforeprint', () => { printing = true; draw(); });
  addEventListener('afterprint', () => { printing = false; draw(); });

  let filter = null;
  if (rows.length > 8) {
    filter = el('input', {type: 'search', placeholder: 'Filter', 'aria-label': 'Filter ' + label, oninput: () => {
      const words = filter.value.toLowerCase().split(/\s+/);
      shown = rows.filter(row => words.every(word => options.text(row).toLowerCase().includes(word)));
      update();
    }});
  }
  layOut();
  update();
  kLayoutCallbacks.push(fit);
  return {table, filter, choose: row => choose(row, true), first: () => shown[0]};
}
