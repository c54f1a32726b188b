// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/source_triangles.h"

#include "cook/mesh/grid.h"

namespace hearth::reference
{

namespace
{

/// False if two corners coincide or all three lie on a line, as far as doubles can tell: products of
/// differences of floats of similar size are exact in double.
bool hasArea(const std::array<Float3, 3>& t)
{
    const auto wide = [](float v) { return static_cast<double>(v); };
    const double ux = wide(t[1].x) - wide(t[0].x), uy = wide(t[1].y) - wide(t[0].y),
                 uz = wide(t[1].z) - wide(t[0].z);
    const double vx = wide(t[2].x) - wide(t[0].x), vy = wide(t[2].y) - wide(t[0].y),
                 vz = wide(t[2].z) - wide(t[0].z);
    return uy * vz != uz * vy || uz * vx != ux * vz || ux * vy != uy * vx;
}

bool hasEdges(const std::array<Float3, 3>& t)
{
    return !(t[0] == t[1]) && !(t[1] == t[2]) && !(t[2] == t[0]);
}

} // namespace

Result<std::vector<SceneTriangle>> trianglesOfImportPart(const formats::PackView& part)
{
    std::vector<SceneTriangle> triangles;
    for (uint32_t instance = 0; instance < part.instances().size(); ++instance)
    {
        HEARTH_ASSIGN_OR_RETURN(const mesh::SourceMesh source,
                                mesh::readSourceMesh(part.container(), part.instances()[instance].mesh));
        mesh::SourceMesh on_grid = source;
        mesh::snapToGrid(on_grid);
        for (size_t t = 0; t < source.triangleCount(); ++t)
        {
            SceneTriangle triangle;
            const auto place = [&](const mesh::SourceMesh& mesh, size_t corner)
            { return mesh.positions[source.indices[t * 3 + corner]]; };
            if (!hasArea({place(source, 0), place(source, 1), place(source, 2)}))
                continue;
            for (size_t corner = 0; corner < 3; ++corner)
                triangle.corners[corner] = place(on_grid, corner);
            triangle.instance = instance;
            triangle.material =
                source.triangle_materials.empty() ? kInvalidIndex : source.triangle_materials[t];
            triangle.id = static_cast<uint32_t>(triangles.size());
            if (hasEdges(triangle.corners))
                triangles.push_back(triangle);
        }
    }
    return triangles;
}

} // namespace hearth::reference
