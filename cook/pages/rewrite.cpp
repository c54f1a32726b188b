// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/pages/rewrite.h"

#include "cook/pages/page_encode.h"
#include "formats/base/assert.h"
#include "formats/codecs/cluster_bounds.h"
#include "formats/codecs/page_codec.h"
#include "formats/container/container_writer.h"
#include "formats/pack/pack_check.h"

#include <zstd.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <vector>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace hearth::pages
{

using namespace formats;

namespace
{

/// Pages of a batch, enough for many threads: four megabytes decoded.
constexpr uint32_t kBatchPages = 64;

/// Copy a cluster from a decoded page. The bytes between its triangles and `end`, where the next cluster
/// begins, are its morph section.
CodedCluster copyCluster(std::span<const std::byte> page, const ClusterRecord& cluster, uint32_t layout,
                         size_t end)
{
    CodedCluster coded;
    const std::byte* at = page.data() + size_t{cluster.page_word} * 4;
    const auto take = [&](auto& values, size_t count)
    {
        if (count == 0)
            return; // an empty vector has no memory to copy to
        values.resize(count);
        std::memcpy(values.data(), at, count * sizeof(values[0]));
        at += count * sizeof(values[0]);
    };
    take(coded.words, uvBaseWords(layout) + size_t{cluster.vertex_count} * vertexWords(layout));
    take(coded.indices, size_t{cluster.triangle_count} * 3);
    const size_t first_morph =
        size_t{cluster.page_word} * 4 + clusterBytes(layout, cluster.vertex_count, cluster.triangle_count);
    at = page.data() + first_morph;
    take(coded.morphs, (end - first_morph) / 4);
    return coded;
}

/// Decodes, edits and encodes pages, for one thread.
class PageEditor
{
public:
    /// Return the page's stored bytes after the edit; empty if they stay unchanged.
    Result<std::vector<std::byte>> edited(const PackView& view, uint32_t page, const VisibilityEdit& edit)
    {
        const PageRecord& record = view.pages()[page];
        const MeshRecord& mesh = view.meshes()[record.mesh];
        if ((mesh.attributes & kVertexVisibility) == 0)
            return std::vector<std::byte>();
        if (record.codec != static_cast<uint32_t>(PageCodec::clusters))
            return Error{Issue::chunk_codec, view.name(), "page " + std::to_string(page),
                         "it is not stored as clusters, but with codec " + std::to_string(record.codec)};
        decoded_.resize(record.size);
        HEARTH_TRY(view.decodePage(page, decoded_));
        const auto clusters = recordsInRange(view.clusters(), record.clusters);
        std::vector<ClusterGeometry> geometry;
        codes_.clear();
        for (const ClusterRecord& cluster : clusters)
        {
            // cannot fail: the page was decoded with these clusters
            auto found = ClusterGeometry::at(decoded_, cluster, mesh);
            if (!found)
                return Error{Issue::meaning_geometry, view.name(), "page " + std::to_string(page),
                             "it does not hold the geometry of its clusters"};
            geometry.push_back(*found);
            for (uint32_t v = 0; v < found->vertexCount(); ++v)
                codes_.push_back(found->visibilityCode(v));
        }
        edit({page, record.mesh, record.clusters, geometry}, codes_);
        const auto walk =
            readWalkCodes(view.pageBytes().subspan(record.offset, record.stored_size), clusters);
        return encoder_.encodeAgain(clusters, mesh.attributes, applyCodes(clusters, mesh.attributes), walk);
    }

private:
    /// Return the stream codes of a page that was decoded: the first stream behind the header.
    std::span<const uint8_t> readWalkCodes(std::span<const std::byte> stored,
                                           std::span<const ClusterRecord> clusters)
    {
        size_t size = 0;
        for (const ClusterRecord& cluster : clusters)
            size += codeBytes(cluster.triangle_count);
        const size_t frame = ZSTD_findFrameCompressedSize(stored.data(), stored.size());
        const auto coded = static_cast<size_t>(ZSTD_getFrameContentSize(stored.data(), stored.size()));
        content_.resize(coded + stored.size() - frame);
        const size_t unpacked =
            ZSTD_decompressDCtx(context_.get(), content_.data(), coded, stored.data(), frame);
        HEARTH_ASSERT(unpacked == coded);
        std::memcpy(content_.data() + coded, stored.data() + frame, stored.size() - frame);
        return std::span(content_).subspan(sizeof(PageHeader), size);
    }

    std::span<CodedCluster> applyCodes(std::span<const ClusterRecord> clusters, uint32_t mesh_layout)
    {
        coded_.clear();
        const uint32_t* code = codes_.data();
        for (size_t c = 0; c < clusters.size(); ++c)
        {
            const uint32_t layout = clusterVertexLayout(clusters[c], mesh_layout);
            const size_t end =
                c + 1 < clusters.size() ? size_t{clusters[c + 1].page_word} * 4 : decoded_.size();
            coded_.push_back(copyCluster(decoded_, clusters[c], layout, end));
            uint32_t* word =
                coded_[c].words.data() + uvBaseWords(layout) + attributeWord(layout, kVertexVisibility);
            for (uint32_t v = 0; v < clusters[c].vertex_count; ++v, word += vertexWords(layout))
            {
                HEARTH_ASSERT(isLegalVisibility(*code));
                *word = *code++;
            }
        }
        return coded_;
    }

    struct FreeContext
    {
        void operator()(ZSTD_DCtx* freed) const { ZSTD_freeDCtx(freed); }
    };

    std::unique_ptr<ZSTD_DCtx, FreeContext> context_{ZSTD_createDCtx()};
    std::vector<uint8_t> content_;
    std::vector<std::byte> decoded_;
    std::vector<uint32_t> codes_;
    std::vector<CodedCluster> coded_;
    PageEncoder encoder_;
};

/// Append all pages, and set their offsets.
Status writePages(ContainerWriter& writer, const PackView& view, const VisibilityEdit& edit,
                  std::vector<PageRecord>& pages)
{
    tbb::enumerable_thread_specific<PageEditor> editors;
    std::vector<std::byte> padded;
    for (uint32_t first = 0; first < pages.size(); first += kBatchPages)
    {
        const auto count = std::min(kBatchPages, static_cast<uint32_t>(pages.size()) - first);
        std::vector<Result<std::vector<std::byte>>> batch(count, std::vector<std::byte>());
        tbb::parallel_for(uint32_t{0}, count,
                          [&](uint32_t i) { batch[i] = editors.local().edited(view, first + i, edit); });
        for (uint32_t i = 0; i < count; ++i)
        {
            HEARTH_ASSIGN_OR_RETURN(padded, std::move(batch[i]));
            PageRecord& page = pages[first + i];
            if (padded.empty())
            {
                const auto stored = view.pageBytes().subspan(page.offset, page.stored_size);
                padded.assign(stored.begin(), stored.end());
            }
            else
            {
                page.stored_size = static_cast<uint32_t>(padded.size());
                page.hash = hashBytes(padded);
            }
            page.offset = writer.chunkSize();
            padded.resize(alignChunk(padded.size()));
            HEARTH_TRY(writer.append(padded));
        }
    }
    return success();
}

} // namespace

Status rewriteVisibility(const ContainerReader& part, const std::string& output_path,
                         const VisibilityEdit& edit, const ReplacedChunks& replaced)
{
    HEARTH_ASSIGN_OR_RETURN(const PackView view, PackView::read(part));
    HEARTH_TRY(checkHierarchy(view));
    HEARTH_ASSIGN_OR_RETURN(ContainerWriter writer,
                            ContainerWriter::create(output_path, ContainerKind::part));
    std::vector<PageRecord> pages(view.pages().begin(), view.pages().end());
    // the page table can only be written after the pages, as in every clusters part
    bool pages_written = false, table_awaited = false;
    for (const ChunkEntry& entry : part.chunks())
    {
        if (std::ranges::find(replaced.types, entry.type) != replaced.types.end())
            continue;
        const ChunkId id{entry.type, entry.index, entry.version};
        if (entry.type == kChunkPages)
        {
            HEARTH_TRY(writer.beginChunk(id, entry.element_size));
            HEARTH_TRY(writePages(writer, view, edit, pages));
            HEARTH_TRY(writer.endChunk());
            pages_written = true;
        }
        if (entry.type == kChunkPageTable && !pages_written)
            table_awaited = true;
        else if (entry.type == kChunkPageTable || (entry.type == kChunkPages && table_awaited))
            HEARTH_TRY(writer.addRecords<PageRecord>(kChunkPageTable, pages));
        else if (entry.type != kChunkPages)
            HEARTH_TRY(writer.addStored(id, entry, part.stored(entry)));
    }
    if (replaced.write)
        HEARTH_TRY(replaced.write(writer));
    return writer.finish();
}

} // namespace hearth::pages
