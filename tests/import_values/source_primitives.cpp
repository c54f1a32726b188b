// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/import_values/source_primitives.h"

#include "tests/import_values/draco_values.h"

#include <map>
#include <numeric>
#include <stdexcept>

namespace hearth::test
{

namespace
{

constexpr const char* kDraco = "KHR_draco_mesh_compression";

/// Attributes that Draco holds, by semantic, and its indices.
struct DracoValues
{
    std::map<std::string, SourceValues> attributes;
    std::vector<size_t> indices;
};

const DracoAttribute& findAttribute(const DracoMesh& mesh, uint32_t id)
{
    for (const DracoAttribute& attribute : mesh.attributes)
        if (attribute.id == id && attribute.component_type != 0)
            return attribute;
    throw std::runtime_error("Draco data lack an attribute");
}

SourceValues makeValues(const DracoAttribute& attribute, bool is_normalised)
{
    SourceValues values{attribute.values, attribute.components, true};
    values.is_exact = attribute.component_type == TINYGLTF_COMPONENT_TYPE_FLOAT || !is_normalised;
    if (is_normalised)
        for (double& value : values.values)
            value = normalised(value, attribute.component_type);
    return values;
}

std::optional<DracoValues> readDraco(const SourceModel& source, const tinygltf::Primitive& primitive)
{
    const auto found = primitive.extensions.find(kDraco);
    if (found == primitive.extensions.end())
        return std::nullopt;
    const DracoMesh mesh =
        decodeDraco(source.views.at(static_cast<size_t>(found->second.Get("bufferView").GetNumberAsInt())));
    if (!mesh.error.empty())
        throw std::runtime_error("Draco data: " + mesh.error);
    DracoValues values{{}, mesh.indices};
    const tinygltf::Value& attributes = found->second.Get("attributes");
    for (const std::string& semantic : attributes.Keys())
    {
        if (semantic.starts_with("_"))
            continue; // attributes of applications may have any type
        const int accessor = primitive.attributes.at(semantic);
        const bool is_normalised = source.model.accessors.at(static_cast<size_t>(accessor)).normalized;
        const auto id = static_cast<uint32_t>(attributes.Get(semantic).GetNumberAsInt());
        values.attributes.emplace(semantic, makeValues(findAttribute(mesh, id), is_normalised));
    }
    return values;
}

/// Reads the attributes of a primitive, from Draco data where these have them.
class AttributeReader
{
public:
    AttributeReader(const SourceModel& source, const tinygltf::Primitive& primitive)
        : source_(source), primitive_(primitive), draco_(readDraco(source, primitive))
    {
    }

    std::optional<SourceValues> read(const std::string& semantic) const
    {
        if (draco_)
            if (const auto found = draco_->attributes.find(semantic); found != draco_->attributes.end())
                return found->second;
        return readFrom(primitive_.attributes, semantic);
    }

    std::optional<SourceValues> readFrom(const std::map<std::string, int>& attributes,
                                         const std::string& semantic) const
    {
        const auto found = attributes.find(semantic);
        return found == attributes.end() ? std::nullopt : std::optional(readValues(source_, found->second));
    }

    const std::optional<DracoValues>& draco() const { return draco_; }

private:
    const SourceModel& source_;
    const tinygltf::Primitive& primitive_;
    std::optional<DracoValues> draco_;
};

SourcePiece readPiece(const AttributeReader& reader, const tinygltf::Primitive& primitive)
{
    SourcePiece piece;
    piece.positions = reader.read("POSITION").value();
    piece.normals = reader.read("NORMAL");
    if (piece.normals) // tangents have no meaning without
        piece.tangents = reader.read("TANGENT");
    for (size_t set = 0; set < kUvSets; ++set)
        piece.uvs[set] = reader.read("TEXCOORD_" + std::to_string(set));
    piece.colors = reader.read("COLOR_0");
    for (size_t set = 0;; ++set)
    {
        auto joints = reader.read("JOINTS_" + std::to_string(set));
        auto weights = reader.read("WEIGHTS_" + std::to_string(set));
        if (!joints || !weights)
            break;
        piece.joints.push_back(std::move(*joints));
        piece.weights.push_back(std::move(*weights));
    }
    for (const std::map<std::string, int>& target : primitive.targets)
        piece.targets.push_back({reader.readFrom(target, "POSITION"), reader.readFrom(target, "NORMAL"),
                                 reader.readFrom(target, "TANGENT")});
    return piece;
}

std::vector<size_t> readIndices(const SourceModel& source, const tinygltf::Primitive& primitive,
                                size_t vertex_count)
{
    std::vector<size_t> indices(vertex_count);
    std::iota(indices.begin(), indices.end(), size_t{0});
    if (primitive.indices < 0)
        return indices;
    indices.clear();
    for (const double value : readValues(source, primitive.indices).values)
        indices.push_back(static_cast<size_t>(value));
    return indices;
}

bool areShared(const tinygltf::Primitive& a, const tinygltf::Primitive& b)
{
    const auto draco = [](const tinygltf::Primitive& primitive)
    {
        const auto found = primitive.extensions.find(kDraco);
        return found == primitive.extensions.end() ? tinygltf::Value() : found->second;
    };
    return a.attributes == b.attributes && a.targets == b.targets && draco(a) == draco(b);
}

} // namespace

std::vector<std::array<size_t, 3>> triangulate(const std::vector<size_t>& indices, int mode)
{
    std::vector<std::array<size_t, 3>> triangles;
    if (mode == TINYGLTF_MODE_TRIANGLES)
        for (size_t i = 0; i + 3 <= indices.size(); i += 3)
            triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
    else
        for (size_t i = 0; i + 2 < indices.size(); ++i)
            if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
                triangles.push_back({indices[i + 1], indices[i + 2], indices[0]});
            else
                triangles.push_back({indices[i], indices[i + (1 + i % 2)], indices[i + (2 - i % 2)]});
    return triangles;
}

std::vector<SourcePiece> readPieces(const SourceModel& source, const tinygltf::Mesh& mesh)
{
    std::vector<SourcePiece> pieces;
    std::vector<const tinygltf::Primitive*> first_of_piece;
    for (const tinygltf::Primitive& primitive : mesh.primitives)
    {
        const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
        if (mode < TINYGLTF_MODE_TRIANGLES || !primitive.attributes.contains("POSITION"))
            continue;
        size_t index = 0;
        while (index < pieces.size() && !areShared(*first_of_piece[index], primitive))
            ++index;
        const AttributeReader reader(source, primitive);
        if (index == pieces.size())
        {
            pieces.push_back(readPiece(reader, primitive));
            first_of_piece.push_back(&primitive);
        }
        SourcePiece& piece = pieces[index];
        const auto& draco = reader.draco();
        const std::vector<size_t> indices =
            draco ? draco->indices : readIndices(source, primitive, piece.positions.count());
        for (const auto& vertices : triangulate(indices, draco ? TINYGLTF_MODE_TRIANGLES : mode))
            piece.triangles.push_back({vertices, primitive.material});
        if (primitive.material >= 0 && !indices.empty())
        {
            const auto& material = source.model.materials.at(static_cast<size_t>(primitive.material));
            piece.has_normal_texture = piece.has_normal_texture || material.normalTexture.index >= 0;
        }
    }
    return pieces;
}

} // namespace hearth::test
