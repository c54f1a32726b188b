// Reads Stanford PLY: ascii and binary, any scalar types, any order of elements. Unknown elements and
// properties are skipped and named in a warning.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/part/limit_messages.h"
#include "pipelines/import/scans/ply_header.h"
#include "pipelines/import/scans/ply_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hearth::import
{

namespace
{

using namespace std::string_view_literals;
/// Meaning of a property. The first group belongs to vertices, the second to faces.
enum class Role : uint8_t
{
    x,
    y,
    z,
    nx,
    ny,
    nz,
    u,
    v,
    red,
    green,
    blue,
    alpha,
    indices,
    corner_uvs,
    none,
};
constexpr size_t kVertexRoles = static_cast<size_t>(Role::alpha) + 1;

/// Values of one vertex by role; the last element takes values without a role.
using VertexRow = std::array<double, kVertexRoles + 1>;

Role vertexRole(const PlyProperty& property)
{
    constexpr std::array kNames = {
        std::pair{"x"sv, Role::x},
        std::pair{"y"sv, Role::y},
        std::pair{"z"sv, Role::z},
        std::pair{"nx"sv, Role::nx},
        std::pair{"ny"sv, Role::ny},
        std::pair{"nz"sv, Role::nz},
        std::pair{"u"sv, Role::u},
        std::pair{"v"sv, Role::v},
        std::pair{"s"sv, Role::u},
        std::pair{"t"sv, Role::v},
        std::pair{"texture_u"sv, Role::u},
        std::pair{"texture_v"sv, Role::v},
        std::pair{"texture_s"sv, Role::u},
        std::pair{"texture_t"sv, Role::v},
        std::pair{"red"sv, Role::red},
        std::pair{"green"sv, Role::green},
        std::pair{"blue"sv, Role::blue},
        std::pair{"alpha"sv, Role::alpha},
        std::pair{"r"sv, Role::red},
        std::pair{"g"sv, Role::green},
        std::pair{"b"sv, Role::blue},
        std::pair{"a"sv, Role::alpha},
        std::pair{"diffuse_red"sv, Role::red},
        std::pair{"diffuse_green"sv, Role::green},
        std::pair{"diffuse_blue"sv, Role::blue},
    };
    if (property.is_list)
        return Role::none;
    const auto found =
        std::find_if(kNames.begin(), kNames.end(), [&](const auto& n) { return n.first == property.name; });
    return found == kNames.end() ? Role::none : found->second;
}

Role faceRole(const PlyProperty& property)
{
    if (property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index"))
        return Role::indices;
    return property.is_list && property.name == "texcoord" ? Role::corner_uvs : Role::none;
}

/// Return the divisor that scales a colour of this type to 0..1.
double colorScale(PlyType type)
{
    switch (type)
    {
    case PlyType::float32:
    case PlyType::float64:
        return 1;
    case PlyType::int16:
    case PlyType::uint16:
        return std::numeric_limits<uint16_t>::max();
    default:
        return std::numeric_limits<uint8_t>::max();
    }
}

/// Return the minimum size in bytes of a row of the element, to refuse counts that the file cannot hold.
uint64_t minRowBytes(const PlyElement& element, PlyFormat format)
{
    uint64_t size = 0;
    for (const PlyProperty& property : element.properties)
        size +=
            format == PlyFormat::ascii ? 2 : byteSize(property.is_list ? property.count_type : property.type);
    return size;
}

/// Reads the body into a ScanPolygons.
template <typename Values>
class BodyReader
{
public:
    BodyReader(const ScanSource& source, const PlyHeader& header, Values values)
        : source_(source), header_(header), values_(std::move(values))
    {
    }

    Result<ScanPolygons> read()
    {
        for (const PlyElement& element : header_.elements)
        {
            HEARTH_TRY(checkCount(element));
            if (element.name == "vertex")
                HEARTH_TRY(readVertices(element));
            else if (element.name == "face")
                HEARTH_TRY(readFaces(element));
            else
                HEARTH_TRY(skipElement(element));
        }
        HEARTH_TRY(checkIndices());
        if (!dropped_.empty())
            file_.note(Issue::dropped, "", "not kept: " + dropped_);
        if (small_faces_ > 0)
            file_.note(Issue::dropped, "",
                       std::to_string(small_faces_) + " faces with fewer than three corners are not kept");
        file_.texture_file = header_.texture_file;
        file_.vertex_count = file_.positions.size();
        return std::move(file_);
    }

private:
    Error failure(Issue issue, std::string detail) const
    {
        return {issue, source_.path, Values::describe(values_.location()), std::move(detail)};
    }
    Error tooShort(const PlyElement& element, uint64_t row) const
    {
        return failure(Issue::mesh_counts, element.name + " " + std::to_string(row) + " of " +
                                               std::to_string(element.count) + " is incomplete");
    }

    Status checkCount(const PlyElement& element)
    {
        if (element.count > 0 && element.properties.empty())
            return failure(Issue::mesh_syntax, "element " + element.name + " has no properties");
        const uint64_t row = minRowBytes(element, header_.format);
        // the last line of a text needs no line end
        if (element.count > 0 && element.count > (values_.remaining() + 1) / row)
            return failure(Issue::mesh_counts, std::to_string(element.count) + " times element " +
                                                   element.name + " do not fit into the " +
                                                   std::to_string(values_.remaining()) +
                                                   " bytes that are left");
        return success();
    }

    void drop(const PlyElement& element, const std::string& name)
    {
        constexpr size_t kMaxText = 300;
        if (dropped_.size() < kMaxText)
            dropped_ += (dropped_.empty() ? "" : ", ") + element.name + (name.empty() ? "" : "." + name);
    }

    /// Roles of the vertex properties, and the attributes that they form.
    struct VertexLayout
    {
        std::vector<Role> roles;
        std::array<const PlyProperty*, kVertexRoles> property_of_role{};

        bool has(Role role) const { return property_of_role[static_cast<size_t>(role)] != nullptr; }
        bool hasAll(Role a, Role b, Role c) const { return has(a) && has(b) && has(c); }
        double scaleForRole(Role role) const
        {
            return has(role) ? 1 / colorScale(property_of_role[static_cast<size_t>(role)]->type) : 1;
        }
    };

    Result<VertexLayout> makeLayout(const PlyElement& element)
    {
        VertexLayout layout;
        for (const PlyProperty& property : element.properties)
        {
            layout.roles.push_back(vertexRole(property));
            if (layout.roles.back() == Role::none)
            {
                drop(element, property.name);
                continue;
            }
            auto& slot = layout.property_of_role[static_cast<size_t>(layout.roles.back())];
            if (slot != nullptr)
                return failure(Issue::mesh_syntax,
                               "the vertices have two properties for '" + property.name + "'");
            slot = &property;
        }
        if (!layout.hasAll(Role::x, Role::y, Role::z))
            return failure(Issue::mesh_syntax, "the vertices have no x, y and z");
        return layout;
    }

    Status readVertices(const PlyElement& element)
    {
        if (!file_.positions.empty())
            return failure(Issue::mesh_syntax, "there are two elements 'vertex'");
        if (element.count > source_.limits.max_vertices)
            return failure(Issue::input_too_large,
                           describeExcess(element.count, "vertices", source_.limits.max_vertices));
        HEARTH_ASSIGN_OR_RETURN(const VertexLayout layout, makeLayout(element));
        file_.positions.reserve(static_cast<size_t>(element.count));
        VertexRow row{};
        row[static_cast<size_t>(Role::alpha)] = 1;
        for (uint64_t i = 0; i < element.count; ++i)
        {
            if (!readVertexRow(element, layout.roles, row))
                return tooShort(element, i);
            if (!addVertex(layout, row))
                return failure(Issue::mesh_syntax,
                               "vertex " + std::to_string(i) + " has a coordinate that is not finite");
        }
        return success();
    }

    bool addVertex(const VertexLayout& layout, const VertexRow& row)
    {
        const auto value = [&](Role role) { return row[static_cast<size_t>(role)]; };
        const auto vector = [&](Role x, Role y, Role z) {
            return Float3{static_cast<float>(value(x)), static_cast<float>(value(y)),
                          static_cast<float>(value(z))};
        };
        const Float3 position = vector(Role::x, Role::y, Role::z);
        if (!isFinite(position))
            return false;
        file_.positions.push_back(position);
        if (layout.hasAll(Role::nx, Role::ny, Role::nz))
            file_.normals.push_back(vector(Role::nx, Role::ny, Role::nz));
        if (layout.has(Role::u) && layout.has(Role::v))
            addUv(value(Role::u), value(Role::v));
        if (layout.hasAll(Role::red, Role::green, Role::blue))
        {
            const double scale = layout.scaleForRole(Role::red);
            file_.colors.push_back(linearColor(
                static_cast<float>(value(Role::red) * scale), static_cast<float>(value(Role::green) * scale),
                static_cast<float>(value(Role::blue) * scale),
                static_cast<float>(value(Role::alpha) * layout.scaleForRole(Role::alpha))));
        }
        return true;
    }

    bool readVertexRow(const PlyElement& element, const std::vector<Role>& roles, VertexRow& row)
    {
        if (!values_.startRow())
            return false;
        for (size_t p = 0; p < roles.size(); ++p)
        {
            if (element.properties[p].is_list)
            {
                if (!skipList(element.properties[p]))
                    return false;
                continue;
            }
            const auto value = values_.read(element.properties[p].type);
            if (!value)
                return false;
            row[std::min(static_cast<size_t>(roles[p]), kVertexRoles)] = *value;
        }
        return values_.endRow();
    }

    void addUv(double u, double v)
    {
        const bool finite = std::isfinite(u) && std::isfinite(v);
        file_.uvs.push_back(finite ? Float2{static_cast<float>(u), static_cast<float>(1 - v)} : Float2{});
    }

    /// Read the length of a list; a negative or fractional one means damage.
    std::optional<uint64_t> listLength(const PlyProperty& property)
    {
        const auto count = values_.read(property.count_type);
        if (!count || *count < 0 || *count != std::floor(*count) ||
            *count > static_cast<double>(values_.remaining()))
            return std::nullopt;
        return static_cast<uint64_t>(*count);
    }

    bool skipList(const PlyProperty& property)
    {
        const auto count = listLength(property);
        for (uint64_t i = 0; count && i < *count; ++i)
            if (!values_.read(property.type))
                return false;
        return count.has_value();
    }

    bool skipProperty(const PlyProperty& property)
    {
        return property.is_list ? skipList(property) : values_.read(property.type).has_value();
    }

    Status skipElement(const PlyElement& element)
    {
        if (element.count > 0)
            drop(element, "");
        for (uint64_t i = 0; i < element.count; ++i)
        {
            bool complete = values_.startRow();
            for (const PlyProperty& property : element.properties)
                complete = complete && skipProperty(property);
            if (!complete || !values_.endRow())
                return tooShort(element, i);
        }
        return success();
    }

    Status readFaces(const PlyElement& element)
    {
        std::vector<Role> roles;
        for (const PlyProperty& property : element.properties)
        {
            roles.push_back(faceRole(property));
            if (roles.back() == Role::none)
                drop(element, property.name);
        }
        if (std::count(roles.begin(), roles.end(), Role::indices) != 1 ||
            std::count(roles.begin(), roles.end(), Role::corner_uvs) > 1)
            return failure(Issue::mesh_syntax, "the faces need one list vertex_indices");
        for (size_t p = 0; p < roles.size(); ++p)
            if (roles[p] == Role::indices && isFloat(element.properties[p].type))
                return failure(Issue::mesh_syntax, "vertex_indices are not integers");
        if (!file_.face_ends.empty())
            return failure(Issue::mesh_syntax, "there are two elements 'face'");
        for (uint64_t i = 0; i < element.count; ++i)
            HEARTH_TRY(readFace(element, roles, i));
        return success();
    }

    Status readFace(const PlyElement& element, const std::vector<Role>& roles, uint64_t row)
    {
        const size_t first = file_.corner_positions.size();
        std::vector<Float2>& uvs = uv_scratch_;
        uvs.clear();
        if (!values_.startRow())
            return tooShort(element, row);
        for (size_t p = 0; p < roles.size(); ++p)
        {
            const PlyProperty& property = element.properties[p];
            if (roles[p] == Role::indices)
                HEARTH_TRY(readIndices(element, property, row));
            else if (!(roles[p] == Role::corner_uvs ? readCornerUvs(property, uvs) : skipProperty(property)))
                return tooShort(element, row);
        }
        if (!values_.endRow())
            return failure(Issue::mesh_syntax, "more values than the header says");
        const size_t corners = file_.corner_positions.size() - first;
        if (corners < 3)
        {
            ++small_faces_;
            file_.corner_positions.resize(first);
            return success();
        }
        addCornerUvs(first, uvs);
        if (file_.corner_positions.size() > 3 * source_.limits.max_triangles)
            return failure(Issue::input_too_large,
                           "more than " + std::to_string(source_.limits.max_triangles) + " triangles");
        file_.face_ends.push_back(static_cast<uint32_t>(file_.corner_positions.size()));
        return success();
    }

    Status readIndices(const PlyElement& element, const PlyProperty& property, uint64_t row)
    {
        const auto count = listLength(property);
        if (!count)
            return tooShort(element, row);
        for (uint64_t i = 0; i < *count; ++i)
        {
            const auto index = values_.read(property.type);
            if (!index)
                return tooShort(element, row);
            if (*index < 0 || *index >= kInvalidIndex || *index != std::floor(*index))
                return failure(Issue::index_out_of_range, "a vertex index of face " + std::to_string(row) +
                                                              " is negative or no integer");
            const auto position = static_cast<uint32_t>(*index);
            if (position >= max_index_)
            {
                max_index_ = position;
                max_index_location_ = values_.location();
            }
            file_.corner_positions.push_back(position);
        }
        return success();
    }

    /// Read two numbers for each corner.
    bool readCornerUvs(const PlyProperty& property, std::vector<Float2>& uvs)
    {
        const auto count = listLength(property);
        for (uint64_t i = 0; count && i + 1 < *count; i += 2)
        {
            const auto u = values_.read(property.type);
            const auto v = u ? values_.read(property.type) : std::nullopt;
            if (!v)
                return false;
            const bool finite = std::isfinite(*u) && std::isfinite(*v);
            uvs.push_back(finite ? Float2{static_cast<float>(*u), static_cast<float>(1 - *v)} : Float2{});
        }
        return count && (*count % 2 == 0 || values_.read(property.type));
    }

    void addCornerUvs(size_t first, const std::vector<Float2>& uvs)
    {
        const size_t corners = file_.corner_positions.size() - first;
        if (file_.corner_uvs.empty() && uvs.empty())
            return;
        if (file_.corner_uvs.empty())
            file_.uvs.clear(); // UVs of corners replace UVs of vertices
        file_.corner_uvs.resize(first, kInvalidIndex);
        for (size_t i = 0; i < corners; ++i)
        {
            const bool given = uvs.size() == corners;
            file_.corner_uvs.push_back(given ? static_cast<uint32_t>(file_.uvs.size()) : kInvalidIndex);
            if (given)
                file_.uvs.push_back(uvs[i]);
        }
    }

    Status checkIndices() const
    {
        if (!file_.corner_positions.empty() && max_index_ >= file_.positions.size())
            return Error{Issue::index_out_of_range, source_.path, Values::describe(max_index_location_),
                         "vertex index " + std::to_string(max_index_) + " of " +
                             std::to_string(file_.positions.size()) + " vertices"};
        return success();
    }

    const ScanSource& source_;
    const PlyHeader& header_;
    Values values_;
    ScanPolygons file_;
    std::string dropped_;
    uint64_t small_faces_ = 0;
    uint32_t max_index_ = 0;
    size_t max_index_location_ = 0;
    std::vector<Float2> uv_scratch_;
};

} // namespace

Result<ScanPolygons> readPly(const ScanSource& source)
{
    HEARTH_ASSIGN_OR_RETURN(const PlyHeader header, readPlyHeader(source));
    if (header.format == PlyFormat::ascii)
        return BodyReader(source, header,
                          AsciiValues(source.text().substr(header.body_offset), header.body_line))
            .read();
    const bool big_endian = header.format == PlyFormat::big_endian;
    return BodyReader(source, header, BinaryValues(source.bytes, header.body_offset, big_endian)).read();
}

} // namespace hearth::import
