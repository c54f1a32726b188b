// Tests messages about layers and depth of OpenEXR files, with files that are written byte by byte.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/images/decode.h"
#include "pipelines/import/part/part_builder.h"

#include <gtest/gtest.h>

#include <cstring>

namespace hearth::import
{

namespace
{

enum PixelType : uint32_t
{
    kUint = 0,
    kHalf = 1,
    kFloat = 2,
};

struct Channel
{
    std::string name;
    PixelType type = kHalf;
};

struct ExrPart
{
    std::string name;
    std::vector<Channel> channels; ///< in the order of their names, as the format asks
};

template <typename T>
void append(std::string& bytes, const T& value)
{
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

void appendAttribute(std::string& bytes, const char* name, const char* type, const std::string& value)
{
    bytes += std::string(name) + '\0' + type + '\0';
    append(bytes, static_cast<uint32_t>(value.size()));
    bytes += value;
}

std::string makeHeader(const ExrPart& part, bool is_multi_part)
{
    std::string channels;
    for (const Channel& channel : part.channels)
    {
        channels += channel.name + '\0';
        for (const uint32_t value : {uint32_t{channel.type}, 0u, 1u, 1u}) // type, linear, sampling
            append(channels, value);
    }
    std::string window, header;
    for (int i = 0; i < 4; ++i)
        append(window, uint32_t{0}); // one texel
    std::string one, center;
    append(one, 1.0f);
    append(center, uint64_t{0});
    appendAttribute(header, "channels", "chlist", channels + '\0');
    appendAttribute(header, "compression", "compression", std::string(1, '\0'));
    appendAttribute(header, "dataWindow", "box2i", window);
    appendAttribute(header, "displayWindow", "box2i", window);
    appendAttribute(header, "lineOrder", "lineOrder", std::string(1, '\0'));
    appendAttribute(header, "pixelAspectRatio", "float", one);
    appendAttribute(header, "screenWindowCenter", "v2f", center);
    appendAttribute(header, "screenWindowWidth", "float", one);
    if (is_multi_part)
    {
        std::string count;
        append(count, 1u);
        appendAttribute(header, "chunkCount", "int", count);
        appendAttribute(header, "name", "string", part.name);
        appendAttribute(header, "type", "string", "scanlineimage");
    }
    return header + '\0';
}

/// Return an uncompressed file of one black texel.
std::string makeExr(const std::vector<ExrPart>& parts)
{
    const bool is_multi_part = parts.size() > 1;
    std::string bytes;
    append(bytes, uint32_t{20000630});
    append(bytes, is_multi_part ? 0x1002u : 2u);
    for (const ExrPart& part : parts)
        bytes += makeHeader(part, is_multi_part);
    if (is_multi_part)
        bytes += '\0';
    std::string chunks;
    const size_t first = bytes.size() + parts.size() * sizeof(uint64_t);
    for (uint32_t i = 0; i < parts.size(); ++i)
    {
        append(bytes, uint64_t{first + chunks.size()});
        if (is_multi_part)
            append(chunks, i);
        uint32_t size = 0;
        for (const Channel& channel : parts[i].channels)
            size += channel.type == kHalf ? 2u : 4u;
        append(chunks, 0u); // line
        append(chunks, size);
        chunks.append(size, '\0');
    }
    return bytes + chunks;
}

/// Return "W1305: text" for each note of the file.
std::vector<std::string> listNotes(const std::vector<ExrPart>& parts)
{
    const std::string bytes = makeExr(parts);
    const auto image = decodeImage(std::as_bytes(std::span(bytes)), "a.exr", {});
    EXPECT_TRUE(image.ok()) << formatMessage(image.error());
    std::vector<std::string> notes;
    if (image.ok())
        for (const ImageNote& note : image->notes)
            notes.push_back("W" + std::to_string(static_cast<unsigned>(note.issue)) + ": " + note.text);
    return notes;
}

using Notes = std::vector<std::string>;

TEST(DecodeExr, keepsAnImageOfHalvesWhole)
{
    EXPECT_EQ(listNotes({{"", {{"B"}, {"G"}, {"R"}}}}), Notes{});
    EXPECT_EQ(listNotes({{"", {{"A"}, {"Y"}}}}), Notes{});
}

TEST(DecodeExr, namesLayersThatAreNotKept)
{
    EXPECT_EQ(listNotes({{"", {{"B"}, {"G"}, {"R"}, {"Z", kFloat}, {"diffuse.B"}, {"diffuse.R"}}}}),
              Notes{"W1305: layers beside the image are not kept: Z, diffuse"});
    EXPECT_EQ(listNotes({{"", {{"Y"}, {"a.Y"}, {"b.Y"}, {"c.x.Y"}, {"d.Y"}, {"e.Y"}, {"id", kUint}}}}),
              Notes{"W1305: layers beside the image are not kept: a, b, c.x, d and 2 more"});
}

TEST(DecodeExr, namesPartsThatAreNotKept)
{
    EXPECT_EQ(listNotes({{"beauty", {{"B"}, {"G"}, {"R"}}}, {"depth", {{"Z", kFloat}}}, {"N", {{"X"}}}}),
              Notes{"W1305: layers beside the image are not kept: part depth, part N"});
}

TEST(DecodeExr, saysThatFloatsBecomeHalves)
{
    EXPECT_EQ(listNotes({{"", {{"B", kFloat}, {"G"}, {"R"}}}}),
              Notes{"W1306: its channels have 32 bits, 16 are kept, as floats"});
}

} // namespace

} // namespace hearth::import
