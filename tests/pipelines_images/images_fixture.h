// Decodes images by hearth-images, and compares texels.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/images/images_program.h"
#include "tests/pipelines_images/artist_files.h"

#include <gtest/gtest.h>

#include <cstring>

namespace hearth::test
{

/// The program, which all tests of a file share: it takes long to start.
inline import::ImagesProgram& sharedProgram()
{
    static import::ImagesProgram program(HEARTH_BIN "/hearth-images");
    return program;
}

struct Asked
{
    std::string layer{};
    bool convert_icc = false;
};

inline Result<import::DecodedImage> decode(images::Format format, const std::string& file,
                                           const Asked& asked = {}, const import::ImportLimits& limits = {},
                                           import::ImagesProgram& program = sharedProgram())
{
    const std::string name = "file";
    const import::EncodedImage source{std::as_bytes(std::span(file)), name, limits};
    return program.decode(format, source, asked.layer, asked.convert_icc);
}

/// Return the channels as numbers: codes, or the bits of halves.
inline std::vector<uint32_t> listChannels(const import::DecodedImage& image)
{
    std::vector<uint32_t> numbers;
    for (size_t i = 0; i < image.texels.size(); i += image.channelBytes())
    {
        uint16_t number = 0;
        std::memcpy(&number, image.texels.data() + i, image.channelBytes());
        numbers.push_back(number);
    }
    return numbers;
}

/// Return "W1305 text" for each note.
inline std::vector<std::string> listNotes(const import::DecodedImage& image)
{
    std::vector<std::string> notes;
    for (const import::ImageNote& note : image.notes)
        notes.push_back("W" + std::to_string(static_cast<unsigned>(note.issue)) + " " + note.text);
    return notes;
}

using Numbers = std::vector<uint32_t>;
using Notes = std::vector<std::string>;

/// Compare the texels of a file with RGBA, row by row, and its notes.
inline void expectTexels(images::Format format, const std::string& file, const Numbers& rgba,
                         const Notes& notes = {}, const Asked& asked = {})
{
    const auto image = decode(format, file, asked);
    ASSERT_TRUE(image.ok()) << formatMessage(image.error());
    EXPECT_EQ(listChannels(*image), rgba);
    EXPECT_EQ(listNotes(*image), notes);
}

inline void expectRefused(images::Format format, const std::string& file, Issue issue,
                          const std::string& detail)
{
    const auto image = decode(format, file);
    ASSERT_FALSE(image.ok());
    EXPECT_EQ(image.error().issue, issue) << formatMessage(image.error());
    EXPECT_NE(image.error().detail.find(detail), std::string::npos) << formatMessage(image.error());
}

} // namespace hearth::test
