// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/sky.h"

#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/shapes.h"

namespace hearth::samples
{

Float3 skyDirection(Float2 uv)
{
    const float azimuth = uv.x * 2 * kPi, elevation = (1 - uv.y) * 0.5f * kPi;
    return {cosine(elevation) * cosine(azimuth), sine(elevation), -cosine(elevation) * sine(azimuth)};
}

void addSky(Document& document, const std::string& name, float radius, const ColorFunction& color_function)
{
    TriangleMesh dome = makeGrid(96, 32,
                                 [&](Float2 uv, Float3& position, Float2& texture_uv)
                                 {
                                     // rows run from the horizon to the zenith and reach a little below
                                     const Float2 image_uv{uv.x == 1.0f ? 0.0f : uv.x, 1.06f - 1.06f * uv.y};
                                     position = skyDirection(image_uv) * radius;
                                     texture_uv = {uv.x, std::min(image_uv.y, 0.998f)};
                                 });
    for (size_t i = 0; i < dome.indices.size(); i += 3)
        std::swap(dome.indices[i + 1], dome.indices[i + 2]);
    setSmoothNormals(dome);
    Material material;
    material.name = name;
    material.unlit = true;
    material.base_color_image = add(document.images, paintColor(name, 2048, 512, color_function));
    Node node;
    node.name = "sky";
    node.mesh = add(document.meshes, Mesh{"sky", {{std::move(dome), add(document.materials, material)}}});
    addRoot(document, node);
}

} // namespace hearth::samples
