// Measures size and decoding speed of a hierarchy's pages.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/hierarchy.h"

#include <string>
#include <vector>

namespace hearth::bench
{

struct PageFigures
{
    struct Kind
    {
        std::string name;
        double bytes; ///< share of the pages' stored bytes, by the entropy of the streams
    };
    std::vector<Kind> kinds;
    double decoded_bytes = 0;
    double seconds = 0;      ///< to decode all pages; minimum of several runs
    double zstd_seconds = 0; ///< zstd's part of `seconds`
};

PageFigures measurePages(const clusters::Hierarchy& hierarchy);

} // namespace hearth::bench
