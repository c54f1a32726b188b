// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/format_tables.h"

#include "formats/base/issues.h"
#include "formats/codecs/page_codec.h"
#include "formats/pack/pack_check.h"
#include "formats/records/animation_paths.h"
#include "formats/records/chunk_list.h"

#include <array>
#include <cstdio>
#include <span>

namespace hearth::formats
{

namespace
{

// records that are no table of their own, besides those of the chunks
constexpr std::array kPartRecords{
    recordInfo<FileHeader>(),       recordInfo<ChunkEntry>(),
    recordInfo<StringRef>(),        recordInfo<Range>(),
    recordInfo<TextureRef>(),       recordInfo<PageHeader>(),
    recordInfo<SourceMeshHeader>(), recordInfo<SourceArray>(),
};

std::vector<RecordInfo> allRecords()
{
    std::vector<RecordInfo> records(kPartRecords.begin(), kPartRecords.end());
    for (const ChunkInfo& chunk : kChunkList)
        if (!chunk.record.name.empty())
            records.push_back(chunk.record);
    return records;
}

struct Value
{
    std::string_view name;
    uint32_t value;
    std::string meaning;
};

struct ValueTable
{
    std::string_view name;
    std::vector<Value> values;
};

template <typename T>
Value value(std::string_view name, T number, std::string_view meaning = "")
{
    return {name, static_cast<uint32_t>(number), std::string(meaning)};
}

std::vector<Value> listExtrasOwners()
{
    std::vector<Value> values;
    for (uint32_t owner = 0; owner < kExtrasOwnerNames.size(); ++owner)
        values.push_back({kExtrasOwnerNames[owner], owner, ""});
    values[static_cast<size_t>(ExtrasOwner::asset)].meaning = "of the source's asset object";
    values[static_cast<size_t>(ExtrasOwner::scene)].meaning = "of the source's scene that is drawn";
    values[static_cast<size_t>(ExtrasOwner::file)].meaning = "of the source's document";
    return values;
}

std::vector<Value> listAnimationPaths()
{
    std::vector<Value> values;
    for (const AnimationPathInfo& info : kAnimationPaths)
        values.push_back(value(info.name, info.path, info.meaning));
    return values;
}

std::vector<Value> listProxyOrigins()
{
    constexpr std::array<std::string_view, kProxyOriginNames.size()> kMeanings{
        "the mesh itself, repaired and decimated", "a closed surface around the mesh",
        "a mesh that an artist made for it"};
    std::vector<Value> values;
    for (uint32_t origin = 0; origin < kProxyOriginNames.size(); ++origin)
        values.push_back({kProxyOriginNames[origin], origin, std::string(kMeanings[origin])});
    return values;
}

std::vector<Value> listTexelFormats()
{
    std::vector<Value> values;
    for (uint32_t format = 0; format < kTexelFormatEnd; ++format)
        if (const TexelFormatTraits* const traits = findTexelFormat(format))
        {
            std::string meaning = std::to_string(traits->block_bytes) + " bytes";
            if (traits->family != TexelFamily::plain)
                meaning += " for " + std::to_string(traits->block_width) + " x " +
                           std::to_string(traits->block_height) + " texels";
            if (!isPackFormat(format))
                meaning += isFileFormat(traits->format) ? "; texture files only" : "; parts only";
            values.push_back({traits->name, format, meaning});
        }
    return values;
}

std::vector<ValueTable> valueTables()
{
    return {
        {"Codec",
         {value("none", Codec::none, "the bytes as they are"), value("zstd", Codec::zstd, "one zstd frame"),
          value("zstd_frames", Codec::zstd_frames, "zstd frames one after another")}},
        {"InstanceFlags",
         {value("mirrored", kInstanceMirrored, "the determinant of world_from_object is negative")}},
        {"CameraType",
         {value("perspective", CameraType::perspective), value("orthographic", CameraType::orthographic)}},
        {"LightType",
         {value("directional", LightType::directional), value("point", LightType::point),
          value("spot", LightType::spot)}},
        {"Wrap",
         {value("repeat", Wrap::repeat), value("mirrored repeat", Wrap::mirrored_repeat),
          value("clamp to edge", Wrap::clamp_to_edge)}},
        {"AlphaMode",
         {value("opaque", AlphaMode::opaque), value("mask", AlphaMode::mask, "cut at alpha_cutoff"),
          value("blend", AlphaMode::blend)}},
        {"ExtrasOwner", listExtrasOwners()},
        {"MaterialFlags",
         {value("double-sided", kMaterialDoubleSided),
          value("unlit", kMaterialUnlit, "KHR_materials_unlit")}},
        {"TexelFormat", listTexelFormats()},
        {"ImageRole",
         {value("none", ImageRole::none, "parts of import only"), value("color", ImageRole::color),
          value("cutout", ImageRole::cutout, "alpha is the opacity"), value("emissive", ImageRole::emissive),
          value("data", ImageRole::data),
          value("normal", ImageRole::normal, "x and y; z is the rest of a unit vector"),
          value("light", ImageRole::light)}},
        {"Swizzle",
         {value("identity", Swizzle::identity), value("zero", Swizzle::zero), value("one", Swizzle::one),
          value("red", Swizzle::red), value("green", Swizzle::green), value("blue", Swizzle::blue),
          value("alpha", Swizzle::alpha)}},
        {"ImageFlags",
         {value("placeholder", kImagePlaceholder, "stands for an image that could not be read"),
          value("normal map", kImageNormalMap, "mips are averaged as directions"),
          value("alpha-tested", kImageAlphaTested, "mips keep the covered area at alpha_cutoff")}},
        {"AnimationPath", listAnimationPaths()},
        {"KeyEncoding",
         {value("floats", KeyEncoding::floats, "times and values as floats"),
          value("packed", KeyEncoding::packed, "codes in a stream of bits")}},
        {"Interpolation",
         {value("step", Interpolation::step),
          value("linear", Interpolation::linear, "rotations: along the arc"),
          value("cubic spline", Interpolation::cubic_spline, "in-tangent, value, out-tangent for each key")}},
        {"VertexAttributes",
         {value("normal", kVertexNormal, "octahedral, 2 x snorm8"),
          value("tangent", kVertexTangent, "angle about the normal, 7 bits, and the flip of the bitangent"),
          value("UV 0", kVertexUv0, "on a grid, or 2 x f32"), value("UV 1", kVertexUv1, "the same"),
          value("UV 2", kVertexUv2, "the same"), value("UV 3", kVertexUv3, "the same"),
          value("colour", kVertexColor, "4 x unorm8, linear RGBA"),
          value("visibility", kVertexVisibility, "moments of what the vertex sees, beside a normal"),
          value("fine normal", kVertexNormal16, "the normal is 2 x snorm16, the tangent's angle 15 bits"),
          value("fine colour", kVertexColor16, "the colour is 4 x unorm16"),
          value("wide", kVertexWideOffsets, "of a cluster only: offsets on grids are u32"),
          value("influences", kVertexInfluences, "4 x u16 joints, then 4 x unorm16 weights"),
          value("more influences", kVertexInfluences8, "8 joints, then 8 weights")}},
        {"PageCodec",
         {value("none", PageCodec::none, "the decoded bytes"),
          value("zstd", PageCodec::zstd, "one zstd frame of them"),
          value("clusters", PageCodec::clusters,
                "a PageHeader and streams, the first of them in a zstd frame")}},
        {"SourceSemantic",
         {value("position", SourceSemantic::position, "f32[3]"),
          value("normal", SourceSemantic::normal, "f32[3], unit"),
          value("tangent", SourceSemantic::tangent, "f32[4], w = +-1: sign of the bitangent"),
          value("uv", SourceSemantic::uv, "f32[2], set 0..3"),
          value("color", SourceSemantic::color, "f32[4], linear"),
          value("joints", SourceSemantic::joints, "u16[4]; joint of the skin"),
          value("weights", SourceSemantic::weights, "f32[4]; the sum over the sets is 1"),
          value("index", SourceSemantic::index, "u32, three for each triangle"),
          value("triangle_material", SourceSemantic::triangle_material, "u32 for each triangle, or none"),
          value("morph_position", SourceSemantic::morph_position, "f32[3] deltas, set = target"),
          value("morph_normal", SourceSemantic::morph_normal, "f32[3] deltas, set = target"),
          value("morph_tangent", SourceSemantic::morph_tangent, "f32[3] deltas, set = target")}},
        {"ProxyOrigin", listProxyOrigins()},
        {"SpecularMasking",
         {value("separable", SpecularMasking::separable, "G1(view) G1(light)"),
          value("correlated", SpecularMasking::correlated, "height-correlated: that of the runtime's BRDF")}},
        {"SpecularSpacing",
         {value("cosine", SpecularSpacing::cosine, "uniform in cos(beta)"),
          value("half sine", SpecularSpacing::half_sine, "uniform in 1 - sin(beta / 2)")}},
    };
}

std::string fourCCText(uint32_t type)
{
    std::string text;
    for (int i = 0; i < 4; ++i)
        text += static_cast<char>(type >> (8 * i));
    return text;
}

/// Return the type with its array size: "u32[]" becomes "u32[3]".
std::string typeText(const Field& field)
{
    std::string type(field.type);
    if (!type.ends_with("[]"))
        return type;
    const size_t element = type.starts_with("u8") ? 1 : type.starts_with("u16") ? 2 : 4;
    return type.substr(0, type.size() - 1) + std::to_string(field.size / element) + "]";
}

std::string row(std::initializer_list<std::string_view> cells)
{
    std::string text = "|";
    for (const std::string_view cell : cells)
        text.append(" ").append(cell).append(" |");
    return text.append("\n");
}

std::string recordTable(const RecordInfo& record)
{
    std::string text = "`";
    text.append(record.name).append("`, ").append(std::to_string(record.size)).append(" bytes\n\n");
    text += "| offset | size | field | type | meaning |\n|---:|---:|---|---|---|\n";
    for (const Field& field : record.fields)
        text += row({std::to_string(field.offset), std::to_string(field.size), field.name, typeText(field),
                     field.note});
    return text;
}

std::string valueTable(const ValueTable& table)
{
    std::string text = row({table.name, "value", "meaning"}) + "|---|---:|---|\n";
    for (const Value& entry : table.values)
        text += row({entry.name, std::to_string(entry.value), entry.meaning});
    return text;
}

std::string contentText(const ChunkInfo& chunk)
{
    return chunk.record.name.empty() ? std::string(chunk.content) : std::string(chunk.record.name) + "[]";
}

std::string chunkTable()
{
    std::string text = "| chunk | version | content | meaning |\n|---|---:|---|---|\n";
    for (const ChunkInfo& chunk : kChunkList)
        text += row({fourCCText(chunk.type) + (chunk.one_per_index ? " i" : ""),
                     std::to_string(chunk.version), contentText(chunk), chunk.meaning});
    return text;
}

std::string_view className(IssueClass kind)
{
    switch (kind)
    {
    case IssueClass::warning:
        return "warning";
    case IssueClass::usage:
        return "usage, 2";
    case IssueClass::malformed:
        return "malformed, 65";
    case IssueClass::missing:
        return "missing, 66";
    case IssueClass::internal:
        return "internal, 70";
    case IssueClass::cannotWrite:
        return "cannot write, 73";
    case IssueClass::io:
        return "I/O, 74";
    case IssueClass::temporary:
        return "temporary, 75";
    case IssueClass::config:
        return "settings, 78";
    }
    return "";
}

std::string issueTable()
{
    std::string text = "| number | name | class, exit code | what is wrong |\n|---:|---|---|---|\n";
    for (const IssueInfo& info : allIssues())
        text += row({std::to_string(static_cast<unsigned>(info.issue)), info.name, className(info.kind),
                     info.summary});
    return text;
}

std::string scientific(double number)
{
    char text[32];
    std::snprintf(text, sizeof(text), "%.0e", number);
    return text;
}

std::string limitTable()
{
    const std::pair<std::string_view, std::string> rows[] = {
        {"bytes of a table, decoded", std::to_string(kMaxTableBytes)},
        {"bytes of all compressed tables, decoded, whatever they hold",
         std::to_string(kMaxUniformTableBytes)},
        {"bytes beyond, for each stored byte of them", std::to_string(kMaxBytesPerStoredByte)},
        {"triangles of a cluster", std::to_string(kMaxClusterTriangles)},
        {"vertices of a cluster", std::to_string(kMaxClusterVertices)},
        {"bytes of a decoded page", std::to_string(kMaxPageBytes)},
        {"texels of an image's side", std::to_string(kMaxImageSize)},
        {"voxels along an axis of a grid of bricks", std::to_string(kMaxGridVoxels)},
        {"groups of a grid of bricks", std::to_string(kMaxBrickGroups)},
        {"solid voxels of a grid of bricks", std::to_string(kMaxBrickVoxels)},
        {"faces of a grid of bricks", std::to_string(kMaxBrickFaces)},
        {"slack of spheres", scientific(kSphereSlack)},
        {"slack of normal cones", scientific(kConeSlack)},
        {"slack of apexes", scientific(kApexSlack)},
        {"slack of unit vectors", scientific(kUnitSlack)},
    };
    std::string text = "| limit | value |\n|---|---:|\n";
    for (const auto& [name, number] : rows)
        text += row({name, number});
    return text;
}

} // namespace

std::optional<std::string> formatTable(std::string_view name)
{
    if (name == "chunks")
        return chunkTable();
    if (name == "issues")
        return issueTable();
    if (name == "limits")
        return limitTable();
    for (const RecordInfo& record : allRecords())
        if (record.name == name)
            return recordTable(record);
    for (const ValueTable& table : valueTables())
        if (table.name == name)
            return valueTable(table);
    return std::nullopt;
}

std::vector<std::string_view> formatTableNames()
{
    std::vector<std::string_view> names = {"chunks", "issues", "limits"};
    for (const RecordInfo& record : allRecords())
        names.push_back(record.name);
    for (const ValueTable& table : valueTables())
        names.push_back(table.name);
    return names;
}

std::string regenerateTables(std::string_view document)
{
    constexpr std::string_view kBegin = "<!-- table ", kClose = " -->\n", kEnd = "<!-- end -->";
    std::string fresh;
    for (;;)
    {
        const size_t begin = document.find(kBegin);
        const size_t close = begin == std::string_view::npos ? begin : document.find(kClose, begin);
        const size_t end = close == std::string_view::npos ? close : document.find(kEnd, close);
        if (end == std::string_view::npos)
            return fresh.append(document);
        const size_t name = begin + kBegin.size();
        fresh += document.substr(0, close + kClose.size());
        fresh += formatTable(document.substr(name, close - name)).value_or("");
        document.remove_prefix(end);
    }
}

} // namespace hearth::formats
