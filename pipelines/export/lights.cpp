// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/export/lights.h"

#include <algorithm>
#include <cmath>

namespace hearth::gltf_export
{

using namespace formats;

namespace
{

std::string lightTypeName(uint32_t type)
{
    switch (static_cast<LightType>(type))
    {
    case LightType::directional:
        return "directional";
    case LightType::spot:
        return "spot";
    default:
        return "point";
    }
}

} // namespace

void addLights(GltfDocument& document, const PackView& pack)
{
    for (const LightRecord& record : pack.lights())
    {
        Light light;
        light.name = pack.text(record.name);
        light.type = lightTypeName(record.type);
        light.color = {double{record.color.x}, double{record.color.y}, double{record.color.z}};
        light.intensity = double{record.intensity};
        light.range = double{record.range};
        light.outer_cone = double{record.outer_cone_rad};
        // glTF wants the inner cone to be the smaller one
        light.inner_cone = double{
            std::min(record.inner_cone_rad, std::max(0.0f, std::nextafter(record.outer_cone_rad, 0.0f)))};
        document.nodes[record.node].light = static_cast<uint32_t>(document.lights.size());
        document.lights.push_back(std::move(light));
    }
}

} // namespace hearth::gltf_export
