// Lists the surfaces and lights that a bake of receivers reads.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/receivers/bake/surface.h"
#include "formats/gpu_shared/record_values.h"
#include "formats/gpu_shared/shading.h"
#include "formats/gpu_shared/sky.h"

#include <optional>
#include <vector>

namespace hearth::receivers
{

/// Lamp or sun.
struct Lamp
{
    shared::Light light{}; ///< in world space; shadows and reflectors are not read
    /// Metres; of a sun: the tangent of half the angle that it covers. 0: sharp shadows.
    float radius = 0;
};

/// Triangles that shine and are switched together, as those of one instance.
struct MeshLight
{
    std::vector<uint32_t> triangles; ///< indices in BakeScene::triangles
    std::vector<Float3> radiance;    ///< of each of them, after exposure, linear Rec.709
};

/// Scene of a bake. Its lights count the lamps first, then the mesh lights, then the sky if there is one.
struct BakeScene
{
    std::vector<Triangle> triangles; ///< sorted by instance
    uint32_t instance_count = 0;     ///< above each Triangle::instance
    std::vector<Lamp> lamps;
    std::vector<MeshLight> mesh_lights;
    std::optional<shared::Sky> sky; ///< seen where rays meet no triangle, from below, too

    size_t lightCount() const { return lamps.size() + mesh_lights.size() + (sky ? 1 : 0); }
    bool isSky(size_t light) const { return sky && light + 1 == lightCount(); }
    bool isSun(size_t light) const
    {
        return light < lamps.size() && lamps[light].light.type == shared::kLightDirectional;
    }
};

} // namespace hearth::receivers
