// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/spheres.h"

#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/scene_parts.h"
#include "sample_assets/shapes/shapes.h"

#include <string>

namespace hearth::samples
{

namespace
{

constexpr uint32_t kRings = 48;

TriangleMesh makeSphere(Float3 center, float radius)
{
    std::vector<Float2> profile;
    for (uint32_t i = 0; i <= kRings; ++i)
    {
        const float angle = kPi * static_cast<float>(i) / kRings;
        profile.push_back({i % kRings == 0 ? 0.0f : sine(angle), cosine(angle)});
    }
    TriangleMesh sphere = makeLathe(profile, 2 * kRings);
    sphere.normals = sphere.positions; // exact ones, of the unit sphere
    return transformed(std::move(sphere), {.translation = center, .scale = {radius, radius, radius}});
}

} // namespace

Document makeSpheres()
{
    constexpr float kRadius = 0.45f;
    Document document;
    const int stone = addPlainMaterial(document, "plinth", {0.46f, 0.44f, 0.41f}, 0.85f);
    addObject(document, "plinth", {{makeBox({0, -0.1f, 0}, {3.1f, 0.1f, 1.7f}, 1), stone}});
    constexpr std::array kRoughnesses{0.1f, 0.3f, 0.5f, 0.75f, 1.0f};
    for (size_t i = 0; i < kRoughnesses.size(); ++i)
        for (const bool is_metal : {false, true})
        {
            const std::string name = (is_metal ? "metal_" : "dielectric_") + std::to_string(i);
            const Float3 color = is_metal ? Float3{0.95f, 0.71f, 0.38f} : Float3{0.13f, 0.31f, 0.52f};
            const int material =
                addPlainMaterial(document, name.c_str(), color, kRoughnesses[i], is_metal ? 1.0f : 0.0f);
            const Float3 center{(static_cast<float>(i) - 2) * 1.14f, kRadius, is_metal ? -0.72f : 0.62f};
            addObject(document, name.c_str(), {{makeSphere(center, kRadius), material}});
        }
    addCamera(document, {.name = "spheres", .y_fov_rad = 0.5f}, {0.9f, 3.4f, 6.3f}, {0, 0.28f, 0});
    return document;
}

} // namespace hearth::samples
