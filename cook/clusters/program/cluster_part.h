// From an import part to a clusters part: the hierarchy of every mesh, a few in memory at a time.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/hierarchy.h"
#include "formats/container/container_reader.h"

#include <functional>
#include <string>
#include <vector>

namespace hearth::clusters
{

/// How a mesh of the part is built, by its name. Called on any thread.
using MeshConfigurer = std::function<Config(const std::string& name)>;

struct BuiltMesh
{
    std::string name;
    Config config;
    Hierarchy hierarchy;
    double seconds = 0; ///< that building took, of the wall clock
};

/// Sees each mesh in order when it has been built, before it is written; an error ends the work.
using MeshObserver = std::function<Status(uint32_t index, const BuiltMesh& mesh)>;

/// The meshes that an import part has.
uint32_t meshCount(const formats::ContainerReader& part);

/// The names of its materials, in their order. errors: those of PackView.
Result<std::vector<std::string>> materialNames(const formats::ContainerReader& part);

/// Build the hierarchies of all meshes of an import part and write them to `output_path`. Meshes that are authored levels
/// of others keep their numbers, but have no clusters of their own. Large meshes are built one after the other on all
/// threads, small ones side by side; the result does not depend on it.
///
/// configure, observe   may be empty
/// errors               those of readSourceMesh, meaning_reference where chunk ALOD names no mesh, those of
///                      ContainerWriter and `observe`; input_too_large where an index would not fit
Status writeClustersPart(const formats::ContainerReader& part, const std::string& output_path,
                         const MeshConfigurer& configure, const MeshObserver& observe);

} // namespace hearth::clusters
