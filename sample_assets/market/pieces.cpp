// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/market/pieces.h"

#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/shapes.h"

namespace hearth::samples::market
{

TriangleMesh makeBlock(Float3 low, Float3 high)
{
    return makeBox((low + high) * 0.5f, (high - low) * 0.5f, 1);
}

TriangleMesh makeBall(Float3 half, uint32_t segments)
{
    const uint32_t rows = std::max(3u, segments / 2);
    std::vector<Float2> profile;
    for (uint32_t i = 0; i <= rows; ++i)
    {
        const float angle = kPi * static_cast<float>(i) / static_cast<float>(rows);
        profile.push_back({i % rows == 0 ? 0.0f : sine(angle), cosine(angle)});
    }
    return transformed(makeLathe(profile, segments), {.scale = half});
}

TriangleMesh makeTurned(std::vector<Float2> profile, uint32_t segments)
{
    if (profile.front().x > 0)
        profile.insert(profile.begin(), {0, profile.front().y});
    if (profile.back().x > 0)
        profile.push_back({0, profile.back().y});
    return makeLathe(profile, segments);
}

TriangleMesh makeRod(Float3 from, Float3 to, float radius, uint32_t segments)
{
    const Float3 axis = to - from;
    const float length = hearth::length(axis);
    const TriangleMesh rod = makeTurned({{radius, length}, {radius, 0}}, segments);
    return transformed(rod,
                       {.translation = from, .rotation = rotationBetween({0, 1, 0}, axis * (1 / length))});
}

TriangleMesh makeSheet(uint32_t columns, uint32_t rows, float thickness,
                       const std::function<Float3(Float2 uv)>& surface)
{
    const Float3 down{0, -thickness, 0};
    TriangleMesh sheet = makeGrid(columns, rows,
                                  [&](Float2 uv, Float3& position, Float2& texture_uv)
                                  {
                                      position = surface(uv);
                                      texture_uv = uv;
                                  });
    setSmoothNormals(sheet);
    TriangleMesh back = moved(sheet, down);
    for (size_t i = 0; i < back.indices.size(); i += 3)
        std::swap(back.indices[i + 1], back.indices[i + 2]);
    for (Float3& n : back.normals)
        n = -n;
    append(sheet, back);
    // each side runs so that its outside is on the right of the way around the square
    const Float2 corners[5] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
    for (uint32_t side = 0; side < 4; ++side)
    {
        const Float2 from = corners[side], to = corners[side + 1];
        TriangleMesh rim = makeGrid(side % 2 == 0 ? columns : rows, 1,
                                    [&](Float2 uv, Float3& position, Float2& texture_uv)
                                    {
                                        texture_uv = from + (to - from) * uv.x;
                                        position = surface(texture_uv) + down * (1 - uv.y);
                                    });
        setSmoothNormals(rim);
        append(sheet, rim);
    }
    return sheet;
}

TriangleMesh moved(TriangleMesh mesh, Float3 by)
{
    for (Float3& p : mesh.positions)
        p += by;
    return mesh;
}

TriangleMesh tinted(TriangleMesh mesh, Float3 color)
{
    mesh.colors.assign(mesh.positions.size(), {color.x, color.y, color.z, 1});
    return mesh;
}

Placement standing(Float3 position, float heading_rad, float scale)
{
    return {position, rotationAbout({0, 1, 0}, heading_rad), {scale, scale, scale}};
}

Float3 fromPlacement(const Placement& placement, Float3 point)
{
    return rotate(placement.rotation, point * placement.scale) + placement.translation;
}

} // namespace hearth::samples::market
