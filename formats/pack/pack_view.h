// Gives access to all tables of a part or pack as typed spans, and to its texels and geometry pages. A view
// is safe on any container, but does not check meaning: checkPack and checkTables (formats/pack/pack_check.h)
// do.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/codecs/cluster_bounds.h"
#include "formats/codecs/visibility_code.h"
#include "formats/container/container_reader.h"
#include "formats/records/bricks.h"
#include "formats/records/deformation.h"
#include "formats/records/extras.h"
#include "formats/records/material_layers.h"
#include "formats/records/mesh.h"
#include "formats/records/probe.h"
#include "formats/records/provenance.h"
#include "formats/records/proxy.h"
#include "formats/records/receivers.h"
#include "formats/records/scene.h"
#include "formats/records/specular.h"
#include "formats/records/surroundings.h"

#include <array>
#include <cstring>
#include <optional>

namespace hearth::formats
{

/// Return the records of `range`, or an empty span if it does not lie inside the table.
template <typename T>
std::span<const T> recordsInRange(std::span<const T> table, Range range)
{
    if (range.first > table.size() || range.count > table.size() - range.first)
        return {};
    return table.subspan(range.first, range.count);
}

/// True if [first, first + count) lies inside a table of `size` records.
constexpr bool isInsideTable(Range range, size_t size)
{
    return range.first <= size && range.count <= size - range.first;
}

/// Return the bytes of a texel; 0 for a compressed format and for one that does not exist.
constexpr uint32_t texelBytes(uint32_t format)
{
    const TexelFormatTraits* const traits = findTexelFormat(format);
    return traits == nullptr || traits->family != TexelFamily::plain ? 0 : traits->block_bytes;
}

/// Return texels with their channels reduced from 16 bits to 8.
std::vector<std::byte> narrowTexels(std::span<const std::byte> texels);

/// True if red, green and blue are coded as sRGB.
constexpr bool isSrgb(uint32_t format)
{
    const TexelFormatTraits* const traits = findTexelFormat(format);
    return traits != nullptr && traits->coding == TexelCoding::srgb;
}

/// True if the channels are 16-bit numbers from 0 to 1.
constexpr bool isUnorm16(uint32_t format)
{
    return format == static_cast<uint32_t>(TexelFormat::rgba16_unorm) ||
           format == static_cast<uint32_t>(TexelFormat::rgba16_srgb);
}

struct MipExtent
{
    uint32_t width;
    uint32_t height;
};

/// Return the size of mip `mip` in texels; mip < 32.
constexpr MipExtent mipExtent(const ImageRecord& image, uint32_t mip)
{
    return {std::max(1u, image.width >> mip), std::max(1u, image.height >> mip)};
}

/// Return the first byte of mip `mip` in the image's data; `mip` = mip_count gives the total size. Cannot
/// overflow for images of at most 2^28 texels a side. 0 for a format that does not exist.
constexpr uint64_t mipOffset(const ImageRecord& image, uint32_t mip)
{
    const TexelFormatTraits* const traits = findTexelFormat(image.format);
    uint64_t offset = 0;
    for (uint32_t i = 0; traits != nullptr && i < mip && i < 32; ++i)
        offset += mipBytes(*traits, mipExtent(image, i).width, mipExtent(image, i).height);
    return offset;
}

/// Return the error of a cluster: the error of its refined group, 0 at level 0. The group must be in the
/// table.
inline float clusterError(const ClusterRecord& cluster, std::span<const GroupRecord> groups)
{
    return cluster.refined_group == kInvalidIndex ? 0 : groups[cluster.refined_group].error;
}

/// Vertices and triangles of a cluster in a decoded page, which must outlive it. Vertex and triangle numbers
/// must be in range (contract of the caller); the indices in the data are as in the file, unchecked.
class ClusterGeometry
{
public:
    /// Find a cluster in a page. nullopt if its data does not lie inside the page, its layout does not exist,
    /// or it has more morph targets than its mesh.
    static std::optional<ClusterGeometry> at(std::span<const std::byte> page, const ClusterRecord& cluster,
                                             const MeshRecord& mesh);

    uint32_t vertexCount() const { return vertex_count_; }
    uint32_t triangleCount() const { return triangle_count_; }
    uint32_t layout() const { return layout_; }
    bool has(uint32_t attribute) const { return (layout_ & attribute) != 0; }

    /// Return UV bases, vertices and indices, their zero padding, and the morph section.
    std::span<const std::byte> bytes() const { return data_; }

    uint32_t word(uint32_t vertex, uint32_t word) const
    {
        HEARTH_RUNTIME_ASSERT(vertex < vertex_count_ && word < words_);
        return wordAt(uvBaseWords(layout_) + size_t{vertex} * words_ + word);
    }

    std::array<uint32_t, 3> triangle(uint32_t triangle) const
    {
        HEARTH_RUNTIME_ASSERT(triangle < triangle_count_);
        const size_t first = uvBaseWords(layout_) + size_t{vertex_count_} * words_;
        const auto index = [&](uint32_t corner)
        { return shared::unpackIndex(wordAt(first + corner / 4), corner); };
        return {index(3 * triangle), index(3 * triangle + 1), index(3 * triangle + 2)};
    }

    /// Return the offset from the cluster's base, in grid steps.
    std::array<uint32_t, 3> gridOffset(uint32_t vertex) const
    {
        const uint32_t third = has(kVertexWideOffsets) ? word(vertex, 2) : 0;
        const shared::GridOffset offset =
            shared::unpackPosition(layout_, word(vertex, 0), word(vertex, 1), third);
        return {offset.x, offset.y, offset.z};
    }
    Float3 position(uint32_t vertex) const
    {
        const std::array<uint32_t, 3> offset = gridOffset(vertex);
        Float3 position;
        for (size_t axis = 0; axis < 3; ++axis)
            position[static_cast<int>(axis)] =
                gridToFloat(wrappingAdd(base_[axis], offset[axis]), grid_step_);
        return position;
    }

    /// Require has(attribute), like the accessors below.
    uint32_t normalCode(uint32_t vertex) const
    {
        return shared::normalCode(layout_, word(vertex, attributeWordIndex(kVertexNormal)));
    }
    Float3 normal(uint32_t vertex) const { return decodeNormal(layout_, normalCode(vertex)); }
    Float4 tangent(uint32_t vertex) const
    {
        return decodeTangent(layout_, word(vertex, attributeWordIndex(kVertexTangent)), normal(vertex));
    }
    /// Return the grid point of a UV; the set must not be stored as floats.
    std::array<int32_t, 2> uvPoint(uint32_t vertex, uint32_t set) const
    {
        HEARTH_RUNTIME_ASSERT(uvFractionBits(layout_, set) != 0);
        const uint32_t first = attributeWordIndex(kVertexUv0 << set);
        const uint32_t base = uvBaseWord(layout_, set);
        const uint32_t second = has(kVertexWideOffsets) ? word(vertex, first + 1) : 0;
        const shared::UvOffset offset = shared::unpackUv(layout_, word(vertex, first), second);
        return {wrappingAdd(wordAt(base), offset.u), wrappingAdd(wordAt(base + 1), offset.v)};
    }
    Float2 uv(uint32_t vertex, uint32_t set) const
    {
        const uint32_t first = attributeWordIndex(kVertexUv0 << set);
        if (uvFractionBits(layout_, set) == 0)
            return {std::bit_cast<float>(word(vertex, first)), std::bit_cast<float>(word(vertex, first + 1))};
        const std::array<int32_t, 2> point = uvPoint(vertex, set);
        const float step = uvStep(uvFractionBits(layout_, set));
        return {gridToFloat(point[0], step), gridToFloat(point[1], step)};
    }
    Float4 color(uint32_t vertex) const
    {
        const uint32_t first = attributeWordIndex(kVertexColor);
        return decodeColor(layout_,
                           {word(vertex, first), has(kVertexColor16) ? word(vertex, first + 1) : 0u});
    }

    uint32_t visibilityCode(uint32_t vertex) const
    {
        return word(vertex, attributeWordIndex(kVertexVisibility));
    }
    shared::VisibilityMoments visibility(uint32_t vertex) const
    {
        return shared::decodeVisibility(visibilityCode(vertex), normal(vertex));
    }

    /// Return the number of influences of each vertex: 0, 4 or 8. Those without weight come last, and refer
    /// to joint 0.
    uint32_t influenceCount() const { return influencesPerVertex(layout_); }
    /// Return joints of the mesh's skin, the largest weight first; only the first influenceCount() are valid.
    std::array<uint32_t, 8> joints(uint32_t vertex) const { return influenceHalves(vertex, 0); }
    /// Return the codes of the weights, which add up to 65535.
    std::array<uint32_t, 8> weightCodes(uint32_t vertex) const
    {
        return influenceHalves(vertex, influenceCount() / 2);
    }
    /// Return weightCodes / 65535.
    std::array<float, 8> weights(uint32_t vertex) const
    {
        const std::array<uint32_t, 8> codes = weightCodes(vertex);
        std::array<float, 8> weights{};
        for (size_t i = 0; i < weights.size(); ++i)
            weights[i] = static_cast<float>(codes[i]) / 65535.0f;
        return weights;
    }

    /// Return the number of the mesh's morph targets that move a vertex of the cluster; `i` below counts
    /// them.
    uint32_t morphCount() const { return morph_count_; }
    uint32_t morphTarget(uint32_t i) const { return wordAt(morphWord(shared::morphTargetWord(i))); }
    float morphStep(uint32_t i) const
    {
        return std::bit_cast<float>(wordAt(morphWord(shared::morphStepWord(i))));
    }
    /// Return the change of position and normal for a weight of 1.
    Float3 morphPosition(uint32_t i, uint32_t vertex) const
    {
        const float step = morphStep(i);
        const std::array<uint32_t, 3> words = morphWords(i, vertex);
        return {gridToFloat(formats::morphPosition(words[0]), step),
                gridToFloat(formats::morphPosition(words[1]), step),
                gridToFloat(formats::morphPosition(words[2]), step)};
    }
    Float3 morphNormal(uint32_t i, uint32_t vertex) const
    {
        const std::array<uint32_t, 3> words = morphWords(i, vertex);
        constexpr float kStep = 1 / kMorphNormalSteps;
        return {gridToFloat(formats::morphNormal(words[0]), kStep),
                gridToFloat(formats::morphNormal(words[1]), kStep),
                gridToFloat(formats::morphNormal(words[2]), kStep)};
    }
    std::array<uint32_t, 3> morphWords(uint32_t i, uint32_t vertex) const
    {
        HEARTH_RUNTIME_ASSERT(i < morph_count_ && vertex < vertex_count_);
        const size_t first = morphWord(shared::morphDeltaWord(morph_count_, vertex_count_, i, vertex));
        return {wordAt(first), wordAt(first + 1), wordAt(first + 2)};
    }

private:
    ClusterGeometry() = default;
    std::array<uint32_t, 8> influenceHalves(uint32_t vertex, uint32_t first_word) const
    {
        std::array<uint32_t, 8> halves{};
        const uint32_t first = attributeWordIndex(kVertexInfluences) + first_word;
        for (uint32_t i = 0; i < influenceCount(); ++i)
            halves[i] = shared::unpackInfluence(word(vertex, first + i / 2), i);
        return halves;
    }
    size_t morphWord(size_t word) const
    {
        HEARTH_RUNTIME_ASSERT(morph_count_ > 0);
        return morph_first_ + word;
    }
    uint32_t wordAt(size_t word) const
    {
        uint32_t value;
        std::memcpy(&value, data_.data() + word * 4, sizeof(value));
        return value;
    }
    uint32_t attributeWordIndex(uint32_t attribute) const
    {
        HEARTH_RUNTIME_ASSERT(has(attribute));
        return attributeWord(layout_, attribute);
    }
    /// Wraps around for inconsistent files.
    static int32_t wrappingAdd(uint32_t base, uint32_t offset) { return static_cast<int32_t>(base + offset); }

    std::span<const std::byte> data_;
    std::array<uint32_t, 3> base_{};
    float grid_step_ = 0;
    uint32_t layout_ = 0;
    uint32_t words_ = 0;
    uint32_t vertex_count_ = 0;
    uint32_t triangle_count_ = 0;
    uint32_t morph_count_ = 0;
    size_t morph_first_ = 0; ///< first word of the morph section
};

/// Treatment of chunk PAGE by PackView::read, if the container's chunks have not been hashed.
enum class PageBytes
{
    hashed,
    left, ///< none of its bytes is read: each decoded page has its own hash
};

/// Tables of one container. A missing chunk is an empty table. Spans are valid as long as the view lives.
class PackView
{
public:
    /// Read and decompress the tables. errors: those of ContainerReader::records; chunk_codec for compressed
    /// PAGE.
    static Result<PackView> read(ContainerReader reader, PageBytes page_bytes = PageBytes::hashed);

    /// Check pages when they are decoded from now on, also in copies of the view: decodePage returns an error
    /// unless checkPack accepts the page. The tables must have been checked, by checkTables or another check
    /// of meshes and pages.
    void enablePageChecks();

    const ContainerReader& container() const { return reader_; }
    const std::string& name() const { return reader_.name(); }

    /// Return chunk META: JSON text.
    std::string_view meta() const { return asText(meta_); }
    /// Return the whole chunk STRS.
    std::string_view strings() const { return asText(strings_); }
    /// Return a name; empty if it lies outside the string table.
    std::string_view text(StringRef ref) const;

    /// Return the assets; none in parts.
    std::span<const AssetRecord> assets() const { return assets_.records.span(); }
    std::span<const ExtrasRecord> extras() const { return extras_.records.span(); }
    /// Return the extras of an object as JSON text; empty if it has none. Time: logarithmic.
    std::string_view findExtras(ExtrasOwner owner, uint32_t index) const;
    std::span<const NodeRecord> nodes() const { return nodes_.records.span(); }
    std::span<const InstanceRecord> instances() const { return instances_.records.span(); }
    std::span<const CameraRecord> cameras() const { return cameras_.records.span(); }
    std::span<const LightRecord> lights() const { return lights_.records.span(); }
    std::span<const ShadowSphereRecord> shadowSpheres() const { return shadow_spheres_.records.span(); }
    std::span<const MaterialRecord> materials() const { return materials_.records.span(); }
    /// Return the layers of the materials that have some, sorted by material.
    std::span<const MaterialLayersRecord> materialLayers() const { return material_layers_.records.span(); }
    std::span<const ImageRecord> images() const { return images_.records.span(); }
    /// Return the pieces of the texels of all images, in the order of the images.
    std::span<const TexturePieceRecord> texturePieces() const { return texture_pieces_.records.span(); }
    std::span<const SkinRecord> skins() const { return skins_.records.span(); }
    std::span<const JointRecord> joints() const { return joints_.records.span(); }
    std::span<const AnimationRecord> animations() const { return animations_.records.span(); }
    std::span<const AnimationChannelRecord> channels() const { return channels_.records.span(); }
    std::span<const float> keys() const { return keys_.records.span(); }
    std::span<const uint32_t> keyBits() const { return key_bits_.records.span(); }
    std::span<const float> morphWeights() const { return morph_weights_.records.span(); }
    std::span<const MeshRecord> meshes() const { return meshes_.records.span(); }
    std::span<const LevelRecord> levels() const { return levels_.records.span(); }
    std::span<const GroupRecord> groups() const { return groups_.records.span(); }
    std::span<const ClusterRecord> clusters() const { return clusters_.records.span(); }
    std::span<const PageRecord> pages() const { return pages_.records.span(); }
    std::span<const uint32_t> pageParents() const { return page_parents_.records.span(); }
    std::span<const AuthoredLevelRecord> authoredLevels() const { return authored_levels_.records.span(); }
    std::span<const DeformedMeshRecord> deformedMeshes() const { return deformed_meshes_.records.span(); }
    std::span<const DeformedClusterRecord> deformedClusters() const
    {
        return deformed_clusters_.records.span();
    }
    std::span<const uint32_t> clusterJoints() const { return cluster_joints_.records.span(); }
    /// Return one table or none.
    std::span<const SpecularTableRecord> specularTables() const { return specular_tables_.records.span(); }
    std::span<const ProbeRecord> probes() const { return probes_.records.span(); }
    std::span<const uint32_t> probeTexels() const { return probe_texels_.records.span(); }
    /// Return one atlas or none.
    std::span<const ReceiverAtlasRecord> receiverAtlases() const { return receiver_atlases_.records.span(); }
    /// Return all tables of receivers; without an atlas they are empty.
    ReceiverTables receivers() const
    {
        return {receiverAtlases().empty() ? ReceiverAtlasRecord{} : receiverAtlases()[0],
                receiver_lamps_.records.span(), receiver_rects_.records.span(),
                receiver_blocks_.records.span(), receiver_words_.records.span()};
    }
    /// Return one record or none.
    std::span<const ReceiverAtlasRecord> faceAtlases() const { return face_atlases_.records.span(); }
    /// Return the tables of the faces of bricks that are receivers, with the lamps of `receivers`.
    ReceiverTables faceReceivers() const
    {
        return {faceAtlases().empty() ? ReceiverAtlasRecord{} : faceAtlases()[0],
                receiver_lamps_.records.span(),
                {},
                face_blocks_.records.span(),
                face_words_.records.span()};
    }
    /// Return the proxies of all meshes, sorted by mesh, and the tables that their ranges are of.
    std::span<const ProxyRecord> proxies() const { return proxies_.records.span(); }
    std::span<const ProxySectionRecord> proxySections() const { return proxy_sections_.records.span(); }
    std::span<const Float3> proxyPositions() const { return proxy_positions_.records.span(); }
    std::span<const uint32_t> proxyIndices() const { return proxy_indices_.records.span(); }
    std::span<const ProxyBindingRecord> proxyBindings() const { return proxy_bindings_.records.span(); }

    /// Return the surroundings of each instance; empty if nothing is baked.
    std::span<const SurroundingsRecord> surroundings() const { return surroundings_.records.span(); }
    std::span<const RadianceTransferRecord> radianceTransfers() const
    {
        return radiance_transfers_.records.span();
    }
    /// Return one grid or none.
    std::span<const BrickGridRecord> brickGrid() const { return brick_grid_.records.span(); }
    std::span<const BrickGroupRecord> brickGroupsAlongAxis() const { return brick_groups_.records.span(); }
    std::span<const BrickRecord> bricks() const { return bricks_.records.span(); }
    std::span<const uint8_t> brickOpacity() const { return brick_opacity_.records.span(); }
    std::span<const uint32_t> brickAlbedo() const { return brick_albedo_.records.span(); }
    std::span<const uint16_t> brickNormals() const { return brick_normals_.records.span(); }
    std::span<const uint32_t> brickEmission() const { return brick_emission_.records.span(); }
    std::span<const uint32_t> brickLighting() const { return brick_lighting_.records.span(); }
    /// Return the reflectors of the first lights, or none.
    std::span<const ReflectorRecord> reflectors() const { return reflectors_.records.span(); }

    /// Return chunk PAGE, as stored in the file.
    std::span<const std::byte> pageBytes() const { return page_bytes_.bytes(); }

    /// Return the texels of an image, all mips, finest first. errors: chunk_missing, and those of
    /// ContainerReader::read.
    Result<ChunkData> imageData(uint32_t image) const;

    /// Decode a piece of an image's texels into `out`, of the size of its record. Thread-safe; `out` is only
    /// written. errors: meaning_value, page_hash, chunk_codec.
    /// piece  of texturePieces(), of tables that have been checked
    Status decodePiece(uint32_t piece, std::span<std::byte> out) const;

    /// Return the image that has a piece of texturePieces(). The tables have been checked. Time: logarithmic
    /// in the number of images.
    uint32_t findPieceImage(uint32_t piece) const;

    /// Decode a page into `out`, whose size is the page's. Thread-safe. If pages are checked when they are
    /// read, `out` is only written, from front to back, and not written at all after an error.
    /// errors: meaning_reference, meaning_range, meaning_value, page_hash, chunk_codec; and the errors of its
    /// meaning.
    /// page  of pages(); numbers from there on are the pieces of texturePieces(), as decodePiece
    Status decodePage(uint32_t page, std::span<std::byte> out) const;

    /// Decode a page into a new buffer.
    Result<std::vector<std::byte>> decodePage(uint32_t page) const;

    /// Return the error that decodePage would return. Only if pages are checked when they are read.
    Status checkPage(uint32_t page) const;

private:
    template <typename T>
    struct Table
    {
        uint32_t chunk;
        Records<T> records{};
    };

    explicit PackView(ContainerReader reader) : reader_(std::move(reader)) {}
    Status readTables(PageBytes page_bytes);
    Result<std::span<const std::byte>> storedPage(uint32_t page, size_t size) const;
    Status decodeStored(std::span<const std::byte> stored, uint32_t page, std::span<std::byte> out) const;
    Result<std::span<const std::byte>> decodeAndCheckPage(uint32_t page, size_t size) const;
    static std::string_view asText(const ChunkData& data)
    {
        return {reinterpret_cast<const char*>(data.bytes().data()), data.bytes().size()};
    }

    ContainerReader reader_;
    ChunkData meta_;
    ChunkData strings_;
    Table<AssetRecord> assets_{kChunkAssets};
    Table<ExtrasRecord> extras_{kChunkExtras};
    Table<NodeRecord> nodes_{kChunkNodes};
    Table<InstanceRecord> instances_{kChunkInstances};
    Table<CameraRecord> cameras_{kChunkCameras};
    Table<LightRecord> lights_{kChunkLights};
    Table<ShadowSphereRecord> shadow_spheres_{kChunkShadowSpheres};
    Table<MaterialRecord> materials_{kChunkMaterials};
    Table<MaterialLayersRecord> material_layers_{kChunkMaterialLayers};
    Table<ImageRecord> images_{kChunkImages};
    Table<TexturePieceRecord> texture_pieces_{kChunkTexturePieces};
    Table<SkinRecord> skins_{kChunkSkins};
    Table<JointRecord> joints_{kChunkJoints};
    Table<AnimationRecord> animations_{kChunkAnimations};
    Table<AnimationChannelRecord> channels_{kChunkChannels};
    Table<float> keys_{kChunkKeys};
    Table<uint32_t> key_bits_{kChunkKeyBits};
    Table<float> morph_weights_{kChunkMorphWeights};
    Table<MeshRecord> meshes_{kChunkMeshes};
    Table<LevelRecord> levels_{kChunkLevels};
    Table<GroupRecord> groups_{kChunkGroups};
    Table<ClusterRecord> clusters_{kChunkClusters};
    Table<PageRecord> pages_{kChunkPageTable};
    Table<uint32_t> page_parents_{kChunkPageParents};
    Table<AuthoredLevelRecord> authored_levels_{kChunkAuthoredLevels};
    Table<DeformedMeshRecord> deformed_meshes_{kChunkDeformedMeshes};
    Table<DeformedClusterRecord> deformed_clusters_{kChunkDeformedClusters};
    Table<uint32_t> cluster_joints_{kChunkClusterJoints};
    Table<SpecularTableRecord> specular_tables_{kChunkSpecular};
    Table<ProbeRecord> probes_{kChunkProbes};
    Table<uint32_t> probe_texels_{kChunkProbeTexels};
    Table<ReceiverAtlasRecord> receiver_atlases_{kChunkReceivers};
    Table<ReceiverLampRecord> receiver_lamps_{kChunkReceiverLamps};
    Table<ReceiverRectRecord> receiver_rects_{kChunkReceiverRects};
    Table<ReceiverBlockRecord> receiver_blocks_{kChunkReceiverBlocks};
    Table<uint32_t> receiver_words_{kChunkReceiverWords};
    Table<ReceiverAtlasRecord> face_atlases_{kChunkFaceReceivers};
    Table<ReceiverBlockRecord> face_blocks_{kChunkFaceBlocks};
    Table<uint32_t> face_words_{kChunkFaceWords};
    Table<ProxyRecord> proxies_{kChunkProxies};
    Table<ProxySectionRecord> proxy_sections_{kChunkProxySections};
    Table<Float3> proxy_positions_{kChunkProxyPositions};
    Table<uint32_t> proxy_indices_{kChunkProxyIndices};
    Table<ProxyBindingRecord> proxy_bindings_{kChunkProxyBindings};
    Table<SurroundingsRecord> surroundings_{kChunkSurroundings};
    Table<RadianceTransferRecord> radiance_transfers_{kChunkRadianceTransfers};
    Table<BrickGridRecord> brick_grid_{kChunkBrickGrid};
    Table<BrickGroupRecord> brick_groups_{kChunkBrickGroups};
    Table<BrickRecord> bricks_{kChunkBricks};
    Table<uint8_t> brick_opacity_{kChunkBrickOpacity};
    Table<uint32_t> brick_albedo_{kChunkBrickAlbedo};
    Table<uint16_t> brick_normals_{kChunkBrickNormals};
    Table<uint32_t> brick_emission_{kChunkBrickEmission};
    Table<uint32_t> brick_lighting_{kChunkBrickLighting};
    Table<ReflectorRecord> reflectors_{kChunkReflectors};
    ChunkData page_bytes_;
    /// For each mesh, the number of joints of its skin, for page checks; nullopt if decoding checks no
    /// meaning.
    std::optional<std::vector<uint32_t>> joint_counts_;
};

} // namespace hearth::formats
