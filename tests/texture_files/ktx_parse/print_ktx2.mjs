// Prints what ktx-parse reads in KTX2 files, a line of JSON each, and writes the bytes of all levels of NAME, finest
// first, to NAME.levels.
//   node print_ktx2.mjs KTX_PARSE_MODULE FILE...
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
import { readFileSync, writeFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

const [module, ...files] = process.argv.slice(2);
const { read } = await import(pathToFileURL(module));
for (const file of files) {
  const texture = read(readFileSync(file));
  const [descriptor] = texture.dataFormatDescriptor;
  writeFileSync(`${file}.levels`, Buffer.concat(texture.levels.map((level) => level.levelData)));
  console.log(JSON.stringify({
    vkFormat: texture.vkFormat,
    typeSize: texture.typeSize,
    size: [texture.pixelWidth, texture.pixelHeight, texture.pixelDepth, texture.layerCount, texture.faceCount],
    scheme: texture.supercompressionScheme,
    levels: texture.levels.map((level) => level.uncompressedByteLength),
    model: descriptor.colorModel,
    primaries: descriptor.colorPrimaries,
    transfer: descriptor.transferFunction,
    flags: descriptor.flags,
    block: descriptor.texelBlockDimension,
    bytes: descriptor.bytesPlane,
    samples: descriptor.samples.map((sample) =>
      [sample.bitOffset, sample.bitLength, sample.channelType, sample.sampleLower, sample.sampleUpper]),
    keys: texture.keyValue,
  }));
}
