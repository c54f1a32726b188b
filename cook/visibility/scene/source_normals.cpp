// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/scene/source_normals.h"

#include "cook/mesh/grid.h"
#include "cook/mesh/source_mesh.h"
#include "formats/base/assert.h"
#include "formats/base/double3.h"

#include <algorithm>
#include <bit>
#include <tuple>

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

namespace hearth::visibility
{

using namespace formats;

namespace
{

using FineCode = NormalCode<16>;

uint64_t hashPlace(Float3 position)
{
    uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
        hash = (hash ^ std::bit_cast<uint32_t>(position[axis])) * 0x9E3779B97F4A7C15u;
        hash ^= hash >> 32;
    }
    return hash;
}

Float3 snapped(Float3 position, double step)
{
    return {mesh::snap(position.x, step), mesh::snap(position.y, step), mesh::snap(position.z, step)};
}

} // namespace

SourceNormals::SourceNormals(std::span<const Float3> positions, std::span<const Float3> normals,
                             uint32_t layout, float grid_step)
    : layout_(layout)
{
    if ((layout & kVertexNormal) == 0 || (layout & kVertexNormal16) != 0 || !(grid_step > 0))
        return;
    HEARTH_ASSERT(normals.empty() || normals.size() == positions.size());
    vertices_.resize(normals.size());
    const auto add = [&](size_t v)
    {
        // encoded twice, as find() encodes what has been decoded: directions on edges of the octahedral
        // square have two codes
        const Float3 normal = normalizeOr(normals[v], {0, 0, 1});
        const Float3 rounded = decodeNormal(layout, encodeNormal(layout, normal));
        vertices_[v] = {encodeNormal(layout, rounded), FineCode::encode(normal),
                        hashPlace(snapped(positions[v], double{grid_step}))};
    };
    tbb::parallel_for(size_t{0}, normals.size(), add);
    tbb::parallel_sort(vertices_.begin(), vertices_.end(),
                       [](const Vertex& a, const Vertex& b)
                       { return std::tie(a.code, a.place, a.fine) < std::tie(b.code, b.place, b.fine); });
    for (size_t first = 0; first < vertices_.size();)
    {
        const uint32_t code = vertices_[first].code;
        size_t end = first;
        while (end < vertices_.size() && vertices_[end].code == code)
            ++end;
        const std::span<const Vertex> vertices = std::span(vertices_).subspan(first, end - first);
        facings_.push_back({code, first, meanNormal(vertices, decodeNormal(layout, code))});
        first = end;
    }
}

Result<SourceNormals> SourceNormals::read(const PackView& import_part, uint32_t mesh,
                                          const MeshRecord& record)
{
    if ((record.attributes & kVertexNormal16) != 0)
        return SourceNormals({}, {}, record.attributes, record.grid_step);
    HEARTH_ASSIGN_OR_RETURN(const mesh::SourceMesh source,
                            mesh::readSourceMesh(import_part.container(), mesh));
    return SourceNormals(source.positions, source.normals, record.attributes, record.grid_step);
}

Float3 SourceNormals::meanNormal(std::span<const Vertex> vertices, Float3 fallback)
{
    Double3 sum;
    for (const Vertex& vertex : vertices)
        sum = sum + widen(FineCode::decode(vertex.fine));
    return normalizeOr(narrow(sum), fallback);
}

Float3 SourceNormals::find(Float3 position, Float3 normal) const
{
    if (facings_.empty())
        return normal;
    const uint32_t code = encodeNormal(layout_, normal);
    const auto facing = std::lower_bound(facings_.begin(), facings_.end(), code,
                                         [](const Facing& f, uint32_t c) { return f.code < c; });
    if (facing == facings_.end() || facing->code != code)
        return normal;
    const size_t end = std::next(facing) == facings_.end() ? vertices_.size() : std::next(facing)->first;
    const std::span<const Vertex> alike = std::span(vertices_).subspan(facing->first, end - facing->first);
    const auto found = std::ranges::equal_range(alike, hashPlace(position), {}, &Vertex::place);
    return found.empty() ? facing->mean : meanNormal({found.begin(), found.end()}, normal);
}

Float3 turnWithNormal(Float3 v, Float3 from, Float3 to)
{
    if (from == to)
        return v;
    const float cosine = dot(from, to);
    const Float3 axis = cross(from, to);
    return v * cosine + cross(axis, v) + axis * (dot(axis, v) / (1 + cosine));
}

} // namespace hearth::visibility
