// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/codecs/page_streams.h"

#include "formats/base/byte_reader.h"
#include "formats/codecs/cluster_bounds.h"

namespace hearth::formats::page
{

namespace
{

/// True if the planes are possible for these lanes.
bool areLegalForms(const LaneForms& forms, const VertexLanes& lanes)
{
    for (size_t lane = 0; lane < kMaxLanes; ++lane)
    {
        const bool bytes = lane < lanes.count && lanes.kinds[lane] == LaneKind::bytes;
        const bool shared = lane < lanes.count && sharesMainByte(lanes, lane);
        const uint32_t most_planes = lane >= lanes.count || (shared && lane % 2 == 1) ? 0
                                     : bytes ? kPlaneMain | kPlaneSecond | kPlaneNibbles
                                             : kPlaneMain;
        const uint32_t most_bits = lane >= lanes.count || bytes ? 0
                                   : shared                     ? kMaxLowBitsAboveFour
                                                                : kMaxLowBits;
        if (forms.planes[lane] > most_planes || forms.low_bits[lane] > most_bits)
            return false;
    }
    return true;
}

/// True if no code is 12 to 14, which are unused.
bool areLegalCodes(std::span<const std::byte> codes)
{
    const auto illegal = [](uint32_t code) { return ((code + 4) & 15u) < 3 ? 1u : 0u; };
    uint32_t found = 0;
    for (const std::byte pair : codes)
        found |= illegal(static_cast<uint8_t>(pair)) | illegal(static_cast<uint8_t>(pair) >> 4);
    return found == 0;
}

} // namespace

bool PageStreamSizes::add(const ClusterRecord& cluster, uint32_t mesh_layout, size_t& end)
{
    if (cluster.vertex_count > kMaxClusterVertices || cluster.triangle_count > kMaxClusterTriangles ||
        size_t{cluster.page_word} * 4 < end)
        return false;
    morph_words += cluster.page_word - end / 4;
    end = size_t{cluster.page_word} * 4;
    const uint32_t layout = clusterVertexLayout(cluster, mesh_layout);
    end += clusterBytes(layout, cluster.vertex_count, cluster.triangle_count);
    codes += codeBytes(cluster.triangle_count);
    uv_base_bytes += size_t{uvBaseWords(layout)} * 4;
    if (layout & kVertexWideOffsets)
        wide_bytes += size_t{cluster.vertex_count} * vertexWords(layout) * 4;
    else
        slots += cluster.vertex_count;
    return true;
}

bool PageStreamSizes::finish(size_t end, size_t page_size)
{
    if (page_size < end || (page_size - end) % 4 != 0)
        return false;
    morph_words += (page_size - end) / 4;
    return true;
}

std::optional<Streams> splitContent(std::span<const std::byte> content, const PageStreamSizes& shape,
                                    const VertexLanes& lanes)
{
    ByteReader reader(content);
    const auto header = reader.read<PageHeader>();
    if (!header)
        return std::nullopt;
    bool good = true;
    const auto take = [&](size_t size)
    {
        const auto bytes = reader.readBytes(size);
        good = good && bytes.has_value();
        const auto* at = bytes ? reinterpret_cast<const uint8_t*>(bytes->data()) : nullptr;
        return Stream{at, at + (bytes ? size : 0)};
    };
    Streams streams;
    streams.header = *header;
    streams.codes = take(shape.codes);
    good = good && areLegalCodes(content.subspan(sizeof(PageHeader), shape.codes));
    for (const size_t place : {size_t{0}, size_t{1}})
        streams.restarts[place] = take(header->restarts[place]);
    for (const size_t place : {size_t{0}, size_t{1}})
        streams.reuses[place] = take(header->reuses[place]);
    streams.references = take(size_t{header->references} * 2).at;
    streams.uv_bases = take(shape.uv_base_bytes);
    streams.wide = take(shape.wide_bytes);
    const auto more_lanes = reader.readBytes(moreLaneBytes(lanes));
    streams.forms = readLaneForms(*header, more_lanes.value_or(std::span<const std::byte>()));
    if (!more_lanes || !areLegalForms(streams.forms, lanes))
        return std::nullopt;
    for (const uint8_t*& plane : streams.morphs)
        plane = take(shape.morph_words).at;
    streams.escapes = take(size_t{header->escapes} * 2);
    const auto takePlanes = [&](bool of_bytes, uint32_t part, auto& planes)
    {
        for (size_t lane = 0; lane < lanes.count; ++lane)
            if ((lanes.kinds[lane] == LaneKind::bytes) == of_bytes &&
                (streams.forms.planes[lane] & part) != 0)
                planes[lane] = take(header->new_vertices).at;
    };
    takePlanes(false, kPlaneMain, streams.main);
    takePlanes(true, kPlaneMain, streams.main);
    takePlanes(true, kPlaneSecond, streams.second);
    for (size_t block = 0; block < kMaxLaneBlocks; ++block)
        for (size_t plane = 0; plane < lowBitFields(streams.forms, block).planes(); ++plane)
            streams.low_bits[block][plane] = take(header->new_vertices).at;
    if (!good || reader.remaining() != 0)
        return std::nullopt;
    return streams;
}

} // namespace hearth::formats::page
