// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/triangles.h"

namespace hearth::import
{

std::vector<uint32_t> makeTriangleList(std::vector<uint32_t> indices, PrimitiveMode mode)
{
    if (mode == PrimitiveMode::triangles)
    {
        indices.resize(indices.size() / 3 * 3);
        return indices;
    }
    std::vector<uint32_t> triangles;
    if (indices.size() < 3)
        return triangles;
    triangles.reserve((indices.size() - 2) * 3);
    for (size_t i = 0; i + 2 < indices.size(); ++i)
    {
        // winding by section 3.7.2.1 of the specification
        const size_t odd = i % 2;
        if (mode == PrimitiveMode::triangle_strip)
            triangles.insert(triangles.end(), {indices[i], indices[i + 1 + odd], indices[i + 2 - odd]});
        else
            triangles.insert(triangles.end(), {indices[i + 1], indices[i + 2], indices[0]});
    }
    return triangles;
}

} // namespace hearth::import
