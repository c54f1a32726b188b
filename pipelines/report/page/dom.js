// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
// Creates DOM elements, and formats figures with their units.

/** Creates an element, as el('td.num', {title: 't'}, 'text', child, ...). Names become text, never markup. */
function el(name, attributes, ...children) {
  const [tag, ...classes] = name.split('.');
  return fill(document.createElement(tag), classes, attributes, children);
}

function svg(name, attributes, ...children) {
  const [tag, ...classes] = name.split('.');
  return fill(document.createElementNS('http://www.w3.org/2000/svg', tag), classes, attributes, children);
}

function fill(element, classes, attributes, children) {
  if (classes.length) element.setAttribute('class', classes.join(' '));
  for (const [key, value] of Object.entries(attributes || {}))
    if (key.startsWith('on')) element.addEventListener(key.slice(2), value);
    else if (value !== undefined && value !== null && value !== false) element.setAttribute(key, value);
  element.append(...children.flat().filter(child => child !== null && child !== undefined));
  return element;
}

const $ = id => document.getElementById(id);

/** Formats any number with three digits. */
function digits(value) {
  if (value === 0) return '0';
  const size = Math.abs(value);
  return size >= 1e4 || size < 1e-3 ? value.toExponential(1) : size >= 100 ? value.toFixed(0) : String(+value.toPrecision(3));
}

function count(value) {
  if (value < 10000) return String(value);
  for (const [unit, size] of [['G', 1e9], ['M', 1e6], ['k', 1e3]])
    if (value >= size) return +(value / size).toPrecision(3) + ' ' + unit;
}

function bytes(value) {
  for (const [unit, size] of [['GiB', 2 ** 30], ['MiB', 2 ** 20], ['KiB', 2 ** 10]])
    if (value >= size) return (value / size).toFixed(value / size < 10 ? 2 : value / size < 100 ? 1 : 0) + ' ' + unit;
  return value + ' B';
}

function seconds(value) {
  if (value >= 3600) return Math.floor(value / 3600) + ' h ' + Math.floor(value / 60 % 60) + ' min';
  if (value >= 60) return Math.floor(value / 60) + ' min ' + Math.floor(value % 60) + ' s';
  return value >= 1 ? value.toFixed(value < 10 ? 2 : 1) + ' s' : Math.round(value * 1000) + ' ms';
}

function metres(value) {
  for (const [unit, size] of [['km', 1e3], ['m', 1], ['mm', 1e-3], ['µm', 1e-6]])
    if (value >= size) return +(value / size).toPrecision(3) + ' ' + unit;
  return value === 0 ? '0' : digits(value) + ' m';
}

const percent = share => (100 * share).toFixed(share < 0.1 && share > 0 ? 1 : 0) + ' %';
const plural = (number, noun) => count(number) + ' ' + noun + (number === 1 ? '' : 's');
const nameOf = path => path.slice(path.lastIndexOf('/') + 1);
const color = name => `var(--${name})`;

/** Creates a label for a state, with colour and text: never colour alone. */
const kStateClasses = {cooked: 'good', cached: 'faint', failed: 'bad', 'dependency failed': 'warn', 'not cooked': 'faint'};
const state = name => el('span.' + (kStateClasses[name] || 'faint'), {}, name);

/** Shows `text` beside the pointer while it is over an element. */
function tip(element, text) {
  element.addEventListener('pointermove', event => {
    const words = typeof text === 'function' ? text(event) : text;
    const box = $('tip');
    box.hidden = !words;
    if (!words) return;
    box.textContent = words;
    box.style.left = Math.min(event.clientX + 14, innerWidth - box.offsetWidth - 8) + 'px';
    box.style.top = Math.min(event.clientY + 14, innerHeight - box.offsetHeight - 8) + 'px';
  });
  element.addEventListener('pointerleave', () => { $('tip').hidden = true; });
  return element;
}
