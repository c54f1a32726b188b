// Packs with one thing wrong and all hashes right: what the meaning checker must refuse, and as which issue.
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
    std::string name; ///< what is wrong, as an identifier
    Issue issue;
    std::string where; ///< of the error
    void (*spoil)(PackModel&);
    /// Geometry was changed: encode the pages again.
    bool reseal = false;
};

/// How GoogleTest prints it.
inline void PrintTo(const MalformedPack& pack, std::ostream* out)
{
    *out << pack.name;
}

/// Wrong records of the scene: nodes, instances, cameras, lights, materials, images, skins, animations, texts.
const std::vector<MalformedPack>& malformedScenes();

/// Wrong meshes, levels, groups, clusters, pages and geometry.
const std::vector<MalformedPack>& malformedHierarchies();

/// Wrong bounds of deformed meshes.
const std::vector<MalformedPack>& malformedDeformations();

/// Wrong records of where things come from.
const std::vector<MalformedPack>& malformedProvenance();

/// Wrong tables of specular occlusion.
const std::vector<MalformedPack>& malformedSpecularTables();

/// Wrong grids of bricks.
const std::vector<MalformedPack>& malformedBricks();

} // namespace hearth::test
