// Makes surfaces of the proxies of a source's meshes, which visibility is sampled and fitted on in place of
// levels. See cook/visibility/README.md, "Proxies".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/scene/level_meshes.h"
#include "cook/visibility/scene/scene_occluders.h"
#include "cook/visibility/scene/source_normals.h"
#include "formats/pack/pack_view.h"

#include <span>
#include <string_view>
#include <vector>

namespace hearth::visibility
{

/// Use of proxies in a bake.
enum class ProxyUse
{
    none,
    fit, ///< samples of a mesh are fitted on its proxy, and its levels take their visibility from there
    all, ///< samples lie on proxies, too, and rays meet proxies in place of their meshes
};

/// Return the word for a use in command lines and statistics.
std::string_view proxyUseName(ProxyUse use);

/// Return the first proxy of a mesh that its visibility can be fitted on, nullptr if there is none. It has no
/// convex parts, and neither of the two has a point that is farther from the other than a twentieth of the
/// diagonal of the mesh's box: the inside of a car that is wrapped as a whole cannot see what its wrap sees.
/// proxies  part or pack with the table of proxies
/// number   of the mesh in it
const formats::ProxyRecord* findFitProxy(const formats::PackView& proxies, const formats::MeshRecord& mesh,
                                         uint32_t number);

/// Surface of a proxy.
struct ProxySurface
{
    /// Without parts, and without links between vertices: each triangle has three of its own. Normals are
    /// those of the mesh near the corners, so that fitting welds corners of smooth surfaces, and keeps hard
    /// edges of the mesh apart.
    LevelArrays arrays;
    std::vector<uint32_t> occluding_corners; ///< of triangles whose material occludes, three for each
    std::vector<uint32_t> colors;            ///< of each of these triangles: encodeSurfaceColor
};

/// Make the surface of a proxy. Each triangle has the material and colour of the mesh near its middle.
///
/// surfaces  of the scene of the mesh
/// proxy     of the table of `proxies`
/// part      clusters part of the mesh
/// normals   of its source
/// errors: those of MeshPages::readLevel and SurfaceColors::find
Result<ProxySurface> makeProxySurface(SceneSurfaces& surfaces, const formats::PackView& proxies,
                                      const formats::ProxyRecord& proxy, const formats::PackView& part,
                                      const SourceNormals& normals);

/// Add a proxy once for each of the transforms. Proxies have no texture coordinates, so none has the holes of
/// a mask.
void addProxy(Occluders& occluders, const ProxySurface& surface, std::span<const Affine3> world_from_mesh);

} // namespace hearth::visibility
