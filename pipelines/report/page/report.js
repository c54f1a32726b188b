// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
// Reads the data embedded in the page, and builds the page.

const named = (row, names) => Object.fromEntries(names.map((name, i) => [name, row[i]]));
const kStage = ['stage', 'state', 'seconds', 'bytes', 'start', 'lane', 'cpu', 'peak', 'why'];
const kMesh = ['name', 'asset', 'triangles', 'vertices', 'bytes', 'clusters', 'pages', 'levels'];
const kProxy = ['name', 'asset', 'origin', 'triangles', 'closed', 'distance', 'bytes'];
const kTexture = ['name', 'asset', 'width', 'height', 'mips', 'format', 'content', 'bytes', 'memory', 'half', 'halfKnown', 'placeholder', 'encoding', 'uses'];
const kEncoding = ['role', 'error', 'p999', 'smooth', 'target', 'targetSmooth', 'holds', 'reason', 'picture', 'brightest', 'candidates'];

function readData() {
  const data = JSON.parse($('data').textContent);
  data.stages = data.stages.map(row => named(row, kStage));
  data.failures ||= [];
  data.assets.forEach((asset, index) => {
    asset.index = index;
    asset.stages = asset.stages.map(row => named(row, kStage));
    asset.sizes ||= {geometry: 0, textures: 0};
    asset.bytes = asset.sizes.geometry + asset.sizes.textures;
    for (const key of ['why', 'messages', 'dropped', 'deps']) asset[key] ||= [];
    asset.warnings = asset.messages.filter(message => message.severity === 'warning').length;
    asset.meshes = [];
    asset.triangles = 0;
  });
  data.meshes = data.meshes.map((row, index) => {
    const mesh = {...named(row, kMesh), index};
    mesh.asset = data.assets[mesh.asset];
    mesh.asset.meshes.push(mesh);
    mesh.asset.triangles += mesh.triangles;
    return mesh;
  });
  data.proxies = data.proxies.map(row => {
    const proxy = named(row, kProxy);
    return {...proxy, asset: data.assets[proxy.asset]};
  });
  data.textures = data.textures.map(row => {
    const texture = named(row, kTexture);
    texture.asset = data.assets[texture.asset];
    texture.encoding = texture.encoding && named(texture.encoding, kEncoding);
    const more = texture.uses.length > 1 ? ` +${texture.uses.length - 1}` : '';
    texture.material = texture.uses.length ? texture.uses[0][0] || '(no name)' : '(none)';
    texture.role = texture.uses.length ? texture.uses[0][1] + more : '';
    return texture;
  });
  data.warnings = data.assets.reduce((sum, asset) => sum + asset.warnings, 0);
  data.dropped = data.assets.reduce((sum, asset) => sum + asset.dropped.length, 0);
  return data;
}

function themeButton(redraw) {
  const dark = () => (document.documentElement.dataset.theme || (matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light')) === 'dark';
  const button = el('button', {type: 'button', onclick: () => {
    document.documentElement.dataset.theme = dark() ? 'light' : 'dark';
    label();
    redraw();
  }});
  const label = () => { button.textContent = dark() ? 'Light' : 'Dark'; };
  label();
  return button;
}

/** True if a table shows all of its columns without clipping figures. */
const fits = table => table.scrollWidth <= table.clientWidth && [...table.querySelectorAll('.num')].every(cell => cell.scrollWidth <= cell.clientWidth);

function showPage() {
  const data = readData();
  const images = JSON.parse($('images').textContent);
  const into = (id, choose, item) => { $(id).scrollIntoView({block: 'start'}); choose(item); };
  const go = {
    asset: asset => into('assets', assets.choose, asset),
    mesh: mesh => into('meshes', meshes.choose, mesh),
    texture: texture => into('textures', textures.choose, texture),
  };
  const assets = assetsSection(data, go);
  const meshes = meshesSection(data, images);
  const textures = texturesSection(data);
  const slow = slowSection(data, go);
  const timeline = timelineSection(data, go);
  const parts = [failuresSection(data), totalsSection(data), sceneSection(images), assets.part, sizesSection(data, go), meshes && meshes.part, proxiesSection(data), textures && textures.part,
                 receiversSection(data), lightSection(images), slow, timeline.part, causesSection(data), messagesSection(data, go)].filter(Boolean);
  $('main').replaceChildren(...parts);

  const ok = data.status === 'ok';
  const when = data.started ? new Date(data.started).toLocaleString() : '';
  document.title = `${ok ? '' : '✗ '}${nameOf(data.output)} – hearth cook`;
  $('top').append(el('h1', {title: data.output}, nameOf(data.output)),
    el('span.badge.' + (ok ? 'good' : 'bad'), {}, ok ? (data.up_to_date ? 'up to date' : 'cooked') : data.status === 'incomplete' ? `without ${plural(data.skipped.length, 'source')}` : `failed, exit code ${data.exit}`),
    el('span.faint', {}, [when, `hearth ${data.tool.version}`].filter(Boolean).join(' · ')),
    el('nav', {'aria-label': 'Sections'}, parts.filter(part => part.id !== 'totals').map(part =>
       el('a', {href: '#' + part.id}, part.querySelector('h2').textContent.split(' and ')[0])), themeButton(timeline.draw)));
  kLayoutCallbacks.forEach(fit => fit());
  timeline.draw();
  // preselect a mesh and an asset, so that there is something to see
  if (meshes) meshes.choose(meshes.first());
  if (textures) textures.choose(textures.first());
  if (data.assets.length) assets.choose(assets.first());
  document.documentElement.dataset.ready = Math.round(performance.now());
  document.documentElement.dataset.cut = [...document.querySelectorAll('.table')].filter(table => !fits(table)).length;
  document.documentElement.dataset.requests = performance.getEntriesByType('resource').filter(entry => !entry.name.startsWith('data:')).length;
}

showPage();
