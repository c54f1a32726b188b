// Packs with one defect and correct hashes, each with the issue that the semantic checker must report.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/issues.h"
#include "tests/support/small_pack.h"

#include <ostream>
#include <string>
#include <vector>

namespace hearth::test
{

struct MalformedPack
{
    std::string name; ///< the defect, as an identifier
    Issue issue;
    std::string where; ///< location of the error
    void (*spoil)(PackModel&);
    /// True if geometry was changed: encode the pages again.
    bool reseal = false;
};

/// Print for GoogleTest.
inline void PrintTo(const MalformedPack& pack, std::ostream* out)
{
    *out << pack.name;
}

/// Invalid records of the scene: nodes, instances, cameras, lights, materials, images, skins, animations,
/// texts.
const std::vector<MalformedPack>& malformedScenes();

/// Invalid meshes, levels, groups, clusters, pages and geometry.
const std::vector<MalformedPack>& malformedHierarchies();

/// Invalid bounds of deformed meshes.
const std::vector<MalformedPack>& malformedDeformations();

/// Invalid provenance records.
const std::vector<MalformedPack>& malformedProvenance();

/// Invalid tables of specular occlusion.
const std::vector<MalformedPack>& malformedSpecularTables();

/// Invalid light probes.
const std::vector<MalformedPack>& malformedProbes();

/// Invalid receivers.
const std::vector<MalformedPack>& malformedReceivers();

/// Invalid surroundings of instances.
const std::vector<MalformedPack>& malformedProxies();
const std::vector<MalformedPack>& malformedSurroundings();

/// Invalid grids of bricks.
const std::vector<MalformedPack>& malformedBricks();

} // namespace hearth::test
