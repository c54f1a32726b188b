// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/vertices.h"

#include "pipelines/import/gltf/draco.h"
#include "pipelines/import/gltf/skinning.h"
#include "pipelines/import/part/limit_messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hearth::import
{

namespace
{

// shorter vectors have no meaningful direction
constexpr float kMinLength = 1e-10f;

constexpr uint32_t bit(ComponentType type)
{
    return 1u << (static_cast<uint32_t>(type) - 5120u);
}
constexpr uint32_t bit(ElementType type)
{
    return 1u << static_cast<uint32_t>(type);
}

constexpr uint32_t kFloat = bit(ComponentType::f32);
constexpr uint32_t kSigned = bit(ComponentType::i8) | bit(ComponentType::i16);
constexpr uint32_t kUnsigned = bit(ComponentType::u8) | bit(ComponentType::u16);

/// Allowed formats of an attribute. KHR_mesh_quantization is always accepted: files that use it undeclared
/// are unambiguous.
struct AttributeFormat
{
    std::string_view prefix; ///< whole name, or up to the number
    uint32_t types;
    uint32_t components;
};
constexpr AttributeFormat kVertexFormats[] = {
    {"POSITION", bit(ElementType::vec3), kFloat | kSigned | kUnsigned},
    {"NORMAL", bit(ElementType::vec3), kFloat | kSigned},
    {"TANGENT", bit(ElementType::vec4), kFloat | kSigned},
    {"TEXCOORD_", bit(ElementType::vec2), kFloat | kSigned | kUnsigned},
    {"COLOR_", bit(ElementType::vec3) | bit(ElementType::vec4), kFloat | kUnsigned},
    {"JOINTS_", bit(ElementType::vec4), kUnsigned},
    {"WEIGHTS_", bit(ElementType::vec4), kFloat | kUnsigned},
};
constexpr AttributeFormat kTargetFormats[] = {
    {"POSITION", bit(ElementType::vec3), kFloat | kSigned},
    {"NORMAL", bit(ElementType::vec3), kFloat | kSigned},
    {"TANGENT", bit(ElementType::vec3), kFloat | kSigned},
};

/// Return the format that an attribute must have, or nullptr for one that Hearth does not read.
const AttributeFormat* findFormat(std::string_view semantic, std::span<const AttributeFormat> formats)
{
    const auto matches = [&](const AttributeFormat& f)
    { return f.prefix.ends_with('_') ? semantic.starts_with(f.prefix) : semantic == f.prefix; };
    const auto found = std::find_if(formats.begin(), formats.end(), matches);
    return found == formats.end() ? nullptr : &*found;
}

/// Reads the attributes of one primitive, from accessors or from its compressed data.
class VertexReader
{
public:
    VertexReader(const GltfPrimitive& primitive, const std::string& where, GltfAccessors& accessors,
                 GltfTally& tally)
        : primitive_(primitive), where_(where), accessors_(accessors), tally_(tally)
    {
    }

    Status checkFormats() const;
    Status decodeCompressed(const GltfModel& model, const GltfBuffers& buffers, const GltfContext& context);
    void reportCounts(const GltfModel& model, const DracoMesh& mesh) const;
    Status readPositions();
    Status readFrame();
    Status readUvs();
    Status readColors();
    Status readInfluences();
    Status readTargets();
    void reportOthers() const;

    GltfVertices result;

private:
    Status checkFormat(const GltfAttribute& attribute, std::span<const AttributeFormat> formats) const;
    Status checkCount(uint32_t accessor, std::string_view semantic) const;
    Status checkPositions(uint32_t accessor, std::string_view what, std::span<const Float3> vectors) const;
    Result<std::vector<float>> values(std::string_view semantic);
    template <typename T>
    Result<std::vector<T>> vectors(std::string_view semantic);
    Result<std::vector<Float3>> deltas(const GltfAttributes& target, std::string_view semantic);
    bool has(std::string_view semantic) const
    {
        return findAttribute(primitive_.attributes, semantic) != kInvalidIndex;
    }

    const GltfPrimitive& primitive_;
    const std::string& where_;
    GltfAccessors& accessors_;
    GltfTally& tally_;
    std::map<std::string, std::vector<float>, std::less<>> decompressed_;
};

Status VertexReader::checkFormat(const GltfAttribute& attribute,
                                 std::span<const AttributeFormat> formats) const
{
    const AttributeFormat* format = findFormat(attribute.semantic, formats);
    if (format == nullptr)
        return success();
    const GltfAccessor& accessor = accessors_.accessor(attribute.accessor);
    if ((format->types & bit(accessor.type)) == 0 || (format->components & bit(accessor.component)) == 0)
        return accessors_.error(attribute.accessor, Issue::gltf_value,
                                fmt::format("{} cannot be a {}", attribute.semantic, formatName(accessor)));
    return success();
}

Status VertexReader::checkFormats() const
{
    const uint64_t vertex_count = accessors_.accessor(findAttribute(primitive_.attributes, "POSITION")).count;
    const auto check = [&](const GltfAttribute& attribute, std::span<const AttributeFormat> formats) -> Status
    {
        HEARTH_TRY(checkFormat(attribute, formats));
        if (accessors_.accessor(attribute.accessor).count != vertex_count)
            return accessors_.error(attribute.accessor, Issue::gltf_data,
                                    fmt::format("{} has {} elements, POSITION {}", attribute.semantic,
                                                accessors_.accessor(attribute.accessor).count, vertex_count));
        return success();
    };
    for (const GltfAttribute& attribute : primitive_.attributes)
        HEARTH_TRY(check(attribute, kVertexFormats));
    for (const GltfAttributes& target : primitive_.targets)
        for (const GltfAttribute& attribute : target)
            HEARTH_TRY(check(attribute, kTargetFormats));
    return success();
}

Status VertexReader::decodeCompressed(const GltfModel& model, const GltfBuffers& buffers,
                                      const GltfContext& context)
{
    if (!primitive_.draco)
        return success();
    const std::string where = where_ + "/extensions/KHR_draco_mesh_compression";
    std::vector<std::string> semantics;
    std::vector<DracoAttribute> wanted;
    for (const GltfAttribute& compressed : primitive_.draco->attributes)
    {
        if (findFormat(compressed.semantic, kVertexFormats) == nullptr)
            continue;
        const uint32_t accessor = findAttribute(primitive_.attributes, compressed.semantic);
        if (accessor == kInvalidIndex)
            return context.error(Issue::gltf_extension_value, where,
                                 fmt::format("{} is not an attribute of the primitive", compressed.semantic));
        const GltfAccessor& format = model.accessors[accessor];
        semantics.push_back(compressed.semantic);
        wanted.push_back({compressed.accessor, componentCount(format.type), format.normalized});
    }
    HEARTH_ASSIGN_OR_RETURN(DracoMesh mesh, decodeDraco(buffers.view(primitive_.draco->buffer_view), wanted,
                                                        context.file, where));
    if (std::find(semantics.begin(), semantics.end(), "POSITION") == semantics.end())
        return context.error(Issue::gltf_extension_value, where,
                             "POSITION is not among the compressed attributes");
    reportCounts(model, mesh);
    for (size_t i = 0; i < semantics.size(); ++i)
        decompressed_.emplace(semantics[i], std::move(mesh.attributes[i]));
    result.draco_indices = std::move(mesh.indices);
    return success();
}

/// Report counts of accessors that differ from what Draco has decoded, which is used.
void VertexReader::reportCounts(const GltfModel& model, const DracoMesh& mesh) const
{
    const auto report = [&](std::string_view what, uint64_t stated, uint64_t decoded)
    {
        if (stated != decoded)
            tally_.inconsistent(
                fmt::format("counts of {} that Draco decodes differ from those of accessors", what), where_,
                fmt::format("{} are decoded, the accessor says {}", decoded, stated));
    };
    report("vertices", model.accessors[findAttribute(primitive_.attributes, "POSITION")].count,
           mesh.vertex_count);
    // strips are decoded as triangles, which have other indices than the accessor counts
    if (primitive_.indices != kInvalidIndex && primitive_.mode == PrimitiveMode::triangles)
        report("indices", model.accessors[primitive_.indices].count, mesh.indices.size());
}

Result<std::vector<float>> VertexReader::values(std::string_view semantic)
{
    const auto found = decompressed_.find(semantic);
    if (found != decompressed_.end())
        return std::move(found->second);
    const uint32_t index = findAttribute(primitive_.attributes, semantic);
    HEARTH_TRY(checkCount(index, semantic));
    return accessors_.floats(index);
}

/// Check the count of an accessor. Accessors agree with each other, but may disagree with the data that Draco
/// decodes.
Status VertexReader::checkCount(uint32_t accessor, std::string_view semantic) const
{
    const uint64_t count = accessors_.accessor(accessor).count;
    if (semantic == "POSITION" || count == result.mesh.vertexCount())
        return success();
    return accessors_.error(accessor, primitive_.draco ? Issue::gltf_extension_value : Issue::gltf_data,
                            fmt::format("{} has {} elements, but there are {} vertices", semantic, count,
                                        result.mesh.vertexCount()));
}

template <typename T>
std::vector<T> asVectors(const std::vector<float>& values)
{
    std::vector<T> vectors(values.size() / (sizeof(T) / sizeof(float)));
    std::copy(values.begin(), values.end(), reinterpret_cast<float*>(vectors.data()));
    return vectors;
}

template <typename T>
Result<std::vector<T>> VertexReader::vectors(std::string_view semantic)
{
    HEARTH_ASSIGN_OR_RETURN(const std::vector<float> floats, values(semantic));
    return asVectors<T>(floats);
}

/// Check that vectors of an accessor can be used as positions. errors: gltf_data (not finite),
/// number_too_large.
Status VertexReader::checkPositions(uint32_t accessor, std::string_view what,
                                    std::span<const Float3> vectors) const
{
    const std::optional<size_t> bad = findBadPosition(vectors);
    if (!bad)
        return success();
    const Float3 v = vectors[*bad];
    return accessors_.error(accessor, isFinite(v) ? Issue::number_too_large : Issue::gltf_data,
                            fmt::format("{} {} is {}", what, *bad, describeBadPosition(v)));
}

Status VertexReader::readPositions()
{
    HEARTH_ASSIGN_OR_RETURN(result.mesh.positions, vectors<Float3>("POSITION"));
    return checkPositions(findAttribute(primitive_.attributes, "POSITION"), "position",
                          result.mesh.positions);
}

/// Read NORMAL and TANGENT; tangents have no meaning without normals.
Status VertexReader::readFrame()
{
    if (!has("NORMAL"))
    {
        if (has("TANGENT"))
            tally_.dropped("TANGENT without NORMAL is not kept", where_);
        return success();
    }
    HEARTH_ASSIGN_OR_RETURN(result.mesh.normals, vectors<Float3>("NORMAL"));
    bool any_repaired = false;
    for (Float3& normal : result.mesh.normals)
    {
        // a comparison with NaN is false too
        const bool usable =
            length(normal) > kMinLength && length(normal) < std::numeric_limits<float>::infinity();
        any_repaired = any_repaired || !usable;
        normal = usable ? normal / length(normal) : Float3{};
    }
    if (any_repaired)
        tally_.repaired("normals without a direction were replaced", where_);
    if (!has("TANGENT"))
        return success();

    HEARTH_ASSIGN_OR_RETURN(result.mesh.tangents, vectors<Float4>("TANGENT"));
    any_repaired = false;
    for (Float4& tangent : result.mesh.tangents)
    {
        const Float3 direction{tangent.x, tangent.y, tangent.z};
        const bool usable =
            length(direction) > kMinLength && length(direction) < std::numeric_limits<float>::infinity();
        any_repaired = any_repaired || !usable;
        const Float3 unit = usable ? direction / length(direction) : Float3{1, 0, 0};
        tangent = {unit.x, unit.y, unit.z, tangent.w < 0 ? -1.0f : 1.0f};
    }
    if (any_repaired)
        tally_.repaired("tangents without a direction were replaced", where_);
    return success();
}

Status VertexReader::readUvs()
{
    for (size_t set = 0; set < mesh::kUvSetCount; ++set)
    {
        const std::string semantic = fmt::format("TEXCOORD_{}", set);
        if (!has(semantic))
            continue;
        HEARTH_ASSIGN_OR_RETURN(result.mesh.uvs[set], vectors<Float2>(semantic));
        bool any_repaired = false;
        for (Float2& uv : result.mesh.uvs[set])
            if (!std::isfinite(uv.x) || !std::isfinite(uv.y))
            {
                uv = {};
                any_repaired = true;
            }
        if (any_repaired)
            tally_.repaired("texture coordinates that are not finite were set to 0", where_);
    }
    return success();
}

Status VertexReader::readColors()
{
    const uint32_t index = findAttribute(primitive_.attributes, "COLOR_0");
    if (index == kInvalidIndex)
        return success();
    const GltfAccessor& accessor = accessors_.accessor(index);
    HEARTH_ASSIGN_OR_RETURN(const std::vector<float> floats, values("COLOR_0"));
    const size_t components = componentCount(accessor.type);
    const float scale = accessor.normalized || accessor.component == ComponentType::f32 ? 1.0f
                        : accessor.component == ComponentType::u8                       ? 1.0f / 255.0f
                                                                                        : 1.0f / 65535.0f;
    bool any_repaired = scale != 1.0f;
    const auto channel = [&](size_t i)
    {
        const float value = floats[i] * scale;
        const float inside = value >= 0.0f ? std::min(value, 1.0f) : 0.0f; // NaN becomes 0
        any_repaired = any_repaired || inside != value;
        return inside;
    };
    for (size_t i = 0; i + components <= floats.size(); i += components)
        result.mesh.colors.push_back(
            {channel(i), channel(i + 1), channel(i + 2), components == 4 ? channel(i + 3) : 1.0f});
    if (any_repaired)
        tally_.repaired("vertex colours outside 0 to 1 were clamped", where_);
    return success();
}

Status VertexReader::readInfluences()
{
    for (uint32_t set = 0;; ++set)
    {
        const std::string joints_name = fmt::format("JOINTS_{}", set);
        const std::string weights_name = fmt::format("WEIGHTS_{}", set);
        if (!has(joints_name) || !has(weights_name))
            break;
        HEARTH_ASSIGN_OR_RETURN(const std::vector<float> joints, values(joints_name));
        HEARTH_ASSIGN_OR_RETURN(std::vector<Float4> weights, vectors<Float4>(weights_name));
        std::vector<mesh::Joints4> joint_set(weights.size());
        for (size_t i = 0; i < joint_set.size(); ++i)
            for (size_t k = 0; k < 4; ++k)
                joint_set[i].joint[k] = static_cast<uint16_t>(std::clamp(joints[i * 4 + k], 0.0f, 65535.0f));
        result.mesh.joint_sets.push_back(std::move(joint_set));
        result.mesh.weight_sets.push_back(std::move(weights));
    }
    const InfluenceRepair repair = normalizeInfluences(result.mesh);
    if (repair == InfluenceRepair::invalid)
        tally_.repaired("joint weights that are negative, not finite or all zero were replaced", where_);
    else if (repair == InfluenceRepair::sum)
        tally_.repaired("joint weights whose sum is not 1 were scaled", where_);
    return success();
}

Result<std::vector<Float3>> VertexReader::deltas(const GltfAttributes& target, std::string_view semantic)
{
    const uint32_t index = findAttribute(target, semantic);
    if (index == kInvalidIndex)
        return std::vector<Float3>{};
    // targets and base may both have a POSITION, but only the base sets the count
    HEARTH_TRY(checkCount(index, "target"));
    HEARTH_ASSIGN_OR_RETURN(const std::vector<float> floats, accessors_.floats(index));
    std::vector<Float3> vectors = asVectors<Float3>(floats);
    HEARTH_TRY(checkPositions(index, fmt::format("{} of vertex", semantic), vectors));
    return vectors;
}

Status VertexReader::readTargets()
{
    for (const GltfAttributes& target : primitive_.targets)
    {
        mesh::MorphTarget& morph = result.mesh.morph_targets.emplace_back();
        HEARTH_ASSIGN_OR_RETURN(morph.positions, deltas(target, "POSITION"));
        HEARTH_ASSIGN_OR_RETURN(morph.normals, deltas(target, "NORMAL"));
        HEARTH_ASSIGN_OR_RETURN(morph.tangents, deltas(target, "TANGENT"));
        for (const GltfAttribute& attribute : target)
            if (attribute.semantic != "POSITION" && attribute.semantic != "NORMAL" &&
                attribute.semantic != "TANGENT")
                tally_.dropped(fmt::format("morph target attribute {} is not kept", attribute.semantic),
                               where_);
    }
    return success();
}

/// Report the attributes that no reader above uses.
void VertexReader::reportOthers() const
{
    const size_t sets = result.mesh.joint_sets.size();
    for (const GltfAttribute& attribute : primitive_.attributes)
    {
        const std::string& name = attribute.semantic;
        bool taken = name == "POSITION" || name == "NORMAL" || name == "TANGENT" || name == "COLOR_0";
        for (size_t set = 0; set < mesh::kUvSetCount; ++set)
            taken = taken || name == fmt::format("TEXCOORD_{}", set);
        for (size_t set = 0; set < sets; ++set)
            taken = taken || name == fmt::format("JOINTS_{}", set) || name == fmt::format("WEIGHTS_{}", set);
        if (!taken)
            tally_.dropped(fmt::format("attribute {} is not kept", name), where_);
    }
}

} // namespace

void GltfTally::add(Issue issue, const std::string& what, const std::string& where,
                    const std::string& example)
{
    Entry& entry = entries_[{issue, what}];
    if (entry.count++ > 0)
        return;
    entry.first_where = where;
    entry.first_example = example;
}

void GltfTally::report(PartBuilder& part) const
{
    for (const auto& [key, entry] : entries_)
    {
        std::string text = key.second;
        if (entry.count > 1)
            text += fmt::format(" ({} times)", entry.count);
        if (!entry.first_example.empty())
            text += ": " + entry.first_example;
        part.warn(key.first, entry.first_where, text);
    }
}

uint32_t findAttribute(const GltfAttributes& attributes, std::string_view semantic)
{
    const auto found = std::find_if(attributes.begin(), attributes.end(),
                                    [&](const GltfAttribute& a) { return a.semantic == semantic; });
    return found == attributes.end() ? kInvalidIndex : found->accessor;
}

Result<GltfVertices> readVertices(const GltfPrimitive& primitive, const std::string& where,
                                  GltfAccessors& accessors, const GltfModel& model,
                                  const GltfBuffers& buffers, const GltfContext& context, GltfTally& tally)
{
    VertexReader reader(primitive, where, accessors, tally);
    HEARTH_TRY(reader.checkFormats());
    const uint64_t vertex_count = accessors.accessor(findAttribute(primitive.attributes, "POSITION")).count;
    if (vertex_count > context.options.limits.max_vertices)
        return context.error(Issue::input_too_large, where,
                             describeExcess(vertex_count, "vertices", context.options.limits.max_vertices));
    HEARTH_TRY(reader.decodeCompressed(model, buffers, context));
    HEARTH_TRY(reader.readPositions());
    HEARTH_TRY(reader.readFrame());
    HEARTH_TRY(reader.readUvs());
    HEARTH_TRY(reader.readColors());
    HEARTH_TRY(reader.readInfluences());
    HEARTH_TRY(reader.readTargets());
    reader.reportOthers();
    return std::move(reader.result);
}

} // namespace hearth::import
