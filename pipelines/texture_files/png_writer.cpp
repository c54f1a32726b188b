// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/texture_files/png_writer.h"

#include "formats/base/assert.h"

#include <zlib.h>

#include <cstdlib>
#include <string_view>

namespace hearth::texture_files
{

namespace
{

using Codes = std::vector<uint8_t>;

constexpr uint8_t kFilters = 5;

void addBigEndian(Codes& file, uint32_t value)
{
    for (const int shift : {24, 16, 8, 0})
        file.push_back(static_cast<uint8_t>(value >> shift));
}

void addChunk(Codes& file, std::string_view type, std::span<const uint8_t> content)
{
    addBigEndian(file, static_cast<uint32_t>(content.size()));
    const size_t start = file.size();
    file.insert(file.end(), type.begin(), type.end());
    file.insert(file.end(), content.begin(), content.end());
    addBigEndian(file, static_cast<uint32_t>(crc32_z(0, file.data() + start, file.size() - start)));
}

/// Return the neighbour that is nearest to left + above - corner.
int predictPaeth(int left, int above, int corner)
{
    const int to_left = std::abs(above - corner), to_above = std::abs(left - corner),
              to_corner = std::abs(left + above - 2 * corner);
    if (to_left <= to_above && to_left <= to_corner)
        return left;
    return to_above <= to_corner ? above : corner;
}

/// Set `result` to the row's differences to what a filter predicts. Returns the sum of their sizes.
/// above  row before; zeros for the first one
/// step   bytes of a texel
template <typename Predict>
uint64_t filterRow(const Predict& predict, std::span<const uint8_t> row, std::span<const uint8_t> above,
                   size_t step, std::span<uint8_t> result)
{
    uint64_t sum = 0;
    for (size_t i = 0; i < row.size(); ++i)
    {
        const int left = i < step ? 0 : row[i - step];
        const int corner = i < step ? 0 : above[i - step];
        result[i] = static_cast<uint8_t>(row[i] - predict(left, int{above[i]}, corner));
        sum += static_cast<uint64_t>(std::abs(static_cast<int8_t>(result[i])));
    }
    return sum;
}

/// The same with the filter of a number.
uint64_t filterRow(uint8_t filter, std::span<const uint8_t> row, std::span<const uint8_t> above, size_t step,
                   std::span<uint8_t> result)
{
    switch (filter)
    {
    case 0:
        return filterRow([](int, int, int) { return 0; }, row, above, step, result);
    case 1:
        return filterRow([](int left, int, int) { return left; }, row, above, step, result);
    case 2:
        return filterRow([](int, int up, int) { return up; }, row, above, step, result);
    case 3:
        return filterRow([](int left, int up, int) { return (left + up) / 2; }, row, above, step, result);
    default:
        return filterRow(predictPaeth, row, above, step, result);
    }
}

/// Filter each row by the filter with the smallest differences.
Codes filterRows(std::span<const uint8_t> codes, size_t row_bytes, size_t step)
{
    Codes rows;
    rows.reserve(codes.size() + codes.size() / row_bytes);
    const Codes zeros(row_bytes);
    Codes best(row_bytes), candidate(row_bytes);
    for (size_t at = 0; at < codes.size(); at += row_bytes)
    {
        const auto row = codes.subspan(at, row_bytes);
        const auto above = at == 0 ? std::span(zeros) : codes.subspan(at - row_bytes, row_bytes);
        uint8_t best_filter = 0;
        uint64_t smallest = filterRow(best_filter, row, above, step, best);
        for (uint8_t filter = 1; filter < kFilters; ++filter)
            if (const uint64_t sum = filterRow(filter, row, above, step, candidate); sum < smallest)
            {
                smallest = sum;
                best_filter = filter;
                best.swap(candidate);
            }
        rows.push_back(best_filter);
        rows.insert(rows.end(), best.begin(), best.end());
    }
    return rows;
}

Codes deflateCodes(const Codes& codes)
{
    uLongf size = compressBound(codes.size());
    Codes stream(size);
    HEARTH_ASSERT(compress2(stream.data(), &size, codes.data(), codes.size(), Z_DEFAULT_COMPRESSION) == Z_OK);
    stream.resize(size);
    return stream;
}

} // namespace

std::vector<std::byte> writePng(uint32_t width, uint32_t height, PngFormat format,
                                std::span<const uint8_t> codes)
{
    const size_t step = size_t{format.channels} * format.bits / 8;
    HEARTH_ASSERT(width > 0 && height > 0 && codes.size() == step * width * height);
    constexpr uint8_t kColor = 2, kColorAndAlpha = 6;
    Codes header;
    addBigEndian(header, width);
    addBigEndian(header, height);
    header.insert(header.end(),
                  {static_cast<uint8_t>(format.bits), format.channels == 4 ? kColorAndAlpha : kColor, 0, 0,
                   0}); // deflate, filters, no interlace
    Codes file = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    addChunk(file, "IHDR", header);
    addChunk(file, "IDAT", deflateCodes(filterRows(codes, step * width, step)));
    addChunk(file, "IEND", {});
    const auto bytes = std::as_bytes(std::span(file));
    return {bytes.begin(), bytes.end()};
}

} // namespace hearth::texture_files
