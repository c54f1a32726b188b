// hearth diff --image: renders both packs with hearth-render, and compares the images with hearth-compare.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>
#include <vector>

namespace hearth::command
{

struct ImageDiffOptions
{
    std::string output;            ///< the heat map, PNG
    std::vector<std::string> view; ///< options of hearth-render: camera, size, view
};

struct ImageDiff
{
    int exit_code = 0;
    std::string error;   ///< error line, if exit_code is not 0
    std::string figures; ///< JSON, schema hearth.compare/1
};

/// Render both packs, and write a heat map of their differences.
ImageDiff diffImages(const std::string& pack_a, const std::string& pack_b, const ImageDiffOptions& options);

} // namespace hearth::command
