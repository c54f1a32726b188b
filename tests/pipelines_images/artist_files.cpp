// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/pipelines_images/artist_files.h"

#include <algorithm>
#include <map>

namespace hearth::test
{

namespace
{

constexpr uint32_t kTile = 16;

/// Return the samples of a rectangle of one plane, or of all channels; zeros beyond the image.
std::string cutSamples(const TiffImage& image, uint32_t x0, uint32_t y0, uint32_t width, uint32_t height,
                       std::optional<uint32_t> plane, bool is_big_endian)
{
    std::string bytes;
    for (uint32_t y = y0; y < y0 + height; ++y)
    {
        uint32_t bit_count = 0, bits = 0;
        for (uint32_t x = x0; x < x0 + width; ++x)
            for (uint32_t c = plane.value_or(0); c < (plane ? *plane + 1 : image.channel_count); ++c)
            {
                const bool is_inside = x < image.width && y < image.height;
                const size_t at = (size_t{y} * image.width + x) * image.channel_count + c;
                const uint64_t sample = is_inside ? image.samples[at] : 0;
                if (image.bits >= 8)
                {
                    appendNumber(bytes, sample, image.bits / 8, is_big_endian);
                    continue;
                }
                bits = bits << image.bits | static_cast<uint32_t>(sample);
                bit_count += image.bits;
                if (bit_count == 8)
                {
                    bytes += static_cast<char>(bits);
                    bits = bit_count = 0;
                }
            }
        if (bit_count > 0)
            bytes += static_cast<char>(bits << (8 - bit_count));
    }
    return bytes;
}

struct Field
{
    uint32_t type = 3; ///< 3: 16 bits, 4: 32 bits, 7: bytes
    std::vector<uint64_t> values{};
};

/// Append the image's data, and its directory, which starts at an even offset that is returned.
uint32_t appendImage(const TiffImage& image, bool is_big_endian, std::string& file, size_t& next_link)
{
    std::vector<uint64_t> offsets, sizes;
    const uint32_t step_x = image.is_tiled ? kTile : image.width;
    const uint32_t step_y = image.is_tiled ? kTile : image.height;
    for (uint32_t plane = 0; plane < (image.is_planar ? image.channel_count : 1); ++plane)
        for (uint32_t y = 0; y < image.height; y += step_y)
            for (uint32_t x = 0; x < image.width; x += step_x)
            {
                const std::string data =
                    cutSamples(image, x, y, step_x, step_y,
                               image.is_planar ? std::optional(plane) : std::nullopt, is_big_endian);
                offsets.push_back(file.size());
                sizes.push_back(data.size());
                file += data;
                file.resize((file.size() + 1) & ~size_t{1});
            }
    std::map<uint32_t, Field> fields{
        {256, {4, {image.width}}},
        {257, {4, {image.height}}},
        {258, {3, std::vector<uint64_t>(image.channel_count, image.bits)}},
        {259, {3, {1}}},
        {262, {3, {image.photometric}}},
        {274, {3, {image.orientation}}},
        {277, {3, {image.channel_count}}},
        {284, {3, {image.is_planar ? 2u : 1u}}},
        {339, {3, std::vector<uint64_t>(image.channel_count, image.sample_format)}},
    };
    if (image.is_tiled)
    {
        fields[322] = fields[323] = {4, {kTile}};
        fields[324] = {4, offsets};
        fields[325] = {4, sizes};
    }
    else
    {
        fields[273] = {4, offsets};
        fields[278] = {4, {image.height}};
        fields[279] = {4, sizes};
    }
    if (!image.extra.empty())
        fields[338] = {3, {image.extra.begin(), image.extra.end()}};
    if (!image.palette.empty())
        fields[320] = {3, {image.palette.begin(), image.palette.end()}};
    if (!image.profile.empty())
        for (const char byte : image.profile)
            (fields[34675].type = 7, fields[34675].values.push_back(static_cast<uint8_t>(byte)));

    std::string directory;
    appendNumber(directory, fields.size(), 2, is_big_endian);
    for (const auto& [tag, field] : fields)
    {
        const size_t size = field.type == 3 ? 2 : field.type == 4 ? 4 : 1;
        std::string values;
        for (const uint64_t value : field.values)
            appendNumber(values, value, size, is_big_endian);
        appendNumber(directory, tag, 2, is_big_endian);
        appendNumber(directory, field.type, 2, is_big_endian);
        appendNumber(directory, field.values.size(), 4, is_big_endian);
        if (values.size() > 4)
        {
            const size_t offset = file.size();
            file += values;
            file.resize((file.size() + 1) & ~size_t{1});
            values.clear();
            appendNumber(values, offset, 4, is_big_endian);
        }
        values.resize(4);
        directory += values;
    }
    const size_t start = file.size();
    next_link = start + directory.size();
    file += directory + std::string(4, '\0');
    return static_cast<uint32_t>(start);
}

/// Pack a row as PackBits: runs of three or more, and literals.
std::string packBits(const std::string& row)
{
    std::string packed;
    for (size_t i = 0; i < row.size();)
    {
        size_t run = 1;
        while (run < 128 && i + run < row.size() && row[i + run] == row[i])
            ++run;
        if (run >= 3)
        {
            packed += static_cast<char>(257 - run);
            packed += row[i];
            i += run;
            continue;
        }
        const size_t count = std::min<size_t>(5, row.size() - i);
        packed += static_cast<char>(count - 1);
        packed += row.substr(i, count);
        i += count;
    }
    return packed;
}

void appendResource(std::string& resources, uint32_t id, const std::string& content)
{
    resources += "8BIM";
    appendNumber(resources, id, 2, true);
    resources += std::string(2, '\0'); // no name
    appendNumber(resources, content.size(), 4, true);
    resources += content + std::string(content.size() & 1, '\0');
}

} // namespace

void appendNumber(std::string& bytes, uint64_t number, size_t size, bool is_big_endian)
{
    for (size_t i = 0; i < size; ++i)
        bytes += static_cast<char>(number >> 8 * (is_big_endian ? size - 1 - i : i));
}

std::string makeTiff(const std::vector<TiffImage>& images, bool is_big_endian)
{
    std::string file = is_big_endian ? "MM" : "II";
    appendNumber(file, 42, 2, is_big_endian);
    size_t link = file.size();
    file += std::string(4, '\0');
    for (const TiffImage& image : images)
    {
        size_t next_link = 0;
        const uint32_t start = appendImage(image, is_big_endian, file, next_link);
        std::string offset;
        appendNumber(offset, start, 4, is_big_endian);
        file.replace(link, 4, offset);
        link = next_link;
    }
    return file;
}

std::string makePsd(const PsdImage& image)
{
    std::string resources;
    if (image.has_composite)
    {
        std::string info;
        appendNumber(info, 1, 4, true);
        info += static_cast<char>(*image.has_composite);
        appendResource(resources, 1057, info + std::string(12, '\0'));
    }
    if (!image.profile.empty())
        appendResource(resources, 1039, image.profile);
    const size_t length_size = image.is_big ? 8 : 4;
    std::string layers;
    if (image.has_transparency)
    {
        appendNumber(layers, 2, length_size, true);
        appendNumber(layers, 0xFFFF, 2, true); // one layer, negative: the first alpha is transparency
    }

    std::string file = "8BPS";
    appendNumber(file, image.is_big ? 2 : 1, 2, true);
    file += std::string(6, '\0');
    appendNumber(file, image.channel_count, 2, true);
    appendNumber(file, image.height, 4, true);
    appendNumber(file, image.width, 4, true);
    appendNumber(file, image.depth, 2, true);
    appendNumber(file, image.mode, 2, true);
    appendNumber(file, image.palette.size(), 4, true);
    file += image.palette;
    appendNumber(file, resources.size(), 4, true);
    file += resources;
    appendNumber(file, layers.size(), length_size, true);
    file += layers;
    appendNumber(file, image.is_packed ? 1 : 0, 2, true);

    const size_t row_samples = image.depth == 1 ? (image.width + 7) / 8 : image.width;
    std::string sizes, rows;
    for (size_t at = 0; at < image.samples.size(); at += row_samples)
    {
        std::string row;
        for (size_t x = 0; x < row_samples; ++x)
            appendNumber(row, image.samples[at + x], std::max<size_t>(1, image.depth / 8), true);
        const std::string stored = image.is_packed ? packBits(row) : row;
        appendNumber(sizes, stored.size(), image.is_big ? 4 : 2, true);
        rows += stored;
    }
    return file + (image.is_packed ? sizes : "") + rows;
}

} // namespace hearth::test
