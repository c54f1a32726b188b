// Fuzzes a page with libFuzzer. The input gives the page's clusters, its zstd frame and the data behind it.
// The page is packed correctly, so that the search gets past zstd to the decoder of triangles and vertices.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/byte_reader.h"
#include "formats/codecs/cluster_bounds.h"
#include "formats/codecs/page_decode.h"

#include <zstd.h>

#include <cstdint>
#include <vector>

namespace
{

using namespace hearth;
using namespace hearth::formats;

constexpr uint32_t kLayouts[] = {0, kVertexNormal | kVertexUv0 | 14u << kVertexUvStepShift,
                                 kVertexNormal | kVertexTangent | kVertexUv0 | kVertexUv1 | kVertexColor |
                                     kVertexVisibility | 14u << kVertexUvStepShift,
                                 kVertexNormal | kVertexInfluences | kVertexInfluences8};

/// Read records from the input's first bytes, one behind the other.
std::vector<ClusterRecord> readRecords(ByteReader& reader, uint32_t layout, size_t& page_size)
{
    std::vector<ClusterRecord> records;
    for (uint8_t count = reader.read<uint8_t>().value_or(0) % 8; count > 0; --count)
    {
        ClusterRecord record{};
        record.vertex_count = reader.read<uint16_t>().value_or(3) % 260;
        record.triangle_count = reader.read<uint8_t>().value_or(1);
        record.extent_shift = reader.read<uint8_t>().value_or(0) % 8 == 7 ? 1 : 0;
        record.page_word = static_cast<uint16_t>(page_size / 4);
        page_size +=
            clusterBytes(clusterVertexLayout(record, layout), record.vertex_count, record.triangle_count);
        page_size += 4 * size_t{reader.read<uint8_t>().value_or(0) % 16u};
        records.push_back(record);
    }
    return records;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    ByteReader reader(std::as_bytes(std::span(data, size)));
    const uint32_t layout = kLayouts[reader.read<uint8_t>().value_or(0) % std::size(kLayouts)];
    size_t page_size = 0;
    const std::vector<ClusterRecord> records = readRecords(reader, layout, page_size);
    const auto rest = std::as_bytes(std::span(data, size)).subspan(reader.position());
    const std::vector<std::byte> content(rest.begin(), rest.end());
    const size_t coded = content.size() / 2;
    std::vector<std::byte> frame(ZSTD_compressBound(coded));
    frame.resize(ZSTD_compress(frame.data(), frame.size(), content.data(), coded, 1));
    frame.insert(frame.end(), content.begin() + static_cast<ptrdiff_t>(coded), content.end());
    static PageDecoder decoder;
    std::vector<std::byte> out(page_size);
    static_cast<void>(decoder.decode(frame, records, layout, out));
    static_cast<void>(decoder.decode(content, records, layout, out));
    return 0;
}
