// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/export/meshes.h"

#include "pipelines/export/accessors.h"
#include "pipelines/export/cut.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <unordered_set>

namespace hearth::gltf_export
{

using namespace formats;

namespace
{

constexpr uint32_t kUvSets = 4;

/// Vertices of one material as rows of words, each row once, and the triangles that use them.
class VertexTable
{
public:
    explicit VertexTable(size_t words) : words_(words), known_(0, RowHash{this}, RowEqual{this}) {}

    /// Add a row, or find it. Returns its number.
    uint32_t add(std::span<const uint32_t> row)
    {
        rows_.insert(rows_.end(), row.begin(), row.end());
        const auto [found, is_new] = known_.insert(static_cast<uint32_t>(rows_.size() / words_ - 1));
        if (!is_new)
            rows_.resize(rows_.size() - words_);
        return *found;
    }

    /// Return `count` words from `first` on of each row.
    std::vector<uint32_t> column(size_t first, size_t count) const
    {
        std::vector<uint32_t> words;
        words.reserve(rows_.size() / words_ * count);
        for (size_t row = 0; row < rows_.size(); row += words_)
            words.insert(words.end(), rows_.begin() + static_cast<std::ptrdiff_t>(row + first),
                         rows_.begin() + static_cast<std::ptrdiff_t>(row + first + count));
        return words;
    }

    std::vector<uint32_t> indices;

private:
    std::span<const uint32_t> row(uint32_t number) const
    {
        return std::span(rows_).subspan(number * words_, words_);
    }
    struct RowHash
    {
        const VertexTable* table;
        size_t operator()(uint32_t number) const
        {
            const auto bytes = std::as_bytes(table->row(number));
            return std::hash<std::string_view>()({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        }
    };
    struct RowEqual
    {
        const VertexTable* table;
        bool operator()(uint32_t a, uint32_t b) const
        {
            return std::memcmp(table->row(a).data(), table->row(b).data(), table->words_ * 4) == 0;
        }
    };

    size_t words_;
    std::vector<uint32_t> rows_;
    std::unordered_set<uint32_t, RowHash, RowEqual> known_;
};

/// Places of the attributes in a row.
struct RowLayout
{
    explicit RowLayout(const MeshRecord& mesh)
        : attributes(mesh.attributes),
          influences(influencesPerVertex(mesh.attributes)),
          targets(mesh.morph_target_count)
    {
        const auto place = [&](uint32_t attribute, size_t count)
        {
            const size_t first = words;
            words += (attributes & attribute) != 0 ? count : 0;
            return first;
        };
        words = 3;
        normal = place(kVertexNormal, 3);
        tangent = place(kVertexTangent, 4);
        for (uint32_t set = 0; set < kUvSets; ++set)
            uv[set] = place(kVertexUv0 << set, 2);
        color = place(kVertexColor, 4);
        joints = place(kVertexInfluences, influences);
        weights = place(kVertexInfluences, influences);
        morph = words;
        morph_words = has(kVertexNormal) ? 6 : 3;
        words += targets * morph_words;
    }

    bool has(uint32_t attribute) const { return (attributes & attribute) != 0; }

    uint32_t attributes;
    uint32_t influences; ///< of a vertex
    uint32_t targets;
    size_t normal, tangent, color, joints, weights, morph;
    size_t uv[kUvSets];
    size_t morph_words; ///< of a target
    size_t words;
};

void setFloats(std::span<uint32_t> row, size_t first, std::initializer_list<float> values)
{
    for (const float value : values)
        row[first++] = std::bit_cast<uint32_t>(value);
}

/// Set joints and weights. glTF wants each joint once.
void setInfluences(std::span<uint32_t> row, const RowLayout& layout, const ClusterGeometry& geometry,
                   uint32_t vertex)
{
    const std::array<uint32_t, 8> joints = geometry.joints(vertex);
    const std::array<uint32_t, 8> codes = geometry.weightCodes(vertex);
    uint32_t count = 0;
    const auto joint_row = row.subspan(layout.joints), weight_row = row.subspan(layout.weights);
    for (uint32_t i = 0; i < layout.influences; ++i)
    {
        if (codes[i] == 0)
            continue;
        uint32_t at = 0;
        while (at < count && joint_row[at] != joints[i])
            ++at;
        count = std::max(count, at + 1);
        joint_row[at] = joints[i];
        weight_row[at] += codes[i];
    }
}

std::vector<uint32_t> vertexRow(const RowLayout& layout, const ClusterGeometry& geometry, uint32_t vertex)
{
    std::vector<uint32_t> row(layout.words);
    const Float3 position = geometry.position(vertex);
    setFloats(row, 0, {position.x, position.y, position.z});
    if (layout.has(kVertexNormal))
    {
        const Float3 normal = geometry.normal(vertex);
        setFloats(row, layout.normal, {normal.x, normal.y, normal.z});
    }
    if (layout.has(kVertexTangent))
    {
        const Float4 tangent = geometry.tangent(vertex);
        setFloats(row, layout.tangent, {tangent.x, tangent.y, tangent.z, tangent.w});
    }
    for (uint32_t set = 0; set < kUvSets; ++set)
        if (layout.has(kVertexUv0 << set))
        {
            const Float2 uv = geometry.uv(vertex, set);
            setFloats(row, layout.uv[set], {uv.x, uv.y});
        }
    if (layout.has(kVertexColor))
    {
        const Float4 color = geometry.color(vertex);
        setFloats(row, layout.color, {color.x, color.y, color.z, color.w});
    }
    if (layout.influences > 0)
        setInfluences(row, layout, geometry, vertex);
    for (uint32_t i = 0; i < geometry.morphCount(); ++i)
    {
        const size_t first = layout.morph + geometry.morphTarget(i) * layout.morph_words;
        const Float3 position_delta = geometry.morphPosition(i, vertex);
        setFloats(row, first, {position_delta.x, position_delta.y, position_delta.z});
        if (!layout.has(kVertexNormal))
            continue;
        const Float3 normal_delta = geometry.morphNormal(i, vertex);
        setFloats(row, first + 3, {normal_delta.x, normal_delta.y, normal_delta.z});
    }
    return row;
}

/// Makes a primitive of a table.
class PrimitiveWriter
{
public:
    PrimitiveWriter(GltfDocument& document, const RowLayout& layout, const VertexTable& table)
        : document_(document), layout_(layout), table_(table)
    {
    }

    Primitive write(uint32_t material)
    {
        Primitive primitive;
        primitive.material = material;
        primitive.indices = addIndices(document_, table_.indices);
        Attributes& attributes = primitive.attributes;
        attributes["POSITION"] = floats(0, ElementType::vec3, 3, Extremes::stated);
        if (layout_.has(kVertexNormal))
            attributes["NORMAL"] = floats(layout_.normal, ElementType::vec3, 3);
        if (layout_.has(kVertexTangent))
            attributes["TANGENT"] = floats(layout_.tangent, ElementType::vec4, 4);
        uint32_t sets = 0;
        for (uint32_t set = 0; set < kUvSets; ++set)
            if (layout_.has(kVertexUv0 << set))
                sets = set + 1;
        // sets of a file follow each other: one that the mesh lacks is 0
        for (uint32_t set = 0; set < sets; ++set)
            attributes[fmt::format("TEXCOORD_{}", set)] =
                layout_.has(kVertexUv0 << set) ? floats(layout_.uv[set], ElementType::vec2, 2) : zeroUvs();
        if (layout_.has(kVertexColor))
            attributes["COLOR_0"] = floats(layout_.color, ElementType::vec4, 4);
        for (uint32_t set = 0; set * 4 < layout_.influences; ++set)
        {
            attributes[fmt::format("JOINTS_{}", set)] = shorts(layout_.joints + 4 * set, false);
            attributes[fmt::format("WEIGHTS_{}", set)] = shorts(layout_.weights + 4 * set, true);
        }
        for (uint32_t target = 0; target < layout_.targets; ++target)
        {
            const size_t first = layout_.morph + target * layout_.morph_words;
            Attributes& deltas = primitive.targets.emplace_back();
            deltas["POSITION"] = floats(first, ElementType::vec3, 3, Extremes::stated);
            if (layout_.has(kVertexNormal))
                deltas["NORMAL"] = floats(first + 3, ElementType::vec3, 3);
        }
        return primitive;
    }

private:
    uint32_t floats(size_t first, ElementType type, size_t count, Extremes extremes = Extremes::none)
    {
        const std::vector<uint32_t> words = table_.column(first, count);
        std::vector<float> values(words.size());
        std::memcpy(values.data(), words.data(), words.size() * 4);
        return addFloats(document_, values, type, ViewTarget::vertices, extremes);
    }
    uint32_t zeroUvs()
    {
        const std::vector<float> zeros(table_.column(0, 2).size());
        return addFloats(document_, zeros, ElementType::vec2, ViewTarget::vertices);
    }
    uint32_t shorts(size_t first, bool is_normalized)
    {
        const std::vector<uint32_t> words = table_.column(first, 4);
        return addShorts(document_, std::vector<uint16_t>(words.begin(), words.end()), is_normalized);
    }

    GltfDocument& document_;
    const RowLayout& layout_;
    const VertexTable& table_;
};

} // namespace

bool isDeformed(const MeshRecord& mesh)
{
    return mesh.skinned != 0 || mesh.morph_target_count != 0;
}

Result<uint32_t> addMesh(GltfDocument& document, const PackView& pack, uint32_t mesh, float error)
{
    const MeshRecord& record = pack.meshes()[mesh];
    const RowLayout layout(record);
    std::map<uint32_t, std::unique_ptr<VertexTable>> tables; // of each material
    PageCache pages(pack);
    for (const uint32_t index : findCutClusters(pack, record, error))
    {
        const ClusterRecord& cluster = pack.clusters()[index];
        HEARTH_ASSIGN_OR_RETURN(const ClusterGeometry geometry, pages.clusterGeometry(cluster, record));
        auto& table = tables[cluster.material];
        if (!table)
            table = std::make_unique<VertexTable>(layout.words);
        std::vector<uint32_t> numbers(geometry.vertexCount());
        for (uint32_t v = 0; v < geometry.vertexCount(); ++v)
            numbers[v] = table->add(vertexRow(layout, geometry, v));
        for (uint32_t t = 0; t < geometry.triangleCount(); ++t)
            for (const uint32_t corner : geometry.triangle(t))
                table->indices.push_back(numbers[corner]);
    }
    if (tables.empty())
        return kInvalidIndex;
    Mesh result{std::string(pack.text(record.name)), {}};
    for (const auto& [material, table] : tables)
        result.primitives.push_back(PrimitiveWriter(document, layout, *table).write(material));
    document.meshes.push_back(std::move(result));
    return static_cast<uint32_t>(document.meshes.size() - 1);
}

} // namespace hearth::gltf_export
