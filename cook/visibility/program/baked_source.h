// Source whose visibility is baked: its meshes, how each is sampled, its instances, and what occludes them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/program/instance_samples.h"
#include "cook/visibility/program/sampling_plan.h"
#include "cook/visibility/rays/sampled_moments.h"
#include "cook/visibility/scene/level_meshes.h"
#include "cook/visibility/scene/proxy_surfaces.h"
#include "cook/visibility/scene/scene_occluders.h"
#include "formats/pack/pack_view.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hearth::visibility
{

/// Parts of a source, as files.
struct PartPaths
{
    std::string import_part;
    std::string clusters_part;
};

/// Return whether the vertices of a mesh get visibility: they have room for it, and some of its surface is
/// lit.
/// scene, part  of one source
bool isBaked(const formats::PackView& scene, const formats::PackView& part, uint32_t mesh);

/// Proxies of a source's meshes that are used.
struct MeshProxies
{
    ProxyUse use = ProxyUse::none;
    std::vector<std::optional<ProxySurface>> surfaces{}; ///< of each mesh of the source; empty: none is used
};

/// Make the surfaces of the proxies of all meshes that are baked and have a proxy to be fitted on.
/// scene, part  of one source
/// proxies      part with the table of its proxies
/// errors: those of checkProxies, SourceNormals::read and makeProxySurface; meaning_reference for a proxy of
/// a mesh that the source does not have
Result<MeshProxies> makeMeshProxies(const formats::PackView& scene, const formats::PackView& part,
                                    const formats::PackView& proxies, ProxyUse use);

struct BakedSource
{
    const formats::PackView& scene;  ///< import part
    const formats::PackView& part;   ///< clusters part; may have copies of meshes
    std::vector<MeshSampling> plan;  ///< of each mesh of the part
    std::vector<uint32_t> originals; ///< mesh of the source that each mesh of the part is, or copies
    /// Instances of each mesh; without those that are flat in the world.
    std::vector<std::vector<MeshInstance>> instances;
    const MeshProxies* proxies; ///< null: none is used

    /// Return the proxy that a mesh is fitted on, null if it is not fitted on one.
    const ProxySurface* findProxy(uint32_t mesh) const;

    /// Return the proxy that the samples of a mesh lie on, and that occludes in its place; null for none, as
    /// for deformed meshes, which occlude themselves in their poses.
    const ProxySurface* findSampledProxy(uint32_t mesh) const;

    /// scene, part      must outlive this
    /// instance_meshes  mesh of the part that each instance draws
    /// weights          of planSampling
    /// proxies          null: none is used; must outlive this
    static BakedSource make(const formats::PackView& scene, const formats::PackView& part,
                            std::span<const uint32_t> instance_meshes, const SamplingSettings& settings,
                            std::span<const double> weights = {}, const MeshProxies* proxies = nullptr);

    /// Collect the occluders of the scene: levels or proxies, as they are sampled, so that no sample is
    /// inside its own mesh. Deformed meshes occlude only themselves.
    /// errors: those of MeshPages::read and addMesh
    Status addOccluders(SceneSurfaces& surfaces, Occluders& world) const;

    /// Add the occluders of other sources.
    /// distance  of the farthest occluder that counts
    /// errors: those of openPart, checkHierarchy and addNeighbour
    Status addNeighbours(std::span<const PartPaths> neighbours, const SamplingSettings& settings,
                         float distance, Occluders& world) const;
};

/// Choose a power of two of a mesh's instances, so that they can share each sample's rays evenly.
std::vector<Placement> placeInstances(const Occluders& world, std::span<const MeshInstance> instances,
                                      uint32_t rays_per_sample);

/// Create samples on a level of a mesh.
std::vector<SurfaceSample> createSamples(const LevelArrays& level, double samples_per_vertex,
                                         const FitMeshSettings& fit_mesh);

/// Return `count` points evenly over the area of a level, or fewer of a level without area.
std::vector<SurfaceSample> choosePoints(const LevelArrays& level, const FitMeshSettings& fit_mesh,
                                        size_t count);

/// Return the area of a level's triangles.
double computeArea(const LevelArrays& level);

} // namespace hearth::visibility
