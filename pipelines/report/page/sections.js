// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
// Builds the sections of the page, each from the data alone.

function section(id, title, note, ...content) {
  return el('section', {id, 'aria-labelledby': id + '-title'},
            el('div.head', {}, el('h2', {id: id + '-title'}, title), note ? el('span.note', {}, note) : null), ...content);
}

/** Adds buttons or a filter to the head of a section. */
const withTools = (part, ...tools) => { part.querySelector('.head').append(el('div.tools', {}, ...tools)); return part; };

function totalsSection(data) {
  const totals = data.totals, actions = totals.actions || {};
  const kept = actions.cached || 0, all = Object.values(actions).reduce((sum, n) => sum + n, 0);
  const total = (figure, name, more) => el('div.total', {}, el('b', {}, figure), el('span', {}, name), more ? el('div.faint', {}, more) : null);
  const triangles = data.meshes.reduce((sum, mesh) => sum + mesh.triangles, 0);
  const texels = data.textures.reduce((sum, texture) => sum + texture.memory, 0);
  return el('section.totals', {id: 'totals', 'aria-label': 'Totals'},
    total(count(totals.assets), totals.assets === 1 ? 'asset' : 'assets',
          [totals.cooked && totals.cooked + ' cooked', totals.cached && totals.cached + ' cached', totals.failed && totals.failed + ' failed']
            .filter(Boolean).join(', ')),
    total(seconds(totals.wall_s), 'wall time', seconds(totals.cpu_s) + ' of processors'),
    total(all ? percent(kept / all) : '–', 'cache hits', `${count(kept)} of ${plural(all, 'action')}`),
    total(bytes(totals.bytes_out), 'pack', data.status !== 'failed' ? 'of ' + bytes(totals.bytes_in) + ' of sources' : 'not made'),
    total(count(triangles), 'source triangles', plural(data.meshes.length, 'mesh').replace('meshs', 'meshes')),
    total(count(data.textures.length), data.textures.length === 1 ? 'texture' : 'textures', bytes(texels) + ' on the GPU'),
    total(totals.peak_rss ? bytes(totals.peak_rss) : '–', 'most memory', 'of one cooker'),
    total(count(data.warnings), data.warnings === 1 ? 'warning' : 'warnings', plural(data.dropped, 'part') + ' of sources left out'));
}

function failuresSection(data) {
  if (!data.failures.length) return null;
  return section('failures', plural(data.failures.length, 'failure'), 'the root causes; what only depends on them is listed below each',
    data.failures.map(failure => {
      const explained = data.explain[failure.code];
      const others = failure.not_made || [];
      return el('div.failure', {},
        el('p.what', {}, failure.file || failure.subject, failure.pointer ? el('span.mono', {}, '  ' + failure.pointer) : null),
        el('p', {}, el('b', {}, failure.text), ' ', el('span.badge.bad', {}, failure.code || 'error')),
        failure.hint ? el('p', {}, 'What to do: ' + failure.hint + '.') : null,
        explained ? el('p.faint', {}, `${failure.code}: ${explained.summary}, says `, el('code', {}, 'hearth explain ' + failure.code), `; it came from hearth-${failure.stage}.`)
                  : el('p.faint', {}, 'It came from ' + failure.stage + '.'),
        others.length ? el('details', {open: others.length <= 6}, el('summary', {}, `Not made because of it: ${plural(others.length, 'action')}`),
                           el('ul', {}, others.slice(0, 50).map(other => el('li', {}, `${other.stage} of ${other.subject}`)))) : null);
    }));
}

function imageFigures(views, uris, name) {
  if (!uris || !uris.some(Boolean)) return null;
  const titles = {final: 'as it is drawn', clusters: 'clusters', lod: 'level of detail', ao: 'ambient occlusion'};
  return el('div.images', {}, views.map((view, i) => uris[i]
    ? el('figure', {}, el('img', {src: uris[i], alt: `${name}: ${titles[view] || view}`, loading: 'lazy'}), el('figcaption', {}, titles[view] || view)) : null));
}

function sceneSection(images) {
  if (!images.scene.length) return null;
  const part = section('scene', 'Scene', images.is_sheet ? 'contact sheet: the assets overlap' : 'all of the pack, framed', imageFigures(images.views, images.scene, 'the scene'));
  part.classList.add('scene');
  if (images.is_sheet) part.classList.add('sheet');
  return part;
}

function assetsSection(data, go) {
  const detail = el('div.detail', {'aria-live': 'polite'}, el('p.faint', {}, 'Choose an asset to see what it is made of, what ran for it and why.'));
  const slowest = data.assets.reduce((most, asset) => Math.max(most, asset.seconds), 1e-9);
  const table = makeTable('Assets', data.assets, [
    {name: 'Asset', of: asset => asset.source, show: asset => path(asset.source), width: 'minmax(170px, 2fr)'},
    {name: 'State', of: asset => asset.state, show: asset => state(asset.state), width: '118px'},
    {name: 'Time', number: true, of: asset => asset.seconds, show: asset => asset.seconds ? seconds(asset.seconds) : '–', tip: 'that its cookers ran in this cook'},
    {name: '', of: asset => asset.seconds, tip: 'time beside that of the slowest', show: asset => asset.seconds ? el('span.bar', {style: `width:${100 * asset.seconds / slowest}%`}) : '', width: '70px', drop: 3},
    {name: 'Memory', number: true, of: asset => asset.peak_rss_bytes, show: asset => asset.peak_rss_bytes ? bytes(asset.peak_rss_bytes) : '–', tip: 'the most that one of its cookers took', drop: 1},
    {name: 'Source', number: true, of: asset => asset.bytes_in, show: asset => bytes(asset.bytes_in), drop: 2},
    {name: 'Cooked', number: true, of: asset => asset.bytes, show: asset => bytes(asset.bytes), tip: 'geometry and textures, as they lie in the pack'},
    {name: 'Triangles', number: true, of: asset => asset.triangles, show: asset => count(asset.triangles)},
    {name: 'Warnings', number: true, of: asset => asset.warnings, show: asset => asset.warnings ? el('span.warn', {}, count(asset.warnings)) : '0', width: '72px'},
  ], {select: show, sort: 2, text: asset => asset.source + ' ' + asset.state});

  function list(title, items, most = 40) {
    if (!items.length) return [];
    return [el('h3', {}, title), el('ul', {}, items.slice(0, most).map(item => el('li', {}, item)),
            items.length > most ? el('li.faint', {}, `and ${count(items.length - most)} more`) : null)];
  }

  function show(asset) {
    detail.replaceChildren(...[
      el('h3', {}, asset.source), el('p', {}, state(asset.state)),
      el('dl', {}, asset.sha256 ? [el('dt', {}, 'content'), el('dd.mono', {title: 'SHA-256 of the source: ' + asset.sha256}, asset.sha256.slice(0, 16))] : [],
         asset.key ? [el('dt', {}, 'key'), el('dd.mono', {title: 'of its import in the cache: ' + asset.key}, asset.key.slice(0, 16))] : [],
         el('dt', {}, 'geometry'), el('dd', {}, bytes(asset.sizes.geometry)), el('dt', {}, 'textures'), el('dd', {}, bytes(asset.sizes.textures))),
      ...(asset.meshes.length ? [el('button', {type: 'button', onclick: () => go.mesh(asset.meshes[0])},
          'Show its ' + plural(asset.meshes.length, 'mesh').replace('meshs', 'meshes'))] : []),
      ...list('Why it ran', asset.why),
      el('h3', {}, 'Stages'),
      el('table.plain', {}, el('thead', {}, el('tr', {}, ['stage', 'state', 'time', 'memory', 'bytes'].map(name => el('th', {}, name)))),
         el('tbody', {}, asset.stages.map(stage => el('tr', {}, el('td', {}, stage.stage), el('td', {}, state(stage.state)),
            el('td', {}, stage.seconds ? seconds(stage.seconds) : '–'), el('td', {}, stage.peak ? bytes(stage.peak) : '–'), el('td', {}, bytes(stage.bytes)))))),
      asset.state === 'cached' ? el('p.faint', {}, 'Times are those of the cook that made the results.') : null,
      ...list('Messages', asset.messages.map(messageText)),
      ...list(`Reads ${plural(asset.dep_count, 'file')} more`, asset.deps.map(file => file.missing ? el('span.warn', {}, file.name + ': not there') : `${file.name}, ${bytes(file.bytes)}`)),
      ...list('Left out', asset.dropped)].filter(Boolean));
  }
  const part = section('assets', 'Assets', 'slowest first', el('div.split', {}, table.table, detail));
  return {part: table.filter ? withTools(part, table.filter) : part, choose: table.choose, first: table.first};
}

/** Puts the name first: it identifies an asset where there is no room for the whole path. */
const path = source => el('span', {title: source}, nameOf(source), el('span.faint', {}, '  ' + source.slice(0, source.length - nameOf(source).length)));

const messageText = message => el('span', {}, el('span.' + (message.severity === 'error' ? 'bad' : 'warn'), {}, message.code), ' ',
                                  message.pointer ? el('span.mono', {}, message.pointer + ' ') : null, message.text);

function sizesSection(data, go) {
  const items = [
    ...data.meshes.map(mesh => ({name: mesh.name || 'mesh', asset: mesh.asset, kind: 'geometry', color: 'geometry', bytes: mesh.bytes, open: () => go.mesh(mesh)})),
    ...data.textures.map(texture => ({name: `${texture.material} · ${texture.role || texture.name}`, asset: texture.asset, kind: 'textures', color: 'textures', bytes: texture.bytes, open: () => go.texture(texture)}))];
  const kinds = data.totals.sizes || {};
  for (const [kind, size] of Object.entries(kinds)) {
    const known = items.filter(item => item.kind === kind).reduce((sum, item) => sum + item.bytes, 0);
    if (size > known) items.push({name: kind === 'geometry' ? 'tables of clusters and groups' : kind, kind, color: kind, bytes: size - known});
  }
  const holder = el('div');
  const by = {
    kind: () => Object.keys({geometry: 0, textures: 0, ...kinds}).map(kind => ({name: kind, color: kind, items: items.filter(item => item.kind === kind)})),
    asset: () => {
      const groups = data.assets.map(asset => ({name: asset.source, color: 'other', items: []}));
      const shared = {name: 'shared', color: 'other', items: []};
      for (const item of items) (item.asset ? groups[item.asset.index] : shared).items.push(item);
      return [...groups, shared];
    }};
  const buttons = Object.keys(by).map(key => el('button', {type: 'button', onclick: () => show(key)}, 'by ' + key));
  function show(key) {
    buttons.forEach((button, i) => button.setAttribute('aria-pressed', String(Object.keys(by)[i] === key)));
    holder.replaceChildren(makeTreemap(by[key]().filter(group => group.items.length), 1400, 380));
  }
  if (!items.length) return null;
  show('kind');
  const names = [...new Set(items.map(item => item.kind))];
  return withTools(section('sizes', 'Size', 'bytes as they lie in the pack, compressed', holder,
    el('p.keys', {}, names.map(kind => el('span', {}, el('i', {style: 'background:' + color(kind)}), kind,
       kinds[kind] === undefined ? '' : ' ' + bytes(kinds[kind]))))), ...buttons);
}

function meshesSection(data, images) {
  if (!data.meshes.length) return null;
  const curves = makeCurves(data.meshes, 400, 250);
  const about = el('div');
  const detail = el('div.detail', {'aria-live': 'polite'}, about, el('h3', {}, 'Error over triangles'), curves.image);
  const last = mesh => mesh.levels[mesh.levels.length - 1] || [0, 0, 0, 0, 0, 0, 0];
  const table = makeTable('Meshes', data.meshes, [
    {name: 'Mesh', of: mesh => mesh.name, show: mesh => el('span', {title: mesh.name}, images.meshes[mesh.index] ? '▣ ' : '', mesh.name || '(no name)'), width: 'minmax(130px, 2fr)'},
    {name: 'Asset', of: mesh => mesh.asset.source, show: mesh => nameOf(mesh.asset.source), width: 'minmax(90px, 1fr)'},
    {name: 'Triangles', number: true, of: mesh => mesh.triangles, show: mesh => count(mesh.triangles)},
    {name: 'Levels', number: true, of: mesh => mesh.levels.length, width: '64px', drop: 2},
    {name: 'Clusters', number: true, of: mesh => mesh.clusters, show: mesh => count(mesh.clusters), width: '72px'},
    {name: 'Coarsest', number: true, of: mesh => last(mesh)[1], show: mesh => count(last(mesh)[1]), tip: 'triangles of the coarsest level', drop: 1},
    {name: 'Its error', number: true, of: mesh => last(mesh)[2], show: mesh => metres(last(mesh)[2]), tip: 'the largest of the coarsest level'},
    {name: 'Bytes', number: true, of: mesh => mesh.bytes, show: mesh => bytes(mesh.bytes), tip: 'of its pages, as they lie in the pack'},
    {name: 'a triangle', number: true, of: mesh => mesh.bytes / Math.max(mesh.triangles, 1), show: mesh => mesh.triangles ? (mesh.bytes / mesh.triangles).toFixed(1) + ' B' : '–', tip: 'bytes for each source triangle, all levels together', drop: 3},
  ], {select: show, sort: 7, text: mesh => mesh.name + ' ' + mesh.asset.source});
  function show(mesh) {
    curves.show(mesh);
    about.replaceChildren(...[el('h3', {}, mesh.name || '(no name)'), imageFigures(images.views, images.meshes[mesh.index], mesh.name),
      el('h3', {}, 'Levels'),
      el('table.plain', {}, el('thead', {}, el('tr', {}, ['level', 'clusters', 'triangles', 'error', 'mean', 'normals'].map(name => el('th', {}, name)))),
         el('tbody', {}, mesh.levels.map((level, i) => el('tr', {}, el('td', {}, String(i)), el('td', {}, count(level[0])), el('td', {}, count(level[1])),
            el('td', {}, metres(level[2])), el('td', {}, metres(level[3])), el('td', {}, (level[5] * 180 / Math.PI).toFixed(1) + '°')))))].filter(Boolean));
  }
  const note = Object.keys(images.meshes).length ? '▣ has images' + (images.left_out ? `; ${count(images.left_out)} have none: ${images.why}` : '')
                                                   : images.why ? 'no images: ' + images.why : 'largest first';
  const part = section('meshes', 'Meshes', note, el('div.split', {}, table.table, detail));
  return {part: table.filter ? withTools(part, table.filter) : part, choose: table.choose, first: table.first};
}

/** Formats an error of an encoding in the unit of its role. */
function errorText(role, value) {
  if (value === null || value === undefined) return 'exact';
  return role === 'normal' ? value.toFixed(2) + '°' : role === 'light' ? value.toFixed(3) + ' stops' : value.toFixed(1) + ' dB';
}

/** Part of its target that an error takes: 1 at the target. */
function errorShare(role, value, target) {
  if (value === null || target === null) return 0;
  return role === 'normal' || role === 'light' ? value / target : 10 ** ((target - value) / 20);
}

/** Tells an error beside its target; a format that a rule or a budget names was asked for no error. */
function boundText({role, reason}, value, target) {
  const isAsked = reason === 'target', isMissed = isAsked && errorShare(role, value, target) > 1;
  return `${errorText(role, value)} (${isAsked ? 'target' : 'usual target'} ${errorText(role, target)}${isMissed ? ', missed' : ''})`;
}

/** Tells how many textures miss their target; nothing if all hold it. */
function missedLine(textures) {
  const missed = textures.filter(texture => texture.encoding && !texture.encoding.holds).length;
  return missed ? el('p.warn', {}, `${plural(missed, 'texture')} ${missed === 1 ? 'misses its' : 'miss their'} target in every compressed format: W1309`) : null;
}

const kReasons = {target: 'the fewest bytes that hold the target', rule: 'named by a rule', budget: 'its share of the budget of all textures'};

/** Tells why a texture has its format. */
const reasonText = ({holds, reason}) => holds ? kReasons[reason] : 'the nearest to its target, which no compressed format holds';

/** Shows a thumbnail beside the picture of its error, both parts of the sheet of the asset. */
function texturePictures(texture) {
  const {role, picture, brightest} = texture.encoding, sheet = texture.asset.texture_pictures;
  if (!sheet || !picture.length) return null;
  const [x, y, errorX, width, height] = picture;
  const white = role === 'normal' || role === 'light' ? errorText(role, brightest) : `${digits(255 / 10 ** (brightest / 20))} of 255`;
  const part = (left, caption, what) => el('figure', {},
    svg('svg.crop', {role: 'img', 'aria-label': `${texture.name}: ${what}`, viewBox: `${left} ${y} ${width} ${height}`}, svg('image', {href: sheet})), el('figcaption', {}, caption));
  return el('div.pair', {}, part(x, `${texture.width} × ${texture.height}`, 'thumbnail'),
            part(errorX, brightest === null ? 'no error' : ['error ', el('i.scale'), ` ${white}`], 'error'));
}

/** Tells what the budget of all textures did; nothing without one. */
function budgetLine(share) {
  if (!share) return null;
  const range = `from ${bytes(share.min_bytes)} in the smallest formats to ${bytes(share.max_bytes)} in the best`;
  return el('p' + (share.holds_budget ? '' : '.warn'), {}, `${bytes(share.bytes)} of a budget of ${bytes(share.budget)} on the GPU; ${share.textures} textures take ${range}.`);
}

function texturesSection(data) {
  if (!data.textures.length) return null;
  const decibels = (value, known) => known === false ? '–' : value === null ? 'exact' : value.toFixed(1) + ' dB';
  const share = texture => texture.encoding ? Math.max(errorShare(texture.encoding.role, texture.encoding.error, texture.encoding.target),
    errorShare(texture.encoding.role, texture.encoding.smooth, texture.encoding.targetSmooth)) : -1;
  const targetCell = ({encoding}) => {
    if (!encoding) return '–';
    const text = errorText(encoding.role, encoding.target);
    if (encoding.reason !== 'target') return el('span.faint', {title: 'not asked for: the format is ' + kReasons[encoding.reason]}, text);
    if (encoding.holds) return text;
    const isSmooth = errorShare(encoding.role, encoding.error, encoding.target) <= 1;
    return el('span.warn', {title: isSmooth ? 'smooth areas: ' + boundText(encoding, encoding.smooth, encoding.targetSmooth) : boundText(encoding, encoding.error, encoding.target)}, text + ' ✗');
  };
  const about = el('div');
  const detail = el('div.detail', {'aria-live': 'polite'}, about);
  const table = makeTable('Textures', data.textures, [
    {name: 'Material', of: texture => texture.material, show: texture => el('span', {title: usesText(texture)}, texture.material, texture.placeholder ? el('span.warn', {}, '  placeholder') : null), width: 'minmax(110px, 2fr)'},
    {name: 'Role', of: texture => texture.role, show: texture => el('span', {title: usesText(texture)}, texture.role), width: '142px'},
    {name: 'Image', of: texture => texture.name, show: texture => el('span.faint', {title: texture.name}, texture.name), width: 'minmax(90px, 1fr)', drop: 3},
    {name: 'Asset', of: texture => texture.asset.source, show: texture => el('span', {title: texture.asset.source}, nameOf(texture.asset.source)), width: 'minmax(90px, 1fr)', drop: 2},
    {name: 'Size', number: true, of: texture => texture.width * texture.height, show: texture => `${texture.width} × ${texture.height}`, width: '102px', drop: 7},
    {name: 'Mips', number: true, of: texture => texture.mips, width: '50px', drop: 6},
    {name: 'Format', of: texture => texture.format, show: texture => el('span', {title: texture.encoding ? reasonText(texture.encoding) : ''}, texture.format), width: '124px'},
    {name: 'In the pack', number: true, of: texture => texture.bytes, show: texture => bytes(texture.bytes), width: '88px', drop: 4},
    {name: 'On the GPU', number: true, of: texture => texture.memory, show: texture => bytes(texture.memory), width: '98px'},
    {name: 'Error', number: true, width: '78px', of: share, show: texture => texture.encoding ? el('span' + (texture.encoding.holds ? '' : '.warn'), {}, errorText(texture.encoding.role, texture.encoding.error)) : '–',
     tip: 'of the compressed texture against the uncompressed one, mips 0 to 3: decibels, more is better, or degrees of normals; sorted by the part of its target'},
    {name: 'Target', number: true, width: '92px', of: texture => texture.encoding ? texture.encoding.target : -1, show: targetCell, drop: 1},
    {name: 'Half size', number: true, width: '78px', of: texture => texture.halfKnown ? texture.half ?? Infinity : -1, show: texture => decibels(texture.half, texture.halfKnown), drop: 5,
     tip: 'PSNR of half the size against the source: where it is 45 dB and more, half the size would hardly be seen'},
  ], {select: show, sort: 8, text: texture => usesText(texture) + ' ' + texture.name + ' ' + texture.asset.source + ' ' + texture.format + ' ' + texture.content + (texture.encoding && !texture.encoding.holds ? ' missed' : '')});
  function show(texture) {
    const encoding = texture.encoding;
    if (!encoding) {
      about.replaceChildren(el('h3', {}, texture.name || '(no name)'), el('p.faint', {}, `${texture.format}, as it was made: nothing was encoded.`));
      return;
    }
    const isMissed = (value, target) => target !== null && errorShare(encoding.role, value, target) > 1;
    const value = (number, target) => el('td' + (isMissed(number, target) ? '.warn' : ''), {}, errorText(encoding.role, number));
    const hasSmooth = encoding.targetSmooth !== null && [encoding.smooth, ...encoding.candidates.map(candidate => candidate[3])].some(smooth => smooth !== null);
    const row = (name, size, error, smooth, mark) => el('tr' + mark, {}, el('td', {}, name), el('td', {}, bytes(size)), value(error, encoding.target), hasSmooth ? value(smooth, encoding.targetSmooth) : null);
    const others = encoding.candidates.filter(candidate => candidate[0] !== texture.format);
    about.replaceChildren(...[el('h3', {}, texture.name || '(no name)'), texturePictures(texture),
      el('dl', {}, ...[['format', `${texture.format}: ${reasonText(encoding)}`], ['error', boundText(encoding, encoding.error, encoding.target)],
        ['99.9 % of texels', errorText(encoding.role, encoding.p999)], hasSmooth ? ['smooth areas', boundText(encoding, encoding.smooth, encoding.targetSmooth)] : null]
        .filter(Boolean).flatMap(([name, text]) => [el('dt', {}, name), el('dd', {}, text)])),
      el('h3', {}, 'Bytes over error'), makeRates(texture, 400, 210),
      el('table.plain', {}, el('thead', {}, el('tr', {}, ['format', 'on the GPU', 'error', hasSmooth ? 'smooth' : null].filter(Boolean).map(name => el('th', {}, name)))),
         el('tbody', {}, row(texture.format, texture.memory, encoding.error, encoding.smooth, '.chosen'), others.map(candidate => row(...candidate, '')))),
      el('p.faint', {}, others.length ? 'The search estimated the others from some of their blocks.' : 'The search looked at no other format.')].filter(Boolean));
  }
  const part = section('textures', 'Textures', 'errors against the uncompressed texture; more decibels, or fewer degrees, are better', budgetLine(data.texture_budget), missedLine(data.textures), el('div.split', {}, table.table, detail));
  return {part: table.filter ? withTools(part, table.filter) : part, choose: table.choose, first: table.first};
}

const kWithoutReceivers = {animated: 'moved by clips', deformed: 'deformed', unlit: 'unlit', transparent: 'surfaces with holes alone', no_uvs: 'without UVs',
                           flat_uvs: 'UVs without an area', uvs_outside: 'UVs outside 0 to 1', overlapping_uvs: 'UVs that overlap'};

/** Lists the proxies of meshes; nothing in packs without them. */
function proxiesSection(data) {
  if (!data.proxies.length) return null;
  const table = makeTable('Proxies', data.proxies, [
    {name: 'Mesh', of: proxy => proxy.name, show: proxy => el('span', {title: proxy.name}, proxy.name || '(no name)'), width: 'minmax(130px, 2fr)'},
    {name: 'Asset', of: proxy => proxy.asset.source, show: proxy => nameOf(proxy.asset.source), width: 'minmax(90px, 1fr)'},
    {name: 'Origin', of: proxy => proxy.origin, show: proxy => proxy.origin, width: '92px'},
    {name: 'Triangles', number: true, of: proxy => proxy.triangles, show: proxy => count(proxy.triangles)},
    {name: 'Surface', of: proxy => proxy.closed ? 'closed' : 'open', show: proxy => proxy.closed ? 'closed' : 'open', width: '72px'},
    {name: 'Distance', number: true, of: proxy => proxy.distance, show: proxy => metres(proxy.distance), tip: 'no point of the mesh or of its proxy is farther from the other'},
    {name: 'Bytes', number: true, of: proxy => proxy.bytes, show: proxy => bytes(proxy.bytes), tip: 'before compression'},
  ], {sort: 6, text: proxy => proxy.name + ' ' + proxy.asset.source});
  const part = section('proxies', 'Proxies', 'simple meshes that stand for others', table.table);
  return table.filter ? withTools(part, table.filter) : part;
}
/** Tells what baked light takes, and which instances have none of it; nothing where the cook made no receivers. */
function receiversSection(data) {
  const atlas = data.receivers;
  if (!atlas) return null;
  const texels = [['atlas', `${atlas.width} × ${atlas.height}, ${atlas.texels} texels at ${atlas.texels_per_metre} a metre, ${atlas.codec}`], ['lamps', `${atlas.lamps}, of which a texel keeps ${atlas.colors_per_texel.toFixed(1)}`],
     ['bytes', `${bytes(atlas.bytes)}, ${atlas.bytes_per_texel.toFixed(1)} a texel`], ['largest share dropped', `${(100 * atlas.largest_dropped).toFixed(2)} % of a texel's light`], ['texels without a lamp of 2 %', String(atlas.dropping_texels)], ['instances', String(atlas.instances)]];
  const faces = atlas.faces.count && [['faces of bricks', `${atlas.faces.count}, of whose lamps one keeps ${atlas.faces.colors_per_face.toFixed(1)}, ${bytes(atlas.faces.bytes)}`]];
  const figures = atlas.none ? [['none', atlas.none]] : [...(atlas.texels ? texels : []), ...(faces || [])];
  const without = Object.entries(atlas.left_out).filter(([, count]) => count > 0).map(([reason, count]) => ['without', `${plural(count, 'instance')}: ${kWithoutReceivers[reason] || reason}`]);
  return section('receivers', 'Receivers', 'baked light of lamps that keep their weights',
    el('dl', {}, ...[...figures, ...without].flatMap(([name, text]) => [el('dt', {}, name), el('dd', {}, text)])));
}

/** Shows what probes see and the light that receivers have; nothing in packs without both. */
function lightSection(images) {
  const light = images.light || [];
  if (!light.length) return null;
  return section('light', 'Baked light', 'faces of a probe are +X, -X, +Y, -Y, +Z, -Z; each row of them is a rougher reflection', el('div.light', {}, light.map(item =>
    el('figure', {}, el('img', {src: item.picture, alt: item.name, loading: 'lazy'}),
       el('figcaption', {}, el('b', {}, item.name), item.facts.map(([name, value]) => ` · ${name} ${value}`).join(''))))));
}

/** Lists all uses of an image, one a line. */
const usesText = texture => texture.uses.map(([material, role]) => `${material || '(no name)'} · ${role}`).join('\n');

/** Shows the time of each cooker, and the settings that make it cheaper. */
function slowSection(data, go) {
  const rows = new Map();
  const add = (stage, asset) => {
    if (stage.start === null) return;
    const row = rows.get(stage.stage) || {cooker: stage.stage, runs: 0, seconds: 0, peak: 0, slowest: null, asset: null};
    rows.set(stage.stage, row);
    row.runs += 1;
    row.seconds += stage.seconds;
    row.peak = Math.max(row.peak, stage.peak);
    if (asset && (!row.slowest || stage.seconds > row.slowest.seconds)) { row.slowest = stage; row.asset = asset; }
  };
  for (const asset of data.assets) for (const stage of asset.stages) add(stage, asset);
  for (const stage of data.stages) add(stage, null);
  if (!rows.size) return null;
  const sorted = [...rows.values()].sort((a, b) => b.seconds - a.seconds);
  const all = sorted.reduce((sum, row) => sum + row.seconds, 0) || 1;
  const saving = ([key, option, advice]) => el('li', {}, el('code', {title: option ? 'hearth cook ' + option : 'hearth cook --set ' + key + '=…'}, key), ': ' + advice);
  const savings = row => data.savings[row.cooker] ? el('ul', {}, data.savings[row.cooker].map(saving)) : el('span.faint', {}, 'no setting');
  const slowest = row => row.asset ? [el('button.link', {type: 'button', title: row.asset.source, onclick: () => go.asset(row.asset)}, nameOf(row.asset.source)), ' ' + seconds(row.slowest.seconds)] : ['–'];
  const table = el('table.plain.slow', {},
    el('thead', {}, el('tr', {}, ['Cooker', 'Runs', 'Time', 'Share', 'Memory', 'Slowest asset', 'Cheaper with'].map(name => el('th', {}, name)))),
    el('tbody', {}, sorted.map(row => el('tr', {}, el('td', {}, row.cooker), el('td', {}, count(row.runs)), el('td', {}, seconds(row.seconds)),
       el('td', {}, percent(row.seconds / all)), el('td', {}, row.peak ? bytes(row.peak) : '–'), el('td', {}, ...slowest(row)), el('td', {}, savings(row))))));
  return section('slow', 'What was slow', 'time of the cookers that ran, and the settings that make each cheaper', el('div.wide', {}, table));
}

function timelineSection(data, go) {
  const bars = [];
  const add = (stage, subject, open) => {
    if (stage.start !== null) bars.push({...stage, subject, open, failed: stage.state === 'failed'});
  };
  for (const asset of data.assets) for (const stage of asset.stages) add(stage, asset.source, () => go.asset(asset));
  for (const stage of data.stages) add(stage, data.output);
  if (!bars.length) return {part: section('timeline', 'Timeline', '', el('p.empty', {}, 'Nothing ran: all results were in the cache.')), draw() {}};
  const line = makeTimeline(bars, data.totals.wall_s);
  const names = [...new Set(bars.map(bar => bar.stage))];
  const busy = bars.reduce((sum, bar) => sum + bar.seconds, 0);
  const part = section('timeline', 'Timeline', `${plural(bars.length, 'action')} ran, ${seconds(busy)} in all`, line.canvas,
    el('p.keys', {}, names.map(name => el('span', {}, el('i', {style: 'background:' + color(kStageColors[name] || 'other')}),
       `${name} ${seconds(bars.filter(bar => bar.stage === name).reduce((sum, bar) => sum + bar.seconds, 0))}`))));
  return {part, draw: line.draw};
}

/** Lists the causes for which actions ran, with the number of actions of each. */
function causesSection(data) {
  const counts = new Map();
  const stages = [...data.assets.flatMap(asset => asset.stages), ...data.stages];
  for (const stage of stages) for (const cause of stage.why) counts.set(cause, (counts.get(cause) || 0) + 1);
  const rows = [...counts].map(([cause, actions]) => ({cause, actions}));
  const table = makeTable('Causes', rows, [
    {name: 'Cause', of: row => row.cause, show: row => el('span', {title: row.cause}, row.cause), width: 'minmax(200px, 1fr)'},
    {name: 'Actions', number: true, of: row => row.actions, width: '90px'},
  ], {sort: 1, text: row => row.cause});
  const hits = stages.filter(stage => stage.state === 'cached').length;
  const part = section('causes', 'Cache', `${count(hits)} of ${plural(stages.length, 'action')} had a result; why the others ran`, table.table);
  return table.filter ? withTools(part, table.filter) : part;
}

function messagesSection(data, go) {
  const rows = data.assets.flatMap(asset => [
    ...asset.messages.map(message => ({asset, code: message.code, severity: message.severity, pointer: message.pointer || '', text: message.text, hint: message.hint || ''}))]);
  const known = new Set(rows.map(row => row.text));
  for (const asset of data.assets) for (const text of asset.dropped)
    if (!known.has(text)) rows.push({asset, code: '', severity: 'dropped', pointer: '', text, hint: ''});
  const table = makeTable('Messages', rows, [
    {name: 'Code', of: row => row.code, show: row => el('span.' + (row.severity === 'error' ? 'bad' : 'warn'), {title: (data.explain[row.code] || {}).summary}, row.code || 'left out'), width: '64px'},
    {name: 'Asset', of: row => row.asset.source, show: row => nameOf(row.asset.source), width: 'minmax(90px, 150px)'},
    {name: 'Where', of: row => row.pointer, show: row => el('span.mono', {title: row.pointer}, row.pointer), width: 'minmax(80px, 200px)'},
    {name: 'What', of: row => row.text, show: row => el('span', {title: row.text + (row.hint ? '\nWhat to do: ' + row.hint : '')}, row.text), width: 'minmax(200px, 2fr)'},
  ], {select: row => go.asset(row.asset, true), sort: 0, down: false, text: row => `${row.code} ${row.asset.source} ${row.pointer} ${row.text}`});
  const part = section('messages', 'Messages and what was left out', 'what a source has and the pack has not', table.table);
  return table.filter ? withTools(part, table.filter) : part;
}
