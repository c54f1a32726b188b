// The linker: merges the parts of one or more sources into a pack.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <span>
#include <string>
#include <vector>

namespace hearth::link
{

/// Paths of the parts that the cookers made of one source.
struct SourceParts
{
    std::string import_part;
    std::string clusters_part;
    std::string textures_part;
    std::string skinning_part;
    /// part with proxies of its meshes; empty: those of the import part are taken
    std::string proxy_part{};
};

/// Parts of what a pack has once, for all of its sources.
struct PackParts
{
    /// Parts with a table of specular occlusion. A pack has one table: all parts must have the same. May
    /// be empty
    std::vector<std::string> specular{};
    std::string bricks{}; ///< part whose grid of bricks the pack gets; empty: no bricks
    /// Parts whose light probes the pack gets, in order, behind a source's sky where none has one
    std::vector<std::string> probes{};
    std::string receivers{}; ///< part whose receivers the pack gets; empty: no receivers
};

/// Write the pack of all sources, their scenes side by side: the records of each source follow the
/// previous source's, with rebased indices. One source is the merge of one. Texels and pages are copied
/// as they are stored, a piece at a time; equal images once. Groups of deformed meshes get the spheres of
/// the skinning part.
/// skipped         JSON objects for META, one for each error of a source that the pack lacks
/// texture_budget  bytes that all textures may take on the GPU, for META; 0: no budget The pack is
/// checked as a whole before it appears under `output`; on an error nothing appears.
/// errors: those of reading the parts, of mergeMeta and of tools::findSourceSky; meaning_reference
/// where parts do not belong together, or tables differ; input_too_large where the tables grow past
/// 32-bit indices; cannot_write; those of checkPack.
Status linkPack(std::span<const SourceParts> sources, const std::string& output,
                const PackParts& pack_parts = {}, std::span<const std::string> skipped = {},
                uint64_t texture_budget = 0);

} // namespace hearth::link
