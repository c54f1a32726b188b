// hearth diff --picture: both packs drawn by hearth-render, and held against each other by hearth-compare.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>
#include <vector>

namespace hearth::command
{

struct PictureOptions
{
    std::string output;            ///< the heat map, PNG
    std::vector<std::string> view; ///< options of hearth-render: from where, how large, what
};

struct PictureDiff
{
    int exit_code = 0;
    std::string error;   ///< the error line, where it is not 0
    std::string figures; ///< JSON, schema hearth.compare/1
};

/// Draw both packs, and write how their pictures differ.
PictureDiff diffPictures(const std::string& pack_a, const std::string& pack_b, const PictureOptions& options);

} // namespace hearth::command
