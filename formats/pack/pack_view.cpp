// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/pack/pack_view.h"

#include "formats/base/byte_reader.h"
#include "formats/codecs/page_decode.h"
#include "formats/pack/check_tools.h"
#include "formats/records/chunk_list.h"
#include "formats/texels/decoded_texel.h"

#include <algorithm>

namespace hearth::formats
{

std::vector<std::byte> narrowTexels(std::span<const std::byte> texels)
{
    std::vector<std::byte> narrow(texels.size() / 2);
    for (size_t i = 0; i < narrow.size(); ++i)
    {
        uint16_t channel;
        std::memcpy(&channel, texels.data() + i * sizeof(channel), sizeof(channel));
        narrow[i] = std::byte{narrowUnorm(channel)};
    }
    return narrow;
}

std::optional<ClusterGeometry> ClusterGeometry::at(std::span<const std::byte> page,
                                                   const ClusterRecord& cluster, const MeshRecord& mesh)
{
    if (!isLegalLayout(mesh.attributes) || cluster.vertex_count > kMaxClusterVertices ||
        cluster.triangle_count > kMaxClusterTriangles)
        return std::nullopt;
    const uint32_t layout = clusterVertexLayout(cluster, mesh.attributes);
    const uint64_t first = uint64_t{cluster.page_word} * 4;
    const uint64_t size = clusterBytes(layout, cluster.vertex_count, cluster.triangle_count);
    uint32_t morphs = 0;
    uint64_t morph_bytes = 0;
    if (mesh.morph_target_count > 0)
    {
        const auto count = checkedPart(page, first + size, sizeof(morphs));
        if (!count)
            return std::nullopt;
        std::memcpy(&morphs, count->data(), sizeof(morphs));
        if (morphs > mesh.morph_target_count || morphs > kMaxPageBytes)
            return std::nullopt;
        morph_bytes = 4 * morphSectionWords(morphs, cluster.vertex_count);
    }
    const auto data = checkedPart(page, first, size + morph_bytes);
    if (!data)
        return std::nullopt;
    ClusterGeometry geometry;
    geometry.data_ = *data;
    std::copy(std::begin(cluster.base), std::end(cluster.base), geometry.base_.begin());
    geometry.grid_step_ = mesh.grid_step;
    geometry.layout_ = layout;
    geometry.words_ = vertexWords(layout);
    geometry.vertex_count_ = cluster.vertex_count;
    geometry.triangle_count_ = cluster.triangle_count;
    geometry.morph_count_ = morphs;
    geometry.morph_first_ = size / 4;
    return geometry;
}

Result<PackView> PackView::read(ContainerReader reader, PageBytes page_bytes)
{
    PackView view(std::move(reader));
    HEARTH_TRY(view.readTables(page_bytes));
    return view;
}

namespace
{

/// Check the version of a chunk. errors: chunk_version.
Status checkVersion(const ContainerReader& reader, const ChunkEntry& entry)
{
    const ChunkInfo* info = chunkInfo(entry.type);
    if (info == nullptr)
        return success();
    const std::string where = chunkName(entry.type, entry.index);
    if (entry.version != info->version)
        return Error{Issue::chunk_version, reader.name(), where,
                     "version " + std::to_string(entry.version) + ", this reads " +
                         std::to_string(info->version)};
    return success();
}

} // namespace

Status PackView::readTables(PageBytes page_bytes)
{
    for (const ChunkEntry& entry : reader_.chunks())
        HEARTH_TRY(checkVersion(reader_, entry));

    Status status = success();
    const auto read = [&]<typename T>(Table<T>& table)
    {
        if (!status.ok())
            return;
        Result<Records<T>> records = reader_.records<T>(table.chunk);
        if (records.ok())
            table.records = std::move(records).value();
        else
            status = std::move(records).error();
    };
    const auto read_all = [&](auto&... tables) { (read(tables), ...); };
    read_all(assets_, extras_, nodes_, instances_, cameras_, lights_, shadow_spheres_, materials_,
             material_layers_, images_, texture_pieces_, skins_, joints_, animations_, channels_, keys_,
             key_bits_, morph_weights_, meshes_, levels_, groups_, clusters_, pages_, page_parents_,
             authored_levels_, deformed_meshes_, deformed_clusters_, cluster_joints_, specular_tables_,
             probes_, probe_texels_, receiver_atlases_, receiver_lamps_, receiver_rects_, receiver_blocks_,
             receiver_words_, face_atlases_, face_blocks_, face_words_, proxies_, proxy_sections_,
             proxy_positions_, proxy_indices_, proxy_bindings_, surroundings_, radiance_transfers_,
             brick_grid_, brick_groups_, bricks_, brick_opacity_, brick_albedo_, brick_normals_,
             brick_emission_, brick_lighting_, reflectors_);
    HEARTH_TRY(status);
    HEARTH_ASSIGN_OR_RETURN(meta_, reader_.read(kChunkMeta));
    HEARTH_ASSIGN_OR_RETURN(strings_, reader_.read(kChunkStrings));

    // pages are read one by one from the file, each with its own codec
    const ChunkEntry* pages = reader_.find(kChunkPages);
    if (pages != nullptr && pages->codec != static_cast<uint32_t>(Codec::none))
        return Error{Issue::chunk_codec, name(), chunkName(kChunkPages, 0),
                     "the chunk of the pages is compressed"};
    if (page_bytes == PageBytes::hashed)
    {
        HEARTH_ASSIGN_OR_RETURN(page_bytes_, reader_.read(kChunkPages));
    }
    else if (pages != nullptr)
        page_bytes_ = ChunkData(reader_.stored(*pages), nullptr); // the reader owns the memory
    return success();
}

std::string_view PackView::text(StringRef ref) const
{
    return isInsideTable({ref.offset, ref.length}, strings().size())
               ? strings().substr(ref.offset, ref.length)
               : std::string_view();
}

std::string_view PackView::findExtras(ExtrasOwner owner, uint32_t index) const
{
    const uint64_t key = makeExtrasKey(static_cast<uint32_t>(owner), index);
    const auto makeKey = [](const ExtrasRecord& record) { return makeExtrasKey(record.owner, record.index); };
    const auto found = std::lower_bound(extras().begin(), extras().end(), key,
                                        [&](const ExtrasRecord& record, uint64_t wanted)
                                        { return makeKey(record) < wanted; });
    return found != extras().end() && makeKey(*found) == key ? text(found->json) : std::string_view();
}

Result<ChunkData> PackView::imageData(uint32_t image) const
{
    if (reader_.find(kChunkImageData, image) == nullptr)
        return Error{Issue::chunk_missing, name(), chunkName(kChunkImageData, image), ""};
    return reader_.read(kChunkImageData, image);
}

uint32_t PackView::findPieceImage(uint32_t piece) const
{
    const auto after =
        std::ranges::upper_bound(images(), piece, {}, [](const ImageRecord& i) { return i.pieces.first; });
    return static_cast<uint32_t>(after - images().begin()) - 1;
}

Status PackView::decodePiece(uint32_t piece, std::span<std::byte> out) const
{
    const uint32_t image = findPieceImage(piece);
    const std::string where = "piece " + std::to_string(piece) + ", of image " + std::to_string(image);
    const TexturePieceRecord& record = texturePieces()[piece];
    if (record.size != out.size())
        return Error{Issue::meaning_value, name(), where, "a size of " + std::to_string(record.size)};
    const std::span<const std::byte> chunk = reader_.stored(*reader_.find(kChunkImageData, image));
    const std::span<const std::byte> stored =
        chunk.subspan(static_cast<size_t>(record.offset), record.stored_size);
    if (hashBytes(stored) != record.hash)
        return Error{Issue::page_hash, name(), where, ""};
    if (!decompress(stored, out))
        return Error{Issue::chunk_codec, name(), where, ""};
    return success();
}

/// Return the stored bytes of a page, their hash checked; `size` is the size after decoding.
Result<std::span<const std::byte>> PackView::storedPage(uint32_t page, size_t size) const
{
    const std::string where = "page " + std::to_string(page);
    if (page >= pages().size())
        return Error{Issue::meaning_reference, name(), where,
                     "there are " + std::to_string(pages().size()) + " pages"};
    const PageRecord& record = pages()[page];
    if (record.size != size || record.size > kMaxPageBytes)
        return Error{Issue::meaning_value, name(), where, "a size of " + std::to_string(record.size)};
    const auto stored = checkedPart(pageBytes(), record.offset, record.stored_size);
    if (!stored)
        return Error{Issue::meaning_range, name(), where, "the page lies outside chunk PAGE"};
    if (hashBytes(*stored) != record.hash)
        return Error{Issue::page_hash, name(), where, ""};
    return *stored;
}

Status PackView::decodeStored(std::span<const std::byte> stored, uint32_t page,
                              std::span<std::byte> out) const
{
    const PageRecord& record = pages()[page];
    const auto decode = [&]
    {
        switch (static_cast<PageCodec>(record.codec))
        {
        case PageCodec::none:
            if (stored.size() != out.size())
                return false;
            std::copy(stored.begin(), stored.end(), out.begin());
            return true;
        case PageCodec::zstd:
            return decompress(stored, out);
        case PageCodec::clusters:
            break;
        default:
            return false;
        }
        if (record.mesh >= meshes().size() || !isLegalLayout(meshes()[record.mesh].attributes))
            return false;
        thread_local PageDecoder decoder;
        return decoder.decode(stored, recordsInRange(clusters(), record.clusters),
                              meshes()[record.mesh].attributes, out);
    };
    if (!decode())
        return Error{Issue::chunk_codec, name(), "page " + std::to_string(page), ""};
    return success();
}

/// Decode and check a page in memory of the thread, valid until the next call. The caller gets exactly the
/// checked bytes, even if the file changes meanwhile, and memory of a device, which is slow to read, is never
/// read.
Result<std::span<const std::byte>> PackView::decodeAndCheckPage(uint32_t page, size_t size) const
{
    HEARTH_ASSIGN_OR_RETURN(const std::span<const std::byte> stored, storedPage(page, size));
    thread_local std::vector<std::byte> memory(kMaxPageBytes);
    const std::span<std::byte> decoded = std::span(memory).first(size);
    HEARTH_TRY(decodeStored(stored, page, decoded));
    HEARTH_TRY(check::checkPage(*this, page, decoded, (*joint_counts_)[pages()[page].mesh]));
    return std::span<const std::byte>(decoded);
}

void PackView::enablePageChecks()
{
    joint_counts_ = check::jointCounts(*this);
}

Status PackView::decodePage(uint32_t page, std::span<std::byte> out) const
{
    if (page >= pages().size() && page - pages().size() < texturePieces().size())
        return decodePiece(page - static_cast<uint32_t>(pages().size()), out);
    if (joint_counts_)
    {
        HEARTH_ASSIGN_OR_RETURN(const std::span<const std::byte> decoded,
                                decodeAndCheckPage(page, out.size()));
        std::copy(decoded.begin(), decoded.end(), out.begin());
        return success();
    }
    HEARTH_ASSIGN_OR_RETURN(const std::span<const std::byte> stored, storedPage(page, out.size()));
    return decodeStored(stored, page, out);
}

Status PackView::checkPage(uint32_t page) const
{
    HEARTH_ASSERT(joint_counts_ && page < pages().size());
    HEARTH_TRY(decodeAndCheckPage(page, pages()[page].size));
    return success();
}

Result<std::vector<std::byte>> PackView::decodePage(uint32_t page) const
{
    const bool legal = page < pages().size() && pages()[page].size <= kMaxPageBytes;
    std::vector<std::byte> bytes(legal ? pages()[page].size : 0);
    HEARTH_TRY(decodePage(page, bytes));
    return bytes;
}

} // namespace hearth::formats
