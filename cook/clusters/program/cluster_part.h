// Builds the hierarchies of all meshes of an import part and writes the clusters part, a few meshes in memory
// at a time.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/hierarchy.h"
#include "formats/container/container_reader.h"

#include <functional>
#include <string>
#include <vector>

namespace hearth::clusters
{

/// Return the settings of a mesh of the part by its name. Called on any thread.
using MeshConfigurer = std::function<Config(const std::string& name)>;

/// Mesh with its hierarchy.
struct BuiltMesh
{
    std::string name;
    Config config;
    Hierarchy hierarchy;
    double seconds = 0; ///< wall-clock time of the build
};

/// Observe each mesh in order after it was built, before it is written; an error ends the work.
using MeshObserver = std::function<Status(uint32_t index, const BuiltMesh& mesh)>;

/// Return the number of meshes of an import part.
uint32_t meshCount(const formats::ContainerReader& part);

/// Return the names of its materials, in order. errors: those of PackView.
Result<std::vector<std::string>> materialNames(const formats::ContainerReader& part);

/// Build the hierarchies of all meshes of an import part and write them to `output_path`. Meshes that are
/// authored LODs of others keep their numbers, but have no clusters of their own. Large meshes are built one
/// after the other on all threads, small ones side by side; the result does not depend on it.
///
/// configure, observe   may be empty
/// errors               those of readSourceMesh, meaning_reference if chunk ALOD refers to a missing mesh,
///                      those of ContainerWriter and `observe`; input_too_large if an index would not fit
Status writeClustersPart(const formats::ContainerReader& part, const std::string& output_path,
                         const MeshConfigurer& configure, const MeshObserver& observe);

} // namespace hearth::clusters
